//! Right-hand sides of equations 1 and 2. One pass over the neighbour lists computes the acceleration, the density rate
//! and the largest approach speed of each target.

use rayon::prelude::*;

use super::gradients::NeighbourData;
use super::pair_loop::PairLoop;
use super::pair_sums::{
    Artificial, Constants, Inviscid, Laminar, Members, MonaghanGingold, Resistance, Sums, Turbulent,
};
use super::rate::Rate;
use crate::sph::lanes::{Lanes, MAX_LANES, WithLanes};
use crate::sph::neighbours::lists::{CHUNK, Chunk, Cluster, NeighbourLists, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::BoundaryCondition;
use crate::sph::terms::density_diffusion::DensityDiffusion;
use crate::sph::terms::viscosity::Viscosity;
use crate::sph::terms::wall_slip::WallSlip;

/// Number of neighbours in each partial sum over neighbours. Partial sums reduce rounding errors.
const BLOCK: usize = 32;

impl PairLoop {
    /// Computes the rates of the targets, which are consecutive `records` from the index `first_target` on. `data` has
    /// one entry per record; it is empty if the scheme needs no data in addition to the records.
    pub fn rates(
        &self,
        lists: &NeighbourLists,
        records: &[Record],
        data: &[NeighbourData],
        first_target: usize,
        rates: &mut [Rate],
    ) {
        rates.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (rates, chunk))| {
            let begin = first_target + number * CHUNK;
            let targets = &records[begin..begin + rates.len()];
            lists.instructions().dispatch(ChunkRates { pairs: self, chunk, begin, targets, records, data, rates });
        });
    }
}

/// Computation of the rates for one chunk of targets.
struct ChunkRates<'a> {
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    /// Index of the first target in the records.
    begin: usize,
    targets: &'a [Record],
    records: &'a [Record],
    data: &'a [NeighbourData],
    rates: &'a mut [Rate],
}

impl WithLanes for ChunkRates<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        match self.pairs.parameters.viscosity {
            Viscosity::Artificial { .. } => self.run_viscous::<L, Artificial>(),
            Viscosity::MonaghanGingold { .. } => self.run_viscous::<L, MonaghanGingold>(),
            Viscosity::Laminar { turbulence: None, .. } => self.run_viscous::<L, Laminar>(),
            Viscosity::Laminar { .. } => self.run_viscous::<L, Turbulent>(),
        }
    }
}

impl ChunkRates<'_> {
    #[inline(always)]
    fn run_viscous<L: Lanes, R: Resistance>(self) {
        if self.pairs.parameters.diffusion.kind == DensityDiffusion::Antuono {
            self.run_terms::<L, R, true>();
        } else {
            self.run_terms::<L, R, false>();
        }
    }

    #[inline(always)]
    fn run_terms<L: Lanes, R: Resistance, const ANTUONO: bool>(self) {
        let constants = Constants::new(&self.pairs.parameters);
        for (cluster, neighbours) in self.chunk.clusters() {
            let members = cluster.first as usize..(cluster.first + cluster.len) as usize;
            let rates = if cluster.crosses_sides {
                self.cluster_rates::<L, R, ANTUONO, true>(&constants, cluster, neighbours)
            } else {
                self.cluster_rates::<L, R, ANTUONO, false>(&constants, cluster, neighbours)
            };
            self.rates[members].copy_from_slice(&rates[..cluster.len as usize]);
        }
    }

    /// Returns the rates of the members of a cluster. In its neighbour list, the water particles come first.
    #[inline(always)]
    fn cluster_rates<L: Lanes, R: Resistance, const ANTUONO: bool, const PERIODIC: bool>(
        &self,
        constants: &Constants,
        cluster: &Cluster,
        neighbours: &[u32],
    ) -> [Rate; MAX_LANES] {
        let Self { pairs, targets, .. } = self;
        let place = pairs.split_positions(cluster, targets);
        let data = self.data.get(self.begin..).unwrap_or_default();
        let mut a = Members::<L>::new::<R, ANTUONO>(constants, cluster, targets, data);
        if pairs.parameters.boundary == BoundaryCondition::Dynamic {
            a.diffuses = self.diffusion_factors::<L, PERIODIC>(constants, cluster, neighbours);
        }
        let mut sums = Sums::zero();
        // At inviscid walls, only pairs of two water particles are viscous. Otherwise, all pairs are.
        let is_water = |&number: &u32| (number as usize) < pairs.water;
        let viscous = match pairs.parameters.slip {
            WallSlip::Inviscid if self.begin < pairs.water => neighbours.partition_point(is_water),
            WallSlip::Inviscid => 0,
            _ => neighbours.len(),
        };
        let (viscous, inviscid) = neighbours.split_at(viscous);
        self.add_neighbours::<L, R, ANTUONO, PERIODIC>(constants, place, &a, viscous, &mut sums);
        self.add_neighbours::<L, Inviscid, ANTUONO, PERIODIC>(constants, place, &a, inviscid, &mut sums);
        sums.rates(constants, &a)
    }

    /// Adds the contributions of `neighbours` to the sums of the members `a`. Partial sums over blocks of neighbours
    /// have a third of the rounding error of a single sum over all neighbours.
    #[inline(always)]
    fn add_neighbours<L: Lanes, R: Resistance, const ANTUONO: bool, const PERIODIC: bool>(
        &self,
        constants: &Constants,
        place: [L; 4],
        a: &Members<L>,
        neighbours: &[u32],
        sums: &mut Sums<L>,
    ) {
        let Self { pairs, records, .. } = self;
        let Some(&first) = neighbours.first() else { return };
        let mut next = constants.near(pairs.difference::<L, PERIODIC>(place, &records[first as usize]));
        for (block, following) in neighbours.chunks(BLOCK).zip(neighbours[1..].chunks(BLOCK).chain([&[][..]])) {
            let mut block_sums = Sums::zero();
            for (k, &number) in block.iter().enumerate() {
                let current = next;
                let after = *following.get(k).unwrap_or(&first);
                next = constants.near(pairs.difference::<L, PERIODIC>(place, &records[after as usize]));
                let b = &records[number as usize];
                let data_b =
                    if ANTUONO || R::TURBULENT { &self.data[number as usize] } else { &NeighbourData::OF_BOUNDARY };
                block_sums.add::<R, ANTUONO>(constants, a, &current, b, data_b);
            }
            sums.add_sums(&block_sums);
        }
    }

    /// Returns the factor of the density diffusion under DBC for each member: 0 for a boundary particle, 0 for a water
    /// particle with a boundary particle within its kernel support, 1 for other water particles.
    #[inline(always)]
    fn diffusion_factors<L: Lanes, const PERIODIC: bool>(
        &self,
        constants: &Constants,
        cluster: &Cluster,
        neighbours: &[u32],
    ) -> L {
        let Self { pairs, targets, records, .. } = self;
        let place = pairs.split_positions(cluster, targets);
        let is_dynamic_boundary = |record: &Record| record.diffusive_volume == 0.0;
        let mut closest: L = lanes_of(cluster, targets, |a| if is_dynamic_boundary(a) { 1.0 } else { 0.0 });
        for &number in neighbours {
            let b = &records[number as usize];
            if is_dynamic_boundary(b) {
                closest = closest.max(constants.near(pairs.difference::<L, PERIODIC>(place, b)).closeness);
            }
        }
        L::splat(1.0) - L::splat(1.0).where_positive(closest)
    }
}
