//! Ends of the flume model: the incoming wave is the requested one, and the reflection is small.

use std::f64::consts::TAU;

use breakwater::geometry::profile::Profile;
use breakwater::waves::flume_model::dispersion::wavelength_error;
use breakwater::waves::flume_model::incoming::IncomingWave;
use breakwater::waves::flume_model::layered::{Breaking, Friction, Pressure, RightEnd};
use breakwater::waves::flume_model::record::FlumeRecord;
use breakwater::waves::flume_model::{FlumeSetup, WaveSource, run};
use breakwater::waves::theory::irregular::{IrregularWave, JonswapSea};
use breakwater::waves::theory::regular::{MeanFlow, RegularWave};
use breakwater::waves::theory::solitary::ThirdOrderSolitary;
use breakwater::waves::theory::stream_function::StreamFunctionWave;

const GRAVITY: f64 = 9.81;
const DEPTH: f64 = 0.5;

fn level_flume(
    wave: IncomingWave,
    length_m: f64,
    right_end: RightEnd,
    gauges_x_m: Vec<f64>,
    end_s: f64,
) -> FlumeRecord {
    run(&setup(wave, length_m, right_end, gauges_x_m, end_s)).unwrap()
}

/// A level flume with two layers.
fn setup(wave: IncomingWave, length_m: f64, right_end: RightEnd, gauges_x_m: Vec<f64>, end_s: f64) -> FlumeSetup {
    FlumeSetup {
        profile: Profile::new(vec![[0.0, -DEPTH], [length_m, -DEPTH]]),
        still_level_m: 0.0,
        gravity_m_s2: GRAVITY,
        wave: WaveSource::Inflow(wave),
        right_end,
        pressure: Pressure::NonHydrostatic,
        friction: Friction::None,
        breaking: Breaking::default(),
        layers: 2,
        cell_m: 0.05,
        gauges_x_m,
        profile_times_s: Vec::new(),
        window_x_m: [0.0, 1.0],
        record_interval_s: 0.025,
        end_s,
    }
}

#[test]
fn solitary_wave_enters_with_its_height_and_leaves() {
    for (height, tolerance) in [(0.05, 0.005), (0.2, 0.02)] {
        let wave = ThirdOrderSolitary { height_m: height * DEPTH, depth_m: DEPTH, gravity: GRAVITY };
        let record = level_flume(IncomingWave::solitary(wave), 30.0, RightEnd::Radiating, vec![15.0], 35.0);
        let (crest, time) = record.crest(0);
        let expected = (wave.half_length_m() + 15.0) / wave.celerity_m_s();
        let after = ((time + 2.0 * wave.half_length_m() / wave.celerity_m_s()) / record.interval_s) as usize;
        let residual = record.gauge_elevations_m[0][after..].iter().fold(0.0, |most: f64, eta| most.max(eta.abs()));
        println!(
            "H/d = {height}: crest {:+.2} %, {:+.4} s; reflected {:.2} %; volume error {:.0e}",
            100.0 * (crest / wave.height_m - 1.0),
            time - expected,
            100.0 * residual / wave.height_m,
            record.volume_error
        );
        // With two layers, the wave is 0.2 % too fast: it arrives 0.014 s too early after about 7 s. Its height
        // changes, because the third-order wave is not an exact solution of the model.
        assert!((crest / wave.height_m - 1.0).abs() < tolerance && (time - expected).abs() < 0.02);
        // The absorption by radiating end and inflow is exact only to first order in H/d.
        assert!(residual < 0.02 * wave.height_m);
        // Limit 1e-12: rounding; the volume balance uses the same fluxes as the water depths.
        assert!(record.volume_error < 1e-12);
    }
}

/// Returns the smallest and largest wave height among the gauges [m], over the last four periods.
fn envelope(record: &FlumeRecord, period_s: f64) -> [f64; 2] {
    let steps = (4.0 * period_s / record.interval_s) as usize;
    let height = |series: &Vec<f64>| {
        let tail = &series[series.len() - steps..];
        tail.iter().copied().fold(f64::MIN, f64::max) - tail.iter().copied().fold(f64::MAX, f64::min)
    };
    let heights = record.gauge_elevations_m.iter().map(height);
    heights.fold([f64::MAX, 0.0], |[smallest, most], h| [smallest.min(h), most.max(h)])
}

#[test]
fn sponge_and_radiating_end_absorb_regular_waves() {
    // The cases are waves of k d = 1.1 (wave number k, depth d) with a sponge of two wave lengths and with the
    // radiating end, and long waves with the radiating end.
    for (period_s, sponge_lengths, most) in [(1.5, Some(2.0), 0.01), (1.5, None, 0.1), (4.0, None, 0.02)] {
        let parameters = RegularWave { height_m: 0.02, period_s, depth_m: DEPTH, gravity: GRAVITY };
        let wave = StreamFunctionWave::new(parameters, MeanFlow::NoTransport).unwrap();
        let length = TAU / wave.wavenumber_per_m();
        let (right_end, flume_m) = match sponge_lengths {
            Some(lengths) => (RightEnd::Sponge { length_m: lengths * length }, 12.0 + lengths * length),
            None => (RightEnd::Radiating, 12.0),
        };
        let gauges = (0..40).map(|i| 5.0 + 0.5 * length * f64::from(i) / 40.0).collect();
        let incoming = IncomingWave::Regular { wave, ramp_s: 2.0 * period_s };
        let record = level_flume(incoming, flume_m, right_end, gauges, 40.0);
        let [smallest, largest] = envelope(&record, period_s);
        let reflection = (largest - smallest) / (largest + smallest);
        println!(
            "T = {period_s} s, L = {length:.2} m, {right_end:?}: height {:.4} m, reflection {:.1} %",
            0.5 * (largest + smallest),
            100.0 * reflection
        );
        // A radiating end reflects the share (1 - c/c_0) / (1 + c/c_0), with celerity c and c_0 = sqrt(g d): 8 % for
        // c/c_0 = 0.85. The sponge is designed to reflect 0.25 %; the other 0.75 % allow for the error of the envelope.
        assert!(reflection < most);
        assert!((0.5 * (largest + smallest) / parameters.height_m - 1.0).abs() < 0.03);
    }
}

/// Returns amplitude [m] and phase [rad] of a series at a period, over the last `periods` periods.
fn harmonic(series: &[f64], interval_s: f64, period_s: f64, periods: f64) -> (f64, f64) {
    let count = (periods * period_s / interval_s).round() as usize;
    let first = series.len() - count;
    let sums = series[first..].iter().enumerate().fold([0.0; 2], |[c, s], (i, eta)| {
        let angle = TAU * (first + i) as f64 * interval_s / period_s;
        [c + eta * angle.cos(), s + eta * angle.sin()]
    });
    let [c, s] = sums.map(|sum| 2.0 * sum / count as f64);
    (c.hypot(s), s.atan2(c))
}

#[test]
fn short_waves_have_their_height_and_the_wavelength_of_the_layers() {
    // Wave periods for k d = 2, 3, 4.5 and, with two layers, beyond k d = 2 K, where neighbouring layers move in opposite
    // directions.
    for (kd, layers) in [(2.0_f64, 2), (3.0, 2), (4.5, 2), (4.5, 3), (6.0, 4)] {
        let period_s = TAU / (GRAVITY * kd * kd.tanh() / DEPTH).sqrt();
        let parameters = RegularWave { height_m: 0.002, period_s, depth_m: DEPTH, gravity: GRAVITY };
        let wave = StreamFunctionWave::new(parameters, MeanFlow::NoTransport).unwrap();
        let length = TAU * DEPTH / kd;
        let end_s = 7.0 + 10.0 * period_s;
        let incoming = IncomingWave::Regular { wave, ramp_s: 3.0 * period_s };
        let (interval, gauges) = (period_s / 40.0, vec![1.0, 1.0 + 0.8 * length]);
        let sponge = RightEnd::Sponge { length_m: 3.0 };
        let case = FlumeSetup {
            layers,
            cell_m: length / 40.0,
            record_interval_s: interval,
            ..setup(incoming, 5.5, sponge, gauges, end_s)
        };
        let record = run(&case).unwrap();
        let [(first, start), (second, end)] =
            [0, 1].map(|gauge| harmonic(&record.gauge_elevations_m[gauge], interval, period_s, 4.0));
        let found = 0.8 * length / ((end - start).rem_euclid(TAU) / TAU) / length - 1.0;
        let expected = wavelength_error(period_s, DEPTH, GRAVITY, layers).unwrap();
        let height = (first + second) / parameters.height_m - 1.0;
        println!(
            "kd = {kd}, {layers} layers: height {:+.1} %, wavelength {found:+.4} (theory {expected:+.4})",
            100.0 * height
        );
        // Before the harmonics were distributed over the layers as in the model, heights were 2, 7 and 13 % too small.
        // The tolerances allow for cells of 1/40 of a wavelength, whose error is of the order (2 pi / 40)^2 / 6 = 0.4 %,
        // and for waves that the sponge reflects.
        assert!(height.abs() < 0.015);
        assert!((found - expected).abs() < 0.006);
    }
}

#[test]
fn irregular_waves_enter_with_their_significant_height() {
    let sea = JonswapSea {
        significant_height_m: 0.02,
        peak_period_s: 2.0,
        peak_enhancement: 3.3,
        depth_m: DEPTH,
        gravity: GRAVITY,
        repeat_s: 60.0,
        seed: 1,
    };
    let wave = IrregularWave::new(sea).unwrap();
    let incoming = IncomingWave::Irregular { wave, ramp_s: 2.0 };
    let record = level_flume(incoming, 18.0, RightEnd::Sponge { length_m: 12.0 }, vec![3.0], 80.0);
    let eta = &record.gauge_elevations_m[0];
    let tail = &eta[eta.len() - (60.0 / record.interval_s) as usize..];
    let mean = tail.iter().sum::<f64>() / tail.len() as f64;
    let variance = tail.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / tail.len() as f64;
    println!("H_s = {:.4} m, mean level {:+.5} m", 4.0 * variance.sqrt(), mean);
    // Limit 6 % for the significant height: the incoming waves are linear, but the flume model is nonlinear.
    assert!((4.0 * variance.sqrt() / 0.02 - 1.0).abs() < 0.06);
}
