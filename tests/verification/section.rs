//! The section of `cases/breakwater/section.json` in still water: nothing moves.

use std::sync::Arc;

use breakwater::case::Case;
use breakwater::simulation::flume::Simulation;
use glam::DVec3;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until};

/// Duration of the full run [s].
const FULL: f64 = 5.0;

/// Runs the section in still water for `duration` [s]. Returns the largest displacement of any unit from its start [m],
/// and the mean vertical force of the water on each unit in the second half over that of Archimedes.
fn still(duration: f64) -> (f64, Vec<f64>) {
    let text = include_str!("../../cases/breakwater/section.json");
    let mut case: Value = serde_json::from_str(text).unwrap();
    case["wave"] = json!({ "kind": "none" });
    case["stop"] = json!({ "duration_s": duration });
    case["gauges"] = json!([]);
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/breakwater/test.json");
    let case = Case::from_str(&case.to_string(), folder).unwrap_or_else(|errors| panic!("{errors}"));
    let level = case.flume.still_water_level;
    let mut section = Simulation::new(Arc::new(case)).unwrap();
    let (mut largest, mut count) = (0.0f64, 0.0);
    let mut lift = vec![0.0; section.units.as_ref().unwrap().states().len()];
    run_until(&mut section, duration, |now| {
        let units = now.units.as_ref().unwrap();
        let moved = units.states().iter().zip(&units.start).map(|(now, start)| now.position.distance(start.position));
        largest = moved.fold(largest, f64::max);
        if now.time > 0.5 * duration {
            count += 1.0;
            lift.iter_mut().zip(&units.fluid_loads).for_each(|(sum, load)| *sum += load.force.z);
        }
    });
    let units = section.units.as_ref().unwrap();
    let of_unit =
        |((solid, state), sum): ((&breakwater::geometry::solid::Solid, &breakwater::rigid::BodyState), f64)| {
            let (volume, _) = solid.below(state.rotation.inverse() * DVec3::Z, level - state.position.z);
            let whole = solid.volume_properties().volume;
            (volume > 0.999 * whole).then(|| sum / count / (RHO0 * GRAVITY * whole))
        };
    (largest, units.solids().into_iter().zip(lift).filter_map(of_unit).collect())
}

/// Prints and checks the results of [`still`].
fn check(duration: f64) {
    let (largest, lift) = still(duration);
    let [low, high] = [lift.iter().copied().fold(f64::MAX, f64::min), lift.iter().copied().fold(f64::MIN, f64::max)];
    println!(
        "{duration} s of still water: largest displacement {:.3} mm; lift of the {} units under water {low:.3} to {high:.3} \
         of Archimedes",
        1e3 * largest,
        lift.len()
    );
    // Target: 0.1 mm.
    assert!(largest < 1e-4);
    // The units are 2 to 6 particles high. Limit for the mean lift: 2 %.
    let mean = lift.iter().sum::<f64>() / lift.len() as f64;
    assert!(lift.len() > 80 && (mean - 1.0).abs() < 0.02, "{mean}");
}

#[test]
#[ignore = "16 minutes on 2 cores: cargo test --release --test verification -- --ignored --nocapture section::"]
fn no_unit_of_the_section_moves_in_still_water() {
    check(FULL);
}

#[test]
fn no_unit_of_the_section_moves_when_it_is_released() {
    // The units are held for 0.4 s. Units with unloaded springs sink by up to 0.3 mm within 0.05 s.
    check(0.5);
}
