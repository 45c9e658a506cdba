//! Faces that give way: tied ones become joints, joints that have failed break.

use glam::DVec3;
use rayon::prelude::*;

use super::assembly;
use super::cohesive_law::Cohesion;
use super::joint::{self, Axes, Memory};
use super::world::{Bond, Joint, World, body_of, faces};

impl World {
    /// Tied faces that have reached their strength become joints, joints that have failed break.
    pub(super) fn release_joints(&mut self) {
        let freed = self.faces_beyond_strength();
        let tied = |joints: &[Joint], face: u32| joints[face as usize].bond == Bond::Tied;
        for (number, memory) in freed {
            let joint = &mut self.joints[number];
            joint.bond = Bond::Joint;
            joint.memory = memory;
            let joints = &self.joints;
            for corner in 0..3 {
                assembly::split(&mut self.nodes, &mut self.tets, &self.setup, number, corner, &|f| tied(joints, f));
            }
            let sides = faces(number, &self.setup, &self.tets, &self.nodes);
            if let Some(cohesion) = body_of(&self.setup, self.setup.interfaces[number].tets[0]).cohesion {
                let joint = &mut self.joints[number];
                joint.freed = joint::stored(&cohesion.law(joint.edge), joint.area, &joint.memory, &sides);
                self.lost.freed += joint.freed;
            }
        }
        for number in 0..self.joints.len() {
            if self.joints[number].failed && self.joints[number].bond == Bond::Joint {
                self.break_joint(number);
            }
        }
    }

    fn break_joint(&mut self, number: usize) {
        // What it would have given back is lost with it.
        let lost = self.stored_in(number);
        let joint = &mut self.joints[number];
        joint.bond = Bond::Broken;
        joint.dissipated += lost;
        let opened = self.setup.interfaces[number];
        self.joint_forces[number] = [DVec3::ZERO; 3];
        let by_sliding = joint.memory.is_mostly_slid();
        self.failures.push(self.failure(number as u32, self.time, by_sliding));
        self.contacts.open(opened.tets, lost);
        let joints = &self.joints;
        let unbroken = |face: u32| joints[face as usize].bond != Bond::Broken;
        for corner in opened.nodes[0] {
            let node = self.setup.tets[opened.tets[0] as usize][usize::from(corner)];
            let groups = assembly::held_together(&self.tets, &self.setup, &self.around[node as usize], &unbroken);
            groups.iter().for_each(|group| self.contacts.regroup(group));
        }
    }

    /// Tied faces on which the mean of the stresses of both sides has reached the strength (eq. 1), with the memory that
    /// carries that stress on.
    fn faces_beyond_strength(&self) -> Vec<(usize, Memory)> {
        if self.stresses.is_empty() {
            return Vec::new();
        }
        let of = |(number, joint): (usize, &Joint)| {
            if joint.bond != Bond::Tied {
                return None;
            }
            let interface = &self.setup.interfaces[number];
            let cohesion: Cohesion = body_of(&self.setup, interface.tets[0]).cohesion?;
            let [one, other] = interface.tets.map(|t| self.stresses[t as usize]);
            let stress = (one + other) * 0.5;
            let strength = &cohesion.strength;
            let most = stress.x_axis.length_squared() + stress.y_axis.length_squared() + stress.z_axis.length_squared();
            let least = strength.tensile.min(strength.shear(strength.tensile));
            if most < least * least {
                return None;
            }
            let axes = Axes::of_faces(&faces(number, &self.setup, &self.tets, &self.nodes));
            let traction = stress * axes.normal();
            let (normal, [a, b]) = axes.split(traction);
            let reached = normal >= strength.tensile || a.hypot(b) >= strength.shear(normal);
            reached.then(|| (number, Memory::loaded(&cohesion.law(joint.edge), traction, &axes)))
        };
        self.joints.par_iter().enumerate().filter_map(of).collect()
    }
}
