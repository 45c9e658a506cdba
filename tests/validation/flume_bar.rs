//! Regular waves over a submerged bar: Beji & Battjes, T = 2.02 s, H = 2 cm in 0.4 m of water.
//!
//! The bar, 1:20 up and 1:10 down, is 0.1 m below the surface; behind it harmonics that were bound to the wave run
//! free. A beach of 1:25 from x = 18.95 m on closes the flume. The surface was measured at eight gauges; the clocks of
//! flume and model differ by one shift common to all of them.

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

/// Times [s] and elevations [m] of a gauge, each once; `None` where the data do not lie beside the crate.
fn measured(gauge: usize) -> Option<Vec<[f64; 2]>> {
    let rows = data::rows_of::<2>(&format!("beji_battjes_bar/gauge-{gauge}.txt"))?;
    let mut points: Vec<[f64; 2]> = rows.into_iter().map(|[time, cm]| [time, 0.01 * cm]).collect();
    // The files hold each series twice.
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points.dedup();
    Some(points)
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

/// 1 - rmse / standard deviation of the measurement, the model read `shift` [s] later.
fn skill(points: &[[f64; 2]], model: impl Fn(f64) -> f64) -> f64 {
    let n = points.len() as f64;
    let mean = points.iter().map(|p| p[1]).sum::<f64>() / n;
    let variance = points.iter().map(|p| (p[1] - mean).powi(2)).sum::<f64>() / n;
    let error = points.iter().map(|p| (p[1] - model(p[0])).powi(2)).sum::<f64>() / n;
    1.0 - (error / variance).sqrt()
}

/// Period of the measured series [s]: the one with which six harmonics fit all gauges best. The files' time axis is
/// 1 % short; the relation of the gauges to each other is that of waves of [`PERIOD_S`].
const MEASURED_PERIOD_S: f64 = 2.0;
/// Middle of the measured series [s].
const MIDDLE_S: f64 = 36.0;

/// A model's series beside the measured ones.
struct Comparison {
    record: FlumeRecord,
    gauges: Vec<Vec<[f64; 2]>>,
}

impl Comparison {
    fn new(layers: usize, cell_m: f64) -> Option<Self> {
        let gauges = (4..12).map(measured).collect::<Option<_>>()?;
        Some(Self { record: flume(layers, cell_m), gauges })
    }

    /// Skill at a gauge, the model read `shift` [s] later and its clock running faster by a factor.
    fn skill(&self, gauge: usize, shift: f64, clock: f64) -> f64 {
        let series = &self.record.gauge_elevations_m[gauge];
        let at = |t: f64| {
            let place = (MIDDLE_S + clock * (t - MIDDLE_S) + shift) / self.record.interval_s;
            let before = (place as usize).min(series.len() - 2);
            series[before] + (place - before as f64) * (series[before + 1] - series[before])
        };
        skill(&self.gauges[gauge], at)
    }

    /// Skill at every gauge after the one shift that is best on average.
    fn skills(&self, clock: f64) -> Vec<f64> {
        let with = |shift| -> Vec<f64> { (0..8).map(|gauge| self.skill(gauge, shift, clock)).collect() };
        shifts().map(with).max_by(|a, b| mean(a).total_cmp(&mean(b))).unwrap()
    }

    /// Shift [s] and skill of every gauge by itself.
    fn own_shifts(&self, clock: f64) -> Vec<[f64; 2]> {
        let best = |gauge| {
            let tried = shifts().map(|shift| [shift, self.skill(gauge, shift, clock)]);
            tried.max_by(|a, b| a[1].total_cmp(&b[1])).unwrap()
        };
        (0..8).map(best).collect()
    }
}

/// Shifts of a period [s].
fn shifts() -> impl Iterator<Item = f64> {
    (0..202).map(|i| -0.01 * f64::from(i))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Skills with one shift, and with the files' clock corrected.
fn compare(layers: usize, cell_m: f64) -> Option<[Vec<f64>; 2]> {
    let comparison = Comparison::new(layers, cell_m)?;
    let clock = PERIOD_S / MEASURED_PERIOD_S;
    let [as_it_is, corrected] = [1.0, clock].map(|clock| comparison.skills(clock));
    println!("K = {layers}, cell {cell_m} m: skill at gauges 4 to 11 {as_it_is:.2?}, mean {:.3}", mean(&as_it_is));
    println!("  clock of the files corrected by 1 %: {corrected:.2?}, mean {:.3}", mean(&corrected));
    println!("  every gauge with its own shift [s] besides: {:.2?}", comparison.own_shifts(clock));
    Some([as_it_is, corrected])
}

#[test]
fn harmonics_behind_the_bar() {
    let Some([as_it_is, corrected]) = compare(2, 0.025) else { return };
    // The aim is 0.8 at every gauge. What was reached, rounded down, so that a change for the worse shows; what is
    // missing is in the clocks of the files: they repeat after 2.00 s, not 2.02 s, and the best shifts of neighbouring
    // gauges go up and down by 0.05 s, which no error of a wave's speed does.
    assert!(mean(&as_it_is) > 0.77 && as_it_is.iter().all(|skill| *skill > 0.57));
    assert!(mean(&corrected) > 0.79 && corrected.iter().all(|skill| *skill > 0.62));
}

/// `cargo test --release --test validation -- --ignored --nocapture more_layers_over_the_bar`, a minute.
#[test]
#[ignore = "a minute"]
fn more_layers_over_the_bar() {
    let Some([as_it_is, corrected]) = compare(3, 0.0125) else { return };
    // As above.
    assert!(mean(&as_it_is) > 0.78 && as_it_is.iter().all(|skill| *skill > 0.6));
    assert!(mean(&corrected) > 0.8 && corrected.iter().all(|skill| *skill > 0.66));
}
