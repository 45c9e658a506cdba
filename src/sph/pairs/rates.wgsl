// Computes the right-hand sides of equations 1 and 2 (rates.rs, pair_sums.rs) for water and units, and the largest
// acceleration and signal speed, which limit the time step.

@group(0) @binding(1) var<uniform> step: Step;
@group(0) @binding(2) var<storage, read> records: array<Record>;
@group(0) @binding(3) var<storage, read> water_start: array<u32>;
@group(0) @binding(4) var<storage, read> boundary_start: array<u32>;
@group(0) @binding(5) var<storage, read> boundary_order: array<u32>;
// Acceleration without gravity [m/s2] and d rho / dt [kg/(m3 s)]: first of the water particles, then of the boundary
// particles in unsorted order.
@group(0) @binding(6) var<storage, read_write> rates: array<vec4<f32>>;
// Bit patterns of the largest |dv/dt| [m/s2] and of the largest c + |mu| [m/s] of the water.
@group(0) @binding(7) var<storage, read_write> limits: array<atomic<u32>, 2>;

// Sums over the neighbours of a particle, without constant factors.
struct Sums {
    force: vec3<f32>,
    compression: f32,
    diffusion: f32,
    fastest: f32,
}

// Adds the contribution of `b` to the sums of `a`. Particles of the same unit do not act on each other, and other
// solids act on a unit only by pressure (gap_pressure.rs).
fn pair(sums: ptr<function, Sums>, a: Record, b: Record, r: vec3<f32>, r2: f32, closeness: f32) {
    if a.state.w >= UNIT && a.state.w == b.state.w {
        return;
    }
    let g = gradient_shape(closeness);
    let gv = g * b.motion.w;
    let v_dot_r = dot(a.motion.xyz - b.motion.xyz, r);
    let rho_a = parameters.rho0 + a.state.x;
    let rho_b = parameters.rho0 + b.state.x;
    // Artificial viscosity, equation 3.
    let approach = v_dot_r / (r2 + 0.01 * parameters.h * parameters.h);
    let h = parameters.h;
    let closing = min(approach, 0.0);
    let per_closing = 0.5 * parameters.beta * h * h * closing - 0.25 * parameters.alpha * h * (a.state.z + b.state.z);
    var viscous = (rho_a + rho_b) * closing * per_closing;
    if a.state.w >= UNIT && b.state.w != WATER {
        viscous = 0.0;
    }
    (*sums).force += ((a.state.y + b.state.y + viscous) * gv) * r;
    (*sums).compression += rho_b * gv * v_dot_r;
    // Density diffusion, equations 4 and 5.
    let slope = parameters.hydrostatic * parameters.curvature * r.z - parameters.hydrostatic;
    (*sums).diffusion += gv * (b.state.x - a.state.x + slope * r.z);
    (*sums).fastest = max((*sums).fastest, abs(approach));
}

fn add_range(total: ptr<function, Sums>, a: Record, first: u32, end: u32) {
    // Compute a partial sum over the range first, because partial sums reduce rounding errors.
    var sums: Sums;
    for (var j = first; j < end; j++) {
        let r = difference(a.place, records[j].place);
        let r2 = dot(r, r);
        let closeness = closeness_of(sqrt(r2));
        if closeness > 0.0 {
            pair(&sums, a, records[j], r, r2, closeness);
        }
    }
    (*total).force += sums.force;
    (*total).compression += sums.compression;
    (*total).diffusion += sums.diffusion;
    (*total).fastest = max((*total).fastest, sums.fastest);
}

fn sum_over_neighbours(a: Record) -> Sums {
    var sums: Sums;
    let rows = rows_within(a.place, step.reach);
    for (var up = rows.first.y; up <= rows.last.y; up++) {
        for (var across = rows.first.x; across <= rows.last.x; across++) {
            let bins = bins_within(a.place, step.reach, vec2<i32>(across, up));
            if bins.x > bins.y {
                continue;
            }
            add_range(&sums, a, water_start[bins.x], water_start[bins.y + 1u]);
            let water = parameters.water;
            add_range(&sums, a, water + boundary_start[bins.x], water + boundary_start[bins.y + 1u]);
        }
    }
    return sums;
}

var<workgroup> largest_acceleration: array<u32, 64>;
var<workgroup> largest_signal: array<u32, 64>;

// Computes the maximum of each limit over all threads from bit patterns, because atomic operations need integers. The
// bit patterns of non-negative numbers have the same order as the numbers; the bit pattern of NaN is larger still.
fn reduce_limits(local: u32, acceleration: u32, signal: u32) {
    largest_acceleration[local] = acceleration;
    largest_signal[local] = signal;
    workgroupBarrier();
    for (var half = 32u; half > 0u; half /= 2u) {
        if local < half {
            largest_acceleration[local] = max(largest_acceleration[local], largest_acceleration[local + half]);
            largest_signal[local] = max(largest_signal[local], largest_signal[local + half]);
        }
        workgroupBarrier();
    }
    if local == 0u {
        atomicMax(&limits[0], largest_acceleration[0]);
        atomicMax(&limits[1], largest_signal[0]);
    }
}

@compute @workgroup_size(64)
fn rates_of_all(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
                @builtin(local_invocation_index) local: u32) {
    let i = thread_number(group, groups, local);
    var acceleration_bits = 0u;
    var signal_bits = 0u;
    if i < parameters.water + parameters.boundary {
        let a = records[i];
        if a.state.w != WALL {
            let sums = sum_over_neighbours(a);
            let scale = parameters.gradient_scale;
            let acceleration = sums.force * (-scale / (parameters.rho0 + a.state.x));
            let density = scale * (sums.diffusion * parameters.diffusion + sums.compression);
            if a.state.w == WATER {
                rates[i] = vec4<f32>(acceleration, density);
                let all = acceleration - vec3<f32>(0.0, 0.0, parameters.gravity);
                acceleration_bits = bitcast<u32>(length(all)) & 0x7fffffffu;
                signal_bits = bitcast<u32>(a.state.z + parameters.h * sums.fastest) & 0x7fffffffu;
            } else {
                let own = boundary_order[i - parameters.water];
                rates[parameters.water + own] = vec4<f32>(acceleration, density);
            }
        }
    }
    reduce_limits(local, acceleration_bits, signal_bits);
}
