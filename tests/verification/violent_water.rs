//! Water that hits walls: damping of sound, a jet and a drop on a plate, thin sheets on a dry bed.

use breakwater::simulation::flume::{Simulation, step::PreparedStep};
use breakwater::sph::terms::{
    acoustic_damping::AcousticDamping, density_diffusion::Diffusion, viscosity::Viscosity, wall_slip::WallSlip,
};
use glam::DVec3;
use serde_json::{Value, json};

use super::tanks::{BareTank, RHO0, run_until, simulation};

/// Decay rate of a standing sound wave between two walls [1/s], with the coefficient `alpha_2` of the acoustic damping.
/// The wave is half a wavelength long, from wall to wall.
fn decay_rate(alpha_2: f64, side: f64, dp: f64, c0: f64) -> f64 {
    let mut tank = BareTank::closed([side, 5.0 * dp], dp, c0, &[], |parameters| {
        parameters.viscosity = Viscosity::Artificial { alpha: 0.0, beta: 0.0 };
        parameters.diffusion = Diffusion::none();
        parameters.slip = WallSlip::FreeSlip;
        parameters.cfl = 0.2;
        parameters.acoustic_damping = (alpha_2 > 0.0).then(|| AcousticDamping::new(alpha_2, parameters.kernel.h, c0));
    });
    let k = std::f64::consts::PI / side;
    for (velocity, position) in tank.water.velocity.iter_mut().zip(&tank.water.position) {
        velocity.x = 1e-3 * c0 * (k * position.x).sin();
    }
    // Amplitude of this wave alone, without the disorder of the particles.
    let amplitude = |tank: &BareTank| {
        let (mut velocity, mut density) = (0.0, 0.0);
        for i in 0..tank.water.len() {
            let (sin, cos) = (k * tank.water.position[i].x).sin_cos();
            velocity += tank.water.velocity[i].x * sin;
            density += (tank.water.density[i] / RHO0 - 1.0) * c0 * cos;
        }
        velocity.hypot(density) / tank.water.len() as f64
    };
    // Four periods of the wave. Regression of the logarithm of the amplitude.
    let (end, mut time) = (4.0 * 2.0 * side / c0, 0.0);
    let mut sums = [0.0; 5];
    while time < end {
        let dt = tank.step(|tank| {
            let log = amplitude(tank).ln();
            sums.iter_mut().zip([1.0, time, log, time * time, time * log]).for_each(|(sum, term)| *sum += term);
        });
        time += dt;
    }
    let [n, t, l, tt, tl] = sums;
    -(n * tl - t * l) / (n * tt - t * t)
}

#[test]
fn sound_decays_at_the_rate_of_the_bulk_viscosity() {
    let (side, dp, c0, alpha_2) = (0.2, 0.01, 20.0, 0.5);
    let h = 1.2 * 3f64.sqrt() * dp;
    let k = std::f64::consts::PI / side;
    let exact = 0.5 * alpha_2 * h * c0 * k * k;
    let [without, with] = [0.0, alpha_2].map(|alpha_2| decay_rate(alpha_2, side, dp, c0));
    println!("decay rate {with:.2} / s with damping, {without:.2} / s without; difference exact {exact:.2} / s");
    // Limit 8 %: the kernel weakens divergence and gradient of this wave by 1.4 % each, and more at the walls.
    assert!(((with - without) / exact - 1.0).abs() < 0.08);
}

/// Returns the case of a flat bed in two dimensions with a block of water on it, nearly without gravity.
fn block_on_bed(half_width: f64, height: f64, dp: f64, sound_speed: f64) -> Value {
    let (gravity, depth) = (0.01, height.max(1.0));
    json!({
        "title": "Water on a plate",
        "flume": { "bed_m": [[0.0, 0.0], [4.0, 0.0]], "still_water_level_m": depth },
        "domain": {
            "x_m": [0.0, 4.0], "sides": "two_dimensional", "top_z_m": depth + 1.0, "dp_m": dp,
            "water": { "kind": "block", "x_m": [2.0 - half_width, 2.0 + half_width], "top_z_m": height }
        },
        "fluid": { "gravity_m_s2": gravity, "sound_speed_factor": sound_speed / f64::sqrt(gravity * depth) },
        "stop": { "duration_s": 10.0 }
    })
}

/// Lifts the water by `gap` [m] and lets it fall at `speed` [m/s], at the reference density.
fn throw_down(simulation: &mut Simulation, gap: f64, speed: f64) {
    let water = &mut simulation.water;
    water.position.iter_mut().for_each(|position| position.z += gap);
    water.velocity.fill(DVec3::NEG_Z * speed);
    water.density.fill(RHO0);
}

/// Returns mass [kg] and vertical momentum [kg m/s] of the water.
fn mass_and_momentum(now: &PreparedStep) -> [f64; 2] {
    let water = &now.water;
    let momentum = water.mass.iter().zip(&water.velocity).map(|(m, v)| m * v.z).sum();
    [water.mass.iter().sum(), momentum]
}

/// A jet of the width D hits a plate at the speed U at a right angle. In steady flow the force per width is rho U^2 D,
/// and the pressure at the stagnation point is rho U^2 / 2.
#[test]
fn a_jet_presses_on_a_plate_with_its_momentum() {
    let (speed, width, length, gap, dp) = (1.0, 0.2, 1.5, 0.1, 0.0125);
    let mut tank = simulation(&block_on_bed(0.5 * width, length, dp, 20.0));
    throw_down(&mut tank, gap, speed);
    let (thickness, gravity) = (tank.case.domain.width, tank.case.fluid.gravity);
    // Steady flow begins when two widths of the jet have arrived, and ends before its end arrives.
    let steady = gap + 2.0 * width..0.85 * length;
    let (mut before, mut last, mut pressures) = (None, None, Vec::new());
    run_until(&mut tank, steady.end, |now| {
        if now.time < steady.start {
            return;
        }
        let [mass, momentum] = mass_and_momentum(now);
        let upward_impulse = momentum + mass * gravity * now.time;
        before.get_or_insert((now.time, upward_impulse));
        last = Some((now.time, upward_impulse));
        let plate = DVec3::new(2.0, 0.0, 0.0);
        pressures.push(now.sampler().unwrap().sample(plate).map_or(0.0, |sample| sample.pressure));
    });
    let ((t0, p0), (t1, p1)) = (before.unwrap(), last.unwrap());
    // Gravity makes the jet faster by 1 %.
    let arriving = speed + gravity * 0.5 * (t0 + t1);
    let force = (p1 - p0) / (t1 - t0) / (RHO0 * arriving * arriving * width * thickness);
    let count = pressures.len() as f64;
    let mean = pressures.iter().sum::<f64>() / count;
    let rms = (pressures.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / count).sqrt();
    let stagnation = 0.5 * RHO0 * arriving * arriving;
    println!(
        "jet, 16 particles wide: force {force:.3} of rho U^2 D, stagnation pressure {:.3} of rho U^2 / 2, its rms \
         noise {:.1} %",
        mean / stagnation,
        100.0 * rms / mean
    );
    // Limits: 3 % of the force, 5 % of the pressure and 10 % noise are enough for the design of a wall. Reached: 1.4,
    // 1.7 and 5.7 %; with 20 particles 3.2, 4.7 and 4.4 %, with 10 particles 2.4, 4.7 and 22 %.
    assert!((force - 1.0).abs() < 0.03 && (mean / stagnation - 1.0).abs() < 0.05 && rms < 0.1 * mean);
}

/// A round drop hits a plate. The plate takes the momentum of the drop without a rebound, and gives it no energy. A wall
/// stores energy for a short time, because the pressure of its particles does work on the water that approaches.
#[test]
fn a_drop_leaves_its_momentum_on_a_plate() {
    let (speed, radius, gap, dp) = (1.0, 0.1, 0.1, 0.02);
    let mut tank = simulation(&block_on_bed(radius, 2.0 * radius, dp, 20.0));
    let inside = |p: &DVec3| (p.x - 2.0).hypot(p.z - radius) < radius;
    let keep: Vec<bool> = tank.water.position.iter().map(inside).collect();
    tank.water.retain(&keep);
    throw_down(&mut tank, gap, speed);
    let (mut start, mut highest) = (None, f64::NEG_INFINITY);
    let (mut rebound, mut left) = (f64::NEG_INFINITY, 0.0);
    run_until(&mut tank, 0.6, |now| {
        let energy = now.energy().total();
        start.get_or_insert(energy);
        highest = highest.max(energy);
        let [mass, momentum] = mass_and_momentum(now);
        left = momentum / (mass * speed);
        rebound = rebound.max(left);
    });
    let rise = highest / start.unwrap() - 1.0;
    println!(
        "drop: upward momentum at most {rebound:.4} of m U, {left:.4} left after 0.6 s; highest energy {rise:+.1e} of \
         the start",
    );
    // Limits: 1 % for a rebound; 5 % left, because the thin spreading water still sinks; energy 1e-4 of the start, the
    // error of the time integration.
    assert!(rebound < 0.01 && left.abs() < 0.05 && rise < 1e-4);
}

/// A sheet of water slides on a dry bed without friction. The walls must not give energy to the water.
#[test]
fn thin_sheets_on_a_dry_bed_gain_no_energy() {
    let (dp, speed) = (0.02, 2.0);
    for layers in [1.0, 2.0, 3.0, 5.0] {
        let mut tank = simulation(&json!({
            "title": "Sheet of water on a dry bed",
            "flume": { "bed_m": [[0.0, 0.0], [10.0, 0.0]], "still_water_level_m": 0.5 },
            "domain": {
                "x_m": [0.0, 10.0], "sides": "two_dimensional", "top_z_m": 1.0, "dp_m": dp,
                "water": { "kind": "block", "x_m": [1.0, 2.0], "top_z_m": layers * dp }
            },
            "fluid": { "sound_speed_factor": 9.0 },
            "stop": { "duration_s": 2.0 }
        }));
        tank.water.velocity.fill(DVec3::X * speed);
        let (mut start, mut end, mut highest) = (None, 0.0, f64::NEG_INFINITY);
        run_until(&mut tank, 2.0, |now| {
            end = now.energy().total();
            start.get_or_insert(end);
            highest = highest.max(end);
        });
        let start = start.unwrap();
        let rise = highest / start - 1.0;
        println!(
            "sheet of {layers} layers: energy after 2 s {:.1} % of the start, highest energy {rise:+.2e} of the start",
            100.0 * end / start
        );
        // Limit 0.5 % of the start: a tenth of the energy that walls gave to thin water in an earlier version. Reached:
        // 0.05 %.
        assert!(rise < 5e-3);
    }
}
