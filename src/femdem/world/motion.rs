//! Motion of nodes and rigid bodies over a time step.

use rayon::prelude::*;

use super::World;
use crate::femdem::assembly::nodes::Nodes;
use crate::femdem::assembly::nodes::RIGID;
use crate::femdem::parallel::chunks::CHUNK;

/// Energies and largest speed of a chunk of nodes over a time step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NodeMotion {
    /// Kinetic energy at the start of the time step [J].
    pub kinetic: f64,
    /// Work of the constraints [J].
    pub work: f64,
    /// Square of the largest new nodal speed [m2/s2].
    pub fastest: f64,
}

impl World {
    /// Computes accelerations (eq. 8), velocities (eq. 9) and positions (eq. 10) of all nodes and rigid bodies.
    pub(super) fn move_nodes(&mut self) -> NodeMotion {
        let Self { nodes, deformation, setup, dt, time, motion, rigid_bodies, .. } = self;
        let forces = &deformation.forces;
        let (dt, gravity) = (*dt, setup.gravity);
        // The new velocities refer to half a time step after `time`.
        let prescribed: Vec<_> = setup.constraints.iter().map(|constraint| constraint.at(*time + 0.5 * dt)).collect();
        let Nodes { position, velocity, mass, constraint, copies } = nodes;
        motion.resize(position.len().div_ceil(CHUNK), NodeMotion::default());
        let chunks = position.par_chunks_mut(CHUNK).zip(velocity.par_chunks_mut(CHUNK)).zip(motion.par_iter_mut());
        chunks.enumerate().for_each(|(chunk, ((positions, velocities), motion))| {
            *motion = NodeMotion::default();
            for (k, (x, v)) in positions.iter_mut().zip(velocities).enumerate() {
                let node = chunk * CHUNK + k;
                if constraint[node] == RIGID {
                    continue;
                }
                let mut force = gravity * mass[node];
                for copy in copies.of(node) {
                    force += forces[*copy as usize / 4][*copy as usize % 4];
                }
                let before = *v;
                *v += force * (dt / mass[node]);
                if let Some(number) = usize::from(constraint[node]).checked_sub(1) {
                    for (axis, prescribed) in prescribed[number].into_iter().enumerate() {
                        let Some(prescribed) = prescribed else { continue };
                        let reaction = mass[node] * (prescribed - before[axis]) / dt - force[axis];
                        v[axis] = prescribed;
                        motion.work += reaction * 0.5 * (before[axis] + prescribed) * dt;
                    }
                }
                motion.kinetic += 0.5 * mass[node] * before.dot(*v);
                motion.fastest = motion.fastest.max(v.length_squared());
                *x += *v * dt;
            }
        });
        let mut sum = motion.iter().fold(NodeMotion::default(), |sum, chunk| NodeMotion {
            kinetic: sum.kinetic + chunk.kinetic,
            work: sum.work + chunk.work,
            fastest: sum.fastest.max(chunk.fastest),
        });
        for body in rigid_bodies {
            let [kinetic, work] = body.advance(nodes, forces, gravity, dt, &prescribed);
            sum.kinetic += kinetic;
            sum.work += work;
            sum.fastest = sum.fastest.max(body.fastest_squared(nodes));
        }
        sum
    }
}
