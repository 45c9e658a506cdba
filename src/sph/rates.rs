//! Right-hand sides of equations 1 and 2. One pass over the neighbour lists computes the acceleration, the density rate
//! and the largest approach speed of each target.

use rayon::prelude::*;

use super::{
    density_diffusion::DensityDiffusion,
    gradients::Extra,
    lanes::{Lanes, MOST_LANES, WithLanes},
    neighbours::{CHUNK, Chunk, Cluster, NeighbourLists},
    pair_sums::{Artificial, Constants, Laminar, Members, MonaghanGingold, Resistance, Sums, Turbulent},
    parameters::{BoundaryCondition, Parameters},
    records::Record,
    viscosity::Viscosity,
};

/// Number of neighbours per partial sum; partial sums reduce rounding errors.
const BLOCK: usize = 32;

/// Rates of one target.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    /// Acceleration without gravity [m/s2].
    pub acceleration: [f32; 3],
    /// d rho / dt [kg/(m3 s)].
    pub density: f32,
    /// Largest |mu_ab| of equation 3 over the neighbours [m/s].
    pub approach: f32,
}

/// Loop over pairs: its constants besides the records.
#[derive(Debug, Clone, Copy)]
pub struct PairLoop {
    /// Constants of the scheme.
    pub parameters: Parameters,
    bin_x: f32,
    width: f32,
}

impl PairLoop {
    /// Creates a loop over pairs in bins of length `bin_x` [m].
    pub fn new(parameters: Parameters, bin_x: f64) -> Self {
        let width = parameters.periodic_width.unwrap_or(0.0) as f32;
        Self { parameters, bin_x: bin_x as f32, width }
    }

    /// Returns the same loop with other parameters.
    pub(super) fn with(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Computes the rates of the targets, which are consecutive `records` from `first_target` on. `extra` has one entry
    /// per record, or is empty if the scheme needs no additional data.
    pub fn rates(
        &self,
        lists: &NeighbourLists,
        records: &[Record],
        extra: &[Extra],
        first_target: usize,
        rates: &mut [Rate],
    ) {
        rates.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (rates, chunk))| {
            let begin = first_target + number * CHUNK;
            let targets = &records[begin..begin + rates.len()];
            lists.instructions().dispatch(ChunkRates { pairs: self, chunk, begin, targets, records, extra, rates });
        });
    }

    /// Counts the pairs of a target and a neighbour within the kernel support; the targets are the first `records`.
    pub fn count_within_support(&self, lists: &NeighbourLists, records: &[Record]) -> u64 {
        let count_chunk = |(number, chunk): (usize, &Chunk)| {
            let count_cluster = |(cluster, neighbours): (&Cluster, &[u32])| {
                let first = number * CHUNK + cluster.first as usize;
                let is_near =
                    |a: &Record, j: &u32| self.distance(a, &records[*j as usize]).1 < self.parameters.kernel.support();
                let count_target = |a| neighbours.iter().filter(|j| is_near(a, j)).count() as u64;
                records[first..first + cluster.len as usize].iter().map(count_target).sum::<u64>()
            };
            chunk.clusters().map(count_cluster).sum::<u64>()
        };
        lists.chunks().par_iter().enumerate().map(count_chunk).sum()
    }

    /// Returns the split positions of the members of a cluster, see [`super::records::split_position`].
    #[inline(always)]
    pub(super) fn split_positions<L: Lanes>(&self, cluster: &Cluster, targets: &[Record]) -> [L; 4] {
        let fields: [fn(&Record) -> f32; 4] = [|r| r.bin_x, |r| r.x, |r| r.y, |r| r.z];
        fields.map(|f| lanes_of(cluster, targets, f))
    }

    /// Returns r_ab [m] of the members of a cluster and a neighbour, or of its nearest image if `PERIODIC`.
    #[inline(always)]
    pub(super) fn difference<L: Lanes, const PERIODIC: bool>(&self, a: [L; 4], b: &Record) -> [L; 3] {
        let splat = L::splat;
        let x = (a[0] - splat(b.bin_x)).mul_add(splat(self.bin_x), a[1] - splat(b.x));
        let mut y = a[2] - splat(b.y);
        if PERIODIC {
            y = y - splat(self.width) * (y * splat(1.0 / self.width)).round();
        }
        [x, y, a[3] - splat(b.z)]
    }

    /// Returns the vector from b to a and its length [m]; in a periodic flume, from the nearest image.
    pub(super) fn distance(&self, a: &Record, b: &Record) -> ([f64; 3], f64) {
        let difference = |a: f32, b: f32| f64::from(a) - f64::from(b);
        let mut r = [
            difference(a.bin_x, b.bin_x) * f64::from(self.bin_x) + difference(a.x, b.x),
            difference(a.y, b.y),
            difference(a.z, b.z),
        ];
        if let Some(width) = self.parameters.periodic_width {
            r[1] -= width * (r[1] / width).round();
        }
        (r, r.iter().map(|r| r * r).sum::<f64>().sqrt())
    }
}

/// Computation of the rates of one chunk of targets.
struct ChunkRates<'a> {
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    /// Index of the first target in the records.
    begin: usize,
    targets: &'a [Record],
    records: &'a [Record],
    extra: &'a [Extra],
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

    /// Returns the rates of a cluster. Partial sums over blocks have a third of the rounding error of one long sum.
    #[inline(always)]
    fn cluster_rates<L: Lanes, R: Resistance, const ANTUONO: bool, const PERIODIC: bool>(
        &self,
        constants: &Constants,
        cluster: &Cluster,
        neighbours: &[u32],
    ) -> [Rate; MOST_LANES] {
        let Self { pairs, targets, records, .. } = self;
        let place = pairs.split_positions(cluster, targets);
        let extra = self.extra.get(self.begin..).unwrap_or_default();
        let mut a = Members::<L>::new::<R, ANTUONO>(constants, cluster, targets, extra);
        if pairs.parameters.boundary == BoundaryCondition::Dynamic {
            a.diffuses = self.out_of_reach_of_walls::<L, PERIODIC>(constants, cluster, neighbours);
        }
        let Some(&first) = neighbours.first() else { return Sums::zero().rates(constants, &a) };
        let mut sums = Sums::zero();
        let mut next = constants.near(pairs.difference::<L, PERIODIC>(place, &records[first as usize]));
        for (block, following) in neighbours.chunks(BLOCK).zip(neighbours[1..].chunks(BLOCK).chain([&[][..]])) {
            let mut block_sums = Sums::zero();
            for (k, &number) in block.iter().enumerate() {
                let current = next;
                let after = *following.get(k).unwrap_or(&first);
                next = constants.near(pairs.difference::<L, PERIODIC>(place, &records[after as usize]));
                let b = &records[number as usize];
                let extra_b = if ANTUONO || R::TURBULENT { &self.extra[number as usize] } else { &Extra::OF_BOUNDARY };
                block_sums.add::<R, ANTUONO>(constants, &a, &current, b, extra_b);
            }
            sums.add_sums(&block_sums);
        }
        sums.rates(constants, &a)
    }

    /// Returns zero for members that are boundary particles of the dynamic boundary condition or have one within their
    /// support, and one for all other members.
    #[inline(always)]
    fn out_of_reach_of_walls<L: Lanes, const PERIODIC: bool>(
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

/// Returns `f` of the members of a cluster, one per lane; surplus lanes repeat the last member.
#[inline(always)]
pub(super) fn lanes_of<L: Lanes, T>(cluster: &Cluster, targets: &[T], f: impl Fn(&T) -> f32) -> L {
    let members = &targets[cluster.first as usize..][..cluster.len as usize];
    let mut values = [0.0; MOST_LANES];
    values.iter_mut().zip(members).for_each(|(value, member)| *value = f(member));
    let last = values[members.len() - 1];
    values[members.len()..].fill(last);
    L::load(&values)
}
