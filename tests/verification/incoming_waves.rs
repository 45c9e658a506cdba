//! The flume model generates the waves that a case requests, and the rows of the multi-layer piston follow these waves.

use breakwater::case::{Case, Wave};
use breakwater::simulation::flume::wave::incoming::{ml_piston, particle_start, run_flume};
use breakwater::waves::flume_model::record::FlumeRecord;
use serde_json::{Value, json};

const DEPTH: f64 = 0.4;

/// Runs a wave in a level flume with a sponge at its end; the particle domain starts at 4 m.
fn run_wave(wave: &Value, duration: f64) -> (Case, FlumeRecord) {
    let case = json!({
        "title": "Waves from the flume model",
        "flume": {
            "bed_m": [[0.0, 0.0], [16.0, 0.0]], "still_water_level_m": DEPTH,
            "right_end": { "kind": "sponge", "length_m": 6.0 }
        },
        "domain": { "x_m": [4.0, 6.0], "width_m": 0.3, "sides": "periodic", "top_z_m": 0.6, "dp_m": 0.02 },
        "wave": wave,
        "gauges": [{ "kind": "elevation", "name": "WG1", "x_m": 4.0 }],
        "stop": { "duration_s": duration }
    });
    let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
    let record = run_flume(&case).unwrap().unwrap();
    (case, record)
}

/// Returns the smallest and the largest value of a series.
fn extremes(series: impl Iterator<Item = f64>) -> [f64; 2] {
    series.fold([f64::MAX, f64::MIN], |[low, high], value| [low.min(value), high.max(value)])
}

#[test]
fn piston_rows_follow_regular_waves_without_drift() {
    const PERIOD: f64 = 1.5;
    let (case, record) = run_wave(&json!({ "kind": "regular", "height_m": 0.03, "period_s": PERIOD }), 45.0);
    let Wave::Regular { wave, .. } = case.wave else { panic!("the wave is not regular") };
    let piston = ml_piston(&case, &record, particle_start(&case, Some(&record)));
    let displacement_range = |row: usize| {
        let times = (0..=100).map(|i| piston.end_s() - PERIOD * f64::from(i) / 100.0);
        extremes(times.map(|t| piston.displacement_m(row, t)))
    };
    // Linear theory: the displacement at z has the amplitude a cosh k(z + d) / sinh kd, with the wave amplitude a.
    let k = wave.wavenumber_per_m();
    for (row, &height) in piston.row_heights_m().iter().enumerate().filter(|(_, height)| **height < 0.36) {
        let [low, high] = displacement_range(row);
        let (theory, mean) = (wave.height_m * (k * height).cosh() / (k * DEPTH).sinh(), 0.5 * (low + high));
        println!("row at {height:.2} m: stroke {:.4} m, theory {theory:.4} m, mean {mean:+.4} m", high - low);
        // Limit 5 % for the stroke: the wave is nonlinear (H/d = 0.075), and the sponge reflects a little.
        assert!(((high - low) / theory - 1.0).abs() < 0.05);
        // Limit 5 mm; reached: 0.7 mm. The return flow below the waves, g H^2 / (8 c d) = 1.5 mm/s on average, would
        // move the rows by 70 mm during the run, and by 10 mm within 6 s, the time constant of the drift removal.
        assert!(mean.abs() < 0.005);
    }
    assert!(piston.max_shoreward_displacement_m() > 0.015);
}

#[test]
fn irregular_waves_have_their_significant_height_and_seed() {
    let sea = |seed: u64| {
        json!({
            "kind": "irregular", "significant_height_m": 0.03, "peak_period_s": 1.6, "repeat_periods": 40, "seed": seed
        })
    };
    let significant = |record: &FlumeRecord| {
        let series = &record.gauge_elevations_m[0];
        let tail = &series[series.len() - (64.0 / record.interval_s) as usize..];
        let mean = tail.iter().sum::<f64>() / tail.len() as f64;
        4.0 * (tail.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / tail.len() as f64).sqrt()
    };
    let (case, record) = run_wave(&sea(1), 70.0);
    println!("H_s = {:.4} m at 4 m", significant(&record));
    // The evaluated 64 s are one full repetition of the sea. Limit 10 % for the significant height: the shortest waves,
    // which a cell of 0.05 m does not resolve, contribute 4 % of the height.
    assert!((significant(&record) / 0.03 - 1.0).abs() < 0.1);
    let (other, _) = run_wave(&sea(2), 1.0);
    assert_ne!(case.hash, other.hash);
}

#[test]
fn a_third_order_solitary_wave_has_its_height() {
    let (_, record) = run_wave(&json!({ "kind": "solitary", "height_m": 0.04, "theory": "third_order" }), 8.0);
    let (crest, time) = record.crest(0);
    println!("crest {crest:.4} m at {time:.2} s");
    // The tolerance is the same as for the inflow in `flume_ends`.
    assert!((crest / 0.04 - 1.0).abs() < 0.005);
    assert!(time > 4.0 / (9.81 * DEPTH * 1.1).sqrt());
}
