// Finds the water particles near surfaces for the host (near.rs). The host knows the exact shapes and corrects the
// velocities of these particles.

// Number of shapes of each kind, in the same order as in the array `shapes`, and dimensions of the surfaces.
struct Surfaces {
    // Number of segments of the outline of bed and walls; `shapes` has x and z of both ends [m].
    segments: u32,
    // Number of obstacles; `shapes` has the low and the high corner [m].
    obstacles: u32,
    // Number of spheres around parts of units; `shapes` has centre and radius [m]. The radius includes min_distance.
    spheres: u32,
    // Number of rows of the wavemaker; `shapes` has the displacement along x [m].
    rows: u32,
    // Particles nearer to a surface than this distance count as near; it includes an allowance for rounding [m].
    min_distance: f32,
    // x of the wavemaker at zero displacement, z of its lowest row, spacing of its rows [m].
    place: f32,
    lowest: f32,
    dp: f32,
    // Distance between the side walls [m]; negative if there are no side walls.
    sides: f32,
    // y of the first side wall [m].
    low_side: f32,
    // Capacity of `near` for find_near; number of changes for put_velocities.
    room: u32,
}

struct Near {
    // Bin indices along x, y and z, and index of the particle in the water arrays.
    cell: vec4<i32>,
    offset: vec4<f32>,
    motion: vec4<f32>,
}

@group(0) @binding(1) var<uniform> surfaces: Surfaces;
@group(0) @binding(2) var<storage, read> offset: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> cell: array<vec4<i32>>;
@group(0) @binding(4) var<storage, read_write> motion: array<vec4<f32>>;
// Dimensions and positions of the surfaces; positions are relative to the low corner of the grid [m].
@group(0) @binding(5) var<storage, read> shapes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> near: array<Near>;
// The last value is the number of particles near surfaces; step.wgsl explains the other values.
@group(0) @binding(7) var<storage, read_write> extremes: array<atomic<u32>, 5>;
// Bit patterns of the three velocity components, and index of the particle. The type is an integer, because a card can
// set an f32 to zero if its bit pattern is a small index.
@group(0) @binding(8) var<storage, read> changes: array<vec4<u32>>;

// Returns true if a point (x, z) is nearer to the outline than min_distance, or behind the outline.
fn is_near_outline(at: vec2<f32>) -> bool {
    var least = 1e30;
    var behind = false;
    for (var k = 0u; k < surfaces.segments; k++) {
        let piece = shapes[k];
        let along = piece.zw - piece.xy;
        let from_start = at - piece.xy;
        let t = clamp(dot(from_start, along) / dot(along, along), 0.0, 1.0);
        let away = length(from_start - t * along);
        // If the nearest point of the outline is a corner, `at` counts as behind if it is behind at least one segment.
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
