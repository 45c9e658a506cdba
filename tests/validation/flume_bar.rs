//! Compares the flume model with regular waves over a submerged bar, as Beji & Battjes (1993) measured them: T = 2.02 s
//! and H = 2 cm in 0.4 m of water.
//!
//! The bar has a seaward slope of 1:20 and a shoreward slope of 1:10. Its crest is 0.1 m below the still water level.
//! Behind the bar, bound harmonics become free waves. A beach of 1:25 closes the flume from x = 18.95 m on. The surface
//! was measured at eight gauges; one time shift, common to all gauges, aligns measurement and model.

use std::f64::consts::TAU;

use breakwater::geometry::profile::Profile;
use breakwater::waves::flume_model::incoming::IncomingWave;
use breakwater::waves::flume_model::layered::{Breaking, Friction, Pressure, RightEnd};
use breakwater::waves::flume_model::record::FlumeRecord;
use breakwater::waves::flume_model::{FlumeSetup, WaveSource, run};
use breakwater::waves::theory::regular::{MeanFlow, RegularWave};
use breakwater::waves::theory::stream_function::StreamFunctionWave;

use super::data;

const GRAVITY: f64 = 9.81;
const PERIOD_S: f64 = 2.02;
const GAUGES_X_M: [f64; 8] = [10.5, 12.5, 13.5, 14.5, 15.7, 17.3, 19.0, 21.0];

/// Times [s] and elevations [m] of each gauge.
type Gauges = Vec<Vec<[f64; 2]>>;

/// Returns the measured elevations from each source.
///
/// The same tolerance applies to both sources. For skills of 0.4 to 0.8, the skills with the table and with the full
/// series differ by at most 0.03, on average by 0.01, because the six harmonics leave out only scatter.
fn measured() -> Vec<(&'static str, Gauges)> {
    data::table_and_series(gauges_of_table(), (4..12).map(gauge_of_series).collect())
}

/// Returns the elevations at round times, computed from the harmonics in the table.
fn gauges_of_table() -> Gauges {
    let elevation = |row: &[f64; 15], time: f64| {
        let harmonic = |(n, [amplitude, phase]): (usize, &[f64; 2])| {
            amplitude * ((n + 1) as f64 * TAU * (time - MIDDLE_S) / MEASURED_PERIOD_S - phase.to_radians()).cos()
        };
        1e-3 * (row[2] + row[3..].as_chunks().0.iter().enumerate().map(harmonic).sum::<f64>())
    };
    let times: Vec<f64> = (331..390).map(|tenths| 0.1 * f64::from(tenths)).collect();
    let gauge = |row: &[f64; 15]| times.iter().map(|time| [*time, elevation(row, *time)]).collect();
    data::table_of("beji_battjes_bar.csv").iter().map(gauge).collect()
}

/// Returns times [s] and elevations [m] of a gauge in the full series, without duplicates.
fn gauge_of_series(gauge: usize) -> Result<Vec<[f64; 2]>, String> {
    let rows = data::series_of::<2>(&format!("beji_battjes_bar/gauge-{gauge}.txt"))?;
    let mut points: Vec<[f64; 2]> = rows.into_iter().map(|[time, cm]| [time, 0.01 * cm]).collect();
    // The files contain each series twice.
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points.dedup();
    Ok(points)
}

fn flume(layers: usize, cell_m: f64) -> FlumeRecord {
    let wave = RegularWave { height_m: 0.02, period_s: PERIOD_S, depth_m: 0.4, gravity: GRAVITY };
    let wave = StreamFunctionWave::new(wave, MeanFlow::NoTransport).unwrap();
    let bar = vec![[0.0, -0.4], [6.0, -0.4], [12.0, -0.1], [14.0, -0.1], [17.0, -0.4], [18.95, -0.4], [31.45, 0.1]];
    run(&FlumeSetup {
        profile: Profile::new(bar),
        still_level_m: 0.0,
        gravity_m_s2: GRAVITY,
        wave: WaveSource::Inflow(IncomingWave::Regular { wave, ramp_s: 2.0 * PERIOD_S }),
        right_end: RightEnd::Wall,
        pressure: Pressure::NonHydrostatic,
        friction: Friction::SmoothBed { viscosity_m2_s: 1e-6 },
        breaking: Breaking::default(),
        layers,
        cell_m,
        gauges_x_m: GAUGES_X_M.to_vec(),
        profile_times_s: Vec::new(),
        window_x_m: [0.0, 1.0],
        record_interval_s: 0.02,
        end_s: 39.0,
    })
    .unwrap()
}

/// Returns the skill of the model [-]: 1 - root mean square error / standard deviation of the measurement.
fn skill(points: &[[f64; 2]], model: impl Fn(f64) -> f64) -> f64 {
    let n = points.len() as f64;
    let mean = points.iter().map(|p| p[1]).sum::<f64>() / n;
    let variance = points.iter().map(|p| (p[1] - mean).powi(2)).sum::<f64>() / n;
    let error = points.iter().map(|p| (p[1] - model(p[0])).powi(2)).sum::<f64>() / n;
    1.0 - (error / variance).sqrt()
}

/// Period of the measured series [s]: six harmonics of this period fit all gauges best. The time lags between gauges
/// agree with waves of the period [`PERIOD_S`], so the time axis of the files is 1 % too short.
const MEASURED_PERIOD_S: f64 = 2.0;
/// Middle of the measured series [s].
const MIDDLE_S: f64 = 36.0;

/// Results of a model run and the measured series.
struct Comparison<'a> {
    record: &'a FlumeRecord,
    gauges: Gauges,
}

impl Comparison<'_> {
    /// Returns the skill at a gauge. The time axis of the measurement is scaled by `clock`, then shifted by `shift`
    /// [s].
    fn skill(&self, gauge: usize, shift: f64, clock: f64) -> f64 {
        let series = &self.record.gauge_elevations_m[gauge];
        let at = |t: f64| {
            let index = (MIDDLE_S + clock * (t - MIDDLE_S) + shift) / self.record.interval_s;
            let before = (index as usize).min(series.len() - 2);
            series[before] + (index - before as f64) * (series[before + 1] - series[before])
        };
        skill(&self.gauges[gauge], at)
    }

    /// Returns the skill at every gauge, with the time shift for all gauges that gives the best mean skill.
    fn skills(&self, clock: f64) -> Vec<f64> {
        let skills_with = |shift| -> Vec<f64> { (0..8).map(|gauge| self.skill(gauge, shift, clock)).collect() };
        shifts().map(skills_with).max_by(|a, b| mean(a).total_cmp(&mean(b))).unwrap()
    }

    /// Returns, for each gauge separately, the best time shift [s] and the skill with this shift.
    fn own_shifts(&self, clock: f64) -> Vec<[f64; 2]> {
        let best = |gauge| {
            let candidates = shifts().map(|shift| [shift, self.skill(gauge, shift, clock)]);
            candidates.max_by(|a, b| a[1].total_cmp(&b[1])).unwrap()
        };
        (0..8).map(best).collect()
    }
}

/// Iterates over the time shifts [s] from 0 to minus one period.
fn shifts() -> impl Iterator<Item = f64> {
    (0..202).map(|i| -0.01 * f64::from(i))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Returns, for each source, the skills with the time axis of the files and with the corrected time axis.
fn compare(layers: usize, cell_m: f64) -> Vec<[Vec<f64>; 2]> {
    let record = flume(layers, cell_m);
    let compare = |(source, gauges)| {
        let comparison = Comparison { record: &record, gauges };
        let clock = PERIOD_S / MEASURED_PERIOD_S;
        let [uncorrected, corrected] = [1.0, clock].map(|clock| comparison.skills(clock));
        println!(
            "K = {layers}, cell {cell_m} m, {source}: skill at gauges 4 to 11 {uncorrected:.2?}, mean {:.3}",
            mean(&uncorrected)
        );
        println!("  with the time axis corrected by 1 %: {corrected:.2?}, mean {:.3}", mean(&corrected));
        println!("  best shift [s] and skill of each gauge: {:.2?}", comparison.own_shifts(clock));
        [uncorrected, corrected]
    };
    measured().into_iter().map(compare).collect()
}

#[test]
fn waves_over_the_bar_agree_with_the_measurement() {
    // Target: a skill of 0.8 at every gauge. The limits are the reached skills, rounded down, to detect a regression.
    // The target is missed because of the time axes of the files: the waves repeat after 2.00 s instead of 2.02 s.
    // Also, the best time shifts of neighbouring gauges scatter by 0.05 s, which an error of the wave speed cannot
    // explain.
    for [uncorrected, corrected] in compare(2, 0.025) {
        assert!(mean(&uncorrected) > 0.77 && uncorrected.iter().all(|skill| *skill > 0.57));
        assert!(mean(&corrected) > 0.79 && corrected.iter().all(|skill| *skill > 0.62));
    }
}

#[test]
#[ignore = "1 minute: cargo test --release --test validation -- --ignored --nocapture flume_bar"]
fn waves_over_the_bar_agree_with_the_measurement_for_three_layers() {
    // The limits are the reached skills, rounded down, as for two layers.
    for [uncorrected, corrected] in compare(3, 0.0125) {
        assert!(mean(&uncorrected) > 0.78 && uncorrected.iter().all(|skill| *skill > 0.6));
        assert!(mean(&corrected) > 0.8 && corrected.iter().all(|skill| *skill > 0.66));
    }
}
