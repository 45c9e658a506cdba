//! A group of particles of one kind, sorted into bins, with neighbour lists and rates.

use glam::DVec3;

use crate::sph::lanes::InstructionSet;
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::neighbours::lists::{NeighbourLists, SortedPositions, Sources};
use crate::sph::pairs::rate::Rate;

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
        self.sorted.clear();
        self.sorted.extend(self.bins.order.iter().map(|&i| grid.wrap(positions[i as usize])));
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
