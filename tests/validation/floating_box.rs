//! A box that floats freely in regular waves: Ren, He, Dong & Wen (2015), 0.30 m long, 0.20 m high, half as heavy as
//! water, in 0.40 m of water, H = 0.10 m, T = 1.2 s.
//!
//! The measurement has no common zero of time with a computation: the first full heave crest of both is aligned.
//! Motions are compared by what fits them best in the five periods after it, a + b t + C cos(omega t) + S sin(omega t):
//! amplitude and phase of heave and roll, drift of surge. A box that drifts with the waves meets fewer of them: omega
//! is the one with which heave is fitted best.

use std::{f64::consts::TAU, path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};
use glam::{DMat4, DVec4};

use super::data;

const MEASURED: &str = "ren2015_floating_box/motion.csv";
const CASE: &str = "cases/verification/floating-box.json";

/// Period of the waves [s].
const PERIOD: f64 = 1.2;
/// Periods that are compared; the measurement has five and a half after its first crest.
const PERIODS: f64 = 5.0;
/// A heave crest higher than this is a full one [m]; measured are 0.047 to 0.054 m.
const FULL_CREST: f64 = 0.035;

/// Time [s], surge [m], heave [m], roll [degrees].
type Row = [f64; 4];

fn measured() -> Option<Vec<Row>> {
    data::rows_of(MEASURED)
}

/// What is computed of the flume.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    /// Ten particles of its width, periodic. The box leaves a gap of a fiftieth of a particle distance to its own image:
    /// enough for the contact search to see two faces apart, and too little for water.
    Slice,
    /// A layer in two dimensions.
    Layer,
}

/// The case with another particle distance [m].
fn tank(dp: f64, part: Part) -> Simulation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(CASE);
    let mut case: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    if part == Part::Layer {
        case["domain"]["dp_m"] = dp.into();
        case["domain"]["sides"] = "two_dimensional".into();
        case["domain"].as_object_mut().unwrap().remove("width_m");
    } else if case["domain"]["dp_m"] != dp {
        let width = 10.0 * dp - 0.02 * dp;
        case["domain"]["dp_m"] = dp.into();
        case["domain"]["width_m"] = (10.0 * dp).into();
        case["units"]["size_m"][1] = width.into();
        case["units"]["mass_kg"] = (500.0 * 0.3 * 0.2 * width).into();
        case["units"]["centres_m"][0][1] = (5.0 * dp).into();
    }
    let case = Case::from_str(&case.to_string(), CASE).unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// Motion of the box until five periods after its first full crest. Roll is positive with the seaward side up.
fn computed(dp: f64, part: Part) -> Vec<Row> {
    let mut tank = tank(dp, part);
    let (mut rows, end) = (Vec::new(), tank.case.stop.duration);
    while tank.time < end {
        let (state, start) = (tank.units.as_ref().unwrap().states()[0], tank.units.as_ref().unwrap().start[0]);
        let moved = state.position - start.position;
        let along = state.rotation * glam::DVec3::X;
        rows.push([tank.time, moved.x, moved.z, (-along.z).atan2(along.x).to_degrees()]);
        if first_full_crest(&rows).is_some_and(|crest| tank.time > crest + PERIODS * PERIOD) {
            break;
        }
        tank.step().unwrap();
    }
    rows
}

/// Time of the highest heave within half a period of the first one above [`FULL_CREST`] [s]; `None` until it is over.
fn first_full_crest(rows: &[Row]) -> Option<f64> {
    let first = rows.iter().position(|row| row[2] > FULL_CREST)?;
    let end = rows[first][0] + 0.5 * PERIOD;
    let of_crest = rows[first..].iter().take_while(|row| row[0] < end);
    let highest = of_crest.max_by(|a, b| a[2].total_cmp(&b[2]))?;
    (rows[rows.len() - 1][0] >= end).then_some(highest[0])
}

/// What fits a motion best.
#[derive(Debug, Clone, Copy)]
struct Fit {
    mean: f64,
    /// Drift [1/s].
    drift: f64,
    amplitude: f64,
    /// Phase after the first full heave crest [degrees].
    phase: f64,
}

/// Fit one column of the rows over the five periods after a time [s], with a period [s]; and what it leaves, the sum of
/// squares.
fn fit(rows: &[Row], column: usize, from: f64, period: f64) -> (Fit, f64) {
    let basis = |row: &Row| {
        let t = row[0] - from;
        let (sin, cos) = (TAU * t / period).sin_cos();
        DVec4::new(1.0, t, cos, sin)
    };
    let rows = || rows.iter().filter(|row| (from..=from + PERIODS * PERIOD).contains(&row[0]));
    let (mut matrix, mut right) = (DMat4::ZERO, DVec4::ZERO);
    for row in rows() {
        let basis = basis(row);
        matrix += DMat4::from_cols(basis * basis.x, basis * basis.y, basis * basis.z, basis * basis.w);
        right += basis * row[column];
    }
    let solution = matrix.inverse() * right;
    let left = rows().map(|row| (row[column] - basis(row).dot(solution)).powi(2)).sum();
    let [mean, drift, cos, sin] = solution.to_array();
    (Fit { mean, drift, amplitude: cos.hypot(sin), phase: sin.atan2(cos).to_degrees() }, left)
}

/// Fits of surge, heave and roll after the first full crest, and the period of heave [s].
fn fits(rows: &[Row]) -> ([Fit; 3], f64) {
    let crest = first_full_crest(rows).expect("the box never rose to a full crest");
    let periods = (0..=300).map(|k| PERIOD * (0.9 + 1e-3 * f64::from(k)));
    let left = |period: &f64| fit(rows, 2, crest, *period).1;
    let period = periods.min_by(|a, b| left(a).total_cmp(&left(b))).unwrap();
    ([1, 2, 3].map(|column| fit(rows, column, crest, period).0), period)
}

/// Angle between -180 and 180 degrees.
fn wrapped(degrees: f64) -> f64 {
    degrees - 360.0 * (degrees / 360.0).round()
}

/// Run, print and compare; returns amplitude ratios and phase differences [degrees] of heave and roll and the ratio of
/// the drifts, or nothing without measurements.
fn compare(dp: f64, part: Part) -> Option<[f64; 5]> {
    let rows = computed(dp, part);
    let ([surge, heave, roll], period) = fits(&rows);
    println!("dp = {dp} m: period {period:.3} s, surge {surge:.4?}\n    heave {heave:.4?}\n    roll {roll:.3?}");
    let ([surge_m, heave_m, roll_m], period_m) = fits(&measured()?);
    println!("measured: period {period_m:.3} s, surge {surge_m:.4?}\n    heave {heave_m:.4?}\n    roll {roll_m:.3?}");
    let result = [
        heave.amplitude / heave_m.amplitude,
        wrapped(heave.phase - heave_m.phase),
        roll.amplitude / roll_m.amplitude,
        wrapped(roll.phase - roll_m.phase),
        surge.drift / surge_m.drift,
    ];
    println!(
        "dp = {dp} m: heave {:+.1} %, {:+.0} degrees; roll {:+.1} %, {:+.0} degrees; drift {:+.1} %",
        100.0 * (result[0] - 1.0),
        result[1],
        100.0 * (result[2] - 1.0),
        result[3],
        100.0 * (result[4] - 1.0)
    );
    Some(result)
}

#[test]
fn a_fit_finds_amplitude_phase_and_drift() {
    let motion = |t: f64| 0.3 + 0.1 * t + 0.05 * (TAU * t / 1.25 - 0.5).cos();
    let rows: Vec<Row> = (0..600).map(|i| 0.0101 * f64::from(i)).map(|t| [t, motion(t), 0.0, 0.0]).collect();
    let (found, left) = fit(&rows, 1, 0.0, 1.25);
    assert!(left < 1e-18);
    assert!((found.mean - 0.3).abs() < 1e-9 && (found.drift - 0.1).abs() < 1e-9);
    assert!((found.amplitude - 0.05).abs() < 1e-9 && (found.phase - 0.5_f64.to_degrees()).abs() < 1e-6);
}

/// Hold a comparison to what was seen: heave and roll as measured, and a drift over the measured one that comes with the
/// resolution. A fit over half of the periods has another drift by a quarter: ranges are 0.15 to either side.
fn hold(result: Option<[f64; 5]>, roll: f64, drift: [f64; 2]) {
    let Some([heave, _, of_roll, _, of_drift]) = result else { return };
    assert!((heave - 1.0).abs() < 0.1 && (of_roll - 1.0).abs() < roll, "heave {heave}, roll {of_roll}");
    assert!(of_drift > drift[0] && of_drift < drift[1], "drift {of_drift}");
}

/// `cargo test --release --test validation -- --ignored --nocapture floating_box_in_a_slice`
#[test]
#[ignore = "20 minutes on one core"]
fn floating_box_in_a_slice() {
    hold(compare(0.025, Part::Slice), 0.3, [0.3, 0.6]);
}

/// `cargo test --release --test validation -- --ignored --nocapture floating_box_in_a_layer`
#[test]
#[ignore = "a minute on one core"]
fn floating_box_in_a_layer() {
    hold(compare(0.025, Part::Layer), 0.2, [0.3, 0.6]);
}

/// `cargo test --release --test validation -- --ignored --nocapture floating_box_in_a_fine_layer`
#[test]
#[ignore = "8 minutes on one core"]
fn floating_box_in_a_fine_layer() {
    hold(compare(0.0125, Part::Layer), 0.2, [0.5, 0.8]);
}

/// `cargo test --release --test validation -- --ignored --nocapture floating_box_in_a_finer_layer`
#[test]
#[ignore = "40 minutes on one core"]
fn floating_box_in_a_finer_layer() {
    hold(compare(0.00625, Part::Layer), 0.2, [0.8, 1.1]);
}
