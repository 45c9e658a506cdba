//! Compares the tip (front) of the water after a dam break with an exact solution and with a measurement. The set-up
//! follows Koshizuka & Oka (1996): a column of width L and height 2L, here with L = 1 m.
//!
//! Koshizuka & Oka show points that Martin & Moyce (1952) measured with a column 57 mm wide. The points are scaled to
//! L = 1 m. These points lag behind every exact solution: from the second point on, the tip of inviscid water without a
//! gate, [`POTENTIAL_FLOW`], is 10 to 18 % (49 to 65 ms) ahead of the measured points. No single time lag fits both the
//! first and the second point. The tests therefore compare the run with the exact solution, and with the measurement
//! after one time lag for all points.

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};

use super::data;

const TABLE: &str = "koshizuka_oka1996.csv";
const SERIES: &str = "koshizuka_oka1996/dam_tip_position.txt";

/// End of the comparison [s]. Because of its time lag, the measured tip has not yet reached the end wall at 4 m.
const LATEST: f64 = 0.7;

/// Time between two values of [`POTENTIAL_FLOW`] [s].
const INTERVAL: f64 = 0.02;

/// Position of the tip [m] at 0.02, 0.04, ... s in two-dimensional inviscid flow without a gate, g = 9.81 m/s2. The
/// method is mixed Eulerian-Lagrangian with boundary elements on the free surface and images in bed and back wall.
/// Errors: volume 1e-5, energy 5e-5, tip acceleration du/dt = g tan(slope of the surface at the tip) 0.6 %. Runs with
/// 250 to 400 nodes differ by at most 0.002 m from runs with half as many nodes.
const POTENTIAL_FLOW: [f64; 37] = [
    1.0090, 1.0302, 1.0609, 1.0995, 1.1451, 1.1971, 1.2548, 1.3178, 1.3858, 1.4584, 1.5354, 1.6165, 1.7015, 1.7903,
    1.8826, 1.9783, 2.0771, 2.1791, 2.2841, 2.3919, 2.5025, 2.6157, 2.7315, 2.8497, 2.9704, 3.0934, 3.2186, 3.3460,
    3.4755, 3.6070, 3.7405, 3.8758, 4.0130, 4.1519, 4.2926, 4.4349, 4.5789,
];

/// Returns measured times [s] and tip positions [m] from each source: the table, and the full series if it exists.
///
/// The same tolerance applies to both sources. The times of the table are within 0.01 s of published points, so linear
/// interpolation changes the largest deviation from potential flow by at most 0.2 %.
fn measured_tips() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let until_latest =
        |rows: Vec<[f64; 2]>| rows.into_iter().filter(|[time, _]| *time <= LATEST).collect::<Vec<[f64; 2]>>();
    data::table_and_series(until_latest(data::table_of(TABLE)), data::series_of(SERIES).map(until_latest))
}

/// Creates the simulation of the case file with the particle spacing `dp` [m].
fn dam(dp: f64) -> Simulation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/dam-break.json");
    let mut case: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    case["domain"]["dp_m"] = dp.into();
    let case = Case::from_str(&case.to_string(), "dam-break.json").unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// Returns the position of the tip near the bed [m]. The tip is half a particle spacing ahead of the foremost particle.
fn tip(simulation: &Simulation) -> f64 {
    let dp = simulation.case.domain.dp;
    let near_bed = simulation.water.position.iter().filter(|p| p.z < 4.0 * dp);
    near_bed.map(|p| p.x).fold(0.0, f64::max) + 0.5 * dp
}

/// Returns the tip position in potential flow [m].
fn exact_tip(time: f64) -> f64 {
    let at = time / INTERVAL - 1.0;
    let k = (at as usize).min(POTENTIAL_FLOW.len() - 2);
    POTENTIAL_FLOW[k] + (at - k as f64) * (POTENTIAL_FLOW[k + 1] - POTENTIAL_FLOW[k])
}

/// Tips of a run: times [s] and positions [m].
struct Tips(Vec<[f64; 2]>);

impl Tips {
    fn of(dp: f64) -> Self {
        let mut dam = dam(dp);
        let mut tips = vec![[0.0, tip(&dam)]];
        // As in `output::driver::drive`, the loop runs on a thread of the rayon pool.
        rayon::scope(|_| {
            while dam.time < LATEST {
                dam.step().unwrap();
                tips.push([dam.time, tip(&dam)]);
            }
        });
        Self(tips)
    }

    fn at(&self, time: f64) -> f64 {
        let after = self.0.partition_point(|[t, _]| *t < time).clamp(1, self.0.len() - 1);
        let ([t0, x0], [t1, x1]) = (self.0[after - 1], self.0[after]);
        x0 + (time - t0) / (t1 - t0) * (x1 - x0)
    }

    /// Returns the largest relative deviation from potential flow [-] between 0.1 and 0.64 s. At 0.64 s, the distance
    /// between tip and back wall is 3.9 m.
    fn deviation_from_exact(&self, dp: f64) -> f64 {
        let times = (5..=32).map(|k| f64::from(k) * INTERVAL);
        let deviations = times.map(|time| {
            let (computed, exact) = (self.at(time), exact_tip(time));
            println!(
                "dp = {dp} m, t = {time:.2} s: tip {computed:.3} m, potential flow {exact:.3} m, {:+.1} %",
                100.0 * (computed / exact - 1.0)
            );
            (computed / exact - 1.0).abs()
        });
        deviations.fold(0.0, f64::max)
    }

    /// Returns the relative deviations from the measured tips [-], with measured times reduced by the lag [s].
    fn deviations_from_measured(&self, measured: &[[f64; 2]], lag: f64) -> Vec<f64> {
        measured.iter().map(|[time, x]| self.at((time - lag).max(0.0)) / x - 1.0).collect()
    }

    /// Returns the largest relative deviation from the measured tips [-] with the best time lag for all points. The
    /// first point is left out.
    fn deviation_after_lag(&self, source: &str, measured: &[[f64; 2]]) -> f64 {
        let percent =
            |deviations: &[f64]| deviations.iter().map(|d| format!("{:+.1}", 100.0 * d)).collect::<Vec<_>>().join(" ");
        let unshifted = self.deviations_from_measured(measured, 0.0);
        println!("deviations from {source}: {} %, largest {:.1} %", percent(&unshifted), 100.0 * largest(&unshifted));
        let lags = (0..=100).map(|ms| 1e-3 * f64::from(ms));
        let remaining = |lag: f64| largest(&self.deviations_from_measured(measured, lag)[1..]);
        let best = lags.min_by(|a, b| remaining(*a).total_cmp(&remaining(*b))).unwrap();
        let shifted = self.deviations_from_measured(measured, best);
        println!(
            "with a lag of {:.0} ms: {} %, largest {:.1} %",
            1e3 * best,
            percent(&shifted),
            100.0 * remaining(best)
        );
        remaining(best)
    }
}

fn largest(deviations: &[f64]) -> f64 {
    deviations.iter().map(|d| d.abs()).fold(0.0, f64::max)
}

/// Compares a run with potential flow and with the measurement. Returns the largest relative deviation from each [-];
/// [`Tips::deviation_after_lag`] defines the deviation from the measurement.
fn compare(dp: f64) -> (f64, f64) {
    let tips = Tips::of(dp);
    let from_exact = tips.deviation_from_exact(dp);
    println!("dp = {dp} m: largest deviation from potential flow {:.1} %", 100.0 * from_exact);
    let sources = measured_tips();
    let from_measured = sources.iter().map(|(source, measured)| tips.deviation_after_lag(source, measured));
    (from_exact, from_measured.fold(0.0, f64::max))
}

#[test]
fn dam_break_tip_follows_potential_flow_coarse() {
    let (from_exact, from_measured) = compare(0.02);
    // Reached: a deviation of 2.5 % from potential flow.
    assert!(from_exact < 0.035);
    // Target: a deviation of at most 3 % from the measurement; reached: 2.1 %.
    assert!(from_measured < 0.03);
}

/// Runs the case with the particle spacing of its file, dp = 0.01 m, and with half this spacing.
#[test]
#[ignore = "30 minutes on 2 cores: \
    cargo test --release --test validation -- --ignored --nocapture dam_break_tip_follows_potential_flow_fine"]
fn dam_break_tip_follows_potential_flow_fine() {
    let [(coarse, _), (fine, from_measured)] = [0.01, 0.005].map(compare);
    assert!(fine < coarse);
    // Target: a deviation of at most 3 % from the measurement; reached with dp = 0.01 m: 1.9 %.
    assert!(from_measured < 0.03);
}
