//! Noise of the pressure on a wall that a dam-break wave hits, as a time series and as a spectrum.
//!
//! The physical pressure changes over tenths of a second. Pressure above [`NOISE_HZ`] is sound in the weakly
//! compressible water and particle noise.

use std::{f64::consts::TAU, sync::Arc};

use breakwater::{
    case::Case,
    simulation::flume::{Simulation, failure::Failure},
};
use glam::DVec3;
use serde_json::{Value, json};

const DP: f64 = 0.05;
/// Interval of the series [s].
const INTERVAL: f64 = 1e-3;
/// Start and end of the series [s]: it starts after the impact (0.8 s) and ends when the water falls back.
const WINDOW: [f64; 2] = [0.9, 1.4];
/// Lowest frequency of noise [Hz]. The physical pressure has frequencies up to about 10 Hz. Sound needs 0.2 s to cross
/// the tank and 20 ms to cross the water depth at the wall, so sound at the wall has frequencies above 25 Hz.
const NOISE_HZ: f64 = 25.0;

/// Runs the dam break of Koshizuka & Oka (1996) and returns the pressure [Pa] at the end wall, 0.1 m above the bed,
/// every millisecond.
fn wall_pressure(numerics: &Value, sound_speed_factor: f64) -> Result<Vec<f64>, Failure> {
    let case = json!({
        "title": "Dam break against a wall",
        "flume": { "bed_m": [[0.0, 0.0], [4.0, 0.0]], "still_water_level_m": 2.0 },
        "domain": {
            "x_m": [0.0, 4.0], "sides": "two_dimensional", "top_z_m": 5.0, "dp_m": DP,
            "water": { "kind": "block", "x_m": [0.0, 1.0], "top_z_m": 2.0 }
        },
        "fluid": { "sound_speed_factor": sound_speed_factor },
        "numerics": numerics,
        "stop": { "duration_s": 2.0 }
    });
    let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
    let mut dam = Simulation::new(Arc::new(case)).unwrap();
    let mut series = Vec::new();
    while dam.time < WINDOW[1] {
        let mut now = dam.begin_step()?;
        if now.time >= WINDOW[0] + INTERVAL * series.len() as f64 {
            let sample = now.sampler()?.sample(DVec3::new(4.0, 5.0 * DP, 0.1));
            series.push(sample.map_or(0.0, |sample| sample.pressure));
        }
        now.finish()?;
    }
    Ok(series)
}

/// Returns frequency [Hz] and amplitude [Pa] of each harmonic of the series, without its mean and linear trend.
fn spectrum(series: &[f64]) -> Vec<(f64, f64)> {
    let n = series.len() as f64;
    let at = |i: usize| i as f64 / (n - 1.0) - 0.5;
    let mean = series.iter().sum::<f64>() / n;
    let slope = series.iter().enumerate().map(|(i, p)| at(i) * (p - mean)).sum::<f64>()
        / (0..series.len()).map(|i| at(i).powi(2)).sum::<f64>();
    (1..series.len() / 2)
        .map(|k| {
            let [re, im] = series.iter().enumerate().fold([0.0; 2], |[re, im], (i, p)| {
                let (value, angle) = (p - mean - slope * at(i), TAU * k as f64 * i as f64 / n);
                [re + value * angle.cos(), im + value * angle.sin()]
            });
            (k as f64 / (n * INTERVAL), 2.0 / n * re.hypot(im))
        })
        .collect()
}

/// Returns the rms pressure above [`NOISE_HZ`], divided by the mean pressure [-], or infinity if the run failed. Prints
/// series and spectrum.
fn noise(numerics: &Value, sound_speed_factor: f64) -> f64 {
    let series = match wall_pressure(numerics, sound_speed_factor) {
        Ok(series) => series,
        Err(failure) => {
            println!("{numerics}: {failure}");
            return f64::INFINITY;
        }
    };
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let spectrum = spectrum(&series);
    let band = |low: f64, high: f64| {
        let power = spectrum.iter().filter(|(f, _)| (low..high).contains(f)).map(|(_, a)| 0.5 * a * a).sum::<f64>();
        power.sqrt() / mean
    };
    let kilopascals: Vec<String> = series.iter().step_by(25).map(|p| format!("{:.2}", 1e-3 * p)).collect();
    println!("{numerics}, c0 = {sound_speed_factor} sqrt(g d): mean {:.2} kPa; every 25 ms", 1e-3 * mean);
    println!("  [kPa]: {}", kilopascals.join(" "));
    for [low, high] in [[0.0, NOISE_HZ], [NOISE_HZ, 50.0], [50.0, 100.0], [100.0, 200.0], [200.0, 500.0]] {
        println!("  {low:>3.0} to {high:>3.0} Hz: rms {:.2} % of the mean", 100.0 * band(low, high));
    }
    band(NOISE_HZ, f64::INFINITY)
}

/// Returns the rms of the noise of five runs, whose speeds of sound are near 10 sqrt(g d). The runs differ, because
/// small differences grow in an impact.
fn noise_of_five(numerics: &Value) -> f64 {
    let squares = [9.8, 9.9, 10.0, 10.1, 10.2].map(|factor| noise(numerics, factor).powi(2));
    let noise = (squares.iter().sum::<f64>() / 5.0).sqrt();
    println!("{numerics}: noise of five runs {:.2} % of the mean", 100.0 * noise);
    noise
}

#[test]
#[ignore = "2 minutes on one core: cargo test --release --test validation -- --ignored --nocapture wall_pressure"]
fn an_impact_leaves_little_noise_in_the_wall_pressure() {
    let default_noise = noise_of_five(&json!({}));
    noise(&json!({}), 20.0);
    noise(&json!({ "density_diffusion": "none" }), 10.0);
    let undamped = noise_of_five(&json!({ "acoustic_damping": 0.0, "suction_limit": 1e6 }));
    // Reached: 6.2 % of the mean pressure by default (single runs 5.0 to 7.2 %) and 19 % without damping. The limits leave
    // room for the scatter of an impact. The target, 5 %, is missed (docs/validation/fluid.md).
    assert!(default_noise < 0.08 && undamped > 1.5 * default_noise);
}
