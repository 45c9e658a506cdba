//! Still water stays still, and its pressure hydrostatic.

use std::path::Path;

use breakwater::simulation::flume::{Simulation, step::PreparedStep};
use glam::DVec3;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation, still_tank};

/// Kinetic energy of the water [J], largest over the first and over the last third of a run.
#[derive(Default)]
struct Calming {
    early: f64,
    late: f64,
}

impl Calming {
    fn look(&mut self, simulation: &Simulation, end: f64) {
        let kinetic = simulation.energy().kinetic;
        if simulation.time < end / 3.0 {
            self.early = self.early.max(kinetic);
        }
        if simulation.time > 2.0 * end / 3.0 {
            self.late = self.late.max(kinetic);
        }
    }
}

/// Error of the pressure at the points [m], as a share of that on the bed, mean over the second half of a run.
struct PressureError {
    points: Vec<DVec3>,
    level: f64,
    depth: f64,
    sums: Vec<f64>,
    count: f64,
}

impl PressureError {
    fn new(points: Vec<DVec3>, level: f64, depth: f64) -> Self {
        Self { sums: vec![0.0; points.len()], points, level, depth, count: 0.0 }
    }

    fn look(&mut self, now: &mut PreparedStep, end: f64) {
        if now.time < 0.5 * end || !now.steps.is_multiple_of(5) {
            return;
        }
        let sampler = now.sampler().unwrap();
        for (point, sum) in self.points.iter().zip(&mut self.sums) {
            let hydrostatic = RHO0 * GRAVITY * (self.level - point.z);
            *sum += (sampler.sample(*point).unwrap().pressure - hydrostatic) / (RHO0 * GRAVITY * self.depth);
        }
        self.count += 1.0;
    }

    /// The largest over the points [-].
    fn largest(&self) -> f64 {
        for (point, sum) in self.points.iter().zip(&self.sums) {
            println!("  pressure at {point:.3} m: {:+.2} % of that on the bed", 100.0 * sum / self.count);
        }
        self.sums.iter().map(|sum| (sum / self.count).abs()).fold(0.0, f64::max)
    }
}

#[test]
fn a_flat_tank_stays_hydrostatic() {
    let (length, depth, dp, end) = (0.24, 0.3, 0.02, 2.4);
    let mut tank = simulation(&still_tank(length, 0.2, depth, dp, end));
    let mass: f64 = tank.water.mass.iter().sum();
    let at = |x: f64, z: f64| DVec3::new(x, 0.1, z);
    let points = [0.04, 0.12, 0.2].iter().flat_map(|&x| [at(x, 0.0), at(x, 0.1), at(x, 0.2)]).collect();
    let mut pressure = PressureError::new(points, depth, depth);
    let mut calming = Calming::default();
    run_until(&mut tank, end, |now| {
        pressure.look(now, end);
        calming.look(now, end);
    });
    let fastest = tank.water.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    let largest = pressure.largest();
    println!(
        "flat tank: pressure within {:.2} % of that on the bed, kinetic energy {:.1e} to {:.1e} J, fastest {fastest:.4} m/s",
        100.0 * largest,
        calming.early,
        calming.late
    );
    // 1 %: a seventh of what a particle distance of water weighs here. The weight of the compressed water is 0.2 % of
    // it (g d / 2 c0^2, c0 being 15 sqrt(g d)); the kernel, cut off at the surface, makes most of the rest.
    assert!(largest < 0.01);
    // It starts in equilibrium but for the kernel's truncation at the surface, and what that stirs up dies away.
    assert!(calming.late < 0.5 * calming.early);
    assert!((tank.water.mass.iter().sum::<f64>() / mass - 1.0).abs() < 1e-12);
}

#[test]
fn a_gauge_that_rises_shows_the_pressure_of_its_height() {
    let (depth, end) = (0.3, 0.4);
    let mut case = still_tank(0.24, 0.2, depth, 0.02, end);
    case["gauges"] = json!([
        { "kind": "pressure", "name": "rising", "at_m": [0.12, 0.1, 0.05], "way": [[0.1, 0.0, 0.0, 0.0], [0.3, 0.02, 0.0, 0.2]] }
    ]);
    let mut tank = simulation(&case);
    let mut seen = Vec::new();
    run_until(&mut tank, end, |now| {
        let place = now.place_of(&now.case.gauges[0]);
        let pressure = now.sampler().unwrap().sample(place).unwrap().pressure;
        seen.push((now.time, place, pressure / (RHO0 * GRAVITY * depth) - (1.0 - place.z / depth)));
    });
    let of = |from: f64, to: f64| seen.iter().filter(move |(t, ..)| (from..to).contains(t));
    assert!(of(0.0, 0.1).all(|(_, place, _)| (place.z - 0.05).abs() < 1e-12));
    assert!(of(0.19, 0.21).all(|(t, place, _)| (place.z - (0.05 + (t - 0.1))).abs() < 1e-12));
    assert!(of(0.31, 0.4).all(|(_, place, _)| (place.z - 0.25).abs() < 1e-12 && (place.x - 0.14).abs() < 1e-12));
    let largest = seen.iter().map(|(_, _, error)| error.abs()).fold(0.0, f64::max);
    println!("rising gauge: pressure within {:.2} % of that on the bed", 100.0 * largest);
    // 3 %: half of what a particle distance weighs here; the water comes to rest in the first tenths of a second.
    assert!(largest < 0.03);
}

/// The case `cases/verification/still-water.json` with a domain [m] and a duration [s] of its own.
fn mound_with_two_units(x: [f64; 2], end: f64) -> Simulation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/still-water.json");
    let mut case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    case["domain"]["x_m"] = json!(x);
    case["gauges"] = json!([]);
    case["stop"]["duration_s"] = json!(end);
    simulation(&case)
}

fn nothing_moves_over_the_mound(x: [f64; 2], end: f64) {
    let mut flume = mound_with_two_units(x, end);
    let case = flume.case.clone();
    let (level, deepest) = (case.flume.still_level, case.domain.depth);
    let on_bed = |x: f64| DVec3::new(x, 0.08, case.flume.profile.z(x));
    // Before and behind the mound, on its flanks, and on its crest away from the units.
    let places = [38.5, 38.6, 38.8, 38.88, 39.12, 39.2, 39.45, 39.55];
    let mut pressure = PressureError::new(places.map(on_bed).to_vec(), level, deepest);
    let mut calming = Calming::default();
    let mass: f64 = flume.water.mass.iter().sum();
    run_until(&mut flume, end, |now| {
        pressure.look(now, end);
        calming.look(now, end);
    });
    let units = flume.units.as_ref().unwrap();
    let moved = units.states().iter().zip(&units.start).map(|(now, start)| (now.position - start.position).length());
    let furthest = moved.fold(0.0, f64::max);
    let largest = pressure.largest();
    println!(
        "mound: {} particles, {end} s; units moved {:.4} mm (across the ground {:.4?} mm), pressure within {:.2} %, \
         kinetic energy {:.1e} to {:.1e} J",
        flume.water.len(),
        1e3 * furthest,
        units.displacements().iter().map(|d| 1e3 * d).collect::<Vec<_>>(),
        100.0 * largest,
        calming.early,
        calming.late
    );
    // 0.1 mm: a thousandth of the distance that counts as damage. A unit's own weight presses it 0.03 mm into the bed.
    assert!(furthest < 1e-4);
    // 1 %: a tenth of what a particle distance of water weighs.
    assert!(largest < 0.01);
    assert!(calming.late < 0.5 * calming.early);
    assert!((flume.water.mass.iter().sum::<f64>() / mass - 1.0).abs() < 1e-12);
}

#[test]
fn nothing_moves_over_a_mound_for_half_a_second() {
    nothing_moves_over_the_mound([38.4, 39.65], 0.5);
}

/// `cargo test --release --test verification -- --ignored --nocapture nothing_moves_over_a_mound_for_three_seconds`
#[test]
#[ignore = "a quarter of an hour on 2 cores"]
fn nothing_moves_over_a_mound_for_three_seconds() {
    nothing_moves_over_the_mound([38.0, 40.0], 3.0);
}
