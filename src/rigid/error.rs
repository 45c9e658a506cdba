//! What can go wrong with rigid bodies.

use thiserror::Error;

/// Why a rigid world cannot be made or cannot go on.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RigidError {
    /// A value in the setup is out of range.
    #[error("{what} is {value}, but must be {allowed}")]
    Setup { what: String, value: f64, allowed: &'static str },
    /// The number of loads differs from the number of bodies.
    #[error("{loads} loads were given for {bodies} bodies")]
    Loads { loads: usize, bodies: usize },
    /// A snapshot of another world.
    #[error("the snapshot holds {snapshot} bodies, this world {world}")]
    Snapshot { snapshot: usize, world: usize },
    /// Two bodies have gone deeper into each other than their rounding, so that the gap is no longer known.
    #[error(
        "at {time:.6} s unit {} has gone {:.3} mm deep into {partner}, more than the {:.3} mm that the rounding allows: \
         stiffer material or a smaller speed is needed", body + 1, depth * 1e3, allowed * 1e3
    )]
    TooDeep { time: f64, body: usize, partner: String, depth: f64, allowed: f64 },
    /// The motion is no longer a number.
    #[error("at {time:.6} s the motion of unit {} is no longer a finite number", body + 1)]
    NotFinite { time: f64, body: usize },
}
