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
    /// The snapshot has a different number of bodies.
    #[error("the snapshot has {snapshot} rigid bodies, but this run has {world}")]
    Snapshot { snapshot: usize, world: usize },
    /// The overlap [m] of a body with `partner` exceeds the `allowed` overlap [m]. This limit depends on the
    /// rounding radii, because the contact normal is undefined if the cores touch.
    #[error(
        "at {time:.6} s unit {} overlaps {partner} by {:.3} mm; the rounding radius allows at most {:.3} mm; \
         use a stiffer material or a lower speed", body + 1, depth * 1e3, allowed * 1e3
    )]
    TooDeep { time: f64, body: usize, partner: String, depth: f64, allowed: f64 },
    /// Position, rotation or angular momentum of a body is not finite.
    #[error("at {time:.6} s the motion of unit {} is no longer a finite number: the simulation has diverged", body + 1)]
    NotFinite { time: f64, body: usize },
}
