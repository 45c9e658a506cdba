//! What can go wrong in a step, and finding out where.

use glam::DVec3;
use thiserror::Error;

use super::Simulation;
use crate::rigid::RigidError;

/// Why a run cannot go on.
#[derive(Debug, Error)]
pub enum Failure {
    /// A number is no longer finite.
    #[error(
        "the water has become unstable after {time:.4} s (step {step}): {what} near x = {:.3}, y = {:.3}, z = {:.3} m; \
         likely causes: a Courant number too large, a speed of sound too low for the flow (sound_speed_factor), \
         or particles too coarse for the geometry there", place.x, place.y, place.z
    )]
    Unstable {
        /// Time [s].
        time: f64,
        /// Step.
        step: u64,
        /// What is wrong.
        what: String,
        /// Where [m].
        place: DVec3,
    },
    /// A particle has left the domain.
    #[error(
        "water particle {id} has left the domain after {time:.4} s (step {step}) at x = {:.3}, y = {:.3}, z = {:.3} m \
         with {speed:.2} m/s: {advice}", place.x, place.y, place.z
    )]
    Escaped {
        /// Time [s].
        time: f64,
        /// Step.
        step: u64,
        /// Number of the particle.
        id: u32,
        /// Where [m].
        place: DVec3,
        /// Its speed [m/s].
        speed: f64,
        /// What to do.
        advice: &'static str,
    },
    /// The units cannot go on.
    #[error("{0}")]
    Contact(#[from] RigidError),
}

/// Name the particle whose state or rate is not finite.
pub(super) fn not_finite(simulation: &Simulation) -> Failure {
    let water = &simulation.water;
    let bad = (0..water.len())
        .find(|&i| !(water.position[i].is_finite() && water.velocity[i].is_finite() && water.density[i].is_finite()));
    let (what, place) = match bad {
        Some(i) => (format!("the state of particle {} is not a finite number", water.id[i]), water.position[i]),
        None => {
            let fastest = (0..water.len())
                .max_by(|&a, &b| water.velocity[a].length_squared().total_cmp(&water.velocity[b].length_squared()));
            let place = fastest.map_or(DVec3::NAN, |i| water.position[i]);
            ("a rate is not a finite number".to_owned(), place)
        }
    };
    Failure::Unstable { time: simulation.time, step: simulation.steps, what, place }
}

/// The first particle outside the domain, if any.
pub(super) fn find_escape(simulation: &Simulation) -> Option<Failure> {
    use rayon::prelude::*;
    let [low, high] = simulation.bounds;
    let water = &simulation.water;
    let outside = |p: &DVec3| !(p.cmpge(low).all() && p.cmple(high).all());
    let i = water.position.par_iter().with_min_len(4096).position_first(outside)?;
    if !water.position[i].is_finite() {
        return Some(not_finite(simulation));
    }
    let advice = if water.position[i].z > high.z {
        "splash higher than the walls: raise domain.top_z_m"
    } else {
        "it has gone through a wall or the bed: refine dp_m, raise boundary_layers, or check that walls reach above the water"
    };
    Some(Failure::Escaped {
        time: simulation.time,
        step: simulation.steps,
        id: water.id[i],
        place: water.position[i],
        speed: water.velocity[i].length(),
        advice,
    })
}
