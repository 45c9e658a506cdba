//! Pressure on units in gaps too narrow for water particles.
//!
//! No water particle fits between the bed and the foot of a unit. The pressure of water particles alone would act on
//! the foot only from above, and would press the unit down with several times its weight. In reality, water fills such
//! a gap, and the pressure in the gap acts on the foot from below. Therefore bed, walls and other units act on a unit
//! through the pressure term of equation 1. Their densities come from the nearby water (see
//! [`mdbc`](crate::sph::boundary::mdbc)). They exert no viscous force on a unit, because the contact law provides the
//! friction.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::{pair_loop::PairLoop, pair_sums::add_to, rate::Rate};
use crate::sph::lanes::{InstructionSet, Lanes, WithLanes};
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::neighbours::lists::{CHUNK, Chunk, Cluster, NeighbourLists, Sources, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::terms::momentum::pair_stress;

/// Number that stands for bed, walls and wavemaker where units are numbered from 0.
const WALL: f32 = -1.0;

/// Neighbours of the unit particles among the particles of bed, walls and other units.
#[derive(Debug)]
pub struct Gaps {
    lists: NeighbourLists,
    /// Number of the unit of each unit particle, from 0, in the order of the records.
    unit: Vec<f32>,
    /// Index of the first unit particle in the records.
    first_unit_record: usize,
}

impl Gaps {
    /// Creates gaps without neighbours.
    pub fn new(instructions: InstructionSet) -> Self {
        Self { lists: NeighbourLists::new(instructions), unit: Vec::new(), first_unit_record: 0 }
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.lists.bytes() + self.unit.capacity() * size_of::<f32>()
    }

    /// Lists the particles of `solids` (walls, then units) within `reach` [m] of the unit particles, except those of
    /// the same unit. `bins` and `sorted` are the bins and the sorted positions of the unit particles; `unit` has the
    /// number of the unit of each unit particle, in the order before sorting.
    pub fn build(
        &mut self,
        grid: &Grid,
        bins: &Bins,
        sorted: &[DVec3],
        solids: [Sources; 2],
        unit: &[u32],
        reach: f64,
    ) {
        self.first_unit_record = solids[1].first_record as usize;
        self.unit.clear();
        self.unit.extend(bins.order.iter().map(|&i| unit[i as usize] as f32));
        self.lists.build(grid, bins, sorted, &solids, reach);
        let Self { lists, unit, first_unit_record } = self;
        let (unit, first) = (&unit[..], *first_unit_record);
        lists.retain(|targets| {
            let own = unit[targets.start];
            let is_one_unit = unit[targets].iter().all(|&unit| unit == own);
            move |neighbour| !is_one_unit || unit_of(unit, first, neighbour) != own
        });
    }

    /// Adds the pressure of bed, walls and other units to the accelerations of the unit particles, which have `rates`
    /// in the order of the records.
    pub fn add_pressure(&self, pairs: &PairLoop, records: &[Record], rates: &mut [Rate]) {
        let chunks = rates.par_chunks_mut(CHUNK).zip(self.lists.chunks()).enumerate();
        chunks.for_each(|(number, (rates, chunk))| {
            let members = number * CHUNK..number * CHUNK + rates.len();
            self.lists.instructions().dispatch(ChunkPressure { gaps: self, pairs, chunk, members, records, rates });
        });
    }
}

/// Returns the number of the unit of the particle with the record `index`; [`WALL`] for a particle of bed, walls and
/// wavemaker.
#[inline(always)]
fn unit_of(unit: &[f32], first_unit_record: usize, index: u32) -> f32 {
    (index as usize).checked_sub(first_unit_record).map_or(WALL, |place| unit[place])
}

/// Computation of the gap pressure for one chunk of unit particles.
struct ChunkPressure<'a> {
    gaps: &'a Gaps,
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    /// Index range of the chunk among the unit particles.
    members: Range<usize>,
    records: &'a [Record],
    rates: &'a mut [Rate],
}

impl WithLanes for ChunkPressure<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for (cluster, neighbours) in self.chunk.clusters().filter(|(_, neighbours)| !neighbours.is_empty()) {
            let sum = if cluster.crosses_sides {
                self.accelerations::<L, true>(cluster, neighbours)
            } else {
                self.accelerations::<L, false>(cluster, neighbours)
            };
            let (x, y, z) = (sum[0].to_array(), sum[1].to_array(), sum[2].to_array());
            let rates = &mut self.rates[cluster.first as usize..][..cluster.len as usize];
            for (lane, rate) in rates.iter_mut().enumerate() {
                rate.acceleration[0] += x[lane];
                rate.acceleration[1] += y[lane];
                rate.acceleration[2] += z[lane];
            }
        }
    }
}

impl ChunkPressure<'_> {
    /// Returns the pressure term of equation 1 for each member of a cluster [m/s2].
    #[inline(always)]
    fn accelerations<L: Lanes, const PERIODIC: bool>(&self, cluster: &Cluster, neighbours: &[u32]) -> [L; 3] {
        let Self { gaps, pairs, members, records, .. } = self;
        let first = gaps.first_unit_record;
        let targets = &records[first + members.start..first + members.end];
        let place = pairs.split_positions::<L>(cluster, targets);
        let pressure: L = lanes_of(cluster, targets, |a| a.pressure);
        let unit: L = lanes_of(cluster, &gaps.unit[members.clone()], |&unit| unit);
        let kernel = &pairs.parameters.kernel;
        let nothing = L::splat(0.0);
        let mut sum = [nothing; 3];
        for &number in neighbours {
            let b = &records[number as usize];
            let [x, y, z] = pairs.difference::<L, PERIODIC>(place, b);
            let closeness = kernel.closeness(x.mul_add(x, y.mul_add(y, z * z)).sqrt());
            let is_other = (unit - L::splat(unit_of(&gaps.unit, first, number))).abs();
            let stress = pair_stress(pressure, L::splat(b.pressure), nothing).where_positive(is_other);
            let factor = stress * kernel.gradient_shape(closeness) * L::splat(b.volume);
            add_to(&mut sum, factor, [x, y, z]);
        }
        let density = L::splat(pairs.parameters.tait.rho0 as f32) + lanes_of(cluster, targets, |a| a.excess_density);
        let scale = L::splat(-kernel.gradient_scale()) / density;
        [sum[0] * scale, sum[1] * scale, sum[2] * scale]
    }
}
