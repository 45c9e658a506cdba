//! The energy book.

use serde::{Deserialize, Serialize};

/// Energies [J]: what the bodies have, and what has been lost or given since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Ledger {
    /// Of motion, sum of m v- v+ / 2 of the velocities half a step before and after.
    pub kinetic: f64,
    /// Strain energy of the tetrahedra.
    pub strain: f64,
    /// What joints would give back.
    pub joint: f64,
    /// What contacts would give back.
    pub contact: f64,
    /// In gravity, zero at the start.
    pub gravity: f64,
    /// Lost by viscosity.
    pub viscous: f64,
    /// Lost in joints: fracture.
    pub fracture: f64,
    /// Lost by friction.
    pub friction: f64,
    /// Given by constraints and loads.
    pub work: f64,
    /// What the springs of joints had when they came free; tied faces do not store energy.
    pub freed: f64,
}

impl Ledger {
    /// What does not change: everything there is, and everything lost, less everything given.
    pub fn total(&self) -> f64 {
        let there = self.kinetic + self.strain + self.joint + self.contact + self.gravity;
        there + self.viscous + self.fracture + self.friction - self.work - self.freed
    }
}
