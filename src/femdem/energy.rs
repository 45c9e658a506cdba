//! The energy balance.

use serde::{Deserialize, Serialize};

/// Energies [J]: stored now, and dissipated or supplied since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Ledger {
    /// Kinetic energy: sum of m v- v+ / 2, with the velocities half a time step before and after.
    pub kinetic: f64,
    /// Strain energy of the tetrahedra.
    pub strain: f64,
    /// Elastic energy of the joints.
    pub joint: f64,
    /// Elastic energy of the contacts.
    pub contact: f64,
    /// Gravitational potential energy, zero at the start.
    pub gravity: f64,
    /// Energy dissipated by viscosity.
    pub viscous: f64,
    /// Energy dissipated in joints by fracture.
    pub fracture: f64,
    /// Energy dissipated by friction.
    pub friction: f64,
    /// Work of constraints and loads.
    pub work: f64,
    /// Elastic energy that tied faces get when they are released as joints; tied faces store none.
    pub freed: f64,
}

impl Ledger {
    /// Returns the conserved total: stored plus dissipated minus supplied energy.
    pub fn total(&self) -> f64 {
        let stored = self.kinetic + self.strain + self.joint + self.contact + self.gravity;
        stored + self.viscous + self.fracture + self.friction - self.work - self.freed
    }
}
