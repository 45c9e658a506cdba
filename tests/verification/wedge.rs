//! The still wedge of English et al. (2022): water of 0.5 m over a wedge 0.25 m high, at rest for seconds.

use breakwater::simulation::Simulation;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation};

const DEPTH: f64 = 0.5;

/// The tank with a boundary condition; dp [m] and duration [s].
fn wedge(boundary: &str, dp: f64, duration: f64) -> Value {
    json!({
        "title": "Still water over a wedge",
        "flume": {
            "bed_m": [[0.0, 0.0], [0.85, 0.0], [1.1, 0.25], [1.35, 0.0], [2.2, 0.0]], "still_water_level_m": DEPTH
        },
        "domain": { "x_m": [0.0, 2.2], "width_m": 10.0 * dp, "sides": "periodic", "top_z_m": 0.8, "dp_m": dp },
        "numerics": { "boundary": boundary },
        "stop": { "duration_s": duration }
    })
}

/// Points on bed, wedge and both walls [m].
fn points(width: f64) -> Vec<DVec3> {
    let bed = [0.2, 0.5, 0.8].map(|x| [x, 0.0]);
    let seaward = [0.2, 0.5, 0.8, 1.0].map(|share| [0.85 + 0.25 * share, 0.25 * share]);
    let shoreward = [0.2, 0.5, 0.8].map(|share| [1.35 - 0.25 * share, 0.25 * share]);
    let walls = [0.1, 0.25, 0.4].iter().flat_map(|&z| [[0.0, z], [2.2, z]]);
    let all = bed.into_iter().chain(seaward).chain(shoreward).chain(walls);
    all.map(|[x, z]| DVec3::new(x, 0.5 * width, z)).collect()
}

/// What is seen over the last half of a run.
#[derive(Debug)]
struct Stillness {
    /// Largest error of the mean pressure at a point, as a share of rho g d [-].
    pressure: f64,
    /// rms of the velocity as a share of sqrt(g d) [-].
    velocity: f64,
}

fn stillness(boundary: &str, dp: f64, duration: f64) -> Stillness {
    let mut tank = simulation(&wedge(boundary, dp, duration));
    let points = points(10.0 * dp);
    let mut errors = vec![0.0; points.len()];
    let (mut square, mut count) = (0.0, 0.0);
    run_until(&mut tank, duration, |now: &Simulation| {
        if now.time < 0.5 * duration || !now.steps.is_multiple_of(20) {
            return;
        }
        let sampler = now.sampler();
        for (error, point) in errors.iter_mut().zip(&points) {
            let hydrostatic = RHO0 * GRAVITY * (DEPTH - point.z);
            *error += (sampler.sample(*point).unwrap().pressure - hydrostatic) / (RHO0 * GRAVITY * DEPTH);
        }
        let squares: f64 = now.water.velocity.iter().map(|v| v.length_squared()).sum();
        square += squares / now.water.len() as f64;
        count += 1.0;
    });
    for (error, point) in errors.iter().zip(&points) {
        let place = DVec2::new(point.x, point.z);
        println!("  {boundary}: pressure at {place:.3} m {:+.2} % of rho g d", 100.0 * error / count);
    }
    let stillness = Stillness {
        pressure: errors.iter().map(|error| (error / count).abs()).fold(0.0, f64::max),
        velocity: (square / count).sqrt() / (GRAVITY * DEPTH).sqrt(),
    };
    println!(
        "wedge, {boundary}, dp = {dp} m, {duration} s: pressure within {:.2} % of rho g d, rms velocity {:.3} % of sqrt(g d)",
        100.0 * stillness.pressure,
        100.0 * stillness.velocity
    );
    stillness
}

/// `cargo test --release --test verification -- --ignored --nocapture water_over_a_wedge_is_still_for_five_seconds`
#[test]
#[ignore = "ten minutes on 2 cores"]
fn water_over_a_wedge_is_still_for_five_seconds() {
    let dynamic = stillness("dbc", 0.02, 5.0);
    let modified = stillness("mdbc", 0.02, 5.0);
    assert!(modified.pressure < 0.01 && modified.velocity < 0.005, "{modified:?}");
    assert!(modified.pressure < dynamic.pressure);
}
