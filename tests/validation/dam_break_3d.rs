//! Three-dimensional dam break in a tank with a building, compared with a DualSPHysics v5.4 calculation.
//!
//! Both programs solve the same equations with the same constants on the same lattice, so the test compares two
//! programs and not a program with an experiment. The walls of DualSPHysics are one layer of particles with the dynamic
//! boundary condition. The tip is the largest x of a water particle, in the axes of the DualSPHysics calculation.

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};
use serde_json::{Value, json};

use super::data;

const TABLE: &str = "dualsphysics_dambreak3d.csv";
const SERIES: &str = "dualsphysics_dambreak3d/series.csv";

/// x of the back wall's surface in the DualSPHysics calculation [m].
const BACK_WALL_X: f64 = 0.02;

/// Particle spacing [m].
const DP: f64 = 0.02;

/// Tip [m] and kinetic energy [J] at a time [s].
#[derive(Clone, Copy)]
struct Moment {
    time: f64,
    tip: f64,
    kinetic: f64,
}

/// Returns the DualSPHysics results up to a time [s] in order of time, each with its source.
///
/// The same tolerance applies to both sources: each time in the table differs by less than 0.3 ms from an output time
/// of DualSPHysics, and the tip moves by less than 1 mm in 0.3 ms.
fn reference(end: f64) -> Vec<(&'static str, Moment)> {
    let table = data::table_of(TABLE).into_iter().map(|[time, tip, kinetic]| Moment { time, tip, kinetic }).collect();
    let series = data::series_of(SERIES).map(|rows: Vec<[f64; 6]>| {
        rows.into_iter().map(|[time, tip, _, _, kinetic, _]| Moment { time, tip, kinetic }).collect::<Vec<Moment>>()
    });
    let sources = data::table_and_series(table, series).into_iter();
    let mut moments: Vec<(&str, Moment)> =
        sources.flat_map(|(source, moments)| moments.into_iter().map(move |moment| (source, moment))).collect();
    moments.retain(|(_, moment)| moment.time <= end + 1e-3);
    moments.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time));
    moments
}

/// Loads the case file and sets the value at each given JSON pointer.
fn case(changes: &[(&str, Value)]) -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/dam-break-3d.json");
    let mut case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    for (pointer, value) in changes {
        *case.pointer_mut(pointer).unwrap() = value.clone();
    }
    Case::from_str(&case.to_string(), "dam-break-3d.json").unwrap_or_else(|errors| panic!("{errors}"))
}

/// Runs a case and returns its state at the given times [s], which must increase.
fn run(case: Case, times: impl Iterator<Item = f64>) -> Vec<Moment> {
    let mut dam = Simulation::new(Arc::new(case)).unwrap();
    let measure = |dam: &Simulation| Moment {
        time: dam.time,
        tip: dam.water.position.iter().map(|p| p.x).fold(0.0, f64::max) + BACK_WALL_X,
        kinetic: dam.energy().kinetic,
    };
    let (mut before, mut now) = (measure(&dam), measure(&dam));
    let mut moments = Vec::new();
    for time in times {
        while now.time < time {
            dam.step().unwrap();
            (before, now) = (now, measure(&dam));
        }
        let share = if now.time > before.time { (time - before.time) / (now.time - before.time) } else { 0.0 };
        let between = |a: f64, b: f64| a + share * (b - a);
        let (tip, kinetic) = (between(before.tip, now.tip), between(before.kinetic, now.kinetic));
        moments.push(Moment { time, tip, kinetic });
    }
    moments
}

/// Largest deviations: of the tip [m], and of the kinetic energy from 0.1 s on [-].
struct Deviations {
    tip: f64,
    kinetic: f64,
}

/// Time from which kinetic energies are compared [s]. Earlier energies are too small for a relative deviation.
const COMPARE_ENERGY_FROM: f64 = 0.1;

/// Compares one run with all sources and returns the largest deviations.
fn compare(name: &str, changes: &[(&str, Value)], end: f64) -> Deviations {
    let reference = reference(end);
    let computed = run(case(changes), reference.iter().map(|(_, moment)| moment.time));
    let mut largest = Deviations { tip: 0.0, kinetic: 0.0 };
    for (a, (source, b)) in computed.iter().zip(&reference) {
        let share = a.kinetic / b.kinetic - 1.0;
        println!(
            "{name}, {source}: t = {:.3} s, tip {:.4} m ({:+.2} dp), kinetic energy {:.3} J ({:+.2} %)",
            a.time,
            a.tip,
            (a.tip - b.tip) / DP,
            a.kinetic,
            100.0 * share
        );
        largest.tip = largest.tip.max((a.tip - b.tip).abs());
        if b.time > COMPARE_ENERGY_FROM {
            largest.kinetic = largest.kinetic.max(share.abs());
        }
    }
    println!("{name}: largest deviations {:.2} dp, {:.2} %", largest.tip / DP, 100.0 * largest.kinetic);
    largest
}

/// Returns the changes that select mDBC and the three boundary layers that mDBC needs.
fn with_mdbc() -> [(&'static str, Value); 2] {
    [("/numerics/boundary", json!("mdbc")), ("/numerics/boundary_layers", json!(3))]
}

/// Asserts that the unchanged case agrees with DualSPHysics up to a time [s].
fn assert_equals_dualsphysics(end: f64) {
    let deviations = compare("unchanged", &[], end);
    // Limits: for the tip one particle spacing, the resolution of the lattice; for the energy 2 %. Reached for the
    // energy: 1.1 %. If density diffusion also acts on wall particles, the energy deviates by 3 % at 0.12 s and 12 % at
    // 0.6 s. With a building one particle narrower, the energy deviates by 7 %.
    assert!(deviations.tip < DP && deviations.kinetic < 0.02);
}

/// The comparison ends when the water hits the building.
#[test]
fn dam_break_equals_dualsphysics_before_the_building() {
    assert_equals_dualsphysics(0.29);
}

#[test]
#[ignore = "2 minutes on 2 cores: \
    cargo test --release --test validation -- --ignored --nocapture dam_break_equals_dualsphysics_past_the_building"]
fn dam_break_equals_dualsphysics_past_the_building() {
    assert_equals_dualsphysics(0.81);
}

/// Changes one setting at a time and prints the deviations; asserts nothing.
#[test]
#[ignore = "10 minutes on 2 cores, prints only: \
    cargo test --release --test validation -- --ignored --nocapture dam_break_sensitivity_to_single_settings"]
fn dam_break_sensitivity_to_single_settings() {
    const END: f64 = 0.6;
    compare("without diffusion", &[("/numerics/density_diffusion", json!("none"))], END);
    compare("three boundary layers", &[("/numerics/boundary_layers", json!(3))], END);
    compare("narrower building", &[("/domain/obstacles/0/high_m/0", json!(1.0))], END);
    compare("mDBC", &with_mdbc(), END);
}
