//! Turns tied faces that have reached their strength into joints (release), and breaks failed joints.

use rayon::prelude::*;

use super::World;
use crate::femdem::assembly::splitting;
use crate::femdem::element;
use crate::femdem::joints::joint::{self, Axes, JointState};
use crate::femdem::joints::{self, Bond, DamagedJoint};

impl World {
    /// Turns tied faces that have reached their strength into joints, and breaks failed joints.
    pub(super) fn release_joints(&mut self) {
        for (number, state) in self.faces_beyond_strength() {
            self.release_face(number, state);
        }
        if self.joints.damaged.iter().any(|joint| joint.failed) {
            let (failed, damaged) =
                std::mem::take(&mut self.joints.damaged).into_iter().partition(|joint| joint.failed);
            self.joints.damaged = damaged;
            let failed: Vec<DamagedJoint> = failed;
            failed.iter().for_each(|joint| self.break_joint(joint));
        }
    }

    /// Turns a tied face into a joint with the given state.
    fn release_face(&mut self, number: usize, state: JointState) {
        let Self { joints, nodes, tets, setup, .. } = self;
        joints.bond[number] = Bond::Damaged;
        for corner in 0..3 {
            splitting::split(nodes, tets, setup, number, corner, &|face| joints.bond[face as usize] == Bond::Tied);
        }
        setup.interfaces[number].tets.iter().for_each(|tet| tets.jointed[*tet as usize] = true);
        let [edge, area] = joints.size[number];
        let mut joint = DamagedJoint::new(number, state);
        joint.released = joint::stored(&joints::cohesion(setup, number).law(edge), area, &state);
        self.dissipated.released += joint.released;
        joints.damaged.push(joint);
    }

    fn break_joint(&mut self, joint: &DamagedJoint) {
        let number = joint.interface as usize;
        // A joint that breaks dissipates its elastic energy. Its last forces were computed at the start of this time
        // step. In central differences, these forces act until half a time step after this start. A joint that is
        // crushed fast receives or releases much energy in this time. If it springs back, the dissipated energy can
        // even be negative.
        let last_work = 0.5 * self.dt * joints::power_on(joint, &self.setup, &self.tets, &self.nodes);
        let stored = self.joints.damaged_energy(joint, &self.setup) + last_work;
        self.dissipated.fracture += joint.dissipated + stored;
        self.joints.bond[number] = Bond::Broken;
        self.joints.forces[number] = Default::default();
        let energy = [joint.dissipated + stored, joint.released];
        self.failures.push(self.failure(joint.interface, self.time, joint.state.is_mostly_sliding(), energy));
        let opened = self.setup.interfaces[number];
        self.contacts.allow_contact(opened.tets, stored.max(0.0));
        let unbroken = |face: u32| self.joints.bond[face as usize] != Bond::Broken;
        for corner in opened.nodes[0] {
            let node = self.setup.tets[opened.tets[0] as usize][usize::from(corner)];
            let groups =
                splitting::connected_groups(&self.tets, &self.setup, &self.copies_around[node as usize], &unbroken);
            groups.iter().for_each(|group| self.contacts.regroup(group));
        }
    }

    /// Returns the tied faces that have reached their strength (eq. 1). The stress at a face is the mean of the
    /// stresses in its two tetrahedra. Each face is returned with the joint state that carries this stress.
    fn faces_beyond_strength(&self) -> Vec<(usize, JointState)> {
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
            let traction = (first + second) * 0.5 * axes.normal;
            let (normal, [a, b]) = axes.split(traction);
            let reached = normal >= cohesion.strength.tensile || a.hypot(b) >= cohesion.strength.shear(normal);
            reached.then(|| (number, JointState::loaded(&cohesion.law(joints.size[number][0]), traction, &axes)))
        };
        if !strained.par_iter().any(|strained| *strained) {
            return Vec::new();
        }
        joints.bond.par_iter().enumerate().filter_map(check_face).collect()
    }

    /// Returns the elastic Cauchy stress of a tetrahedron at the current positions [Pa].
    fn stress(&self, tet: usize) -> glam::DMat3 {
        let corners = self.tets.nodes[tet].map(|node| self.nodes.position[node as usize]);
        element::stress(&self.tets.shape[tet], &self.moduli[usize::from(self.tets.body[tet])], &corners)
    }
}
