//! Coupling of the flume model with the particles: motion of the wavemaker rows, and the water when the particles start
//! within a wave.

use breakwater::simulation::flume::{step::PreparedStep, wave::incoming::ml_piston};
use glam::DVec2;
use serde_json::{Value, json};

use super::tanks::{run_until, simulation};

const STILL_LEVEL: f64 = 0.4;

/// Returns the case of a flat flume with 0.4 m of water and a wave of 8 cm; particles from 6 to 8 m start at a flume
/// time [s].
fn flume(start_s: f64, dp: f64) -> Value {
    json!({
        "title": "A solitary wave in a flat flume",
        "flume": { "bed_m": [[0.0, 0.0], [16.0, 0.0]], "still_water_level_m": STILL_LEVEL },
        "domain": {
            "x_m": [6.0, 8.0], "width_m": 0.32, "sides": "periodic", "top_z_m": 0.7, "dp_m": dp, "start_s": start_s
        },
        "wave": { "kind": "solitary", "height_m": 0.08 },
        "stop": { "duration_s": 0.3 }
    })
}

/// Approximate flume time at which the crest passes x = 7 m [s].
const PASSING: f64 = 5.2;

#[test]
fn rows_of_the_wavemaker_follow_the_multi_layer_piston() {
    let mut simulation = simulation(&flume(PASSING - 0.8, 0.032));
    let piston = ml_piston(&simulation.case, simulation.flume.as_ref().unwrap(), simulation.start);
    let particles = simulation.boundary.pistons();
    let anchors = simulation.boundary.position[particles.clone()].to_vec();
    assert!(!anchors.is_empty());
    let mut furthest = 0.0_f64;
    run_until(&mut simulation, 0.1, |_| ());
    for (particle, anchor) in particles.zip(&anchors) {
        let row = piston.row_heights_m().iter().position(|z| (z - anchor.z).abs() < 1e-9).unwrap();
        let time = simulation.flume_time();
        let moved = simulation.boundary.position[particle] - *anchor;
        // Limit 1e-12 m: rounding of a position some metres from the origin.
        assert!((moved.x - piston.displacement_m(row, time)).abs() < 1e-12 && moved.y == 0.0 && moved.z == 0.0);
        assert_eq!(simulation.boundary.velocity[particle].x, piston.velocity_m_s(row, time));
        furthest = furthest.max(moved.x);
    }
    println!("wavemaker: largest displacement of a row {:.1} mm", 1e3 * furthest);
    assert!(furthest > 0.01);
}

fn elevation(now: &mut PreparedStep, x: f64) -> f64 {
    now.sampler().unwrap().surface(DVec2::new(x, 0.16), 0.0).unwrap() - STILL_LEVEL
}

#[test]
fn water_starts_with_elevation_and_velocity_of_the_flume_model() {
    let dp = 0.032;
    let mut simulation = simulation(&flume(PASSING, dp));
    let mut now = simulation.begin_step().unwrap();
    let record = now.flume.clone().unwrap();
    let mut worst = [0.0_f64; 2];
    for x in [6.5, 7.0, 7.5] {
        let (particles, flume) = (elevation(&mut now, x), record.elevation(x, PASSING));
        let sample = now.sampler().unwrap().sample(glam::DVec3::new(x, 0.16, 0.2)).unwrap();
        let (u, _) = record.velocity(x, 0.2, PASSING);
        println!(
            "x = {x} m: elevation {particles:.4}, flume {flume:.4} m; u {:.4}, flume {u:.4} m/s",
            sample.velocity.x
        );
        worst[0] = worst[0].max((particles - flume).abs());
        worst[1] = worst[1].max((sample.velocity.x - u).abs());
    }
    assert!(record.elevation(7.0, PASSING) > 0.03);
    assert!(worst[0] < 0.1 * dp);
    assert!(worst[1] < 1e-3);
    now.finish().unwrap();
}

/// Returns the case of the 4.5 cm wave of the Fudo experiment over the bare slope. The flume model and the particles
/// end at a wall 1.4 m from the wavemaker. The run lasts from a flume time [s] until after the crest.
fn bare_slope(start_s: f64, dp: f64, sound_speed_factor: f64) -> Value {
    json!({
        "title": "The 4.5 cm wave against a wall",
        "flume": { "bed_m": [[0.0, 0.0], [19.0, 0.0], [37.9, 0.63]], "still_water_level_m": 0.8 },
        "domain": {
            "x_m": [36.5, 37.9], "sides": "two_dimensional", "top_z_m": 1.1, "dp_m": dp, "start_s": start_s
        },
        "fluid": { "sound_speed_factor": sound_speed_factor },
        "wave": { "kind": "solitary", "height_m": 0.045 },
        "stop": { "duration_s": 20.5 - start_s }
    })
}

/// Asserts that the crests of particles and flume model agree 0.5 m from the wavemaker.
fn assert_crest_follows_the_flume_model(start_s: f64, dp: f64, sound_speed_factor: f64) {
    let (height, x, level) = (0.045, 37.0, 0.8);
    let mut simulation = simulation(&bare_slope(start_s, dp, sound_speed_factor));
    let end = simulation.case.stop.duration;
    let (mut particles, mut flume, mut largest_difference) = ([0.0; 2], [0.0; 2], 0.0_f64);
    run_until(&mut simulation, end, |now| {
        if !now.steps.is_multiple_of(20) {
            return;
        }
        let time = now.flume_time();
        let surface = now.sampler().unwrap().surface(DVec2::new(x, 0.0), 0.6).unwrap() - level;
        let expected = now.flume.as_ref().unwrap().elevation(x, time);
        largest_difference = largest_difference.max((surface - expected).abs());
        let keep_higher = |crest: &mut [f64; 2], eta| *crest = if eta > crest[0] { [eta, time] } else { *crest };
        keep_higher(&mut particles, surface);
        keep_higher(&mut flume, expected);
    });
    println!(
        "dp = {dp} m: crest {:.4} m at {:.3} s, flume model {:.4} m at {:.3} s; largest difference {:.1} mm",
        particles[0],
        particles[1],
        flume[0],
        flume[1],
        1e3 * largest_difference
    );
    // The crest passes before the end of the run.
    assert!(flume[1] < 20.4 && flume[0] > 2.0 * height);
    assert!((particles[0] - flume[0]).abs() < 0.05 * height);
    assert!((particles[1] - flume[1]).abs() < 0.05);
}

#[test]
fn crest_near_the_wavemaker_follows_the_flume_model_coarse() {
    assert_crest_follows_the_flume_model(19.6, 0.014, 10.0);
}

#[test]
#[ignore = "30 minutes on 2 cores: \
    cargo test --release --test verification -- --ignored --nocapture crest_near_the_wavemaker_follows"]
fn crest_near_the_wavemaker_follows_the_flume_model_fine() {
    assert_crest_follows_the_flume_model(18.2, 0.007, 15.0);
}
