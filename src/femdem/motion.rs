//! Motion of nodes and rigid bodies over a time step.

use rayon::prelude::*;

use super::assembly::Nodes;
use super::rigid_body::RIGID;
use super::world::{PIECE, World};

/// Energies and largest speed of a chunk of nodes over a time step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moved {
    /// Kinetic energy at the start of the time step [J].
    pub kinetic: f64,
    /// Work of the constraints [J].
    pub work: f64,
    /// Square of the largest speed at the end of the time step [m2/s2].
    pub fastest: f64,
}

impl World {
    /// Computes accelerations (eq. 8), velocities (eq. 9) and positions (eq. 10).
    pub(super) fn move_nodes(&mut self) -> Moved {
        let Self { nodes, deformation, setup, dt, time, moved, rigid_bodies, .. } = self;
        let forces = &deformation.forces;
        let (dt, gravity) = (*dt, setup.gravity);
        // Velocities are half a time step ahead.
        let given: Vec<_> = setup.constraints.iter().map(|constraint| constraint.at(*time + 0.5 * dt)).collect();
        let Nodes { place, velocity, mass, constraint, ties } = nodes;
        moved.resize(place.len().div_ceil(PIECE), Moved::default());
        let chunks = place.par_chunks_mut(PIECE).zip(velocity.par_chunks_mut(PIECE)).zip(moved.par_iter_mut());
        chunks.enumerate().for_each(|(chunk, ((positions, velocities), moved))| {
            *moved = Moved::default();
            for (k, (x, v)) in positions.iter_mut().zip(velocities).enumerate() {
                let node = chunk * PIECE + k;
                if constraint[node] == RIGID {
                    continue;
                }
                let mut force = gravity * mass[node];
                for copy in ties.of(node) {
                    force += forces[*copy as usize / 4][*copy as usize % 4];
                }
                let before = *v;
                *v += force * (dt / mass[node]);
                if let Some(number) = usize::from(constraint[node]).checked_sub(1) {
                    for (axis, given) in given[number].into_iter().enumerate() {
                        let Some(given) = given else { continue };
                        let reaction = mass[node] * (given - before[axis]) / dt - force[axis];
                        v[axis] = given;
                        moved.work += reaction * 0.5 * (before[axis] + given) * dt;
                    }
                }
                moved.kinetic += 0.5 * mass[node] * before.dot(*v);
                moved.fastest = moved.fastest.max(v.length_squared());
                *x += *v * dt;
            }
        });
        let mut sum = moved.iter().fold(Moved::default(), |sum, chunk| Moved {
            kinetic: sum.kinetic + chunk.kinetic,
            work: sum.work + chunk.work,
            fastest: sum.fastest.max(chunk.fastest),
        });
        for body in rigid_bodies {
            let [kinetic, work] = body.advance(nodes, forces, gravity, dt, &given);
            sum.kinetic += kinetic;
            sum.work += work;
            sum.fastest = sum.fastest.max(body.fastest_squared(nodes));
        }
        sum
    }
}
