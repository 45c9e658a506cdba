//! A wall reflects a wave back to a multi-layer piston. The tests measure the height after reflection by the piston:
//! without absorption, with a relaxation zone, and with active absorption.

use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, run_until, simulation};

const DEPTH: f64 = 0.3;
const HEIGHT: f64 = 0.09;
/// Seaward and shoreward end of the particle domain [m].
const TANK: [f64; 2] = [4.0, 7.5];
/// End of the relaxation zone [m]. The zone is a third as long as the part of the wave above 1 % of the wave height.
const ZONE_END: f64 = 6.0;
/// Position of the gauge [m].
const GAUGE: f64 = 6.4;

/// Returns the case of a solitary wave in a tank that ends at a wall; the flume model has no such wall.
fn tank(dp: f64, zone: Option<f64>, gauge: Option<f64>) -> Value {
    let mut case = json!({
        "title": "A solitary wave between a multi-layer piston and a wall",
        "flume": { "bed_m": [[0.0, 0.0], [30.0, 0.0]], "still_water_level_m": DEPTH, "right_end": { "kind": "radiating" } },
        "domain": { "x_m": TANK, "sides": "two_dimensional", "top_z_m": 0.6, "dp_m": dp },
        "numerics": { "viscosity_alpha": 0.01 },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": { "kind": "solitary", "height_m": HEIGHT },
        "wavemaker": { "kind": "ml_piston", "absorption_gauge_m": gauge },
        "stop": { "duration_s": 20.0 }
    });
    if let Some(coefficient) = zone {
        case["domain"]["relaxation_zone"] = json!({ "end_x_m": ZONE_END, "coefficient_per_s": coefficient });
    }
    case
}

/// Returns three crest levels at the gauge [m]: in the flume model, in the particle domain for the incident wave, and
/// in the particle domain after reflection by wall and piston.
fn crests(dp: f64, zone: Option<f64>, gauge: Option<f64>) -> [f64; 3] {
    let mut tank = simulation(&tank(dp, zone, gauge));
    let celerity = (GRAVITY * (DEPTH + HEIGHT)).sqrt();
    let record = tank.flume.as_ref().unwrap();
    let elevation = |t: &f64| record.elevation(GAUGE, *t);
    let passing = record.times_s().iter().copied().max_by(|a, b| elevation(a).total_cmp(&elevation(b))).unwrap();
    let incident = record.elevation(GAUGE, passing);
    // The wave travels from the gauge to the wall and back, then to the piston and back.
    let reflected = passing + 2.0 * (TANK[1] - GAUGE) / celerity;
    let rereflected = reflected + 2.0 * (GAUGE - TANK[0]) / celerity;
    let (until, from) = (0.5 * (passing + reflected), reflected + 0.7 * (rereflected - reflected));
    let mut crests = [incident, f64::MIN, f64::MIN];
    let end = rereflected + 0.5 - tank.start;
    run_until(&mut tank, end, |now| {
        let time = now.flume_time();
        if now.steps.is_multiple_of(10) && (time < until || time > from) {
            let level = now.sampler().unwrap().surface(DVec2::new(GAUGE, 5.0 * dp), 0.0).unwrap() - DEPTH;
            let crest = &mut crests[if time < until { 1 } else { 2 }];
            *crest = crest.max(level);
        }
    });
    println!(
        "dp = {dp} m, zone {zone:?} 1/s, gauge {gauge:?} m: flume model {:.4} m, incident {:.4} m, re-reflected {:+.4} m ({:.1} %)",
        crests[0],
        crests[1],
        crests[2],
        100.0 * crests[2] / crests[1]
    );
    crests
}

#[test]
fn an_absorbing_multi_layer_piston_does_not_reflect_the_wave() {
    let [flume, first, rereflected] = crests(0.025, None, Some(0.2));
    // Reached: the crest of the incident wave in the particles differs by 0.3 % from the flume model. Limit 8 %: the
    // reading may include the start of the reflected wave.
    assert!((first / flume - 1.0).abs() < 0.08);
    // Limit for the wave after reflection by wall and piston: 10 % of the incident crest. Reached: 5.0 %, which is a
    // fifth of a particle spacing.
    assert!((-first..0.1 * first).contains(&rereflected));
}

#[test]
#[ignore = "3 minutes on 2 cores: \
    cargo test --release --test verification -- --ignored --nocapture a_relaxation_zone_weakens"]
fn a_relaxation_zone_weakens_the_reflected_wave() {
    let [_, first, rereflected] = crests(0.05, None, None);
    assert!(rereflected > 0.8 * first);
    // With coefficients of 3 and 10 1/s, the re-reflected wave has 73 and 63 % of the height of the incident wave
    // respectively. Without a zone, it has 93 %.
    let [weak, strong] = [3.0, 10.0].map(|coefficient| {
        let [_, first, rereflected] = crests(0.05, Some(coefficient), None);
        rereflected / first
    });
    assert!(strong < weak && weak < 0.9 * rereflected / first && strong < 0.65);
}
