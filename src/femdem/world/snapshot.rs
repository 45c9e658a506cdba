//! Saves and restores the state of a world without any change, not even of the last bit.
//!
//! A snapshot contains positions, velocities, the nodes at the vertices, bonds and states of joints, broken faces, the
//! history of contacts, and the dissipated energies. Shapes, masses, constraints and node copies follow from the setup.
//! Forces and stresses are recomputed in each time step.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::energy_balance::EnergyBalance;
use super::{Failure, World, contacts};
use crate::femdem::contact::pairs::{ContactScalars, snapshot::ContactSnapshot};
use crate::femdem::joints::{self, Bond, DamagedJoint, JOINT_STATE_LENGTH};
use crate::femdem::rigid::body::RigidMotion;

/// State of a world.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Snapshot {
    /// Positions of the nodes [m].
    pub position: Vec<DVec3>,
    /// Velocities of the nodes [m/s].
    pub velocity: Vec<DVec3>,
    /// Node numbers at the vertices of each tetrahedron.
    pub vertices: Vec<[u32; 4]>,
    /// Bond of each face: 0 tied, 1 intact joint, 2 broken, 3 damaged joint.
    pub bonds: Vec<u8>,
    /// Interface numbers of the damaged joints, in the order of `Joints::damaged`.
    pub damaged: Vec<u32>,
    /// State of each damaged joint, see [`DamagedJoint::to_array`].
    pub joint_states: Vec<[f64; JOINT_STATE_LENGTH]>,
    /// Interface numbers of the broken faces, in order of time.
    pub failed: Vec<u32>,
    /// Time at which each face broke [s].
    pub failed_at: Vec<f64>,
    /// For each broken face, 1 if it broke mainly by sliding, else 0.
    pub failed_by_sliding: Vec<u8>,
    /// For each broken face, the energy that its joint dissipated, and the elastic energy of the joint when its tied
    /// face was released [J].
    pub failed_energy: Vec<[f64; 2]>,
    /// Motion of each rigid body, see [`RigidMotion::to_array`].
    pub rigid: Vec<[f64; 13]>,
    /// History of the contacts.
    pub contacts: ContactSnapshot,
    /// Time, time step and energies.
    pub scalars: Scalars,
}

/// Time, time step, dissipated energies and contact scalars of a world.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Scalars {
    time: f64,
    dt: f64,
    #[serde(rename = "lost")]
    dissipated: EnergyBalance,
    contacts: ContactScalars,
}

impl World {
    /// Returns the state after a time step.
    pub fn snapshot(&self) -> Snapshot {
        let bond = |bond: &Bond| match bond {
            Bond::Tied => 0,
            Bond::Intact => 1,
            Bond::Broken => 2,
            Bond::Damaged => 3,
        };
        let &Self { time, dt, dissipated, .. } = self;
        Snapshot {
            position: self.nodes.position.clone(),
            velocity: self.nodes.velocity.clone(),
            vertices: self.tets.nodes.clone(),
            bonds: self.joints.bond.iter().map(bond).collect(),
            damaged: self.joints.damaged.iter().map(|joint| joint.interface).collect(),
            joint_states: self.joints.damaged.iter().map(DamagedJoint::to_array).collect(),
            failed: self.failures.iter().map(|failure| failure.interface).collect(),
            failed_at: self.failures.iter().map(|failure| failure.time).collect(),
            failed_by_sliding: self.failures.iter().map(|failure| u8::from(failure.by_sliding)).collect(),
            failed_energy: self.failures.iter().map(|failure| [failure.dissipated, failure.released]).collect(),
            rigid: self.rigid_bodies.iter().map(|body| body.motion.to_array()).collect(),
            scalars: Scalars { time, dt, dissipated, contacts: self.contacts.scalars },
            contacts: self.contacts.snapshot(),
        }
    }

    /// Restores a snapshot into a new world of the same setup.
    ///
    /// # Errors
    /// If the snapshot does not belong to this setup. The text gives the reason. The world must then not be used.
    pub fn restore(&mut self, snapshot: Snapshot) -> Result<(), &'static str> {
        let Snapshot {
            position, velocity, vertices, bonds, damaged, joint_states, contacts: of_contacts, scalars, ..
        } = snapshot;
        let Snapshot { failed, failed_at, failed_by_sliding, failed_energy, rigid, .. } = snapshot;
        if rigid.len() != self.rigid_bodies.len() {
            return Err("its rigid bodies do not match the case");
        }
        for (body, numbers) in self.rigid_bodies.iter_mut().zip(rigid) {
            body.motion = RigidMotion::from_array(&numbers);
        }
        let exists = |face: &u32| (*face as usize) < self.joints.count();
        let counts = [failed_at.len(), failed_by_sliding.len(), failed_energy.len()];
        let counts_match = damaged.len() == joint_states.len() && counts == [failed.len(); 3];
        if bonds.len() != self.joints.count() || !counts_match || !damaged.iter().chain(&failed).all(exists) {
            return Err("its joints do not match the mesh");
        }
        for (bond, number) in self.joints.bond.iter_mut().zip(bonds) {
            *bond = match number {
                0 => Bond::Tied,
                1 => Bond::Intact,
                2 => Bond::Broken,
                3 => Bond::Damaged,
                _ => return Err("it has faces with an unknown bond"),
            };
        }
        let joint = |(number, numbers): (u32, _)| DamagedJoint::from_array(number, numbers);
        self.joints.damaged = damaged.into_iter().zip(joint_states).map(joint).collect();
        self.joints.mark_tetrahedra(&self.setup, &mut self.tets);
        self.nodes.restore_split(&mut self.tets, &self.setup, vertices, [position, velocity])?;
        self.failures.clear();
        let modes = failed_by_sliding.into_iter().zip(failed_energy);
        for ((interface, time), (by_sliding, energy)) in failed.into_iter().zip(failed_at).zip(modes) {
            self.failures.push(self.failure(interface, time, by_sliding != 0, energy));
        }
        self.contacts = contacts(&self.setup, &self.tets, &self.copies_around, &self.joints);
        let open = self.failures.iter().flat_map(|failure| self.setup.interfaces[failure.interface as usize].tets);
        self.contacts.restore((of_contacts, scalars.contacts), open, &self.setup, &self.tets)?;
        (self.time, self.dt, self.dissipated) = (scalars.time, scalars.dt, scalars.dissipated);
        Ok(())
    }

    /// Creates the record of a face that broke at a time [s]. `energy` contains the energy that its joint dissipated,
    /// and the elastic energy of the joint when its tied face was released [J].
    pub(super) fn failure(&self, interface: u32, time: f64, by_sliding: bool, energy: [f64; 2]) -> Failure {
        let corners = joints::corners(&self.setup, interface as usize);
        let centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
        let [_, area] = self.joints.size[interface as usize];
        Failure { interface, time, centroid, area, by_sliding, dissipated: energy[0], released: energy[1] }
    }
}
