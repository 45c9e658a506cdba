//! The still wedge of English et al. (2022): water of 0.5 m over a wedge 0.25 m high, at rest for seconds.

use breakwater::simulation::flume::step::PreparedStep;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation};

const DEPTH: f64 = 0.5;

/// The part of the tank that is filled [m]: walls 0.35 m from the wedge, seven tenths of the depth.
const TANK: [f64; 2] = [0.5, 1.7];

/// The tank with a boundary condition; dp [m] and duration [s].
fn wedge(boundary: &str, dp: f64, duration: f64) -> Value {
    json!({
        "title": "Still water over a wedge",
        "flume": {
            "bed_m": [[0.0, 0.0], [0.85, 0.0], [1.1, 0.25], [1.35, 0.0], [2.2, 0.0]], "still_water_level_m": DEPTH
        },
        "domain": { "x_m": TANK, "sides": "two_dimensional", "top_z_m": 0.8, "dp_m": dp },
        "numerics": { "boundary": boundary },
        "stop": { "duration_s": duration }
    })
}

/// Points on bed, wedge and both walls with their names [m].
fn points(width: f64) -> Vec<(&'static str, DVec3)> {
    let bed = [0.6, 0.7, 0.8, 1.45, 1.6].map(|x| ("bed", [x, 0.0]));
    let edges = [("toe", [0.85, 0.0]), ("apex", [1.1, 0.25]), ("toe", [1.35, 0.0])];
    let shares = [0.2, 0.5, 0.8];
    let seaward = shares.map(|share| ("flank", [0.85 + 0.25 * share, 0.25 * share]));
    let shoreward = shares.map(|share| ("flank", [1.35 - 0.25 * share, 0.25 * share]));
    let walls = [0.1, 0.25, 0.4].iter().flat_map(|&z| TANK.map(|x| ("wall", [x, z])));
    let all = bed.into_iter().chain(edges).chain(seaward).chain(shoreward).chain(walls);
    all.map(|(name, [x, z])| (name, DVec3::new(x, 0.5 * width, z))).collect()
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
    run_until(&mut tank, duration, |now: &mut PreparedStep| {
        if now.time < 0.5 * duration || !now.steps.is_multiple_of(20) {
            return;
        }
        let sampler = now.sampler().unwrap();
        for (error, (_, point)) in errors.iter_mut().zip(&points) {
            let hydrostatic = RHO0 * GRAVITY * (DEPTH - point.z);
            *error += (sampler.sample(*point).unwrap().pressure - hydrostatic) / (RHO0 * GRAVITY * DEPTH);
        }
        let squares: f64 = now.water.velocity.iter().map(|v| v.length_squared()).sum();
        square += squares / now.water.len() as f64;
        count += 1.0;
    });
    for (error, (name, point)) in errors.iter().zip(&points) {
        let place = DVec2::new(point.x, point.z);
        println!("  {boundary}: pressure at {name} {place:.3} m {:+.2} % of rho g d", 100.0 * error / count);
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

#[test]
fn water_over_a_wedge_is_still() {
    let seen = stillness("mdbc", 0.02, 2.0);
    // 2 %: half of what a particle distance of water weighs here; over five seconds it is half of that. With dp = 0.025 m,
    // ten particles in the height of the wedge, the toes have 3 %. When the layers behind the surface held too much at the
    // apex and too little at the toes, it was -7 % and +6 % there.
    assert!(seen.pressure < 0.02, "{seen:?}");
    // 0.5 %: what is asked of the five seconds.
    assert!(seen.velocity < 0.005, "{seen:?}");
}

/// `cargo test --release --test verification -- --ignored --nocapture water_over_a_wedge_is_still_for_five_seconds`
#[test]
#[ignore = "a minute on 2 cores"]
fn water_over_a_wedge_is_still_for_five_seconds() {
    let modified = stillness("mdbc", 0.02, 5.0);
    // For comparison; nothing is asked of it.
    stillness("dbc", 0.02, 5.0);
    // 1 % and 0.5 %: a quarter of what a particle distance of water weighs here, and a thirteenth of the Mach number
    // 1/15 that the scheme allows.
    assert!(modified.pressure < 0.01 && modified.velocity < 0.005, "{modified:?}");
}
