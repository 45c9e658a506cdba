//! Tip of a breaking dam: Koshizuka & Oka (1996), a column of width L and height 2L, here with L = 1 m.
//!
//! The points are those of Martin & Moyce (1952) with a = 57 mm, scaled to L = 1 m. They trail every exact solution:
//! the tip of inviscid water behind a gate that vanishes, [`POTENTIAL_FLOW`], is 10 to 18 % ahead of them from the
//! second point on, by 49 to 65 ms, and no lag puts it onto the first two points at once. What a computation can be
//! held to is therefore the exact solution, and the measurement after a lag common to all points.

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};

use super::data;

const MEASURED: &str = "koshizuka_oka1996/dam_tip_position.txt";

/// Time until which tips are compared [s]: with the measured lag the end wall at 4 m is not yet felt.
const LATEST: f64 = 0.7;

/// Interval of [`POTENTIAL_FLOW`] [s].
const INTERVAL: f64 = 0.02;

/// Position of the tip [m] every 0.02 s in two-dimensional inviscid flow without a gate: a mixed Eulerian-Lagrangian
/// computation with boundary elements on the free surface (images in bed and back wall, g = 9.81 m/s2). Volume and
/// energy are kept to 1e-5 and 5e-5, 250 to 400 nodes agree with half as many to 0.002 m, and the tip obeys
/// du/dt = g tan(slope of the surface there) to 0.6 %.
const POTENTIAL_FLOW: [f64; 37] = [
    1.0090, 1.0302, 1.0609, 1.0995, 1.1451, 1.1971, 1.2548, 1.3178, 1.3858, 1.4584, 1.5354, 1.6165, 1.7015, 1.7903,
    1.8826, 1.9783, 2.0771, 2.1791, 2.2841, 2.3919, 2.5025, 2.6157, 2.7315, 2.8497, 2.9704, 3.0934, 3.2186, 3.3460,
    3.4755, 3.6070, 3.7405, 3.8758, 4.0130, 4.1519, 4.2926, 4.4349, 4.5789,
];

/// Times [s] and positions of the tip [m] as measured, `None` where the data do not lie beside the crate.
fn measured_tips() -> Option<Vec<[f64; 2]>> {
    let rows = data::rows_of::<2>(MEASURED)?;
    Some(rows.into_iter().filter(|[time, _]| *time <= LATEST).collect())
}

/// The case with another particle distance [m].
fn dam(dp: f64) -> Simulation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/dam-break.json");
    let mut case: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    case["domain"]["dp_m"] = dp.into();
    let case = Case::from_str(&case.to_string(), "dam-break.json").unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// The foremost water near the bed [m]; the water begins half a particle distance before its particles.
fn tip(simulation: &Simulation) -> f64 {
    let dp = simulation.case.domain.dp;
    let near_bed = simulation.water.position.iter().filter(|p| p.z < 4.0 * dp);
    near_bed.map(|p| p.x).fold(0.0, f64::max) + 0.5 * dp
}

/// Tip in potential flow [m].
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
        while dam.time < LATEST {
            dam.step().unwrap();
            tips.push([dam.time, tip(&dam)]);
        }
        Self(tips)
    }

    fn at(&self, time: f64) -> f64 {
        let after = self.0.partition_point(|[t, _]| *t < time).clamp(1, self.0.len() - 1);
        let ([t0, x0], [t1, x1]) = (self.0[after - 1], self.0[after]);
        x0 + (time - t0) / (t1 - t0) * (x1 - x0)
    }

    /// Largest deviation from potential flow from 0.1 to 0.64 s, when the tip is 3.9 m from the back wall [-].
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

    /// Deviations from the measured tips, which are taken to be later by `lag` [s], [-].
    fn deviations_from_measured(&self, measured: &[[f64; 2]], lag: f64) -> Vec<f64> {
        measured.iter().map(|[time, x]| self.at((time - lag).max(0.0)) / x - 1.0).collect()
    }
}

fn largest(deviations: &[f64]) -> f64 {
    deviations.iter().map(|d| d.abs()).fold(0.0, f64::max)
}

/// Compare a run with potential flow and with the measurement; returns the largest deviation from potential flow, and
/// the smallest one from the measurement beyond its first point that a common lag leaves.
fn compare(dp: f64) -> (f64, Option<f64>) {
    let tips = Tips::of(dp);
    let from_exact = tips.deviation_from_exact(dp);
    println!("dp = {dp} m: at most {:.1} % from potential flow", 100.0 * from_exact);
    let Some(measured) = measured_tips() else { return (from_exact, None) };
    let percent =
        |deviations: &[f64]| deviations.iter().map(|d| format!("{:+.1}", 100.0 * d)).collect::<Vec<_>>().join(" ");
    let raw = tips.deviations_from_measured(&measured, 0.0);
    println!("measured, as it is: {} %, at most {:.1} %", percent(&raw), 100.0 * largest(&raw));
    let lags = (0..=100).map(|ms| 1e-3 * f64::from(ms));
    let left = |lag: f64| largest(&tips.deviations_from_measured(&measured, lag)[1..]);
    let best = lags.min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap();
    let shifted = tips.deviations_from_measured(&measured, best);
    println!("measured, {:.0} ms later: {} %, at most {:.1} %", 1e3 * best, percent(&shifted), 100.0 * left(best));
    (from_exact, Some(left(best)))
}

#[test]
fn tip_of_the_dam_break_coarse() {
    let (from_exact, from_measured) = compare(0.02);
    // 2.5 % is reached, a little more than a particle distance of the last 3.9 m.
    assert!(from_exact < 0.035);
    // 2.1 % is reached, 3 % is asked.
    assert!(from_measured.is_none_or(|left| left < 0.03));
}

/// `cargo test --release --test validation -- --ignored --nocapture tip_of_the_dam_break_fine`: the case as it is,
/// dp = 0.01 m, and half of it.
#[test]
#[ignore = "half an hour on 2 cores"]
fn tip_of_the_dam_break_fine() {
    let [(coarse, _), (fine, from_measured)] = [0.01, 0.005].map(compare);
    assert!(fine < coarse);
    // 3 % is asked; 1.9 % is reached with dp = 0.01 m.
    assert!(from_measured.is_none_or(|left| left < 0.03));
}
