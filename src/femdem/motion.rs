//! How nodes and rigid bodies move on.

use rayon::prelude::*;

use super::assembly::Nodes;
use super::rigid_body::RIGID;
use super::world::{PIECE, World};

impl World {
    /// Accelerations (eq. 8), velocities (eq. 9) and places (eq. 10); returns the kinetic energy at the start of the step
    /// and the work of the constraints over it [J].
    pub(super) fn move_nodes(&mut self) -> [f64; 2] {
        let Self { nodes, forces, setup, dt, time, moved, rigid_bodies, .. } = self;
        let (dt, gravity) = (*dt, setup.gravity);
        // Velocities stand half a step on.
        let given: Vec<_> = setup.constraints.iter().map(|constraint| constraint.at(*time + 0.5 * dt)).collect();
        let Nodes { place, velocity, mass, constraint, ties } = nodes;
        moved.resize(place.len().div_ceil(PIECE), [0.0; 2]);
        let pieces = place.par_chunks_mut(PIECE).zip(velocity.par_chunks_mut(PIECE)).zip(moved.par_iter_mut());
        pieces.enumerate().for_each(|(piece, ((places, velocities), moved))| {
            *moved = [0.0; 2];
            for (k, (x, v)) in places.iter_mut().zip(velocities).enumerate() {
                let node = piece * PIECE + k;
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
                        moved[1] += reaction * 0.5 * (before[axis] + given) * dt;
                    }
                }
                moved[0] += 0.5 * mass[node] * before.dot(*v);
                *x += *v * dt;
            }
        });
        let mut sum = moved.iter().fold([0.0; 2], |sum, piece| [sum[0] + piece[0], sum[1] + piece[1]]);
        for body in rigid_bodies {
            let [kinetic, work] = body.advance(nodes, forces, gravity, dt, &given);
            sum = [sum[0] + kinetic, sum[1] + work];
        }
        sum
    }
}
