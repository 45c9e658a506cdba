// Computes the density of boundary particles from the water around their ghost nodes (mdbc.rs).

@group(0) @binding(1) var<storage, read> records: array<Record>;
@group(0) @binding(2) var<storage, read> water_start: array<u32>;
@group(0) @binding(3) var<storage, read> order: array<u32>;
@group(0) @binding(4) var<storage, read> cell: array<vec4<i32>>;
@group(0) @binding(5) var<storage, read> to_surface: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> offset: array<vec4<f32>>;
// rho - rho0 of the boundary [kg/m3].
@group(0) @binding(7) var<storage, read_write> density: array<f32>;

// Sums over the water particles around a ghost node. W is the kernel, g = -G h^2 with the factor G of the kernel
// gradient (kernel.rs), V the volume of a particle, (x, y, z) the vector from the node to the particle in units of h,
// and f = rho - rho0 [kg/m3].
struct NodeSums {
    // Sum of W V (x, y, z, 1).
    value: vec4<f32>,
    // Sum of W V f.
    value_f: f32,
    // Sums of g V (x, y, z) and of g V f (x, y, z).
    first: vec3<f32>,
    first_f: vec3<f32>,
    // Sums of g V (xx, yy, zz) and of g V (xy, xz, yz).
    squares: vec3<f32>,
    products: vec3<f32>,
}

fn sum_around_node(node: vec4<f32>) -> NodeSums {
    var sums: NodeSums;
    let reach = 1.0 / parameters.inv_2h;
    let rows = rows_within(node, reach);
    for (var up = rows.first.y; up <= rows.last.y; up++) {
        for (var across = rows.first.x; across <= rows.last.x; across++) {
            let bins = bins_within(node, reach, vec2<i32>(across, up));
            if bins.x > bins.y {
                continue;
            }
            for (var j = water_start[bins.x]; j < water_start[bins.y + 1u]; j++) {
                let r = -difference(node, records[j].place);
                let closeness = closeness_of(length(r));
                if closeness == 0.0 {
                    continue;
                }
                let volume = records[j].motion.w;
                let f = records[j].state.x;
                let wv = kernel_shape(closeness) * volume;
                let gv = gradient_shape(closeness) * volume;
                sums.value += wv * vec4<f32>(r, 1.0);
                sums.value_f += wv * f;
                let gr = gv * r;
                sums.first += gr;
                sums.first_f += gr * f;
                sums.squares += gr * r;
                sums.products += gr.xxy * r.yzz;
            }
        }
    }
    let h = parameters.h;
    let w = parameters.kernel_scale;
    let g = -parameters.gradient_scale * h * h;
    sums.value *= vec4<f32>(vec3<f32>(w / h), w);
    sums.value_f *= w;
    sums.first *= g / h;
    sums.first_f *= g / h;
    sums.squares *= g / (h * h);
    sums.products *= g / (h * h);
    return sums;
}

// Returns the trust in the fitted gradient (0 to 1), from the centroid of the water around the node and the spread of
// this water along the wall normal. `surface` is the vector from the boundary particle to its surface [m].
fn trust_in(sums: NodeSums, surface: vec3<f32>) -> f32 {
    let far = length(surface);
    var normal = vec3<f32>(0.0);
    if far > 0.0 {
        normal = surface / far;
    }
    let occupied = sums.value.w;
    let behind = -dot(sums.value.xyz, normal) / occupied;
    let s = sums.squares;
    let p = sums.products;
    let along = vec3<f32>(dot(vec3<f32>(s.x, p.x, p.y), normal), dot(vec3<f32>(p.x, s.y, p.z), normal),
                          dot(vec3<f32>(p.y, p.z, s.z), normal));
    let spread = dot(along, normal) / occupied;
    let place = parameters.centroid_limits;
    let layers = parameters.spread_limits;
    return clamp((place.y - behind) / (place.y - place.x), 0.0, 1.0)
        * clamp((spread - layers.x) / (layers.y - layers.x), 0.0, 1.0);
}

// Returns the fitted rho - rho0 at the boundary particle, or `mean` if the equations are ill-conditioned. `back` is the
// vector from the node to the boundary particle [h].
fn fitted(sums: NodeSums, back: vec3<f32>, mean: f32) -> f32 {
    var s = sums.squares;
    // In a two-dimensional flume, sum g V yy is zero; use the value of a full neighbourhood instead.
    s.y = select(s.y, sums.value.w, s.y == 0.0);
    let p = sums.products;
    var rows = array<vec4<f32>, 4>(
        sums.value.wxyz,
        vec4<f32>(sums.first.x, s.x, p.x, p.y),
        vec4<f32>(sums.first.y, p.x, s.y, p.z),
        vec4<f32>(sums.first.z, p.y, p.z, s.z),
    );
    var right = vec4<f32>(sums.value_f, sums.first_f);
    var determinant = 1.0;
    for (var column = 0u; column < 4u; column++) {
        var pivot = column;
        for (var i = column + 1u; i < 4u; i++) {
            if abs(rows[i][column]) > abs(rows[pivot][column]) {
                pivot = i;
            }
        }
        let lead = rows[pivot];
        let lead_right = right[pivot];
        rows[pivot] = rows[column];
        right[pivot] = right[column];
        rows[column] = lead;
        right[column] = lead_right;
        determinant *= lead[column];
        if lead[column] == 0.0 {
            return mean;
        }
        for (var i = column + 1u; i < 4u; i++) {
            let factor = rows[i][column] / lead[column];
            rows[i] -= factor * lead;
            right[i] -= factor * lead_right;
        }
    }
    let occupied = sums.value.w;
    if abs(determinant) < parameters.least_determinant * occupied * occupied * occupied * occupied {
        return mean;
    }
    let z = right.w / rows[3].w;
    let y = (right.z - rows[2].w * z) / rows[2].z;
    let x = (right.y - rows[1].w * z - rows[1].z * y) / rows[1].y;
    let value = (right.x - rows[0].w * z - rows[0].z * y - rows[0].y * x) / rows[0].x;
    return value + dot(vec3<f32>(x, y, z), back);
}

// Returns the vector from the surface point of a boundary particle to its ghost node [m]; `surface` [m] is the vector
// from the particle to its surface point (`beyond` in mdbc.rs).
fn beyond(surface: vec3<f32>) -> vec3<f32> {
    let way = length(surface.xy);
    if way <= parameters.longest_way {
        return surface;
    }
    return vec3<f32>(surface.xy * (parameters.longest_way / way), surface.z);
}

// Returns rho - rho0 of the boundary particle; `surface` [m] is the vector from the particle to its surface.
fn excess_density(sums: NodeSums, surface: vec3<f32>) -> f32 {
    let occupied = sums.value.w;
    if occupied < parameters.dry {
        return 0.0;
    }
    let back = -2.0 * beyond(surface) / parameters.h;
    let above_centroid = back.z - sums.value.z / occupied;
    let mean = sums.value_f / occupied + parameters.density_slope * above_centroid * parameters.h;
    let trust = trust_in(sums, surface);
    var excess = mean;
    if trust > 0.0 {
        excess += trust * (fitted(sums, back, mean) - mean);
    }
    // Walls exert no suction on the water.
    return max(excess, 0.0);
}

@compute @workgroup_size(64)
fn densities(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
             @builtin(local_invocation_index) local: u32) {
    let place = thread_number(group, groups, local);
    if place >= parameters.boundary {
        return;
    }
    let i = order[place];
    let surface = to_surface[i].xyz;
    var node = split(cell[i].xyz, offset[i].xyz + (surface + beyond(surface)));
    if PERIODIC {
        node.z -= parameters.width * round(node.z / parameters.width);
    }
    density[i] = excess_density(sum_around_node(node), surface);
}
