//! Waves pass through an empty domain with open ends: height, reflection and volume of the water.

use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{run_until, simulation};

const DEPTH: f64 = 0.3;
const DP: f64 = 0.015;
/// Seaward and shoreward end of the particle domain [m].
const DOMAIN: [f64; 2] = [8.0, 11.0];
/// Positions of the gauges [m].
const GAUGES: [f64; 3] = [8.8, 9.5, 10.2];

/// Returns the case of a wave in the middle of a long flume.
fn case(wave: &Value, duration: f64) -> Value {
    json!({
        "title": "A wave passes through open ends",
        "flume": { "bed_m": [[0.0, 0.0], [30.0, 0.0]], "still_water_level_m": DEPTH,
                   "right_end": { "kind": "sponge", "length_m": 10.0 } },
        "domain": { "x_m": DOMAIN, "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": DP },
        "numerics": { "viscosity_alpha": 0.01, "wall_friction": 0.0 },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": wave,
        "wavemaker": { "kind": "open_ends" },
        "stop": { "duration_s": duration }
    })
}

/// Elevations at the gauges in the particle domain and in the flume model [m], and the volume of the water divided by
/// the volume in the flume model [-].
struct Reading {
    time: f64,
    /// From the level of the surface.
    particles: [f64; 3],
    /// From the volume of the water near the gauges. These elevations scatter less, but are lower in waves: disordered
    /// particles take up a few thousandths more space than the sum of their volumes.
    by_volume: [f64; 3],
    flume: [f64; 3],
    volume: f64,
}

/// Runs the case; returns readings every 20 time steps.
fn readings(case: &Value) -> Vec<Reading> {
    let mut tank = simulation(case);
    let end = case["stop"]["duration_s"].as_f64().unwrap();
    let mut readings = Vec::new();
    run_until(&mut tank, end, |now| {
        if now.steps.is_multiple_of(20) {
            let time = now.flume_time();
            let flume = GAUGES.map(|x| now.flume.as_ref().unwrap().elevation(x, time));
            let sampler = now.sampler().unwrap();
            let particles = GAUGES.map(|x| sampler.surface(DVec2::new(x, 0.5 * DP), 0.0).unwrap() - DEPTH);
            let by_volume = GAUGES.map(|x| sampler.depth(x, DP) - DEPTH);
            let record = now.flume.as_ref().unwrap();
            let mut volume: f64 = now.water.mass.iter().zip(&now.water.density).map(|(m, rho)| m / rho).sum();
            // The rows of the open ends fill the part of the domain into which they have moved.
            for end in &now.ends {
                let level = record.surface_level_m(end.wavemaker.rest_x_m(), time);
                for ([x, _], z) in end.rows(time, 0.0).into_iter().zip(end.wavemaker.row_heights_m()) {
                    volume += if *z < level { end.inwards * x * DP * DP } else { 0.0 };
                }
            }
            let columns = 300;
            let x = |k: i32| DOMAIN[0] + (DOMAIN[1] - DOMAIN[0]) * (f64::from(k) + 0.5) / f64::from(columns);
            let mean = (0..columns).map(|k| record.surface_level_m(x(k), time)).sum::<f64>() / f64::from(columns);
            readings.push(Reading {
                time,
                particles,
                by_volume,
                flume,
                volume: volume / (mean * (DOMAIN[1] - DOMAIN[0]) * DP),
            });
        }
    });
    readings
}

/// Returns the largest value at each gauge.
fn crests(levels: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    levels.fold([f64::MIN; 3], |most, now| std::array::from_fn(|k| most[k].max(now[k])))
}

#[test]
fn a_solitary_wave_passes_through_open_ends() {
    let height = 0.08;
    let readings = readings(&case(&json!({ "kind": "solitary", "height_m": height }), 7.0));
    let (made, flume) = (crests(readings.iter().map(|r| r.particles)), crests(readings.iter().map(|r| r.flume)));
    // The wave has left when it is lower than 1 % of its height everywhere in the flume model.
    let left = readings.iter().rposition(|r| r.flume.iter().any(|eta| *eta > 0.01 * height)).unwrap();
    let after = &readings[left..];
    let deviation = |r: &Reading| (0..GAUGES.len()).map(|k| (r.by_volume[k] - r.flume[k]).abs()).fold(0.0, f64::max);
    let reflected = after.iter().map(deviation).fold(0.0, f64::max);
    let volume = readings.last().unwrap().volume - 1.0;
    println!(
        "crests {made:.4?} m, flume model {flume:.4?} m; afterwards at most {:.1} % from the flume model over {:.2} s; volume {:+.2} %",
        100.0 * reflected / height,
        after.last().unwrap().time - after[0].time,
        100.0 * volume
    );
    let ratios: [f64; 3] = std::array::from_fn(|k| made[k] / flume[k]);
    let mean = ratios.iter().sum::<f64>() / 3.0;
    // Reached: 0.6 %. Limit 1 %, as for regular waves.
    assert!((mean - 1.0).abs() < 0.01);
    // The wave loses height on its way. Reached: 0.1, 0.5 and 1.1 %; with sixteen lanes, whose sums have another order,
    // the last value is 1.0 %. Limit 2 %: a tenth of the particle spacing.
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 0.02));
    assert!(reflected < 0.03 * height);
    // Reached: 1.1 to 1.4 % of the height and 0.1 to 0.2 % of the volume. Limits: 3 % of the height is a sixth of the
    // particle spacing, and 0.5 % of the volume a tenth of the particle spacing in the level.
    assert!(volume.abs() < 0.005);
}

#[test]
fn regular_waves_pass_through_open_ends() {
    let (height, period) = (0.06, 1.6);
    let readings = readings(&case(&json!({ "kind": "regular", "height_m": height, "period_s": period }), 12.0));
    let end = readings.last().unwrap().time;
    let late: Vec<&Reading> = readings.iter().filter(|r| r.time > end - 5.0 * period).collect();
    let ratio = |k: usize| {
        let amplitude = |of: fn(&Reading) -> &[f64; 3]| {
            let omega = std::f64::consts::TAU / period;
            let sum = late.iter().fold([0.0; 2], |[c, s], r| {
                [c + of(r)[k] * (omega * r.time).cos(), s + of(r)[k] * (omega * r.time).sin()]
            });
            2.0 * sum[0].hypot(sum[1]) / late.len() as f64
        };
        amplitude(|r| &r.particles) / amplitude(|r| &r.flume)
    };
    let ratios: [f64; 3] = std::array::from_fn(ratio);
    let mean = ratios.iter().sum::<f64>() / 3.0;
    println!("amplitudes {ratios:.4?} of the flume model, mean {mean:.4}");
    // Reached: less than 0.1 %. Limit 1 %, as for the solitary wave.
    assert!((mean - 1.0).abs() < 0.01);
    // Reflected waves make the amplitudes differ between the gauges. Reached: 1.8 %, of which 0.6 % is the scatter of
    // the mean of five periods. Limit 3 %, as for the solitary wave.
    assert!(ratios.iter().all(|ratio| (ratio - mean).abs() < 0.03));
    let volume = late.iter().map(|r| r.volume).sum::<f64>() / late.len() as f64 - 1.0;
    println!("volume {:+.2} %", 100.0 * volume);
    assert!(volume.abs() < 0.005);
}
