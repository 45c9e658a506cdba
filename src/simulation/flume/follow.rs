//! The fine water follows the units.
//!
//! The seaward end of the finest region keeps its distance from the most seaward unit, and the shoreward end its
//! distance from the most shoreward unit. All interfaces on the same side move together. Water over which an interface
//! moves changes from water to buffer or back, as if it had crossed the interface itself. The new part of a buffer is
//! filled with particles up to the water level of the neighbouring region; they take their state from the neighbouring
//! region, as all buffer particles do.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::{
    Simulation, Units,
    regions::buffer::{Buffer, BufferState, Place},
    scheme::tait,
    setup::{SetupError, across},
    water_at_start::basin,
};
use crate::{
    case::{Domain, Region, SHARE_TO_GAUGE},
    rigid::BodyState,
    sph::{device::Device, particles::water::Water},
};

/// Distance by which an end of the finest region moves at once, in particle spacings of this region [-]. It is the
/// largest spacing of a coarser region, so the interfaces stay on the lattices of all regions. It also prevents a unit
/// that rocks from moving an end back and forth.
const HOP: f64 = 4.0;

impl Simulation {
    /// Moves the ends of the finest region with the units. All regions must be evaluated; they are evaluated again if
    /// they have moved.
    ///
    /// # Errors
    /// If the regions cannot be set up.
    pub(super) fn follow_units(&mut self) -> Result<(), SetupError> {
        let moved = self.units.as_ref().map_or(self.moved, |units| self.moved_with(units));
        if moved == self.moved { Ok(()) } else { self.move_regions(moved) }
    }

    /// Returns how far from their places at the start the ends of the finest region should be [m].
    fn moved_with(&self, units: &Units) -> [f64; 2] {
        let domain = &self.case.domain;
        let gauge = self.case.wavemaker.absorption_gauge().unwrap_or(0.0);
        let (hop, room) = (HOP * domain.dp, Region::room(&domain.regions, domain.dp, gauge / SHARE_TO_GAUGE));
        [(0, -1.0), (1, 1.0)].map(|(end, outwards)| {
            let outermost = |states: &[BodyState]| {
                states.iter().map(|state| outwards * state.position.x).fold(f64::NEG_INFINITY, f64::max)
            };
            let travel = outermost(units.states()) - outermost(&units.start);
            if !domain.regions[0].continues[end] || (travel - outwards * self.moved[end]).abs() < hop {
                return self.moved[end];
            }
            // Parts and obstacles are in the finest region at the start, and stay in it.
            let least = if self.case.has_parts_in_water() { 0.0 } else { f64::NEG_INFINITY };
            let hops = (travel / hop).round().min((room[end] / hop).floor().max(0.0)).max(least);
            outwards * hops * hop
        })
    }

    /// Moves the ends of the finest region to the distances `moved` [m] from their places at the start, by less than
    /// the width of a buffer. All regions must be evaluated; they are evaluated again.
    ///
    /// # Errors
    /// If the regions cannot be set up.
    pub fn move_regions(&mut self, moved: [f64; 2]) -> Result<(), SetupError> {
        let mut new = Self::in_regions(&Device::Cpu, self.case.clone(), self.flume.clone(), self.start, moved, false)?;
        let old: Vec<&Self> = self.regions().collect();
        new.for_each_region(|number, region| {
            let now = old[number];
            region.water = now.water.clone();
            region.next_id = now.next_id;
            for (buffer, before) in region.buffers.iter_mut().zip(&now.buffers) {
                buffer.take_state(before, &now.water);
            }
            region.let_out();
            for (number, before) in now.buffers.iter().enumerate() {
                region.fill_strip(number, before.edge, old[before.neighbour]);
            }
        });
        let coarse = std::mem::take(&mut new.coarse);
        let mut new = std::iter::once(new).chain(coarse);
        self.for_each_region(|number, region| {
            let Some(new) = new.next() else { return };
            region.solver = new.solver;
            region.water = new.water;
            region.boundary = new.boundary;
            region.standing = new.standing;
            region.buffers = new.buffers;
            region.next_id = new.next_id;
            region.outline = new.outline;
            region.bins_near_surfaces = new.bins_near_surfaces;
            region.bounds = new.bounds;
            if number > 0 {
                region.case = new.case;
            }
            region.place_boundary();
        });
        self.moved = moved;
        self.evaluate_regions();
        Ok(())
    }

    /// Fills the buffer with the given number from its outer edge to the place `before` [m] of this edge before it
    /// moved outwards, up to the level of the water of the region `neighbour`.
    fn fill_strip(&mut self, number: usize, before: f64, neighbour: &Self) {
        let Buffer { edge, outwards, .. } = self.buffers[number];
        if outwards * (edge - before) > 0.0 {
            let advance = self.advance_at(before, outwards);
            let (case, sampler) = (&self.case, neighbour.sampler());
            let (profile, level) = (&case.flume.profile, |x: f64, y: f64| case.flume.level(x, y));
            let surface = |x: f64| {
                let place = DVec2::new(x, 0.5 * case.domain.width);
                sampler.surface(place, profile.z(x)).unwrap_or(f64::NEG_INFINITY).max(profile.z(x))
            };
            let at_rest = |_: f64, _: f64| DVec2::ZERO;
            let mut strip = basin(case, &across(case), &level, &surface, &at_rest);
            strip.x = [edge.min(before), edge.max(before)];
            let mut water = strip.fill(&tait(case));
            for position in &mut water.position {
                // Continue the rows of particles that end at the old edge.
                position.x -= outwards * advance.get(&self.row_of(*position)).copied().unwrap_or(0.0);
            }
            let count = water.len() as u32;
            water.id = (self.next_id..self.next_id + count).collect();
            self.next_id += count;
            self.water.append(water);
        }
        if edge != before {
            let advance = self.advance_at(edge, outwards);
            let Buffer { places, state, .. } = &mut self.buffers[number];
            let bed = self.case.flume.profile.z(edge);
            let of_place = |place: &Place| {
                let row = row(&self.case.domain, place.at.x, place.at.y - bed);
                advance.get(&row).copied().unwrap_or(0.0)
            };
            state.advance = places.iter().map(of_place).collect();
        }
    }

    /// Returns the row of particles along the flume to which a position belongs: its numbers across and upwards.
    fn row_of(&self, position: DVec3) -> [i64; 2] {
        row(&self.case.domain, position.y, position.z - self.case.flume.profile.z(position.x))
    }

    /// Returns for each row of particles with an outer end near x = `edge` [m] the distance by which water has moved
    /// away from `edge` since a particle passed it [m]; see [`BufferState::advance`].
    fn advance_at(&self, edge: f64, outwards: f64) -> BTreeMap<[i64; 2], f64> {
        let dp = self.case.domain.dp;
        let mut advance = BTreeMap::new();
        for position in &self.water.position {
            let inside = outwards * (edge - position.x);
            if (0.0..dp).contains(&inside) {
                let least = advance.entry(self.row_of(*position)).or_insert(f64::INFINITY);
                *least = least.min(inside - 0.5 * dp);
            }
        }
        advance
    }
}

/// Returns the row at the distance `y` from the side and at the height `z` above the bed [m].
fn row(domain: &Domain, y: f64, z: f64) -> [i64; 2] {
    [(y / domain.dy).floor() as i64, (z / domain.dp).floor() as i64]
}

impl Buffer {
    /// Takes the state of the same buffer `before` its region moved. Counts the particles of the `water` of the region
    /// that change from water to buffer or back.
    fn take_state(&mut self, before: &Self, water: &Water) {
        let of_water = |(position, mass): (&DVec3, &f64)| match (before.contains(position.x), self.contains(position.x))
        {
            (true, false) => *mass,
            (false, true) => -mass,
            _ => 0.0,
        };
        let received: f64 = water.position.iter().zip(&water.mass).map(of_water).sum();
        self.state = BufferState { received: before.state.received + received, ..before.state.clone() };
    }
}
