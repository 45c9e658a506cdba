//! The energy balance of a world.

use serde::{Deserialize, Serialize};

use super::World;
use crate::femdem::element;
use crate::femdem::parallel::chunks::ordered_sum;

/// Energies of a world [J]: stored at the current time, and dissipated or supplied since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Kinetic energy: sum of m v- . v+ / 2 over the nodes, with the mass m and the velocities v- half a time step
    /// before and v+ half a time step after the current time.
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
    /// Elastic energy that joints receive when tied faces are released. No energy of the balance supplies it, because
    /// tied faces store no elastic energy. The total therefore subtracts it, like work.
    #[serde(rename = "freed")]
    pub released: f64,
}

impl EnergyBalance {
    /// Returns the total [J], which is conserved: stored plus dissipated minus supplied energy.
    pub fn total(&self) -> f64 {
        let stored = self.kinetic + self.strain + self.joint + self.contact + self.gravity;
        stored + self.viscous + self.fracture + self.friction - self.work - self.released
    }
}

impl World {
    /// Computes all energies at the current positions, except kinetic energy.
    pub(super) fn energies(&self, viscous_power: f64) -> EnergyBalance {
        let tets = &self.tets;
        let strain = |t: usize| {
            let x = tets.nodes[t].map(|n| self.nodes.position[n as usize]);
            element::energy(&tets.shape[t], &self.moduli[usize::from(tets.body[t])], &x)
        };
        let gravity = |n: usize| -self.nodes.mass[n] * self.setup.gravity.dot(self.nodes.position[n]);
        EnergyBalance {
            strain: ordered_sum(tets.nodes.len(), strain),
            joint: self.joints.stored(&self.setup, tets, &self.nodes),
            contact: self.contacts.scalars.stored,
            friction: self.contacts.scalars.friction,
            fracture: self.dissipated.fracture + self.joints.dissipated() - self.contacts.scalars.taken_over,
            gravity: ordered_sum(self.nodes.count(), gravity) - self.gravity_at_start,
            // The viscous power acts from half a time step before the current time to half a time step after it. Only
            // the first half is dissipated at the current time.
            viscous: self.dissipated.viscous + 0.5 * self.dt * viscous_power,
            ..self.dissipated
        }
    }
}
