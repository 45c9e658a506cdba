//! Waves of the flume model as a case orders them, and the rows of the multi-layer piston that follow them.

use breakwater::case::{Case, Wave};
use breakwater::simulation::flume::incoming::{ml_piston, particle_start, run_flume};
use breakwater::waves::flume_model::record::FlumeRecord;
use serde_json::{Value, json};

const DEPTH: f64 = 0.4;

/// A level flume with a sponge at its end, particles from 4 m on.
fn ordered(wave: &Value, duration: f64) -> (Case, FlumeRecord) {
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

/// Least and most of a series.
fn extremes(series: impl Iterator<Item = f64>) -> [f64; 2] {
    series.fold([f64::MAX, f64::MIN], |[low, high], value| [low.min(value), high.max(value)])
}

#[test]
fn rows_swing_with_the_water_of_regular_waves_and_do_not_drift_away() {
    const PERIOD: f64 = 1.5;
    let (case, record) = ordered(&json!({ "kind": "regular", "height_m": 0.03, "period_s": PERIOD }), 45.0);
    let Wave::Regular { wave, .. } = case.wave else { panic!("regular waves") };
    let piston = ml_piston(&case, &record, particle_start(&case, Some(&record)));
    let swing = |row: usize| {
        let times = (0..=100).map(|i| piston.end_s() - PERIOD * f64::from(i) / 100.0);
        extremes(times.map(|t| piston.displacement_m(row, t)))
    };
    // Linear theory: the water at z swings by a cosh k(z + d) / sinh kd to either side.
    let k = wave.wavenumber_per_m();
    for (row, &height) in piston.row_heights_m().iter().enumerate().filter(|(_, height)| **height < 0.36) {
        let [low, high] = swing(row);
        let (theory, mean) = (wave.height_m * (k * height).cosh() / (k * DEPTH).sinh(), 0.5 * (low + high));
        println!("row at {height:.2} m swings by {:.4} m, theory {theory:.4} m, about {mean:+.4} m", high - low);
        // 5 %: the wave is not linear (H/d = 0.075), and a little comes back from the sponge.
        assert!(((high - low) / theory - 1.0).abs() < 0.05);
        // 5 mm: the flow back below the waves, g H^2 / (8 c d) = 1.5 mm/s on average, would carry the rows by 10 mm in
        // the six seconds in which they are drawn back and by 70 mm in the run; 0.7 mm is reached.
        assert!(mean.abs() < 0.005);
    }
    assert!(piston.max_shoreward_displacement_m() > 0.015);
}

#[test]
fn a_sea_of_the_case_has_its_height_and_its_seed() {
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
    let (case, record) = ordered(&sea(1), 70.0);
    println!("H_s = {:.4} m at 4 m", significant(&record));
    // The whole sea passes once. 10 %: the shortest waves, which a cell of 0.05 m does not resolve, hold 4 % of the
    // height.
    assert!((significant(&record) / 0.03 - 1.0).abs() < 0.1);
    let (other, _) = ordered(&sea(2), 1.0);
    assert_ne!(case.hash, other.hash);
}

#[test]
fn a_wave_of_third_order_comes_as_high_as_it_is_ordered() {
    let (_, record) = ordered(&json!({ "kind": "solitary", "height_m": 0.04, "theory": "third_order" }), 8.0);
    let (crest, time) = record.crest(0);
    println!("crest {crest:.4} m at {time:.2} s");
    // As through the inflow alone, see `flume_ends`.
    assert!((crest / 0.04 - 1.0).abs() < 0.005);
    assert!(time > 4.0 / (9.81 * DEPTH * 1.1).sqrt());
}
