//! Right-hand sides of equations 1 and 2: one pass over the neighbour lists gives the acceleration, the rate of the
//! density and the largest approach speed of each target.

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

/// Neighbours that are summed up before their sums are added to those of all.
const BLOCK: usize = 32;

/// Sums of one target.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    /// Acceleration without gravity [m/s2].
    pub acceleration: [f32; 3],
    /// d rho / dt [kg/(m3 s)].
    pub density: f32,
    /// Largest |mu_ab| of equation 3 over the neighbours [m/s].
    pub approach: f32,
}

/// What the pair loop needs besides the records.
#[derive(Debug, Clone, Copy)]
pub struct PairLoop {
    /// Constants of the scheme.
    pub parameters: Parameters,
    bin_x: f32,
    width: f32,
}

impl PairLoop {
    /// Loop over pairs in bins of length `bin_x` [m].
    pub fn new(parameters: Parameters, bin_x: f64) -> Self {
        let width = parameters.periodic_width.unwrap_or(0.0) as f32;
        Self { parameters, bin_x: bin_x as f32, width }
    }

    /// The same loop with other constants.
    pub(super) fn with(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Rates of the targets, which are consecutive `records` from `first_target` on; `extra` is what the scheme needs
    /// besides, a value for each record, or nothing.
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

    /// Number of pairs of a target, the first of the `records`, and a neighbour within the kernel's support.
    pub fn count_within_support(&self, lists: &NeighbourLists, records: &[Record]) -> u64 {
        let count = |(number, chunk): (usize, &Chunk)| {
            let of_cluster = |(cluster, neighbours): (&Cluster, &[u32])| {
                let first = number * CHUNK + cluster.first as usize;
                let near =
                    |a: &Record, j: &u32| self.distance(a, &records[*j as usize]).1 < self.parameters.kernel.support();
                let of_target = |a| neighbours.iter().filter(|j| near(a, j)).count() as u64;
                records[first..first + cluster.len as usize].iter().map(of_target).sum::<u64>()
            };
            chunk.clusters().map(of_cluster).sum::<u64>()
        };
        lists.chunks().par_iter().enumerate().map(count).sum()
    }

    /// Split positions of the members of a cluster, as [`super::records::split_position`] gives them.
    #[inline(always)]
    pub(super) fn split_positions<L: Lanes>(&self, cluster: &Cluster, targets: &[Record]) -> [L; 4] {
        let of: [fn(&Record) -> f32; 4] = [|r| r.bin_x, |r| r.x, |r| r.y, |r| r.z];
        of.map(|f| lanes_of(cluster, targets, f))
    }

    /// r_ab [m] of the members of a cluster and a neighbour; its nearest image, if `PERIODIC`.
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

    /// Vector from b to a, its nearest image in a periodic flume, and its length [m].
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

/// The rates of one chunk of targets.
struct ChunkRates<'a> {
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    /// Number of the first target among the records.
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

    /// Rates of a cluster. Neighbours are summed up in blocks: the sum of sums is three times as exact as one long sum.
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
            let mut of_block = Sums::zero();
            for (k, &number) in block.iter().enumerate() {
                let current = next;
                let after = *following.get(k).unwrap_or(&first);
                next = constants.near(pairs.difference::<L, PERIODIC>(place, &records[after as usize]));
                let b = &records[number as usize];
                let extra_b = if ANTUONO || R::TURBULENT { &self.extra[number as usize] } else { &Extra::OF_BOUNDARY };
                of_block.add::<R, ANTUONO>(constants, &a, &current, b, extra_b);
            }
            sums.add_sums(&of_block);
        }
        sums.rates(constants, &a)
    }

    /// One for members of a cluster that neither are boundary particles of the dynamic boundary condition nor are
    /// reached by one, and zero for others.
    #[inline(always)]
    fn out_of_reach_of_walls<L: Lanes, const PERIODIC: bool>(
        &self,
        constants: &Constants,
        cluster: &Cluster,
        neighbours: &[u32],
    ) -> L {
        let Self { pairs, targets, records, .. } = self;
        let place = pairs.split_positions(cluster, targets);
        let of_boundary = |record: &Record| record.diffusive_volume == 0.0;
        let mut closest: L = lanes_of(cluster, targets, |a| if of_boundary(a) { 1.0 } else { 0.0 });
        for &number in neighbours {
            let b = &records[number as usize];
            if of_boundary(b) {
                closest = closest.max(constants.near(pairs.difference::<L, PERIODIC>(place, b)).closeness);
            }
        }
        L::splat(1.0) - L::splat(1.0).where_positive(closest)
    }
}

/// The members of a cluster, one a lane; missing ones repeat the last.
#[inline(always)]
pub(super) fn lanes_of<L: Lanes, T>(cluster: &Cluster, targets: &[T], f: impl Fn(&T) -> f32) -> L {
    let members = &targets[cluster.first as usize..][..cluster.len as usize];
    let mut values = [0.0; MOST_LANES];
    values.iter_mut().zip(members).for_each(|(value, member)| *value = f(member));
    let last = values[members.len() - 1];
    values[members.len()..].fill(last);
    L::load(&values)
}
