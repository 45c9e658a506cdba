//! Buffers take their state from the neighbouring region.
//!
//! At the start of each time step of the coarser regions, velocity, density and their rates are interpolated from the
//! particles of the neighbouring region to the buffer particles (see [`Source`]). During this time step, a buffer
//! particle keeps the interpolated rates. Thus the regions do not wait for each other, and the error in the buffer is
//! of second order in the time step, because its state is set again at the next time step.
//!
//! The density of the water does not diffuse between water and buffer (see
//! [`Parameters::own_x`](crate::sph::parameters::Parameters::own_x)). In a trial with diffusion, a difference of the
//! water level of a tenth of the coarse particle spacing remained between two regions: the given pressure of the buffer
//! drew density from the water next to it, until gaps between the particles balanced the difference of pressure.

use glam::DVec3;
use rayon::prelude::*;

use super::buffer::{Buffer, Flow, Place};
use super::source::{Interpolated, Source};
use crate::simulation::flume::Simulation;

/// What the neighbouring region gives to a buffer.
struct Given {
    /// Index of each particle in the buffer, with its new state; `None` where the neighbouring region is dry.
    particles: Vec<(usize, Option<Interpolated>)>,
    /// Flow through each place on the outer edge.
    flows: Vec<Option<Flow>>,
    /// Factor of the mass of each particle in `particles`.
    packing: Vec<f64>,
}

impl Simulation {
    /// Returns the simulations of all regions, the finest first.
    pub fn regions(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.coarse)
    }

    /// Calls `f` for the simulations of all regions, the finest first.
    pub(in crate::simulation::flume) fn for_each_region(&mut self, mut f: impl FnMut(usize, &mut Self)) {
        let mut coarse = std::mem::take(&mut self.coarse);
        f(0, self);
        coarse.iter_mut().enumerate().for_each(|(number, region)| f(1 + number, region));
        self.coarse = coarse;
    }

    /// Returns the range of x between the interfaces of this region [m]; infinite at an end where no region continues.
    pub fn own_x(&self) -> [f64; 2] {
        self.solver.parameters().own_x
    }

    /// Returns true if the water at x [m] belongs to this region, not to one of its buffers.
    pub fn owns(&self, x: f64) -> bool {
        let [from, to] = self.own_x();
        (from..to).contains(&x)
    }

    /// Gives the buffers of all regions the state of the neighbouring regions. All regions must be evaluated.
    pub(in crate::simulation::flume) fn couple(&mut self) {
        if self.coarse.is_empty() {
            return;
        }
        let regions: Vec<&Self> = self.regions().collect();
        let given = |region: &&Self| -> Vec<Given> {
            region.buffers.iter().map(|buffer| read(region, buffer, regions[buffer.neighbour])).collect()
        };
        let mut given: Vec<Vec<Given>> = regions.iter().map(given).collect();
        self.for_each_region(|number, region| {
            let given = std::mem::take(&mut given[number]);
            let mut buffers = std::mem::take(&mut region.buffers);
            for (buffer, given) in buffers.iter_mut().zip(given) {
                region.set_buffer(buffer, given);
            }
            region.buffers = buffers;
            region.drive_buffers();
        });
    }

    /// Sets the state of the particles of a buffer, and notes the rates and flows until the next call.
    fn set_buffer(&mut self, buffer: &mut Buffer, given: Given) {
        buffer.given.clear();
        for ((particle, state), packing) in given.particles.into_iter().zip(given.packing) {
            self.water.mass[particle] *= packing;
            if let Some(state) = state {
                self.water.velocity[particle] = state.velocity;
                self.water.density[particle] = state.density;
            }
            buffer.given.push((self.water.id[particle], state.map(|state| state.rate)));
        }
        buffer.given.sort_unstable_by_key(|(id, _)| *id);
        buffer.places.iter_mut().zip(given.flows).for_each(|(place, flow)| place.flow = flow);
    }

    /// Replaces the last computed rates of the buffer particles by the rates that the neighbouring regions give.
    pub(in crate::simulation::flume) fn drive_buffers(&mut self) {
        let Self { buffers, water, solver, .. } = self;
        if buffers.is_empty() {
            return;
        }
        let rates = solver.host_rates_mut().par_iter_mut().zip(&water.position).zip(&water.id).with_min_len(4096);
        rates.for_each(|((rate, position), id)| {
            let buffer = buffers.iter().find(|buffer| buffer.contains(position.x));
            if let Some(Some(given)) = buffer.and_then(|buffer| buffer.given_to(*id)) {
                *rate = given;
            }
        });
    }
}

/// Returns what the region `neighbour` gives to a buffer of `region`.
fn read(region: &Simulation, buffer: &Buffer, neighbour: &Simulation) -> Given {
    let (water, domain) = (&region.water, &region.case.domain);
    let source = Source::new(region, neighbour, buffer);
    let in_buffer = |particle: &usize| buffer.contains(water.position[*particle].x);
    let members: Vec<usize> = (0..water.len()).filter(in_buffer).collect();
    let corrections = source.packing_corrections(buffer);
    let packing = members.iter().map(|&i| corrections[source.along(water.position[i].x)]).collect();
    let particles = members.into_par_iter().with_min_len(64);
    let flow = |place: &Place| {
        let level = source.level(DVec3::new(buffer.edge, place.at.x, place.at.y))?;
        let share = (level - (place.at.y - 0.5 * domain.dp)) / domain.dp;
        if share <= 0.0 {
            return None;
        }
        let share = share.min(1.0);
        let height = place.at.y - 0.5 * (1.0 - share) * domain.dp;
        let Interpolated { velocity, density, .. } = source.state(DVec3::new(buffer.edge, place.at.x, height))?;
        Some(Flow { share, velocity, density })
    };
    Given {
        particles: particles.map(|i| (i, source.state(water.position[i]))).collect(),
        flows: buffer.places.par_iter().with_min_len(16).map(flow).collect(),
        packing,
    }
}
