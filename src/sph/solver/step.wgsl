// Computes the symplectic position Verlet step, equations 7 to 9 (step.rs).

@group(0) @binding(1) var<uniform> step: Step;
@group(0) @binding(2) var<storage, read_write> offset: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> cell: array<vec4<i32>>;
@group(0) @binding(4) var<storage, read_write> motion: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> rates: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> half_offset: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> half_motion: array<vec4<f32>>;
// Five values: bit pattern of the largest speed [m/s]; lowest and highest rho - rho0 as integers (see `ordered`);
// 1 if a particle has left the domain or has a state that is not finite, else 0; number of particles near surfaces
// (near.wgsl).
@group(0) @binding(8) var<storage, read_write> extremes: array<atomic<u32>, 5>;

fn with_gravity(rate: vec4<f32>) -> vec3<f32> {
    return rate.xyz - vec3<f32>(0.0, 0.0, parameters.gravity);
}

// Predictor, equations 8.1, 8.2 and 9.1: computes the state at the half step.
@compute @workgroup_size(64)
fn predict(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    if i >= parameters.water {
        return;
    }
    let half_dt = 0.5 * step.dt;
    let rate = rates[i];
    let now = motion[i];
    half_offset[i] = offset[i] + half_dt * vec4<f32>(now.xyz, rate.w);
    half_motion[i] = vec4<f32>(now.xyz + half_dt * with_gravity(rate), now.w);
}

// Maps a number to an integer so that the integers have the same order as the numbers, for atomicMin and atomicMax.
fn ordered(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

// Returns true if all values are finite. The function tests the bits, because shader compilers are allowed to assume
// that all numbers are finite.
fn is_finite(values: vec4<f32>) -> bool {
    return all((bitcast<vec4<u32>>(values) & vec4<u32>(0x7f800000u)) != vec4<u32>(0x7f800000u));
}

var<workgroup> fastest: array<u32, 64>;
var<workgroup> lightest: array<u32, 64>;
var<workgroup> densest: array<u32, 64>;

fn reduce_extremes(local: u32) {
    workgroupBarrier();
    for (var half = 32u; half > 0u; half /= 2u) {
        if local < half {
            fastest[local] = max(fastest[local], fastest[local + half]);
            lightest[local] = min(lightest[local], lightest[local + half]);
            densest[local] = max(densest[local], densest[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u {
        atomicMax(&extremes[0], fastest[0]);
        atomicMin(&extremes[1], lightest[0]);
        atomicMax(&extremes[2], densest[0]);
    }
}

// Corrector, equations 8.3, 8.4 and 9.2: computes the state at the end of the time step.
@compute @workgroup_size(64)
fn correct(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    fastest[local] = 0u;
    lightest[local] = 0xffffffffu;
    densest[local] = 0u;
    if i < parameters.water {
        let rate = rates[i];
        let now = motion[i];
        let velocity = now.xyz + step.dt * with_gravity(rate);
        let before = offset[i];
        let moved = before.xyz + (0.5 * step.dt) * (now.xyz + velocity);
        let epsilon = -step.dt * rate.w / (parameters.rho0 + half_offset[i].w);
        // `excess` equals rho (2 - epsilon) / (2 + epsilon) - rho0, equation 9.2, written without cancellation.
        let excess = before.w - (parameters.rho0 + before.w) * (2.0 * epsilon / (2.0 + epsilon));
        let turned = floor(moved / parameters.size);
        var place = cell[i];
        place = vec4<i32>(place.xyz + vec3<i32>(turned), place.w);
        if PERIODIC {
            place.y = (place.y % parameters.count.y + parameters.count.y) % parameters.count.y;
        }
        let rest = moved - turned * parameters.size;
        offset[i] = vec4<f32>(rest, excess);
        cell[i] = place;
        motion[i] = vec4<f32>(velocity, now.w);
        let at = vec3<f32>(place.xyz) * parameters.size + rest;
        let inside = all(at >= parameters.bounds_low) && all(at <= parameters.bounds_high);
        let finite = is_finite(vec4<f32>(rest, excess)) && is_finite(vec4<f32>(velocity, 0.0));
        if !(inside && finite) {
            atomicMax(&extremes[3], 1u);
        }
        fastest[local] = bitcast<u32>(length(velocity)) & 0x7fffffffu;
        lightest[local] = ordered(excess);
        densest[local] = ordered(excess);
    }
    reduce_extremes(local);
}
