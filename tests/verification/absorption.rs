//! A piston that absorbs the wave reflected by a wall.

use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{GRAVITY, run_until, simulation};

const DEPTH: f64 = 0.3;
const LENGTH: f64 = 4.0;

/// Returns the case of a tank between a piston that generates a solitary wave and a wall.
fn tank(dp: f64, height: f64, absorbs: bool) -> Value {
    let mut wavemaker = json!({ "kind": "piston" });
    if absorbs {
        wavemaker["absorption_gauge_m"] = json!(4.0 * dp);
    }
    json!({
        "title": "A solitary wave between a piston and a wall",
        "flume": { "bed_m": [[0.0, 0.0], [LENGTH, 0.0]], "still_water_level_m": DEPTH },
        "domain": { "x_m": [0.0, LENGTH], "sides": "two_dimensional", "top_z_m": 0.6, "dp_m": dp },
        "numerics": { "viscosity_alpha": 0.01 },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": { "kind": "solitary", "height_m": height },
        "wavemaker": wavemaker,
        "stop": { "duration_s": 20.0 }
    })
}

/// Returns the highest elevations in the middle of the tank [m]: of the incident wave, and after reflection by the wall
/// and the piston.
fn crests(dp: f64, height: f64, absorbs: bool) -> [f64; 2] {
    let mut tank = simulation(&tank(dp, height, absorbs));
    let celerity = (GRAVITY * (DEPTH + height)).sqrt();
    // The crest leaves the piston after half of the stroke time.
    let outskirt = (0.75 * height / (DEPTH * DEPTH * (DEPTH + height))).sqrt();
    let leaves = (3.8 + height / DEPTH) / (outskirt * celerity);
    let [first, reflected, rereflected] = [0.5, 1.5, 2.5].map(|lengths| leaves + lengths * LENGTH / celerity);
    // The readings stop after the first passage of the crest and start again before the third passage. At both times,
    // the wave is far from the middle.
    let (until, from) = (0.5 * (first + reflected), reflected + 0.75 * (rereflected - reflected));
    let mut crests = [0.0_f64; 2];
    run_until(&mut tank, rereflected + 0.2 * LENGTH / celerity, |now| {
        if now.steps.is_multiple_of(10) && (now.time < until || now.time > from) {
            let level = now.sampler().unwrap().surface(DVec2::new(0.5 * LENGTH, 5.0 * dp), 0.0).unwrap() - DEPTH;
            let crest = &mut crests[usize::from(now.time > until)];
            *crest = crest.max(level);
        }
    });
    println!(
        "dp = {dp} m, absorbing: {absorbs}: incident crest {:.4} m, re-reflected crest {:+.4} m ({:.1} %); absorption moved the piston by {:+.3} m",
        crests[0],
        crests[1],
        100.0 * crests[1] / crests[0],
        tank.ends[0].state.absorbed.displacement_m
    );
    crests
}

fn compare(dp: f64, height: f64) -> [f64; 2] {
    [false, true].map(|absorbs| {
        let [first, rereflected] = crests(dp, height, absorbs);
        rereflected / first
    })
}

#[test]
fn an_absorbing_piston_does_not_reflect_the_wave_coarse() {
    let [without, with] = compare(0.03, 0.09);
    // Limit for the wave after reflection by the absorbing piston: 10 % of the incident crest. Reached: 6.5 %, which is
    // a fifth of a particle spacing.
    assert!(without > 0.5 && with < 0.1);
}

#[test]
#[ignore = "5 minutes on 2 cores: cargo test --release --test verification -- --ignored --nocapture absorption::"]
fn an_absorbing_piston_does_not_reflect_the_wave_fine() {
    let [without, with] = compare(0.025, 0.06);
    assert!(without > 0.5 && with < 0.1);
}
