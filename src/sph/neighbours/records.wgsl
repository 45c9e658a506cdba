// Creates the packed records of the particles (records.rs), and sorts the water arrays into the order of the bins.

@group(0) @binding(1) var<storage, read> offset: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> cell: array<vec4<i32>>;
@group(0) @binding(3) var<storage, read> motion: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> order: array<u32>;
@group(0) @binding(5) var<storage, read_write> records: array<Record>;
@group(0) @binding(6) var<storage, read_write> sorted_offset: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> sorted_cell: array<vec4<i32>>;
@group(0) @binding(8) var<storage, read_write> sorted_motion: array<vec4<f32>>;
// rho - rho0 of the boundary [kg/m3].
@group(0) @binding(9) var<storage, read> boundary_density: array<f32>;

// Returns the record of a particle. Pressure (equation 6) and speed of sound are computed as binomial series in
// (rho - rho0) / rho0, because these series stay precise near rho0.
fn record(cell: vec3<i32>, offset: vec4<f32>, motion: vec4<f32>, kind: f32) -> Record {
    let e = offset.w / parameters.rho0;
    let p = parameters.pressure;
    let c = parameters.sound;
    let pressure = e * (p[0].x + e * (p[0].y + e * (p[0].z + e * (p[0].w
        + e * (p[1].x + e * (p[1].y + e * (p[1].z + e * p[1].w)))))));
    let sound_speed = c[0].x + e * (c[0].y + e * (c[0].z + e * (c[0].w
        + e * (c[1].x + e * (c[1].y + e * (c[1].z + e * c[1].w))))));
    var out: Record;
    out.place = split(cell, offset.xyz);
    out.motion = vec4<f32>(motion.xyz, motion.w / (parameters.rho0 + offset.w));
    out.state = vec4<f32>(offset.w, pressure, sound_speed, kind);
    return out;
}

@compute @workgroup_size(64)
fn permute(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= parameters.water {
        return;
    }
    let from_place = order[i];
    sorted_offset[i] = offset[from_place];
    sorted_cell[i] = cell[from_place];
    sorted_motion[i] = motion[from_place];
}

@compute @workgroup_size(64)
fn of_water(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
            @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= parameters.water {
        return;
    }
    records[i] = record(cell[i].xyz, offset[i], motion[i], WATER);
}

@compute @workgroup_size(64)
fn of_boundary(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
               @builtin(local_invocation_index) local: u32) {
    let place = thread_number(group, groups, local);
    if place >= parameters.boundary {
        return;
    }
    let i = order[place];
    let own = vec4<f32>(offset[i].xyz, boundary_density[i]);
    records[parameters.water + place] =
        record(cell[i].xyz, own, motion[i], WALL + f32(cell[i].w));
}
