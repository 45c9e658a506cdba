//! Release of tied faces as joints, and breaking of failed joints.

use rayon::prelude::*;

use super::assembly;
use super::element;
use super::joint::{self, Axes, Memory};
use super::joints::{self, Bond, WornJoint};
use super::world::World;

impl World {
    /// Releases tied faces that have reached their strength as joints, and breaks failed joints.
    pub(super) fn release_joints(&mut self) {
        for (number, memory) in self.faces_beyond_strength() {
            self.release_face(number, memory);
        }
        if self.joints.worn.iter().any(|joint| joint.failed) {
            let (failed, worn) = std::mem::take(&mut self.joints.worn).into_iter().partition(|joint| joint.failed);
            self.joints.worn = worn;
            let failed: Vec<WornJoint> = failed;
            failed.iter().for_each(|joint| self.break_joint(joint));
        }
    }

    /// Turns a tied face into a joint with the last_work state.
    fn release_face(&mut self, number: usize, memory: Memory) {
        let Self { joints, nodes, tets, setup, .. } = self;
        joints.bond[number] = Bond::Worn;
        for corner in 0..3 {
            assembly::split(nodes, tets, setup, number, corner, &|face| joints.bond[face as usize] == Bond::Tied);
        }
        setup.interfaces[number].tets.iter().for_each(|tet| tets.jointed[*tet as usize] = true);
        let [edge, area] = joints.size[number];
        let mut joint = WornJoint::new(number, memory);
        joint.freed = joint::stored(&joints::cohesion(setup, number).law(edge), area, &memory);
        self.lost.freed += joint.freed;
        joints.worn.push(joint);
    }

    fn break_joint(&mut self, joint: &WornJoint) {
        let number = joint.interface as usize;
        // The elastic energy of the joint is dissipated with it. Its last forces were computed at the start of this
        // time step; in central differences they act for half a time step after that. A joint that is crushed fast
        // exchanges much of its energy in this time. If it springs back, the dissipated energy may even be negative.
        let last_work = 0.5 * self.dt * joints::power_on(joint, &self.setup, &self.tets, &self.nodes);
        let stored = self.joints.stored_in(joint, &self.setup) + last_work;
        self.lost.fracture += joint.dissipated + stored;
        self.joints.bond[number] = Bond::Broken;
        self.joints.forces[number] = Default::default();
        let energy = [joint.dissipated + stored, joint.freed];
        self.failures.push(self.failure(joint.interface, self.time, joint.memory.is_mostly_slid(), energy));
        let opened = self.setup.interfaces[number];
        self.contacts.open(opened.tets, stored.max(0.0));
        let unbroken = |face: u32| self.joints.bond[face as usize] != Bond::Broken;
        for corner in opened.nodes[0] {
            let node = self.setup.tets[opened.tets[0] as usize][usize::from(corner)];
            let groups = assembly::held_together(&self.tets, &self.setup, &self.around[node as usize], &unbroken);
            groups.iter().for_each(|group| self.contacts.regroup(group));
        }
    }

    /// Returns the tied faces on which the mean stress of both sides has reached the strength (eq. 1), with the joint
    /// state that carries this stress.
    fn faces_beyond_strength(&self) -> Vec<(usize, Memory)> {
        let Self { joints, setup, tets, nodes, .. } = self;
        let strained = &self.deformation.strained;
        let check_face = |(number, bond): (usize, &Bond)| {
            let interface = &setup.interfaces[number];
            if *bond != Bond::Tied || !interface.tets.iter().any(|tet| strained[*tet as usize]) {
                return None;
            }
            let cohesion = joints::cohesion(setup, number);
            let [first, second] = interface.tets.map(|tet| self.stress(tet as usize));
            let axes = Axes::of_faces(&joints::faces(number, setup, tets, nodes));
            let traction = (first + second) * 0.5 * axes.normal();
            let (normal, [a, b]) = axes.split(traction);
            let reached = normal >= cohesion.strength.tensile || a.hypot(b) >= cohesion.strength.shear(normal);
            reached.then(|| (number, Memory::loaded(&cohesion.law(joints.size[number][0]), traction, &axes)))
        };
        if !strained.par_iter().any(|strained| *strained) {
            return Vec::new();
        }
        joints.bond.par_iter().enumerate().filter_map(check_face).collect()
    }

    /// Elastic Cauchy stress of a tetrahedron at the current positions [Pa].
    fn stress(&self, tet: usize) -> glam::DMat3 {
        let corners = self.tets.nodes[tet].map(|node| self.nodes.place[node as usize]);
        element::stress(&self.tets.shape[tet], &self.moduli[usize::from(self.tets.body[tet])], &corners)
    }
}
