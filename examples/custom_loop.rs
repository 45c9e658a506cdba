//! A custom simulation loop: a dam breaks, and the loop stops when the water reaches the far wall.
//!
//!     cargo run --release --example custom_loop

use std::{error::Error, sync::Arc};

use breakwater::{Case, Simulation};
use glam::DVec3;

/// A column of water, 0.25 m wide and 0.5 m high, at one end of a tank of 1 m, in two dimensions.
const CASE: &str = r#"{
    "title": "Dam break",
    "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.5 },
    "domain": {
        "x_m": [0.0, 1.0], "sides": "two_dimensional", "top_z_m": 1.0, "dp_m": 0.0125,
        "water": { "kind": "block", "x_m": [0.0, 0.25], "top_z_m": 0.5 }
    },
    "stop": { "duration_s": 2.0 }
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    let case = Arc::new(Case::from_str(CASE, "dam break")?);
    let mut simulation = Simulation::new(case.clone())?;
    let wall = case.domain.x[1];
    let foot = DVec3::new(0.0, 0.0, case.domain.dp);

    loop {
        // `begin_step` evaluates the current state. The water can be sampled before `finish` completes the time step.
        let mut now = simulation.begin_step()?;
        let front = now.water.position.iter().map(|position| position.x).fold(0.0, f64::max);
        if now.steps.is_multiple_of(100) {
            let pressure = now.sampler()?.sample(foot).map_or(0.0, |sample| sample.pressure);
            println!("{:.3} s: front at {front:.3} m, {pressure:.0} Pa at the foot of the column", now.time);
        }
        // If a particle touches the wall, its centre is 0.5 dp away from the wall; 0.75 includes a tolerance.
        if front > wall - 0.75 * case.domain.dp {
            println!("The water reaches the wall after {:.3} s and {} steps.", now.time, now.steps);
            return Ok(());
        }
        if now.time > case.stop.duration {
            return Err("the water did not reach the wall".into());
        }
        now.finish()?;
    }
}
