//! Rigid bodies of tetrahedra.
//!
//! Mass and inertia are those of the tetrahedra; the forces act on the nodes. The centre of mass moves by central
//! differences, like a node. For the rotation, the code integrates the angular momentum, not the angular velocity. The
//! rotation in a time step is a sequence of rotations about the principal axes (Dullweber, Leimkuhler and McLachlan
//! 1997, "Symplectic splitting methods for rigid body molecular dynamics", J. Chem. Phys. 107, 5840-5851). This method
//! is symplectic and reversible, and conserves angular momentum exactly.

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

use super::constraint::{RigidVelocity, Row, constraint_impulse};
use super::principal_axes::principal_axes;
use crate::femdem::assembly::{nodes::Nodes, tets::Tets};
use crate::femdem::parallel::chunks::CHUNK;
use crate::femdem::setup::Setup;

/// State of motion of a rigid body. Together with the case, this state is sufficient for a restart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Velocity of the centre of mass [m/s], half a time step before the time of `centre`.
    pub velocity: DVec3,
    /// Angular momentum about the centre of mass [kg m2/s], half a time step before the time of `orientation`.
    pub angular_momentum: DVec3,
    /// Rotation from the principal axes of the body to axes fixed in space.
    pub orientation: DQuat,
}

impl RigidMotion {
    /// Returns centre, velocity, angular momentum and orientation (x, y, z, w) as numbers.
    pub fn to_array(&self) -> [f64; 13] {
        let vectors = [self.centre, self.velocity, self.angular_momentum];
        let rotation = self.orientation.to_array();
        std::array::from_fn(|k| if k < 9 { vectors[k / 3][k % 3] } else { rotation[k - 9] })
    }

    /// Restores the motion from the numbers of [`Self::to_array`].
    pub fn from_array(numbers: &[f64; 13]) -> Self {
        let [centre, velocity, angular_momentum] = [0, 3, 6].map(|k| DVec3::from_slice(&numbers[k..k + 3]));
        let orientation = DQuat::from_slice(&numbers[9..13]);
        Self { centre, velocity, angular_momentum, orientation }
    }
}

/// A rigid body.
#[derive(Debug, Clone)]
pub struct RigidBody {
    /// Number of the body.
    pub body: usize,
    /// State of motion.
    pub motion: RigidMotion,
    /// Kinetic energy at the start of the last time step [J].
    pub kinetic: f64,
    mass: f64,
    /// Principal moments of inertia [kg m2].
    moments: DVec3,
    /// Numbers of its nodes, with their positions relative to the centre of mass in the principal axes [m].
    nodes: Vec<(u32, DVec3)>,
    /// For each node with prescribed velocities: its index in `nodes` and the number of its constraint.
    held: Vec<(u32, u16)>,
}

impl RigidBody {
    /// Creates the rigid bodies of a setup.
    pub fn all(setup: &Setup, nodes: &Nodes, tets: &Tets) -> Vec<Self> {
        let is_rigid = |number: &usize| setup.bodies[*number].rigid;
        (0..setup.bodies.len()).filter(is_rigid).map(|number| Self::new(number, setup, nodes, tets)).collect()
    }

    /// Returns the square of the largest speed of the nodes of the body [m2/s2].
    pub fn fastest_squared(&self, nodes: &Nodes) -> f64 {
        self.nodes.iter().map(|(node, _)| nodes.velocity[*node as usize].length_squared()).fold(0.0, f64::max)
    }

    fn new(body: usize, setup: &Setup, nodes: &Nodes, tets: &Tets) -> Self {
        let def = &setup.bodies[body];
        let corners = |t: usize| setup.tets[t].map(|node| setup.nodes[node as usize]);
        let mass_of = |t: usize| def.elastic.density * tets.shape[t].volume;
        let mass: f64 = def.tets.clone().map(mass_of).sum();
        let centroid = |t: usize| corners(t).iter().sum::<DVec3>() * 0.25;
        let centre = def.tets.clone().map(|t| centroid(t) * mass_of(t)).sum::<DVec3>() / mass;
        let inertia =
            def.tets.clone().map(|t| inertia(&corners(t), mass_of(t), centre)).fold(DMat3::ZERO, |a, b| a + b);
        let (moments, axes) = principal_axes(inertia);
        let orientation = DQuat::from_mat3(&axes);
        let motion = RigidMotion {
            centre,
            velocity: def.velocity + def.angular_velocity.cross(centre - def.pivot),
            angular_momentum: inertia * def.angular_velocity,
            orientation,
        };
        let mesh_node = |node: u32| {
            let copy = nodes.copies_of(node as usize)[0] as usize;
            setup.tets[copy / 4][copy % 4]
        };
        let mut own: Vec<u32> = tets.nodes[def.tets.clone()].iter().flatten().copied().collect();
        own.sort_unstable();
        own.dedup();
        let mut held = Vec::new();
        for (number, constraint) in setup.constraints.iter().enumerate() {
            let constrained: std::collections::BTreeSet<u32> = constraint.nodes.iter().copied().collect();
            held.extend(
                own.iter()
                    .enumerate()
                    .filter(|(_, node)| constrained.contains(&mesh_node(**node)))
                    .map(|(index, _)| (index as u32, number as u16)),
            );
        }
        let arm = |node: &u32| (*node, orientation.inverse() * (setup.nodes[mesh_node(*node) as usize] - centre));
        Self { body, motion, kinetic: 0.0, mass, moments, nodes: own.iter().map(arm).collect(), held }
    }

    /// Advances the body and its nodes by one time step. `forces` act on the vertices of the tetrahedra [N];
    /// `prescribed` are the velocities of the constraints [m/s]. Returns the kinetic energy at the start and the work
    /// of the constraints [J].
    pub fn advance(
        &mut self,
        nodes: &mut Nodes,
        forces: &[[DVec3; 4]],
        gravity: DVec3,
        dt: f64,
        prescribed: &[[Option<f64>; 3]],
    ) -> [f64; 2] {
        let [force, torque] = self.resultant(nodes, forces);
        let RigidMotion { centre, orientation, .. } = self.motion;
        let axes = DMat3::from_quat(orientation);
        let inverse_inertia = axes * DMat3::from_diagonal(self.moments.recip()) * axes.transpose();
        let velocity_of = |motion: &RigidMotion| RigidVelocity {
            velocity: motion.velocity,
            angular_velocity: inverse_inertia * motion.angular_momentum,
        };
        let before = velocity_of(&self.motion);
        let mut motion = self.motion;
        motion.velocity += (force / self.mass + gravity) * dt;
        motion.angular_momentum += torque * dt;
        let mut work = 0.0;
        if !self.held.is_empty() {
            let rows = self.held.iter().flat_map(|(index, number)| {
                let arm = orientation * self.nodes[*index as usize].1;
                let components = prescribed[usize::from(*number)].into_iter().enumerate();
                components.filter_map(move |(axis, speed)| Some(Row { axis: DVec3::AXES[axis], arm, velocity: speed? }))
            });
            let impulse = constraint_impulse(self.mass, inverse_inertia, velocity_of(&motion), rows);
            motion.velocity += impulse.force / self.mass;
            motion.angular_momentum += impulse.torque;
            let after = velocity_of(&motion);
            work = 0.5
                * (impulse.force.dot(before.velocity + after.velocity)
                    + impulse.torque.dot(before.angular_velocity + after.angular_velocity));
        }
        // The kinetic energy at the start of the time step follows from the velocities half a time step before and
        // after this start, as for the nodes of deformable bodies.
        self.kinetic = 0.5 * self.mass * before.velocity.dot(motion.velocity)
            + 0.5 * before.angular_velocity.dot(motion.angular_momentum);
        motion.centre = centre + motion.velocity * dt;
        motion.orientation = rotate_freely(orientation, self.moments, motion.angular_momentum, dt);
        self.motion = motion;
        self.move_nodes(nodes, dt);
        [self.kinetic, work]
    }

    /// Moves the nodes with the body over a time step [s].
    fn move_nodes(&self, nodes: &mut Nodes, dt: f64) {
        let rotation = DMat3::from_quat(self.motion.orientation);
        for (node, arm) in &self.nodes {
            let position = self.motion.centre + rotation * *arm;
            let node = *node as usize;
            nodes.velocity[node] = (position - nodes.position[node]) / dt;
            nodes.position[node] = position;
        }
    }

    /// Returns the force [N] and the torque about the centre of mass [N m]. A sum is formed within each chunk of nodes
    /// and then over the chunks, so the order of addition does not depend on the number of threads.
    fn resultant(&self, nodes: &Nodes, forces: &[[DVec3; 4]]) -> [DVec3; 2] {
        let sum_chunk = |chunk: &[(u32, DVec3)]| {
            let mut sum = [DVec3::ZERO; 2];
            for (node, arm) in chunk {
                let copies = nodes.copies_of(*node as usize).iter();
                let force: DVec3 = copies.map(|copy| forces[*copy as usize / 4][*copy as usize % 4]).sum();
                if force != DVec3::ZERO {
                    sum = [sum[0] + force, sum[1] + (self.motion.orientation * *arm).cross(force)];
                }
            }
            sum
        };
        let chunks: Vec<[DVec3; 2]> = self.nodes.par_chunks(CHUNK).map(sum_chunk).collect();
        chunks.iter().fold([DVec3::ZERO; 2], |sum, chunk| [sum[0] + chunk[0], sum[1] + chunk[1]])
    }
}

/// Returns the inertia tensor of a tetrahedron of uniform density about a point [kg m2].
fn inertia(corners: &[DVec3; 4], mass: f64, about: DVec3) -> DMat3 {
    let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
    let arms = corners.map(|corner| corner - about);
    // The integral of rho x x^T over a tetrahedron with the density rho, the mass m and the corners x_i is
    // m/20 (sum x_i x_i^T + (sum x_i)(sum x_i)^T).
    let second = arms.iter().fold(outer(arms.iter().sum()), |sum, arm| sum + outer(*arm)) * (mass / 20.0);
    DMat3::IDENTITY * (second.x_axis.x + second.y_axis.y + second.z_axis.z) - second
}

/// Returns the orientation after a free rotation of duration `dt` [s].
fn rotate_freely(orientation: DQuat, moments: DVec3, angular_momentum: DVec3, dt: f64) -> DQuat {
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
    fn the_inertia_of_a_tetrahedron_has_its_textbook_value() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        // The tetrahedron is the corner of a cube with edges of 1 m. About this corner, its moment of inertia I_xx is
        // m (1 + 1) / 10, and its product of inertia I_xy is -m / 20.
        let found = inertia(&corners, 3.0, DVec3::ZERO);
        assert!((found.x_axis.x - 0.6).abs() < 1e-15 && (found.x_axis.y + 3.0 / 20.0).abs() < 1e-15);
    }

    #[test]
    fn free_rotation_conserves_energy_and_is_reversible() {
        let (moments, l) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.3, 20.0, 1.0));
        let energy = |q: DQuat| {
            let own = q.inverse() * l;
            0.5 * own.dot(own / moments)
        };
        let mut orientation = DQuat::IDENTITY;
        let (start, mut farthest) = (energy(orientation), 0.0f64);
        for _ in 0..100_000 {
            orientation = rotate_freely(orientation, moments, l, 1e-3);
            farthest = farthest.max((energy(orientation) / start - 1.0).abs());
        }
        // The body rotates about its intermediate axis and therefore tumbles. The angular momentum is constant by
        // construction. The energy error is of second order, (omega dt)^2 = 1e-4 at most, and does not grow.
        assert!(farthest < 1e-4, "{farthest:.1e}");
        assert!((orientation * DVec3::Y).dot(DVec3::Y) < 0.999);
        // A rotation forwards and then backwards in time gives the initial orientation.
        let back = rotate_freely(rotate_freely(orientation, moments, l, 1e-2), moments, l, -1e-2);
        assert!(back.abs_diff_eq(orientation, 1e-14));
    }

    #[test]
    fn motion_is_restored_exactly_from_its_numbers() {
        let motion = RigidMotion {
            centre: DVec3::new(1.0, 2.0, 3.0),
            velocity: DVec3::new(4.0, 5.0, 6.0),
            angular_momentum: DVec3::new(7.0, 8.0, 9.0),
            orientation: DQuat::from_rotation_x(0.3),
        };
        assert_eq!(RigidMotion::from_array(&motion.to_array()), motion);
    }
}
