//! Errors of the rigid-body solver.

use thiserror::Error;

/// Error that prevents the setup or the time stepping of a rigid world.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RigidError {
    /// A value in the setup is out of range.
    #[error("{what} is {value}, but must be {allowed}")]
    Setup { what: String, value: f64, allowed: &'static str },
    /// The number of loads differs from the number of bodies.
    #[error("{loads} loads were passed for {bodies} bodies; pass one load per body")]
    Loads { loads: usize, bodies: usize },
    /// The snapshot belongs to another world.
    #[error("the snapshot has {snapshot} bodies, but this world has {world}")]
    Snapshot { snapshot: usize, world: usize },
    /// The overlap of two bodies exceeds the rounding radius, so the gap can no longer be computed.
    #[error(
        "at {time:.6} s unit {} overlaps {partner} by {:.3} mm; the rounding radius allows {:.3} mm: \
         use a stiffer material or a smaller speed", body + 1, depth * 1e3, allowed * 1e3
    )]
    TooDeep { time: f64, body: usize, partner: String, depth: f64, allowed: f64 },
    /// Position, rotation or angular momentum of a body is not finite.
    #[error("at {time:.6} s the motion of unit {} is no longer a finite number: the simulation has diverged", body + 1)]
    NotFinite { time: f64, body: usize },
}
