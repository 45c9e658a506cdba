//! A two-dimensional layer of particles gives the results of a three-dimensional slice of the same flume.

use breakwater::simulation::flume::Simulation;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, dam_break, run_until, simulation, still_tank};

/// Returns the case in two dimensions.
pub fn in_two_dimensions(mut case: Value) -> Value {
    let domain = case["domain"].as_object_mut().unwrap();
    domain.remove("width_m");
    domain["sides"] = json!("two_dimensional");
    case
}

/// Returns the position of the tip [m] and the kinetic energy per metre of width [J/m].
fn tip_and_energy(simulation: &Simulation) -> [f64; 2] {
    let water = &simulation.water;
    let tip = water.position.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    let energy: f64 = water.mass.iter().zip(&water.velocity).map(|(m, v)| 0.5 * m * v.length_squared()).sum();
    [tip, energy / simulation.case.domain.width]
}

#[test]
fn dam_breaks_in_a_layer_and_in_a_slice_agree() {
    let (dp, end) = (0.08, 0.6);
    let [slice, layer] = [dam_break(dp, 1.0), in_two_dimensions(dam_break(dp, 1.0))].map(|case| {
        let mut tank = simulation(&case);
        run_until(&mut tank, end, |_| ());
        tip_and_energy(&tank)
    });
    println!("tip {:.3} and {:.3} m, energy {:.1} and {:.1} J/m", slice[0], layer[0], slice[1], layer[1]);
    // Limits: half a particle spacing for the tip and 2 % for the energy, because the particles of layer and slice
    // start at different positions.
    assert!((slice[0] - layer[0]).abs() < 0.5 * dp && (slice[1] / layer[1] - 1.0).abs() < 0.02);
}

#[test]
fn nothing_moves_across_the_flume() {
    let mut tank = simulation(&in_two_dimensions(dam_break(0.08, 1.0)));
    run_until(&mut tank, 0.4, |_| ());
    assert!(tank.water.position.iter().all(|p| p.y == 0.04) && tank.water.velocity.iter().all(|v| v.y == 0.0));
}

#[test]
fn gauges_read_level_and_pressure_of_a_layer() {
    let (depth, dp) = (0.4, 0.02);
    let mut tank = simulation(&in_two_dimensions(still_tank(1.0, 0.2, depth, dp, 1.0)));
    let (width, mut read) = (tank.case.domain.width, Vec::new());
    run_until(&mut tank, 1.0, |now| {
        let sampler = now.sampler().unwrap();
        // The y coordinate must not matter.
        let level = sampler.surface(DVec2::new(0.5, 3.0), 0.0).unwrap();
        let at = DVec3::new(0.5, -1.0, 0.1);
        let by_force = sampler.hydrostatic_depth(0.5, 6.0 * dp, width, |_| 0.0);
        let wetted = sampler.wetted_length(DVec2::new(0.5, 3.0), 0.0);
        read = vec![level, sampler.sample(at).unwrap().pressure, sampler.occupied(at), by_force, wetted];
    });
    // Limits: 0.1 dp for the level and the wetted length; 2 % of the pressure, which still oscillates after 1 s; 2 % of
    // the sum of W V.
    assert!((read[0] - depth).abs() < 0.1 * dp && (read[4] - depth).abs() < 0.1 * dp, "{read:?}");
    assert!((read[1] / (RHO0 * GRAVITY * (depth - 0.1)) - 1.0).abs() < 0.02, "{read:?}");
    assert!((read[2] - 1.0).abs() < 0.02, "{read:?}");
    // Limit 0.02 dp: the weights of particles in rows add up to 1 with an error of 4e-4 of the depth, 0.008 dp.
    assert!((read[3] - depth).abs() < 0.02 * dp, "{read:?}");
}

/// At the shoreline, the water is one or two layers of particles deep.
#[test]
fn still_water_stays_still_on_a_beach() {
    let dp = 0.02;
    let mut tank = simulation(&json!({
        "title": "Still water on a beach",
        "flume": { "bed_m": [[0.0, -0.1], [4.0, 0.1 / 3.0]], "still_water_level_m": 0.0 },
        "domain": { "x_m": [0.0, 4.0], "sides": "two_dimensional", "top_z_m": 0.3, "dp_m": dp },
        "fluid": { "sound_speed_factor": 10.0 },
        "stop": { "duration_s": 4.0 }
    }));
    let mut fastest = 0.0_f64;
    run_until(&mut tank, 3.0, |now| {
        if now.time > 1.0 {
            fastest = now.water.velocity.iter().map(|v| v.length()).fold(fastest, f64::max);
        }
    });
    println!("fastest {fastest:.3} m/s");
    // Limit 0.44 m/s: the speed sqrt(g dp) of a particle that slides down the beach by half a spacing without friction.
    // At the start, the edge of the water is uneven by this height. Walls that attract the water would cause 1.6 m/s.
    assert!(fastest < (GRAVITY * dp).sqrt());
}

#[test]
fn the_wetted_length_does_not_count_air() {
    let (depth, dp, air) = (0.4, 0.02, 0.16);
    let mut tank = simulation(&in_two_dimensions(still_tank(1.0, 0.2, depth, dp, 1.0)));
    for position in &mut tank.water.position {
        position.z += if position.z > 0.3 { air } else { 0.0 };
    }
    let mut read = [0.0; 2];
    // A single time step, in which nothing moves far.
    run_until(&mut tank, 1e-9, |now| {
        let (sampler, at) = (now.sampler().unwrap(), DVec2::new(0.5, 0.0));
        read = [sampler.surface(at, 0.0).unwrap(), sampler.wetted_length(at, 0.0)];
    });
    println!("level {:.4} m, wetted length {:.4} m", read[0], read[1]);
    // Limits: 0.1 dp for each free surface that the reading contains, one for the level and three for the length.
    assert!((read[0] - depth - air).abs() < 0.1 * dp && (read[1] - depth).abs() < 0.3 * dp, "{read:?}");
}
