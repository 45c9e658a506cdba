//! A dam break in front of a dam of crushed rock, compared with the surfaces measured by Lin (1998), published in Liu et
//! al. (1999). The coefficients of the rock are those that Jensen et al. (2014) found for the lower level; the higher
//! level is a prediction.

use std::sync::Arc;

use breakwater::case::Case;
use breakwater::simulation::flume::Simulation;
use glam::DVec2;
use serde_json::{Value, json};

use super::data;

const TABLE: &str = "lin1998_dam.csv";
/// Places of the measured levels: x of the first one, and their spacing [m].
const PLACES: [f64; 2] = [0.025, 0.05];

/// Creates the tank with the reservoir at this level [m].
fn tank(level: f64, dp: f64, porosity: f64) -> Simulation {
    let mut case: Value = serde_json::from_str(include_str!("../../cases/verification/porous-dam.json")).unwrap();
    case["structure"][0]["porous"]["porosity"] = json!(porosity);
    case["domain"]["dp_m"] = json!(dp);
    case["domain"]["water"]["top_z_m"] = json!(level);
    let case = Case::from_str(&case.to_string(), "dam.json").unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// Returns the level of the surface at the measured places [m].
fn levels(tank: &mut Simulation, count: usize) -> Vec<f64> {
    let mut step = tank.begin_step().unwrap();
    let sampler = step.sampler().unwrap();
    let x = |k: usize| PLACES[0] + PLACES[1] * k as f64;
    let level = |k: usize| sampler.surface(DVec2::new(x(k), 0.0), 0.0).unwrap_or(0.0);
    (0..count).map(level).collect()
}

/// Runs a dam break and returns the rms of the level over all profiles, divided by the initial level, and the relative
/// change of the mass of the water.
fn compare(level: f64, dp: f64, porosity: f64) -> [f64; 2] {
    let profiles: Vec<Vec<f64>> = data::table(TABLE).into_iter().filter(|row| row[0] == level).collect();
    let mut tank = tank(level, dp, porosity);
    let mass = |tank: &Simulation| tank.water.mass.iter().sum::<f64>();
    let before = mass(&tank);
    let (mut squares, mut count) = (0.0, 0.0);
    for profile in &profiles {
        rayon::scope(|_| {
            while tank.time < profile[1] {
                tank.step().unwrap();
            }
        });
        let found = levels(&mut tank, profile.len() - 2);
        let errors: Vec<f64> = found.iter().zip(&profile[2..]).map(|(found, measured)| found - measured).collect();
        let of_profile = errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64;
        println!(
            "{:.2} s: rms {:.1} mm {}",
            profile[1],
            1e3 * of_profile.sqrt(),
            errors.iter().map(|error| format!("{:+.0}", 1e3 * error)).collect::<Vec<_>>().join(" ")
        );
        squares += of_profile;
        count += 1.0;
    }
    [(squares / count).sqrt() / level, mass(&tank) / before - 1.0]
}

#[test]
fn water_flows_through_a_dam_of_rock_as_measured() {
    for level in [0.24, 0.35] {
        let [rms, change] = compare(level, 0.01, 0.49);
        println!("level {level} m: rms {:.2} % of the level; change of the mass {change:.1e}", 1e2 * rms);
        // Target: 6 %. The area below the measured profiles differs by up to 5 % from profile to profile.
        assert!(rms < 0.06);
        // No particle is lost.
        assert!(change.abs() < 1e-12);
    }
}

#[test]
#[ignore = "cargo test --release -p breakwater-sim --test validation -- --ignored --nocapture porous_dam"]
fn dependence_on_spacing_and_porosity() {
    for (dp, porosity) in [(0.01, 0.49), (0.007, 0.49), (0.005, 0.49), (0.01, 0.44), (0.01, 0.54)] {
        for level in [0.24, 0.35] {
            let [rms, _] = compare(level, dp, porosity);
            println!("dp = {dp} m, n = {porosity}, level {level} m: rms {:.2} % of the level", 1e2 * rms);
        }
    }
}
