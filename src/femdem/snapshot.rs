//! Saves and restores the state of a world, bit by bit.
//!
//! A snapshot contains positions, velocities, the nodes at the vertices, bonds and states of joints, broken faces, the
//! history of contacts, and the dissipated energies. Shapes, masses, constraints and node copies follow from the setup.
//! Forces and stresses are recomputed in each time step.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::cohesive_law::Point;
use super::contact::pairs::snapshot::{ContactScalars, ContactSnapshot};
use super::energy::Ledger;
use super::joint::Memory;
use super::joints::{self, Bond, WornJoint};
use super::rigid_body::RigidMotion;
use super::world::{Failure, World, contacts};

/// Count of numbers that describe a damaged joint: offset, damaged or not, two energies, three points.
pub const MEMORY: usize = 4 + 3 * POINT;
/// Count of numbers that describe an integration point.
const POINT: usize = 10;

/// State of a world.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Snapshot {
    /// Positions of the nodes [m].
    pub place: Vec<DVec3>,
    /// Velocities of the nodes [m/s].
    pub velocity: Vec<DVec3>,
    /// Nodes at the vertices of the tetrahedra.
    pub vertices: Vec<[u32; 4]>,
    /// Bond of each face: 0 tied, 1 intact joint, 2 broken, 3 damaged joint.
    pub bonds: Vec<u8>,
    /// Face numbers of the damaged joints, in the order of their list.
    pub worn: Vec<u32>,
    /// States of the damaged joints (opaque).
    pub memories: Vec<[f64; MEMORY]>,
    /// Broken faces, in order of time.
    pub failed: Vec<u32>,
    /// Times of breaking [s].
    pub failed_at: Vec<f64>,
    /// 1 if the face broke mainly by sliding, else 0.
    pub failed_by_sliding: Vec<u8>,
    /// Energy dissipated by each broken face, and elastic energy at its release [J].
    pub failed_energy: Vec<[f64; 2]>,
    /// Motions of the rigid bodies (opaque).
    pub rigid: Vec<[f64; 13]>,
    /// Contacts.
    pub contacts: ContactSnapshot,
    /// Scalars of the world.
    pub scalars: Scalars,
}

/// Scalars of a world and its contacts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Scalars {
    time: f64,
    dt: f64,
    lost: Ledger,
    contacts: ContactScalars,
}

impl Snapshot {
    /// Returns the scalars of the world and of the contacts.
    pub fn scalars(&self) -> Scalars {
        Scalars { contacts: self.contacts.scalars, ..self.scalars }
    }

    /// Sets the scalars of the world and of the contacts.
    pub fn set_scalars(&mut self, scalars: Scalars) {
        (self.scalars, self.contacts.scalars) = (scalars, scalars.contacts);
    }
}

impl World {
    /// Returns the state after a time step.
    pub fn snapshot(&self) -> Snapshot {
        let bond = |bond: &Bond| match bond {
            Bond::Tied => 0,
            Bond::Whole => 1,
            Bond::Broken => 2,
            Bond::Worn => 3,
        };
        let contacts = self.contacts.snapshot();
        Snapshot {
            place: self.nodes.place.clone(),
            velocity: self.nodes.velocity.clone(),
            vertices: self.tets.nodes.clone(),
            bonds: self.joints.bond.iter().map(bond).collect(),
            worn: self.joints.worn.iter().map(|joint| joint.interface).collect(),
            memories: self.joints.worn.iter().map(numbers_of).collect(),
            failed: self.failures.iter().map(|failure| failure.interface).collect(),
            failed_at: self.failures.iter().map(|failure| failure.time).collect(),
            failed_by_sliding: self.failures.iter().map(|failure| u8::from(failure.by_sliding)).collect(),
            failed_energy: self.failures.iter().map(|failure| [failure.dissipated, failure.freed]).collect(),
            rigid: self.rigid_bodies.iter().map(|body| body.motion.to_array()).collect(),
            scalars: Scalars { time: self.time, dt: self.dt, lost: self.lost, contacts: contacts.scalars },
            contacts,
        }
    }

    /// Restores a snapshot into a new world of the same setup.
    ///
    /// # Errors
    /// Says why the snapshot does not belong to this setup. The world must not be used then.
    pub fn restore(&mut self, snapshot: Snapshot) -> Result<(), &'static str> {
        let Snapshot { place, velocity, vertices, bonds, worn, memories, contacts: of_contacts, scalars, .. } =
            snapshot;
        let Snapshot { failed, failed_at, failed_by_sliding, failed_energy, rigid, .. } = snapshot;
        if rigid.len() != self.rigid_bodies.len() {
            return Err("its rigid bodies do not match the case");
        }
        for (body, numbers) in self.rigid_bodies.iter_mut().zip(rigid) {
            body.motion = RigidMotion::from_array(&numbers);
        }
        let exists = |face: &u32| (*face as usize) < self.joints.count();
        let counts = [failed_at.len(), failed_by_sliding.len(), failed_energy.len()];
        let counts_match = worn.len() == memories.len() && counts == [failed.len(); 3];
        if bonds.len() != self.joints.count() || !counts_match || !worn.iter().chain(&failed).all(exists) {
            return Err("its joints do not match the mesh");
        }
        for (bond, number) in self.joints.bond.iter_mut().zip(bonds) {
            *bond = match number {
                0 => Bond::Tied,
                1 => Bond::Whole,
                2 => Bond::Broken,
                3 => Bond::Worn,
                _ => return Err("it has faces with an unknown bond"),
            };
        }
        self.joints.worn = worn.into_iter().zip(memories).map(|(number, numbers)| rebuild(number, numbers)).collect();
        self.joints.mark(&self.setup, &mut self.tets);
        self.nodes.come_apart(&mut self.tets, &self.setup, vertices, [place, velocity])?;
        self.failures.clear();
        let modes = failed_by_sliding.into_iter().zip(failed_energy);
        for ((interface, time), (by_sliding, energy)) in failed.into_iter().zip(failed_at).zip(modes) {
            self.failures.push(self.failure(interface, time, by_sliding != 0, energy));
        }
        self.contacts = contacts(&self.setup, &self.tets, &self.around, &self.joints);
        let open = self.failures.iter().flat_map(|failure| self.setup.interfaces[failure.interface as usize].tets);
        self.contacts.restore(of_contacts, open, &self.setup, &self.tets)?;
        (self.time, self.dt, self.lost) = (scalars.time, scalars.dt, scalars.lost);
        Ok(())
    }

    /// Creates the record of a broken face: time [s], dissipated energy and elastic energy at its release [J].
    pub(super) fn failure(&self, interface: u32, time: f64, by_sliding: bool, energy: [f64; 2]) -> Failure {
        let corners = joints::corners(&self.setup, interface as usize);
        let place = (corners[0] + corners[1] + corners[2]) / 3.0;
        let [_, area] = self.joints.size[interface as usize];
        Failure { interface, time, place, area, by_sliding, dissipated: energy[0], freed: energy[1] }
    }
}

fn numbers_of(joint: &WornJoint) -> [f64; MEMORY] {
    let Memory { points, offset, is_worn } = joint.memory;
    let mut numbers = [0.0; MEMORY];
    numbers[..4].copy_from_slice(&[offset, f64::from(u8::from(is_worn)), joint.dissipated, joint.freed]);
    for (numbers, point) in numbers[4..].chunks_exact_mut(POINT).zip(points) {
        let Point { damage, secant, opening, slip: [a, b], plastic: [c, d], slipped, lost: [e, f] } = point;
        numbers.copy_from_slice(&[damage, secant, opening, a, b, c, d, slipped, e, f]);
    }
    numbers
}

fn rebuild(number: u32, numbers: [f64; MEMORY]) -> WornJoint {
    let [offset, is_worn, dissipated, freed, ref points @ ..] = numbers;
    let memory = Memory { offset, is_worn: is_worn != 0.0, ..Memory::default() };
    let mut joint = WornJoint { dissipated, freed, ..WornJoint::new(number as usize, memory) };
    for (point, numbers) in joint.memory.points.iter_mut().zip(points.as_chunks::<POINT>().0) {
        let [damage, secant, opening, a, b, c, d, slipped, e, f] = *numbers;
        *point = Point { damage, secant, opening, slip: [a, b], plastic: [c, d], slipped, lost: [e, f] };
    }
    joint
}
