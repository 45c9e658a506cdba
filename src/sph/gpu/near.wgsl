// The water near surfaces (near.rs): gathered for the host, which knows all shapes and changes the velocities.

// Numbers of each kind of shape, which follow each other in `shapes`.
struct Surfaces {
    // Segments of the outline, x and z of both ends [m].
    segments: u32,
    // Low and high corners of obstacles [m].
    obstacles: u32,
    // Bounding spheres of the units' parts, radius with the distance [m].
    spheres: u32,
    // Displacements of the rows of the wavemaker [m].
    rows: u32,
    // Distance from a surface at which the approach ends, and a little [m].
    min_distance: f32,
    // Rows of the wavemaker: place, height of the lowest, distance of one from the next [m].
    place: f32,
    lowest: f32,
    dp: f32,
    // Width between side walls; negative if there are none [m].
    sides: f32,
    // Side walls begin here [m].
    low_side: f32,
    // Particles that there is room for.
    room: u32,
}

struct Near {
    // Cell and number.
    cell: vec4<i32>,
    offset: vec4<f32>,
    motion: vec4<f32>,
}

@group(0) @binding(1) var<uniform> surfaces: Surfaces;
@group(0) @binding(2) var<storage, read> offset: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> cell: array<vec4<i32>>;
@group(0) @binding(4) var<storage, read_write> motion: array<vec4<f32>>;
// From the low corner of the grid.
@group(0) @binding(5) var<storage, read> shapes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> near: array<Near>;
// The last one counts the near particles; for the others see step.wgsl.
@group(0) @binding(7) var<storage, read_write> extremes: array<atomic<u32>, 5>;
// Bits of a velocity, and the particle's place. As whole numbers: small ones would be lost as bits of a number.
@group(0) @binding(8) var<storage, read> changes: array<vec4<u32>>;

// Within the distance of the outline or behind it.
fn is_near_outline(at: vec2<f32>) -> bool {
    var least = 1e30;
    var behind = false;
    for (var k = 0u; k < surfaces.segments; k++) {
        let piece = shapes[k];
        let along = piece.zw - piece.xy;
        let from_start = at - piece.xy;
        let t = clamp(dot(from_start, along) / dot(along, along), 0.0, 1.0);
        let away = length(from_start - t * along);
        // Where two segments meet in the nearest corner, being behind one of them is enough.
        if away < least + 1e-6 {
            let is_behind = dot(from_start, vec2<f32>(-along.y, along.x)) < 0.0;
            behind = is_behind || (behind && away > least - 1e-6);
            least = min(least, away);
        }
    }
    return least < surfaces.min_distance || behind;
}

fn is_near_shape(at: vec3<f32>) -> bool {
    var k = surfaces.segments;
    for (let end = k + 2u * surfaces.obstacles; k < end; k += 2u) {
        if all(at > shapes[k].xyz - surfaces.min_distance) && all(at < shapes[k + 1u].xyz + surfaces.min_distance) {
            return true;
        }
    }
    for (let end = k + surfaces.spheres; k < end; k++) {
        var r = at - shapes[k].xyz;
        if PERIODIC {
            r.y -= parameters.width * round(r.y / parameters.width);
        }
        if dot(r, r) < shapes[k].w * shapes[k].w {
            return true;
        }
    }
    if surfaces.rows > 0u {
        let row = clamp(i32(round((at.z - surfaces.lowest) / surfaces.dp)), 0, i32(surfaces.rows) - 1);
        if at.x < surfaces.place + shapes[k + u32(row)].x + surfaces.min_distance {
            return true;
        }
    }
    if surfaces.sides > 0.0 {
        let y = at.y - surfaces.low_side;
        return y < surfaces.min_distance || y > surfaces.sides - surfaces.min_distance;
    }
    return false;
}

@compute @workgroup_size(64)
fn find_near(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
             @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= parameters.water {
        return;
    }
    let at = vec3<f32>(cell[i].xyz) * parameters.size + offset[i].xyz;
    if is_near_shape(at) || is_near_outline(at.xz) {
        let place = atomicAdd(&extremes[4], 1u);
        if place < surfaces.room {
            near[place].cell = vec4<i32>(cell[i].xyz, i32(i));
            near[place].offset = offset[i];
            near[place].motion = motion[i];
        }
    }
}

@compute @workgroup_size(64)
fn put_velocities(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
                  @builtin(local_invocation_index) local: u32) {
    let k = thread_number(group, groups, local);
    if k < surfaces.room {
        let change = changes[k];
        motion[change.w] = vec4<f32>(bitcast<vec3<f32>>(change.xyz), motion[change.w].w);
    }
}
