//! A group of particles of one kind, sorted into bins, with neighbour lists and rates.

use glam::DVec3;
use rayon::prelude::*;

use crate::sph::lanes::InstructionSet;
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::neighbours::lists::{NeighbourLists, SortedPositions, Sources};
use crate::sph::pairs::rate::Rate;

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
const MIN_CHUNK: usize = 4096;

/// One of the three groups of particles: water, walls (with bed and wavemaker) or units.
#[derive(Debug, Default)]
pub(super) struct Group {
    pub(super) bins: Bins,
    pub(super) sorted: Vec<DVec3>,
    pub(super) near: SortedPositions,
    pub(super) lists: NeighbourLists,
    pub(super) rates: Vec<Rate>,
    pub(super) first_record: usize,
}

impl Group {
    /// Creates a group without particles.
    pub(super) fn new(instructions: InstructionSet) -> Self {
        Self { lists: NeighbourLists::new(instructions), ..Self::default() }
    }

    /// Sorts the particles at `positions` [m] into bins.
    pub(super) fn sort(&mut self, grid: &Grid, positions: &[DVec3]) {
        self.bins.sort(grid, positions);
        self.sorted.resize(positions.len(), DVec3::ZERO);
        let sorted = self.sorted.par_iter_mut().zip(&self.bins.order).with_min_len(MIN_CHUNK);
        sorted.for_each(|(sorted, &i)| *sorted = grid.wrap(positions[i as usize]));
        self.near.set(grid, &self.sorted);
        self.rates.resize(positions.len(), Rate::default());
    }

    pub(super) fn bytes(&self) -> usize {
        let of_targets = self.sorted.capacity() * size_of::<DVec3>() + self.rates.capacity() * size_of::<Rate>();
        self.bins.bytes() + of_targets + self.near.bytes() + self.lists.bytes()
    }

    pub(super) fn sources(&self) -> Sources<'_> {
        Sources { bins: &self.bins, positions: &self.near, first_record: self.first_record as u32 }
    }
}
