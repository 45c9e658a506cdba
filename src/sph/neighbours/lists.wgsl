// Finds the bins within a distance (`reach`) of a point, row by row (lists.rs). A row of bins extends along x.

// First and last row of bins within reach of a point, as indices (along y, along z). In a periodic flume, the index
// along y can lie outside the grid; `bins_within` takes it modulo the number of bins along y.
struct Rows {
    first: vec2<i32>,
    last: vec2<i32>,
}

fn rows_within(place: vec4<f32>, reach: f32) -> Rows {
    let middle = 0.5 * vec2<f32>(parameters.count.yz);
    let low = vec2<i32>(floor((place.zw - reach) / parameters.size.yz + middle));
    let high = vec2<i32>(floor((place.zw + reach) / parameters.size.yz + middle));
    let last = parameters.count.yz - 1;
    var rows: Rows;
    rows.first = clamp(low, vec2<i32>(0), last);
    rows.last = clamp(high, vec2<i32>(0), last);
    if PERIODIC {
        rows.first.x = low.x;
        rows.last.x = min(high.x, low.x + last.x);
    }
    return rows;
}

// Returns the first and the last bin of a row within reach of a point; first > last if there is no such bin. `row` has
// the indices of the row along y and z.
fn bins_within(place: vec4<f32>, reach: f32, row: vec2<i32>) -> vec2<u32> {
    var middle = (vec2<f32>(row) + 0.5 - 0.5 * vec2<f32>(parameters.count.yz)) * parameters.size.yz - place.zw;
    let last = parameters.count.yz - 1;
    // The outermost bins of the grid extend to infinity, because they also contain particles outside the grid.
    if (row.y == 0 && middle.y > 0.0) || (row.y == last.y && middle.y < 0.0) {
        middle.y = 0.0;
    }
    var across = row.x;
    if PERIODIC {
        middle.x -= parameters.width * round(middle.x / parameters.width);
        across = (row.x % parameters.count.y + parameters.count.y) % parameters.count.y;
    } else if (row.x == 0 && middle.x > 0.0) || (row.x == last.x && middle.x < 0.0) {
        middle.x = 0.0;
    }
    let gap = max(abs(middle) - 0.5 * parameters.size.yz, vec2<f32>(0.0));
    let rest = reach * reach - dot(gap, gap);
    if rest < 0.0 {
        return vec2<u32>(1u, 0u);
    }
    let along = sqrt(rest);
    let bin = i32(place.x);
    let ends = vec2<i32>(floor(vec2<f32>(place.y - along, place.y + along) / parameters.size.x)) + bin;
    let clamped = clamp(ends, vec2<i32>(0), vec2<i32>(parameters.count.x - 1));
    let begin = (row.y * parameters.count.y + across) * parameters.count.x;
    return vec2<u32>(begin + clamped);
}

// Returns the vector from b to a [m]; in a periodic flume, from the nearest periodic image of b.
fn difference(a: vec4<f32>, b: vec4<f32>) -> vec3<f32> {
    var r = vec3<f32>((a.x - b.x) * parameters.size.x + (a.y - b.y), a.zw - b.zw);
    if PERIODIC {
        r.y -= parameters.width * round(r.y / parameters.width);
    }
    return r;
}
