//! Bodies that are not deformed: all nodes of each move as one.
//!
//! Mass and inertia are those of the tetrahedra, forces those on the nodes. The centre moves by central differences as
//! nodes do. Angular momentum is the state; between two steps the body turns about its principal axes one after another
//! (Dullweber, Leimkuhler and McLachlan 1997, "Symplectic splitting methods for rigid body molecular dynamics", J. Chem.
//! Phys. 107, 5840-5851): symplectic, the same to and fro, and the angular momentum is kept exactly.

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

use super::assembly::{Nodes, Tets};
use super::principal_axes::principal_axes;
use super::rigid_hold::{Freedom, Row, hold};
use super::setup::Setup;
use super::world::PIECE;

/// Mark of the nodes of rigid bodies in [`Nodes::constraint`]: their constraints are those of the body.
pub const RIGID: u16 = u16::MAX;

/// What changes with time in a rigid body; with the case, enough to go on from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Velocity of the centre [m/s], half a step before its place.
    pub velocity: DVec3,
    /// Angular momentum about the centre [kg m2/s], half a step before the orientation.
    pub angular_momentum: DVec3,
    /// From the principal axes to those of space.
    pub orientation: DQuat,
}

impl RigidMotion {
    /// All of it as numbers: centre, velocity, angular momentum, orientation (x, y, z, w).
    pub fn to_array(&self) -> [f64; 13] {
        let vectors = [self.centre, self.velocity, self.angular_momentum];
        let turn = self.orientation.to_array();
        std::array::from_fn(|k| if k < 9 { vectors[k / 3][k % 3] } else { turn[k - 9] })
    }

    /// From the numbers of [`Self::to_array`].
    pub fn from_array(numbers: &[f64; 13]) -> Self {
        let [centre, velocity, angular_momentum] = [0, 3, 6].map(|k| DVec3::from_slice(&numbers[k..k + 3]));
        let orientation = DQuat::from_slice(&numbers[9..13]);
        Self { centre, velocity, angular_momentum, orientation }
    }
}

/// A body that is not deformed.
#[derive(Debug, Clone)]
pub struct RigidBody {
    /// Number of the body.
    pub body: usize,
    /// Motion.
    pub motion: RigidMotion,
    /// Kinetic energy at the start of the last step [J].
    pub(super) kinetic: f64,
    mass: f64,
    /// Principal moments of inertia [kg m2].
    moments: DVec3,
    /// Its nodes, and their places from the centre along the principal axes [m].
    nodes: Vec<(u32, DVec3)>,
    /// Its nodes that are held, by their place in `nodes`, and the numbers of their constraints.
    held: Vec<(u32, u16)>,
}

impl RigidBody {
    /// The rigid bodies of a setup.
    pub fn all(setup: &Setup, nodes: &Nodes, tets: &Tets) -> Vec<Self> {
        let rigid = |number: &usize| setup.bodies[*number].rigid;
        (0..setup.bodies.len()).filter(rigid).map(|number| Self::new(number, setup, nodes, tets)).collect()
    }

    /// Square of the largest speed of its nodes [m2/s2].
    pub(super) fn fastest_squared(&self, nodes: &Nodes) -> f64 {
        self.nodes.iter().map(|(node, _)| nodes.velocity[*node as usize].length_squared()).fold(0.0, f64::max)
    }

    fn new(body: usize, setup: &Setup, nodes: &Nodes, tets: &Tets) -> Self {
        let of = &setup.bodies[body];
        let corners = |t: usize| setup.tets[t].map(|node| setup.nodes[node as usize]);
        let mass_of = |t: usize| of.elastic.density * tets.shape[t].volume;
        let mass: f64 = of.tets.clone().map(mass_of).sum();
        let middle = |t: usize| corners(t).iter().sum::<DVec3>() * 0.25;
        let centre = of.tets.clone().map(|t| middle(t) * mass_of(t)).sum::<DVec3>() / mass;
        let inertia = of.tets.clone().map(|t| inertia(&corners(t), mass_of(t), centre)).fold(DMat3::ZERO, |a, b| a + b);
        let (moments, axes) = principal_axes(inertia);
        let orientation = DQuat::from_mat3(&axes);
        let motion = RigidMotion {
            centre,
            velocity: of.velocity + of.angular_velocity.cross(centre - of.pivot),
            angular_momentum: inertia * of.angular_velocity,
            orientation,
        };
        let origin = |node: u32| {
            let copy = nodes.ties.of(node as usize)[0] as usize;
            setup.tets[copy / 4][copy % 4]
        };
        let mut own: Vec<u32> = tets.nodes[of.tets.clone()].iter().flatten().copied().collect();
        own.sort_unstable();
        own.dedup();
        let mut held = Vec::new();
        for (number, constraint) in setup.constraints.iter().enumerate() {
            let is_held: std::collections::BTreeSet<u32> = constraint.nodes.iter().copied().collect();
            held.extend(
                own.iter()
                    .enumerate()
                    .filter(|(_, node)| is_held.contains(&origin(**node)))
                    .map(|(index, _)| (index as u32, number as u16)),
            );
        }
        let arm = |node: &u32| (*node, orientation.inverse() * (setup.nodes[origin(*node) as usize] - centre));
        Self { body, motion, kinetic: 0.0, mass, moments, nodes: own.iter().map(arm).collect(), held }
    }

    /// Velocities and places at the end of a step from the forces on the tetrahedra [N]; `given` are the velocities of
    /// the constraints [m/s]. Returns the kinetic energy at its start and the work of the constraints over it [J].
    pub fn advance(
        &mut self,
        nodes: &mut Nodes,
        forces: &[[DVec3; 4]],
        gravity: DVec3,
        dt: f64,
        given: &[[Option<f64>; 3]],
    ) -> [f64; 2] {
        let [force, torque] = self.resultant(nodes, forces);
        let RigidMotion { centre, orientation, .. } = self.motion;
        let axes = DMat3::from_quat(orientation);
        let inverse_inertia = axes * DMat3::from_diagonal(self.moments.recip()) * axes.transpose();
        let before = Freedom {
            velocity: self.motion.velocity,
            angular_velocity: inverse_inertia * self.motion.angular_momentum,
        };
        let mut motion = self.motion;
        motion.velocity += (force / self.mass + gravity) * dt;
        motion.angular_momentum += torque * dt;
        let mut work = 0.0;
        if !self.held.is_empty() {
            let rows = self.held.iter().flat_map(|(index, number)| {
                let arm = orientation * self.nodes[*index as usize].1;
                let components = given[usize::from(*number)].into_iter().enumerate();
                components.filter_map(move |(axis, given)| Some(Row { axis: DVec3::AXES[axis], arm, velocity: given? }))
            });
            let free =
                Freedom { velocity: motion.velocity, angular_velocity: inverse_inertia * motion.angular_momentum };
            let impulse = hold(self.mass, inverse_inertia, free, rows);
            motion.velocity += impulse.force / self.mass;
            motion.angular_momentum += impulse.torque;
            let after =
                Freedom { velocity: motion.velocity, angular_velocity: inverse_inertia * motion.angular_momentum };
            work = 0.5
                * (impulse.force.dot(before.velocity + after.velocity)
                    + impulse.torque.dot(before.angular_velocity + after.angular_velocity));
        }
        // Of the velocities half a step before and after, as for nodes.
        self.kinetic = 0.5 * self.mass * before.velocity.dot(motion.velocity)
            + 0.5 * before.angular_velocity.dot(motion.angular_momentum);
        motion.centre = centre + motion.velocity * dt;
        motion.orientation = turned(orientation, self.moments, motion.angular_momentum, dt);
        self.motion = motion;
        self.place(nodes, dt);
        [self.kinetic, work]
    }

    /// Moves the nodes to where the body has brought them over a step [s].
    fn place(&self, nodes: &mut Nodes, dt: f64) {
        let turn = DMat3::from_quat(self.motion.orientation);
        for (node, arm) in &self.nodes {
            let place = self.motion.centre + turn * *arm;
            let node = *node as usize;
            nodes.velocity[node] = (place - nodes.place[node]) / dt;
            nodes.place[node] = place;
        }
    }

    /// Force and torque about the centre [N, N m]; pieces first, so that the sum has one order.
    fn resultant(&self, nodes: &Nodes, forces: &[[DVec3; 4]]) -> [DVec3; 2] {
        let of_piece = |piece: &[(u32, DVec3)]| {
            let mut sum = [DVec3::ZERO; 2];
            for (node, arm) in piece {
                let copies = nodes.ties.of(*node as usize).iter();
                let force: DVec3 = copies.map(|copy| forces[*copy as usize / 4][*copy as usize % 4]).sum();
                if force != DVec3::ZERO {
                    sum = [sum[0] + force, sum[1] + (self.motion.orientation * *arm).cross(force)];
                }
            }
            sum
        };
        let pieces: Vec<[DVec3; 2]> = self.nodes.par_chunks(PIECE).map(of_piece).collect();
        pieces.iter().fold([DVec3::ZERO; 2], |sum, piece| [sum[0] + piece[0], sum[1] + piece[1]])
    }
}

/// Inertia of a tetrahedron of even density about a point [kg m2].
fn inertia(corners: &[DVec3; 4], mass: f64, about: DVec3) -> DMat3 {
    let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
    let arms = corners.map(|corner| corner - about);
    // Integral of x x^T over a tetrahedron: m/20 (sum of x_i x_i^T + sum of x_i times itself).
    let second = arms.iter().fold(outer(arms.iter().sum()), |sum, arm| sum + outer(*arm)) * (mass / 20.0);
    DMat3::IDENTITY * (second.x_axis.x + second.y_axis.y + second.z_axis.z) - second
}

/// Orientation after a time [s] of free rotation.
fn turned(orientation: DQuat, moments: DVec3, angular_momentum: DVec3, dt: f64) -> DQuat {
    let about = |orientation: DQuat, (axis, share): (usize, f64)| {
        let angle = (orientation.inverse() * angular_momentum)[axis] / moments[axis] * share * dt;
        orientation * DQuat::from_axis_angle(DVec3::AXES[axis], angle)
    };
    [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)].into_iter().fold(orientation, about).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inertia_of_a_tetrahedron_is_that_of_the_tables() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        // Right-angled corner of edges 1: I_xx about the corner is m (1 + 1) / 10.
        let found = inertia(&corners, 3.0, DVec3::ZERO);
        assert!((found.x_axis.x - 0.6).abs() < 1e-15 && (found.x_axis.y + 3.0 / 20.0).abs() < 1e-15);
    }

    #[test]
    fn free_rotation_keeps_angular_momentum_and_energy() {
        let (moments, l) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.3, 20.0, 1.0));
        let energy = |q: DQuat| {
            let own = q.inverse() * l;
            0.5 * own.dot(own / moments)
        };
        let mut orientation = DQuat::IDENTITY;
        let (start, mut farthest) = (energy(orientation), 0.0f64);
        for _ in 0..100_000 {
            orientation = turned(orientation, moments, l, 1e-3);
            farthest = farthest.max((energy(orientation) / start - 1.0).abs());
        }
        // About the middle axis, which tumbles; the angular momentum is no part of what is advanced. Second order of the
        // step: (omega dt)^2 = 1e-4 at most, and it does not grow.
        assert!(farthest < 1e-4, "{farthest:.1e}");
        assert!((orientation * DVec3::Y).dot(DVec3::Y) < 0.999);
        // To and fro.
        let back = turned(turned(orientation, moments, l, 1e-2), moments, l, -1e-2);
        assert!(back.abs_diff_eq(orientation, 1e-14));
    }

    #[test]
    fn motion_survives_as_numbers() {
        let motion = RigidMotion {
            centre: DVec3::new(1.0, 2.0, 3.0),
            velocity: DVec3::new(4.0, 5.0, 6.0),
            angular_momentum: DVec3::new(7.0, 8.0, 9.0),
            orientation: DQuat::from_rotation_x(0.3),
        };
        assert_eq!(RigidMotion::from_array(&motion.to_array()), motion);
    }
}
