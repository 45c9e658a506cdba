//! Clusters of adjacent particles (one particle per SIMD lane), and the neighbour list of each cluster.
//!
//! The list of a cluster contains all particles near its bounding box. In the lane of a member that is too far from a
//! listed particle, the kernel is zero. The lists are built once per time step and serve both evaluations of the rates.
//! Therefore a list reaches as far as the kernel support plus the distance by which two particles can approach each
//! other in half a time step.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::grid::{Bins, Grid};
use crate::sph::lanes::{InstructionSet, Lanes, MAX_LANES, WithLanes};

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
const MIN_CHUNK: usize = 4096;

/// Number of targets (particles that need neighbours) in a chunk, which is one task of the thread pool. A cluster lies
/// within one chunk.
pub const CHUNK: usize = 512;

/// Largest number of bins that a cluster spans, divided by the number of lanes. The limit keeps the bounding box of a
/// cluster small where the bins contain few particles. A bin that is full of water contains four particles.
const CLUSTER_BINS_PER_LANE: f32 = 0.5;

/// A cluster: consecutive targets, at most as many as there are lanes, that share one neighbour list.
#[derive(Debug, Clone, Copy)]
pub struct Cluster {
    /// Index of the first target in the chunk.
    pub first: u32,
    /// Number of targets, at least 1.
    pub len: u32,
    /// True if the flume is periodic and neighbours can lie beyond its sides.
    pub crosses_sides: bool,
    /// End of the cluster's neighbours in the list of the chunk; they start where the neighbours of the previous
    /// cluster end.
    pub list_end: u32,
}

/// Clusters and neighbour lists of [`CHUNK`] consecutive targets.
#[derive(Debug, Default)]
pub struct Chunk {
    clusters: Vec<Cluster>,
    list: List,
}

/// Neighbours of consecutive clusters. The entries behind the first `len` are free memory, which keeps its values, so
/// that the memory is not cleared in every time step.
#[derive(Debug, Default)]
struct List {
    entries: Vec<u32>,
    len: usize,
}

impl Chunk {
    /// Returns each cluster with its neighbours.
    pub fn clusters(&self) -> impl Iterator<Item = (&Cluster, &[u32])> {
        let mut begin = 0;
        self.clusters.iter().map(move |cluster| {
            let neighbours = &self.list.entries[begin..cluster.list_end as usize];
            begin = cluster.list_end as usize;
            (cluster, neighbours)
        })
    }
}

/// Evaluates `f` for the members of a cluster, one member per lane. Unused lanes repeat the value of the last member.
#[inline(always)]
pub(in crate::sph) fn lanes_of<L: Lanes, T>(cluster: &Cluster, targets: &[T], f: impl Fn(&T) -> f32) -> L {
    let members = &targets[cluster.first as usize..][..cluster.len as usize];
    let mut values = [0.0; MAX_LANES];
    values.iter_mut().zip(members).for_each(|(value, member)| *value = f(member));
    let last = values[members.len() - 1];
    values[members.len()..].fill(last);
    L::load(&values)
}

/// Sorted particles among which the neighbours of the targets are searched.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// Bins of the particles.
    pub bins: &'a Bins,
    /// Positions of the particles, in the order of the bins.
    pub positions: &'a SortedPositions,
    /// Index of the first of these particles in the records.
    pub first_record: u32,
}

/// Positions in the order of the bins, relative to the low corner of the grid, one array per axis [m].
#[derive(Debug, Default)]
pub struct SortedPositions {
    axes: [Vec<f32>; 3],
}

impl SortedPositions {
    /// Copies the positions `points` [m]. The arrays have extra entries at their end, so that a whole SIMD register can
    /// be read from any index.
    pub fn set(&mut self, grid: &Grid, points: &[DVec3]) {
        for (axis, values) in self.axes.iter_mut().enumerate() {
            values.resize(points.len() + MAX_LANES, 0.0);
            let pairs = values.par_iter_mut().zip(points).with_min_len(MIN_CHUNK);
            pairs.for_each(|(value, point)| *value = (point[axis] - grid.low[axis]) as f32);
        }
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.axes.iter().map(|axis| axis.capacity() * size_of::<f32>()).sum()
    }

    #[inline(always)]
    fn load<L: Lanes>(&self, axis: usize, first: usize) -> L {
        L::load(&self.axes[axis][first..])
    }
}

/// Neighbour lists of sorted targets.
#[derive(Debug, Default)]
pub struct NeighbourLists {
    chunks: Vec<Chunk>,
    instructions: InstructionSet,
}

impl NeighbourLists {
    /// Creates empty lists. Their clusters will have at most as many targets as the instruction set has lanes.
    pub fn new(instructions: InstructionSet) -> Self {
        Self { chunks: Vec::new(), instructions }
    }

    /// Returns the instruction set for which the clusters are built.
    pub fn instructions(&self) -> InstructionSet {
        self.instructions
    }

    /// Returns the chunks in the order of the targets.
    pub fn chunks(&self) -> &[Chunk] {
        &self.chunks
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.chunks.iter().map(|c| c.list.entries.capacity() * 4 + c.clusters.capacity() * size_of::<Cluster>()).sum()
    }

    /// Returns the mean number of pairs that are computed per target, including pairs in unused lanes and pairs outside
    /// the kernel support.
    pub fn lanes_per_target(&self) -> f64 {
        let clusters = || self.chunks.iter().flat_map(Chunk::clusters);
        let listed: usize = clusters().map(|(_, list)| list.len()).sum();
        let targets: u32 = clusters().map(|(cluster, _)| cluster.len).sum();
        (listed * self.instructions.lanes()) as f64 / f64::from(targets.max(1))
    }

    /// Divides the targets into clusters, and lists for each cluster the sources within `reach` [m] of its bounding
    /// box.
    ///
    /// `targets` are the positions of the targets [m], in the order of `bins`.
    pub fn build(&mut self, grid: &Grid, bins: &Bins, targets: &[DVec3], sources: &[Sources], reach: f64) {
        self.chunks.resize_with(targets.len().div_ceil(CHUNK), Chunk::default);
        let instructions = self.instructions;
        self.chunks.par_iter_mut().enumerate().for_each(|(number, chunk)| {
            let begin = number * CHUNK;
            let members = begin..(begin + CHUNK).min(targets.len());
            instructions.dispatch(Build { chunk, grid, bins, targets, members, sources, reach });
        });
    }

    /// Removes neighbours from the lists. `keeps` gets the index range of the targets of a cluster, and returns a
    /// function that is true for the record index of each neighbour to keep.
    pub fn retain<K: Fn(u32) -> bool>(&mut self, keeps: impl Fn(Range<usize>) -> K + Sync) {
        self.chunks.par_iter_mut().enumerate().for_each(|(number, Chunk { clusters, list })| {
            let (mut begin, mut kept) = (0, 0);
            for cluster in clusters {
                let first = number * CHUNK + cluster.first as usize;
                let keeps = keeps(first..first + cluster.len as usize);
                for entry in begin..cluster.list_end as usize {
                    if keeps(list.entries[entry]) {
                        list.entries[kept] = list.entries[entry];
                        kept += 1;
                    }
                }
                begin = cluster.list_end as usize;
                cluster.list_end = kept as u32;
            }
            list.len = kept;
        });
    }
}

/// Construction of the clusters and neighbour lists of one chunk.
struct Build<'a> {
    chunk: &'a mut Chunk,
    grid: &'a Grid,
    bins: &'a Bins,
    targets: &'a [DVec3],
    members: Range<usize>,
    sources: &'a [Sources<'a>],
    reach: f64,
}

impl WithLanes for Build<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { chunk, grid, bins, targets, members, sources, reach } = self;
        chunk.clusters.clear();
        chunk.list.len = 0;
        let mut first = members.start;
        while first < members.end {
            let end = cluster_end(grid, &bins.bin_at[..members.end], first, L::COUNT);
            let cluster_box = BoundingBox::around(grid, &targets[first..end]);
            for source in sources {
                cluster_box.list_near::<L>(grid, source, reach, &mut chunk.list);
            }
            chunk.clusters.push(Cluster {
                first: (first - members.start) as u32,
                len: (end - first) as u32,
                crosses_sides: cluster_box.crosses_sides(grid, reach),
                list_end: chunk.list.len as u32,
            });
            first = end;
        }
    }
}

/// Returns the end index of the cluster that starts at `first`. A cluster has at most `lanes` targets, in one row of
/// bins and within a limited number of bins.
fn cluster_end(grid: &Grid, bin_at: &[u32], first: usize, lanes: usize) -> usize {
    let nx = grid.count[0] as u32;
    let row = bin_at[first] / nx;
    let max_bins = (CLUSTER_BINS_PER_LANE * lanes as f32) as u32;
    let fits = |bin: u32| bin / nx == row && bin - bin_at[first] < max_bins;
    let limit = (first + lanes).min(bin_at.len());
    (first + 1..limit).find(|&i| !fits(bin_at[i])).unwrap_or(limit)
}

/// Bounding box of a cluster, relative to the low corner of the grid [m]; in f64, for precision in a long flume.
struct BoundingBox {
    low: DVec3,
    high: DVec3,
}

impl BoundingBox {
    fn around(grid: &Grid, points: &[DVec3]) -> Self {
        let low = points.iter().copied().reduce(DVec3::min).expect("a cluster has a particle");
        let high = points.iter().copied().reduce(DVec3::max).expect("a cluster has a particle");
        Self { low: low - grid.low, high: high - grid.low }
    }

    /// Appends to `list` the record indices of the particles of `source` within `reach` [m] of the box.
    #[inline(always)]
    fn list_near<L: Lanes>(&self, grid: &Grid, source: &Sources, reach: f64, list: &mut List) {
        let [nx, ny, nz] = grid.count;
        let near = Near::<L>::new(self, reach, grid.periodic_width);
        for iz in self.bins(grid, 2, reach) {
            let gap_z = self.gap(grid, 2, iz, iz == 0, iz + 1 == nz);
            for iy in grid.rows_across(self.low.y - reach + grid.low.y, self.high.y + reach + grid.low.y) {
                let is_open_edge = |at_edge: bool| at_edge && grid.periodic_width.is_none();
                let gap_y = self.gap(grid, 1, iy, is_open_edge(iy == 0), is_open_edge(iy + 1 == ny));
                let rest = reach * reach - gap_z * gap_z - gap_y * gap_y;
                if rest < 0.0 {
                    continue;
                }
                let row = (iz * ny + iy % ny) * nx;
                let x_bins = self.bins(grid, 0, rest.sqrt());
                let begin = source.bins.start[row + x_bins.start()] as usize;
                let end = source.bins.start[row + x_bins.end() + 1] as usize;
                near.append(source.positions, begin..end, source.first_record, list);
            }
        }
    }

    /// Returns true if a side of a periodic flume is within `reach` [m] of the box.
    fn crosses_sides(&self, grid: &Grid, reach: f64) -> bool {
        grid.periodic_width.is_some_and(|width| self.low.y < reach || self.high.y > width - reach)
    }

    /// Returns the range of bins along an axis within `reach` [m] of the box.
    fn bins(&self, grid: &Grid, axis: usize, reach: f64) -> std::ops::RangeInclusive<usize> {
        let from = grid.along(axis, self.low[axis] - reach + grid.low[axis]);
        from..=grid.along(axis, self.high[axis] + reach + grid.low[axis])
    }

    /// Returns the distance along an axis between the box and a bin [m]. If the bin is at an open end of the grid
    /// (`first` or `last` is true), it extends to infinity, because it also contains particles outside the grid.
    fn gap(&self, grid: &Grid, axis: usize, bin: usize, first: bool, last: bool) -> f64 {
        let size = grid.size[axis];
        let (mut low, mut high) = (bin as f64 * size, (bin + 1) as f64 * size);
        if let (1, Some(width)) = (axis, grid.periodic_width) {
            let shift = width * ((0.5 * (self.low.y + self.high.y - low - high)) / width).round();
            low += shift;
            high += shift;
        }
        let below = if last { f64::NEG_INFINITY } else { self.low[axis] - high };
        let above = if first { f64::NEG_INFINITY } else { low - self.high[axis] };
        below.max(above).max(0.0)
    }
}

/// Tests whether points are within reach of a box, in single precision and with one point per lane. `reach2` is the
/// square of the reach, which includes an allowance for rounding errors.
struct Near<L> {
    low: [L; 3],
    high: [L; 3],
    middle_y: L,
    reach2: L,
    /// Width of a periodic flume [m] and its inverse [1/m]; both are 0 if the flume is not periodic.
    width: L,
    per_width: L,
}

impl<L: Lanes> Near<L> {
    #[inline(always)]
    fn new(cluster_box: &BoundingBox, reach: f64, periodic_width: Option<f64>) -> Self {
        let extent = cluster_box.high.abs().max_element();
        let reach = reach + 4.0 * f64::from(f32::EPSILON) * extent;
        let splat = |value: f64| L::splat(value as f32);
        Self {
            low: cluster_box.low.to_array().map(splat),
            high: cluster_box.high.to_array().map(splat),
            middle_y: splat(0.5 * (cluster_box.low.y + cluster_box.high.y)),
            reach2: splat(reach * reach),
            width: splat(periodic_width.unwrap_or(0.0)),
            per_width: splat(periodic_width.map_or(0.0, f64::recip)),
        }
    }

    /// Appends the indices of the points within reach to `list`. To avoid branches, each step writes as many indices as
    /// there are lanes, with the points within reach first. The next step overwrites the remaining indices.
    #[inline(always)]
    fn append(&self, positions: &SortedPositions, members: Range<usize>, offset: u32, list: &mut List) {
        let most = list.len + members.len() + L::COUNT;
        if list.entries.len() < most {
            list.entries.resize(most, 0);
            list.entries.resize(list.entries.capacity(), 0);
        }
        for first in members.clone().step_by(L::COUNT) {
            let x = positions.load::<L>(0, first);
            let mut y = positions.load::<L>(1, first);
            // In a periodic flume, use the periodic image that is nearest to the box.
            y += self.width * ((self.middle_y - y) * self.per_width).round();
            let z = positions.load::<L>(2, first);
            let (dx, dy, dz) = (self.distance_along(0, x), self.distance_along(1, y), self.distance_along(2, z));
            let distance2 = dx.mul_add(dx, dy.mul_add(dy, dz * dz));
            let present = (1_u32 << (members.end - first).min(L::COUNT)) - 1;
            let near = distance2.at_most(self.reach2) & present;
            L::list_set_bits(near, offset + first as u32, &mut list.entries[list.len..]);
            list.len += near.count_ones() as usize;
        }
    }

    /// Returns the distance of points from the box along an axis [m]; zero inside.
    #[inline(always)]
    fn distance_along(&self, axis: usize, value: L) -> L {
        (self.low[axis] - value).max(value - self.high[axis]).max(L::splat(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered(n: u32, size: DVec3) -> Vec<DVec3> {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        (0..n).map(|_| DVec3::new(random(), random(), random()) * size).collect()
    }

    fn assert_every_pair_is_listed(instructions: InstructionSet, periodic: Option<f64>) {
        let (dp, reach, size) = (0.05, 0.21, DVec3::new(2.0, 0.6, 0.7));
        let grid = Grid::new(DVec3::ZERO, size, dp, periodic);
        let points = scattered(3000, size);
        let mut bins = Bins::default();
        bins.sort(&grid, &points);
        let sorted: Vec<DVec3> = bins.order.iter().map(|&i| points[i as usize]).collect();
        let mut positions = SortedPositions::default();
        positions.set(&grid, &sorted);
        let mut lists = NeighbourLists::new(instructions);
        let source = Sources { bins: &bins, positions: &positions, first_record: 0 };
        lists.build(&grid, &bins, &sorted, &[source], reach);
        let mut clustered = 0;
        for (number, chunk) in lists.chunks().iter().enumerate() {
            for (cluster, list) in chunk.clusters() {
                for lane in 0..cluster.len {
                    let a = sorted[number * CHUNK + (cluster.first + lane) as usize];
                    clustered += 1;
                    for (b, other) in sorted.iter().enumerate() {
                        let mut r = a - *other;
                        if let Some(width) = periodic {
                            r.y -= width * (r.y / width).round();
                        }
                        assert!(r.length() > reach || list.iter().filter(|&&j| j == b as u32).count() == 1);
                    }
                }
            }
        }
        assert_eq!(clustered, 3000);
    }

    #[test]
    fn every_neighbour_is_listed_once() {
        InstructionSet::available().into_iter().for_each(|set| assert_every_pair_is_listed(set, None));
    }

    #[test]
    fn every_neighbour_is_listed_once_across_periodic_sides() {
        InstructionSet::available().into_iter().for_each(|set| assert_every_pair_is_listed(set, Some(0.6)));
    }
}
