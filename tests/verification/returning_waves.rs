//! A multi-layer piston and the wave that a wall sends back to it: without anything, with a relaxation zone, with
//! absorption.

use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, run_until, simulation};

const DEPTH: f64 = 0.3;
const HEIGHT: f64 = 0.09;
/// Seaward and shoreward end of the particles [m].
const TANK: [f64; 2] = [4.0, 7.5];
/// End of the zone [m]: a third of the wave's length, from 1 % of the height to 1 %.
const ZONE_END: f64 = 6.0;
/// Where the wave is looked at [m].
const GAUGE: f64 = 6.4;

/// A solitary wave of the flume model, which knows no wall, enters a tank that ends at one.
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

/// Crest at the gauge in the flume model [m], and by the particles on the first way and when it has come back from the
/// wall to the piston.
fn crests(dp: f64, zone: Option<f64>, gauge: Option<f64>) -> [f64; 3] {
    let mut tank = simulation(&tank(dp, zone, gauge));
    let celerity = (GRAVITY * (DEPTH + HEIGHT)).sqrt();
    let record = tank.flume.as_ref().unwrap();
    let elevation = |t: &f64| record.elevation(GAUGE, *t);
    let passing = record.times_s().iter().copied().max_by(|a, b| elevation(a).total_cmp(&elevation(b))).unwrap();
    let incident = record.elevation(GAUGE, passing);
    // From the gauge to the wall and back, then to the piston and back.
    let back = passing + 2.0 * (TANK[1] - GAUGE) / celerity;
    let again = back + 2.0 * (GAUGE - TANK[0]) / celerity;
    let (until, from) = (0.5 * (passing + back), back + 0.7 * (again - back));
    let mut crests = [incident, f64::MIN, f64::MIN];
    let end = again + 0.5 - tank.start;
    run_until(&mut tank, end, |now| {
        let time = now.flume_time();
        if now.steps.is_multiple_of(10) && (time < until || time > from) {
            let level = now.sampler().unwrap().surface(DVec2::new(GAUGE, 5.0 * dp), 0.0, 0.6).unwrap() - DEPTH;
            let crest = &mut crests[if time < until { 1 } else { 2 }];
            *crest = crest.max(level);
        }
    });
    println!(
        "dp = {dp} m, zone {zone:?} 1/s, gauge {gauge:?} m: flume {:.4} m, particles {:.4} m, after coming back {:+.4} m ({:.1} %)",
        crests[0],
        crests[1],
        crests[2],
        100.0 * crests[2] / crests[1]
    );
    crests
}

#[test]
fn a_multi_layer_piston_takes_up_what_comes_back() {
    let [flume, first, again] = crests(0.025, None, Some(0.2));
    // 0.3 % is reached. Without absorption it is more: the first of what the wall sends back is in the reading.
    assert!((first / flume - 1.0).abs() < 0.08);
    // 10 % is asked for after one return; 5.2 % is reached, a fifth of a particle distance.
    assert!((-first..0.1 * first).contains(&again));
}

/// `cargo test --release --test verification -- --ignored --nocapture returning_waves::`
#[test]
#[ignore = "3 minutes on 2 cores"]
fn without_absorption_or_in_a_zone() {
    let [_, first, again] = crests(0.05, None, None);
    assert!(again > 0.8 * first);
    // A zone of a third of a solitary wave's length weakens what returns: 73 and 63 % of the wave, 93 % without it.
    let [weak, strong] = [3.0, 10.0].map(|coefficient| {
        let [_, first, again] = crests(0.05, Some(coefficient), None);
        again / first
    });
    assert!(strong < weak && weak < 0.9 * again / first && strong < 0.65);
}
