//! The energy balance of a world and of each body.

use glam::DVec3;
use rayon::prelude::*;

use super::element;
use super::energy::Ledger;
use super::rigid_body::RIGID;
use super::world::{PIECE, World};

/// Energies of a body [J]. Contact energy belongs to two bodies and appears only in the total balance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyEnergy {
    /// Kinetic energy, defined as in [`Ledger`].
    pub kinetic: f64,
    /// Strain energy of the tetrahedra.
    pub strain: f64,
    /// Elastic energy of the joints.
    pub joint: f64,
    /// Gravitational potential energy, zero at the start.
    pub gravity: f64,
    /// Energy dissipated in the joints so far, including the part that contacts have taken over.
    pub fracture: f64,
}

impl World {
    /// Computes all energies at the current positions, except kinetic energy.
    pub(super) fn energies(&self, viscous_power: f64) -> Ledger {
        let tets = &self.tets;
        let strain = |t: usize| {
            let x = tets.nodes[t].map(|n| self.nodes.place[n as usize]);
            element::energy(&tets.shape[t], &self.moduli[usize::from(tets.body[t])], &x)
        };
        let gravity = |n: usize| -self.nodes.mass[n] * self.setup.gravity.dot(self.nodes.place[n]);
        Ledger {
            strain: ordered_sum(tets.nodes.len(), strain),
            joint: self.joints.stored(&self.setup, tets, &self.nodes),
            contact: self.contacts.stored,
            friction: self.contacts.friction,
            fracture: self.lost.fracture + self.joints.dissipated() - self.contacts.taken_over,
            gravity: ordered_sum(self.nodes.count(), gravity) - self.gravity_at_start,
            // The power is that of the velocity half a time step ago and lasts until half a time step after.
            viscous: self.lost.viscous + 0.5 * self.dt * viscous_power,
            ..self.lost
        }
    }

    /// Computes the energies of each body at the current positions, except kinetic energy.
    pub(super) fn body_energies(&self) -> Vec<BodyEnergy> {
        let mut energies = vec![BodyEnergy::default(); self.setup.bodies.len()];
        for t in 0..self.tets.nodes.len() {
            let number = usize::from(self.tets.body[t]);
            let x = self.tets.nodes[t].map(|node| self.nodes.place[node as usize]);
            energies[number].strain += element::energy(&self.tets.shape[t], &self.moduli[number], &x);
        }
        let body_of = |interface: usize| usize::from(self.tets.body[self.setup.interfaces[interface].tets[0] as usize]);
        for number in 0..self.joints.count() {
            energies[body_of(number)].joint +=
                self.joints.stored_in_whole(number, &self.setup, &self.tets, &self.nodes);
        }
        for joint in &self.joints.worn {
            let energy = &mut energies[body_of(joint.interface as usize)];
            energy.joint += self.joints.stored_in(joint, &self.setup);
            energy.fracture += joint.dissipated;
        }
        for failure in &self.failures {
            energies[body_of(failure.interface as usize)].fracture += failure.dissipated;
        }
        for node in 0..self.nodes.count() {
            let displacement = self.nodes.place[node] - self.place_at_start(node);
            energies[self.body_of_node(node)].gravity -= self.nodes.mass[node] * self.setup.gravity.dot(displacement);
        }
        energies
    }

    /// Adds the kinetic energies, from the velocities `before` and now (half a time step earlier and later).
    pub(super) fn add_kinetic_energies(&self, energies: &mut [BodyEnergy], before: &[DVec3]) {
        for (node, before) in before.iter().enumerate().filter(|(node, _)| self.nodes.constraint[*node] != RIGID) {
            let energy = 0.5 * self.nodes.mass[node] * before.dot(self.nodes.velocity[node]);
            energies[self.body_of_node(node)].kinetic += energy;
        }
        self.rigid_bodies.iter().for_each(|body| energies[body.body].kinetic += body.kinetic);
    }

    /// Returns the number of the body that a node belongs to.
    fn body_of_node(&self, node: usize) -> usize {
        usize::from(self.tets.body[self.nodes.ties.of(node)[0] as usize / 4])
    }
}

/// Sums `value` over 0..count in an order that does not depend on the number of threads.
pub(super) fn ordered_sum(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let chunks: Vec<f64> = (0..count.div_ceil(PIECE))
        .into_par_iter()
        .map(|chunk| (chunk * PIECE..((chunk + 1) * PIECE).min(count)).map(&value).sum())
        .collect();
    chunks.iter().fold(0.0, |sum, chunk| sum + chunk)
}
