//! The energies of each body.

use glam::DVec3;

use super::World;
use crate::femdem::assembly::nodes::RIGID;
use crate::femdem::element;

/// Energies of a body [J]. Contact energy belongs to two bodies, so only the energy balance of the world includes it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyEnergy {
    /// Kinetic energy, defined as in [`EnergyBalance`](super::energy_balance::EnergyBalance).
    pub kinetic: f64,
    /// Strain energy of the tetrahedra.
    pub strain: f64,
    /// Elastic energy of the joints.
    pub joint: f64,
    /// Gravitational potential energy, zero at the start.
    pub gravity: f64,
    /// Energy dissipated in the joints so far, including the elastic energy of broken joints that contacts took over.
    pub fracture: f64,
}

impl World {
    /// Computes the energies of each body at the current positions, except kinetic energy.
    pub(super) fn body_energies(&self) -> Vec<BodyEnergy> {
        let mut energies = vec![BodyEnergy::default(); self.setup.bodies.len()];
        for t in 0..self.tets.nodes.len() {
            let number = usize::from(self.tets.body[t]);
            let x = self.tets.nodes[t].map(|node| self.nodes.position[node as usize]);
            energies[number].strain += element::energy(&self.tets.shape[t], &self.moduli[number], &x);
        }
        let body_of = |interface: usize| usize::from(self.tets.body[self.setup.interfaces[interface].tets[0] as usize]);
        for number in 0..self.joints.count() {
            energies[body_of(number)].joint += self.joints.intact_energy(number, &self.setup, &self.tets, &self.nodes);
        }
        for joint in &self.joints.damaged {
            let energy = &mut energies[body_of(joint.interface as usize)];
            energy.joint += self.joints.damaged_energy(joint, &self.setup);
            energy.fracture += joint.dissipated;
        }
        for failure in &self.failures {
            energies[body_of(failure.interface as usize)].fracture += failure.dissipated;
        }
        for node in 0..self.nodes.count() {
            let displacement = self.nodes.position[node] - self.initial_position(node);
            energies[self.body_of_node(node)].gravity -= self.nodes.mass[node] * self.setup.gravity.dot(displacement);
        }
        energies
    }

    /// Adds the kinetic energies at the start of a time step, after the nodes have moved. `before` are the nodal
    /// velocities half a time step before this start; the current nodal velocities refer to half a time step after this
    /// start.
    pub(super) fn add_kinetic_energies(&self, energies: &mut [BodyEnergy], before: &[DVec3]) {
        for (node, before) in before.iter().enumerate().filter(|(node, _)| self.nodes.constraint[*node] != RIGID) {
            let energy = 0.5 * self.nodes.mass[node] * before.dot(self.nodes.velocity[node]);
            energies[self.body_of_node(node)].kinetic += energy;
        }
        self.rigid_bodies.iter().for_each(|body| energies[body.body].kinetic += body.kinetic);
    }

    /// Returns the number of the body that a node belongs to.
    fn body_of_node(&self, node: usize) -> usize {
        usize::from(self.tets.body[self.nodes.copies_of(node)[0] as usize / 4])
    }
}
