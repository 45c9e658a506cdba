//! A relaxation zone before the multi-layer piston: the wave comes in, and what a wall sends back does not return.

use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, run_until, simulation};

const DEPTH: f64 = 0.3;
const HEIGHT: f64 = 0.06;
/// Seaward and shoreward end of the particles [m].
const TANK: [f64; 2] = [6.0, 12.0];
/// End of the zone [m]: two thirds of the wave's length before it falls to a twentieth of its height.
const ZONE_END: f64 = 8.5;
/// Where the wave is looked at [m].
const GAUGE: f64 = 10.0;

/// A solitary wave of the flume model, which knows no wall, enters a tank that ends at one.
fn tank(dp: f64, relaxes: bool) -> Value {
    let mut case = json!({
        "title": "A solitary wave between a multi-layer piston and a wall",
        "flume": { "bed_m": [[0.0, 0.0], [30.0, 0.0]], "still_water_level_m": DEPTH, "right_end": { "kind": "radiating" } },
        "domain": { "x_m": TANK, "width_m": 10.0 * dp, "sides": "periodic", "top_z_m": 0.6, "dp_m": dp },
        "numerics": { "viscosity_alpha": 0.01 },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": { "kind": "solitary", "height_m": HEIGHT },
        "stop": { "duration_s": 20.0 }
    });
    if relaxes {
        case["domain"]["relaxation_zone"] = json!({ "end_x_m": ZONE_END });
    }
    case
}

/// Crest at the gauge in the flume model [m], and by the particles on the first way and when it has come back from the wall
/// to the piston.
fn crests(dp: f64, relaxes: bool) -> [f64; 3] {
    let mut tank = simulation(&tank(dp, relaxes));
    let celerity = (GRAVITY * (DEPTH + HEIGHT)).sqrt();
    let record = tank.flume.as_ref().unwrap();
    let elevation = |t: &f64| record.elevation(GAUGE, *t);
    let passing = record.times_s().iter().copied().max_by(|a, b| elevation(a).total_cmp(&elevation(b))).unwrap();
    let incident = record.elevation(GAUGE, passing);
    // From the gauge to the wall and back, then to the piston and back.
    let back = passing + 2.0 * (TANK[1] - GAUGE) / celerity;
    let again = back + 2.0 * (GAUGE - TANK[0]) / celerity;
    let (until, from) = (0.5 * (passing + back), back + 0.7 * (again - back));
    let mut crests = [incident, 0.0, 0.0];
    let end = again + 0.5 - tank.start;
    run_until(&mut tank, end, |now| {
        let time = now.flume_time();
        if now.steps.is_multiple_of(10) && (time < until || time > from) {
            let level = now.sampler().surface(DVec2::new(GAUGE, 5.0 * dp), 0.0, 0.6).unwrap() - DEPTH;
            let crest = &mut crests[if time < until { 1 } else { 2 }];
            *crest = crest.max(level);
        }
    });
    println!(
        "dp = {dp} m, relaxation zone: {relaxes}: flume {:.4} m, particles {:.4} m, after coming back {:+.4} m ({:.1} %)",
        crests[0],
        crests[1],
        crests[2],
        100.0 * crests[2] / crests[1]
    );
    crests
}

#[test]
fn what_a_wall_sends_back_ends_in_the_relaxation_zone() {
    let ([_, first, again], [_, relaxed_first, relaxed_again]) = (crests(0.04, false), crests(0.04, true));
    // The zone lets the wave in as it is without it: by less than a tenth of a particle distance.
    assert!((relaxed_first - first).abs() < 0.1 * 0.04);
    assert!(again > 0.5 * first);
    assert!(relaxed_again < 0.15 * relaxed_first);
}
