//! Particles enter and leave a buffer at its outer edge, at the end of a time step.
//!
//! The flow of the neighbouring region through each place on the outer edge moves a surface of water; whenever it has
//! moved by one particle spacing into the buffer, a particle enters (Tafuni et al. 2018). A buffer particle beyond the
//! edge leaves.
//!
//! Interpolated velocities do not conserve mass exactly. Each buffer therefore counts the mass that its region receives
//! through the interface. The two regions at an interface should receive equal and opposite masses. A difference is
//! mass on its way through the buffers, and makes the next particles that enter heavier or lighter.

use glam::DVec3;

use super::buffer::{Buffer, Flow};
use crate::simulation::flume::Simulation;

/// Largest change of the mass of an entering particle [-].
const LARGEST_CORRECTION: f64 = 0.02;

impl Simulation {
    /// Lets particles enter and leave the buffers of all regions, after a time step of length `dt` [s].
    pub(in crate::simulation::flume) fn exchange_between_regions(&mut self, dt: f64) {
        if self.coarse.is_empty() {
            return;
        }
        self.for_each_region(|_, region| region.count_crossings());
        let received: Vec<(f64, f64)> = self
            .regions()
            .flat_map(|region| region.buffers.iter().map(|buffer| (buffer.interface, buffer.state.received)))
            .collect();
        self.for_each_region(|_, region| {
            let mut buffers = std::mem::take(&mut region.buffers);
            for buffer in &mut buffers {
                let both = received.iter().filter(|(interface, _)| *interface == buffer.interface);
                let missing = -both.map(|(_, mass)| mass).sum::<f64>();
                region.let_in(buffer, missing, dt);
            }
            region.buffers = buffers;
            region.let_out();
        });
    }

    /// Returns the mass that has left regions and not yet entered their neighbours [kg].
    pub fn mass_between_regions(&self) -> f64 {
        -self.regions().flat_map(|region| &region.buffers).map(|buffer| buffer.state.received).sum::<f64>()
    }

    /// Counts the mass of the particles that have crossed the interfaces since the buffers were set.
    fn count_crossings(&mut self) {
        let Self { buffers, water, solver, .. } = self;
        // A particle moves much less than the kernel radius in a time step.
        let reach = solver.parameters().kernel.support();
        for buffer in buffers {
            for particle in 0..water.len() {
                let x = water.position[particle].x;
                if buffer.outwards * (x - buffer.interface) < -reach {
                    continue;
                }
                let was_in_buffer = buffer.given_to(water.id[particle]).is_some();
                if was_in_buffer && !buffer.contains(x) {
                    buffer.state.received += water.mass[particle];
                } else if !was_in_buffer && buffer.contains(x) {
                    buffer.state.received -= water.mass[particle];
                }
            }
        }
    }

    /// Lets particles enter at the outer edge of a buffer, after a time step of length `dt` [s]. `missing` is the mass
    /// that should still enter the two regions at the interface [kg].
    fn let_in(&mut self, buffer: &mut Buffer, missing: f64, dt: f64) {
        let in_buffer = (0..self.water.len()).filter(|&i| buffer.contains(self.water.position[i].x));
        let mass: f64 = in_buffer.map(|i| self.water.mass[i]).sum();
        let correction = if mass > 0.0 { missing / mass } else { 0.0 };
        let factor = 1.0 + correction.clamp(-LARGEST_CORRECTION, LARGEST_CORRECTION);
        let (dp, dy) = (self.case.domain.dp, self.case.domain.dy);
        for (place, advance) in buffer.places.iter().zip(&mut buffer.state.advance) {
            let Some(Flow { share, velocity, density }) = place.flow else { continue };
            *advance -= buffer.outwards * velocity.x * share * dt;
            if *advance < -0.5 * dp {
                // A particle has left the buffer here.
                *advance += dp;
            } else if *advance >= 0.5 * dp {
                let x = buffer.edge - buffer.outwards * (*advance - 0.5 * dp);
                *advance -= dp;
                let z = place.at.y - 0.5 * (1.0 - share) * dp;
                self.water.position.push(DVec3::new(x, place.at.x, z));
                self.water.velocity.push(velocity);
                self.water.density.push(density);
                self.water.mass.push(factor * density * dp * dp * dy);
                self.water.id.push(self.next_id);
                self.next_id += 1;
            }
        }
    }

    /// Removes the buffer particles beyond the outer edges.
    pub(in crate::simulation::flume) fn let_out(&mut self) {
        let is_inside = |x: f64| self.buffers.iter().all(|buffer| buffer.outwards * (x - buffer.edge) <= 0.0);
        let keep: Vec<bool> = self.water.position.iter().map(|position| is_inside(position.x)).collect();
        if keep.contains(&false) {
            self.water.retain(&keep);
        }
    }
}
