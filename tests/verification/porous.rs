//! Water in porous media: at rest, and steady flow through a block.

use breakwater::simulation::flume::Simulation;
use breakwater::sph::solver::sampling::Sampler;
use breakwater::sph::terms::porous::{Medium, Pores};
use glam::DVec3;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation};

/// Median diameter of the crushed rock of Liu et al. (1999) [m].
const ROCK: f64 = 0.0159;

/// Returns a two-dimensional tank with these parts.
fn tank(length: f64, level: f64, dp: f64, structure: Value) -> Value {
    json!({
        "title": "Porous block",
        "flume": { "bed_m": [[0.0, 0.0], [length, 0.0]], "still_water_level_m": level },
        "structure": structure,
        "domain": { "x_m": [0.0, length], "sides": "two_dimensional", "top_z_m": 1.6 * level, "dp_m": dp },
        "stop": { "duration_s": 60.0 },
    })
}

fn block(x: [f64; 2], top: f64, porosity: f64, diameter: f64) -> Value {
    json!({
        "name": "block",
        "polygon_m": [[x[0], 0.0], [x[0], top], [x[1], top], [x[1], 0.0]],
        "porous": { "porosity": porosity, "d50_m": diameter },
    })
}

/// Runs still water for `duration` [s]. Returns the largest error of the pressure over that at the bed, the largest
/// speed [m/s] in the second half, and the change of the level in the middle of the block [m].
fn rest(porosity: f64, top: f64, duration: f64) -> [f64; 3] {
    const LEVEL: f64 = 0.3;
    let mut tank = simulation(&tank(1.2, LEVEL, 0.02, json!([block([0.4, 0.8], top, porosity, ROCK)])));
    let places: Vec<DVec3> = [0.2, 0.38, 0.42, 0.6, 0.78, 0.82]
        .into_iter()
        .flat_map(|x| [0.03, 0.11, 0.19].map(|z| DVec3::new(x, 0.0, z)))
        .collect();
    let (mut sums, mut count, mut speed) = (vec![0.0; places.len()], 0.0, 0.0f64);
    let mut level = 0.0;
    run_until(&mut tank, duration, |now| {
        if now.time < 0.5 * duration {
            return;
        }
        let width = now.case.domain.width;
        let sampler = now.sampler().unwrap();
        for (sum, place) in sums.iter_mut().zip(&places) {
            *sum += sampler.sample(*place).unwrap().pressure;
        }
        level = depth(&sampler, 0.6, width);
        count += 1.0;
        speed = now.water.velocity.iter().map(|v| v.length()).fold(speed, f64::max);
    });
    let error = |(sum, place): (&f64, &DVec3)| ((sum / count) / (RHO0 * GRAVITY) - (LEVEL - place.z)).abs() / LEVEL;
    [sums.iter().zip(&places).map(error).fold(0.0, f64::max), speed, level - LEVEL]
}

/// Returns the depth of water at x in a tank of this width with a level bed [m].
fn depth(sampler: &Sampler, x: f64, width: f64) -> f64 {
    sampler.hydrostatic_depth(x, 0.1, width, |_| 0.0)
}

fn check_rest(duration: f64) {
    for (porosity, top) in [(0.3, 0.4), (0.45, 0.4), (0.7, 0.4), (0.45, 0.15), (0.999, 0.4)] {
        let [error, speed, level] = rest(porosity, top, duration);
        println!(
            "n = {porosity}, block {top} m high: pressure {:.2} %, {speed:.4} m/s, level {:+.2} mm",
            100.0 * error,
            1e3 * level
        );
        // Target: 1 % of the pressure at the bed.
        assert!(error < 0.01);
    }
}

#[test]
fn water_in_and_beside_a_block_stays_at_rest() {
    check_rest(1.0);
}

#[test]
#[ignore = "cargo test --release --test verification -- --ignored --nocapture porous::"]
fn water_in_and_beside_a_block_stays_at_rest_for_long() {
    check_rest(10.0);
}

/// Length and height of a block below a lid, and length of the tank in front of it [m].
const BLOCK: [f64; 2] = [0.4, 0.12];
const TANK: f64 = 0.6;

/// Lets water flow through a block below a lid into a tank with a lower level. Returns times [s] and the depth on both
/// sides [m].
fn permeameter(dp: f64, porous: &Value, duration: f64) -> Vec<[f64; 3]> {
    let [from, to] = [TANK, TANK + BLOCK[0]];
    let lid = json!([[from, BLOCK[1]], [to, BLOCK[1]], [to, 0.5], [from, 0.5]]);
    let mut block = block([from, to], BLOCK[1], 0.49, ROCK);
    block["porous"] = porous.clone();
    let mut case = tank(to + TANK, 0.35, dp, json!([{ "name": "lid", "polygon_m": lid }, block]));
    case["domain"]["water"] = json!({ "kind": "block", "x_m": [0.0, TANK], "top_z_m": 0.35, "around_z_m": 0.15 });
    let mut tank: Simulation = simulation(&case);
    let mut rows = Vec::new();
    run_until(&mut tank, duration, |now| {
        if now.steps.is_multiple_of(100) {
            let (time, width) = (now.time, now.case.domain.width);
            let sampler = now.sampler().unwrap();
            rows.push([time, depth(&sampler, 0.5 * TANK, width), depth(&sampler, to + 0.5 * TANK, width)]);
        }
    });
    rows
}

#[test]
fn the_discharge_through_a_block_is_that_of_darcy_and_of_forchheimer() {
    // Rock with the coefficients of Jensen et al. (2014), and a finer medium with linear drag alone.
    for (alpha, beta) in [(500.0, 2.0), (5834.0, 0.0)] {
        let medium =
            Medium { porosity: 0.49, diameter: ROCK, alpha, beta, keulegan_carpenter: f64::INFINITY, gamma: 0.34 };
        let Pores { linear: a, quadratic: b, porosity, .. } = medium.pores(1e-6);
        let porous = json!({ "porosity": 0.49, "d50_m": ROCK, "alpha": alpha, "beta": beta });
        let rows = permeameter(0.04 / 3.0, &porous, 6.0);
        // The pores carry u with a u + b u^2 = g (h1 - h2) / L.
        let velocity = |[_, h1, h2]: &[f64; 3]| {
            let drive = GRAVITY * (h1 - h2) / BLOCK[0];
            2.0 * drive / (a + (a * a + 4.0 * b * drive).sqrt())
        };
        // The flow is steady except for the slow fall of the level.
        let steady: Vec<&[f64; 3]> = rows.iter().filter(|row| row[0] > 2.0).collect();
        let through: f64 =
            steady.windows(2).map(|w| 0.5 * (velocity(w[0]) + velocity(w[1])) * (w[1][0] - w[0][0])).sum();
        let expected = porosity * BLOCK[1] * through / TANK;
        let fall = steady[0][1] - steady[steady.len() - 1][1];
        println!(
            "alpha {alpha}, beta {beta}: the level falls by {:.2} mm, expected {:.2} mm",
            1e3 * fall,
            1e3 * expected
        );
        // Target: 1 %. With dp = 20 mm, six particles in the height of the block, the discharge is 1.7 % too small.
        assert!((fall / expected - 1.0).abs() < 0.01);
    }
}

#[test]
fn a_block_on_a_porous_bed_rests_and_has_the_uplift_of_the_water_below_it() {
    const EDGE: f64 = 0.1;
    let mut case = tank(0.3, 0.3, 0.0125, json!([block([0.0, 0.3], 0.1, 0.45, ROCK)]));
    case["flume"]["material"] = json!("concrete");
    case["domain"]["sides"] = json!("periodic");
    case["domain"]["width_m"] = json!(0.3);
    case["materials"] =
        json!([{ "name": "concrete", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }]);
    case["friction"] = json!([{ "between": ["concrete", "concrete"], "coefficient": 0.6 }]);
    case["units"] = json!({
        "shape": "cuboid", "size_m": [EDGE, EDGE, EDGE], "mass_kg": 2.4, "material": "concrete",
        "poses": [{ "centre_m": [0.15, 0.15, 0.1 + 0.5 * EDGE] }],
    });
    case["numerics"] = json!({ "hold_units_s": 0.2 });
    let mut tank = simulation(&case);
    let (mut lift, mut count) = (0.0, 0.0);
    run_until(&mut tank, 0.6, |now| {
        if now.time > 0.35 {
            lift += now.units.as_ref().unwrap().fluid_loads[0].force.z;
            count += 1.0;
        }
    });
    let moved = tank.units.as_ref().unwrap().states()[0].position - DVec3::new(0.15, 0.15, 0.1 + 0.5 * EDGE);
    let share = lift / count / (RHO0 * GRAVITY * EDGE.powi(3));
    println!("lift {share:.4} of Archimedes, moved by {:.4} mm", 1e3 * moved.length());
    // The block is eight particles high: limit 3 %, as for units in open water.
    assert!((share - 1.0).abs() < 0.03);
    // The springs of its contacts give way by some hundredths of a millimetre.
    assert!(moved.length() < 1e-4);
}

/// Wave number of the standing wave [1/m]: one half wave in a basin 1 m long.
const K: f64 = std::f64::consts::PI;
/// Depth of the water above the porous bed, and thickness of the bed [m].
const LAYERS: [f64; 2] = [0.3, 0.2];

/// Angular frequency and damping rate [1/s] of a standing wave over a porous bed with linear drag `sigma` [1/s] and
/// without added mass: the root of w^2 - g k tanh kh = r (g k - w^2 tanh kh), r = n tanh(kd) / (1 + i sigma / w).
fn theory(porosity: f64, sigma: f64) -> [f64; 2] {
    let [h, d] = LAYERS;
    let tanh = (K * h).tanh();
    let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
    let over = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
        let size = c * c + d * d;
        [(a * c + b * d) / size, (b * c - a * d) / size]
    };
    let mut w = [(GRAVITY * K * tanh).sqrt(), 0.0];
    // w^2 (1 + r tanh) = g k (tanh + r): fixed-point iterations.
    for _ in 0..200 {
        let drag = over([0.0, sigma], w);
        let r = over([porosity * (K * d).tanh(), 0.0], [1.0 + drag[0], drag[1]]);
        let squared = over([GRAVITY * K * (tanh + r[0]), GRAVITY * K * r[1]], [1.0 + r[0] * tanh, r[1] * tanh]);
        let size = squared[0].hypot(squared[1]).sqrt();
        let angle = 0.5 * squared[1].atan2(squared[0]);
        w = [size * angle.cos(), size * angle.sin()];
        assert!((times(w, w)[0] - squared[0]).abs() < 1e-9);
    }
    [w[0], -w[1]]
}

/// Runs a standing wave over a porous bed. Returns its angular frequency and its damping rate [1/s].
fn standing_wave(sigma: Option<f64>, dp: f64) -> [f64; 2] {
    const POROSITY: f64 = 0.45;
    let [h, d] = LAYERS;
    let mut structure = json!([]);
    if let Some(sigma) = sigma {
        // alpha gives the drag, with nu = 1e-6 m2/s.
        let diameter = 0.02;
        let alpha = sigma / (1e-6 * ((1.0 - POROSITY) / (POROSITY * diameter)).powi(2));
        structure = json!([{
            "name": "bed", "polygon_m": [[0.0, 0.0], [0.0, d], [1.0, d], [1.0, 0.0]],
            "porous": { "porosity": POROSITY, "d50_m": diameter, "alpha": alpha, "beta": 0.0, "added_mass": 0.0 },
        }]);
    }
    let depth = if sigma.is_some() { h + d } else { h };
    let mut case = tank(1.0, depth, dp, structure);
    case["numerics"] = json!({ "wall_friction": 0.0 });
    let mut tank = simulation(&case);
    // At first, the surface is level and the water moves as over a solid bed.
    let speed = 0.1 / (K * depth).sinh();
    for (velocity, at) in tank.water.velocity.iter_mut().zip(&tank.water.position) {
        let (kx, kz) = (K * at.x, K * at.z);
        *velocity = speed * DVec3::new(kx.sin() * kz.cosh(), 0.0, -kx.cos() * kz.sinh());
    }
    let mut rows = Vec::new();
    run_until(&mut tank, 5.2, |now| {
        if now.steps.is_multiple_of(20) {
            let time = now.time;
            // The pores are full, so this sum changes with the surface alone.
            let level: f64 =
                (0..now.water.len()).map(|k| now.water.mass[k] * (K * now.water.position[k].x).cos()).sum();
            rows.push([time, level]);
        }
    });
    // Times and levels of the extremes between the zeros.
    let zeros: Vec<f64> = rows
        .windows(2)
        .filter(|w| w[0][1] * w[1][1] < 0.0)
        .map(|w| w[0][0] + (w[1][0] - w[0][0]) * w[0][1] / (w[0][1] - w[1][1]))
        .collect();
    let peaks: Vec<f64> = zeros
        .windows(2)
        .map(|z| rows.iter().filter(|r| z[0] < r[0] && r[0] < z[1]).map(|r| r[1].abs()).fold(0.0, f64::max))
        .collect();
    let (first, last, count) = (1, peaks.len() - 1, zeros.len() - 1);
    let period = 2.0 * (zeros[count] - zeros[0]) / count as f64;
    let decay = (peaks[first] / peaks[last]).ln() / (0.5 * period * (last - first) as f64);
    println!("peaks {peaks:.5?}");
    [std::f64::consts::TAU / period, decay]
}

#[test]
fn a_standing_wave_over_a_porous_bed_has_the_frequency_of_theory() {
    let [frequency, own] = standing_wave(None, 0.02);
    println!("without porous bed: {frequency:.3} 1/s, {own:.4} 1/s");
    let mut decays = Vec::new();
    for sigma in [5.0, 20.0, 100.0] {
        let [found, decay] = standing_wave(Some(sigma), 0.02);
        let [expected, rate] = theory(0.45, sigma);
        println!("sigma {sigma}: {found:.3} 1/s ({expected:.3}), damping {decay:.4} 1/s ({rate:.4})");
        // Limit 1 %: the wave over a solid bed is 0.1 % too fast, and the extremes are 0.01 s apart in the records.
        assert!((found / expected - 1.0).abs() < 0.01);
        decays.push(decay);
    }
    // The rate is 0.02 to 0.04 1/s too high with this spacing, but a bed that water enters more easily damps more.
    assert!(decays.is_sorted_by(|a, b| a > b) && decays[2] > own);
}
