//! Pencil bins and the stable counting sort that puts particles into them.
//!
//! A bin is dp long and 2dp wide and high; bins of one row follow each other in x. Eight consecutive particles of a
//! row are then a compact cluster, which is what the SIMD lanes want.

use glam::DVec3;
use rayon::prelude::*;

/// Points whose bins are found, and looked through, by one task.
const PIECE: usize = 4096;

/// Ranges of bins to sort for each thread: more than one, because bins above the water are empty.
const TASKS_PER_THREAD: usize = 4;

/// Rectangular bins over the domain. Particles outside are counted into the nearest bin.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Low corner [m].
    pub low: DVec3,
    /// Size of a bin [m].
    pub size: DVec3,
    /// 1 / size [1/m].
    per_size: DVec3,
    /// Bins along x, y, z.
    pub count: [usize; 3],
    /// Width of the domain if it is periodic across [m].
    pub periodic_width: Option<f64>,
}

impl Grid {
    /// Bins for the box from `low` to `high` [m]. A periodic domain starts at `low.y` and is `periodic_width` wide.
    pub fn new(low: DVec3, high: DVec3, dp: f64, periodic_width: Option<f64>) -> Self {
        let extent = high - low;
        let bins = |length: f64, size: f64| ((length / size).ceil() as usize).max(1);
        let ny = periodic_width.map_or_else(|| bins(extent.y, 2.0 * dp), |w| ((w / (2.0 * dp)) as usize).max(1));
        let size_y = periodic_width.map_or(2.0 * dp, |w| w / ny as f64);
        let size = DVec3::new(dp, size_y, 2.0 * dp);
        Self {
            low,
            size,
            per_size: size.recip(),
            count: [bins(extent.x, dp), ny, bins(extent.z, 2.0 * dp)],
            periodic_width,
        }
    }

    /// Number of bins.
    pub fn bins(&self) -> usize {
        self.count[0] * self.count[1] * self.count[2]
    }

    /// Bin along one axis, clamped to the grid.
    pub fn along(&self, axis: usize, value: f64) -> usize {
        // The cast takes everything below the grid, and NaN, to bin 0.
        (((value - self.low[axis]) * self.per_size[axis]) as usize).min(self.count[axis] - 1)
    }

    /// The point, or its image inside a periodic domain.
    pub fn wrap(&self, point: DVec3) -> DVec3 {
        let Some(width) = self.periodic_width else { return point };
        DVec3 { y: point.y - width * ((point.y - self.low.y) / width).floor(), ..point }
    }

    /// Number of the bin that holds the point (wrapped, in a periodic domain).
    pub fn bin(&self, point: DVec3) -> u32 {
        let [nx, ny, _] = self.count;
        let row = self.along(2, point.z) * ny + self.along(1, point.y);
        (row * nx + self.along(0, point.x)) as u32
    }
}

/// Points sorted into bins.
#[derive(Debug, Default)]
pub struct Bins {
    /// First place of each bin in `order`, and the number of points at the end.
    pub start: Vec<u32>,
    /// Index of each point, bin after bin; points of one bin keep their order.
    pub order: Vec<u32>,
    /// Bin at each place of `order`.
    pub bin_at: Vec<u32>,
    bin_of: Vec<u32>,
    /// Lowest and highest bin of each piece of the points.
    extents: Vec<[u32; 2]>,
}

impl Bins {
    /// Bytes in use.
    pub fn bytes(&self) -> usize {
        let numbers = [&self.start, &self.order, &self.bin_at, &self.bin_of];
        numbers.map(|v| v.capacity() * size_of::<u32>()).iter().sum::<usize>()
            + self.extents.capacity() * size_of::<[u32; 2]>()
    }

    /// Sort the points stably into the bins of `grid`.
    ///
    /// Every task owns a range of bins and looks through the pieces of the points that have any there: few, since the
    /// points come nearly sorted from the step before. There is one stable order, whatever the number of tasks.
    pub fn sort(&mut self, grid: &Grid, points: &[DVec3]) {
        self.bin_of.resize(points.len(), 0);
        self.order.resize(points.len(), 0);
        self.bin_at.resize(points.len(), 0);
        self.extents.resize(points.len().div_ceil(PIECE), [0; 2]);
        self.start.resize(grid.bins() + 1, 0);
        let pieces = self.bin_of.par_chunks_mut(PIECE).zip(points.par_chunks(PIECE)).zip(&mut self.extents);
        pieces.for_each(|((bins, points), extent)| {
            *extent = [u32::MAX, 0];
            for (bin, &point) in bins.iter_mut().zip(points) {
                *bin = grid.bin(point);
                *extent = [extent[0].min(*bin), extent[1].max(*bin)];
            }
        });
        let pieces = Pieces { bin_of: &self.bin_of, extents: &self.extents };
        let tasks = TASKS_PER_THREAD * rayon::current_num_threads();
        let span = grid.bins().div_ceil(tasks);
        // start[b + 1] holds the number of points in bin b, then where the next of them goes, and in the end where the
        // bin ends.
        let (first, cursors) = self.start.split_first_mut().expect("a grid has a bin");
        *first = 0;
        cursors.par_chunks_mut(span).enumerate().for_each(|(task, counts)| {
            counts.fill(0);
            let first_bin = task * span;
            pieces.each_in(first_bin..first_bin + counts.len(), |_, bin| counts[bin as usize - first_bin] += 1);
        });
        let mut total = 0;
        for cursor in cursors.iter_mut() {
            total += std::mem::replace(cursor, total);
        }
        pieces.place(span, 0, cursors, 0, &mut self.order, &mut self.bin_at);
    }
}

/// Points in pieces, by their bins.
#[derive(Clone, Copy)]
struct Pieces<'a> {
    bin_of: &'a [u32],
    extents: &'a [[u32; 2]],
}

impl Pieces<'_> {
    /// Call `f` with each point in a range of bins and its bin.
    fn each_in(self, bins: std::ops::Range<usize>, mut f: impl FnMut(u32, u32)) {
        for (piece, (members, [lowest, highest])) in self.bin_of.chunks(PIECE).zip(self.extents).enumerate() {
            if bins.start > *highest as usize || bins.end <= *lowest as usize {
                continue;
            }
            for (point, &bin) in members.iter().enumerate() {
                if bins.contains(&(bin as usize)) {
                    f((piece * PIECE + point) as u32, bin);
                }
            }
        }
    }

    /// Write the points of the bins from `first_bin` on, which `cursors` belong to, and their bins to `order` and
    /// `bin_at`, which begin at place `begin`.
    fn place(
        self,
        span: usize,
        first_bin: usize,
        cursors: &mut [u32],
        begin: u32,
        order: &mut [u32],
        bin_at: &mut [u32],
    ) {
        let bins = cursors.len();
        if bins > span {
            let half = bins.div_ceil(span) / 2 * span;
            let middle = cursors[half];
            let (low_cursors, high_cursors) = cursors.split_at_mut(half);
            let (low_order, high_order) = order.split_at_mut((middle - begin) as usize);
            let (low_at, high_at) = bin_at.split_at_mut((middle - begin) as usize);
            rayon::join(
                || self.place(span, first_bin, low_cursors, begin, low_order, low_at),
                || self.place(span, first_bin + half, high_cursors, middle, high_order, high_at),
            );
            return;
        }
        self.each_in(first_bin..first_bin + bins, |point, bin| {
            let cursor = &mut cursors[bin as usize - first_bin];
            let place = (*cursor - begin) as usize;
            order[place] = point;
            bin_at[place] = bin;
            *cursor += 1;
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More than two pieces.
    const COUNT: u32 = 9000;

    #[test]
    fn sorts_stably_and_keeps_everyone() {
        let grid = Grid::new(DVec3::ZERO, DVec3::splat(1.0), 0.1, None);
        let points: Vec<DVec3> =
            (0..COUNT).map(|i| DVec3::splat(f64::from(i * 7919 % 9973) / 9973.0) * DVec3::new(1.0, 0.7, 1.3)).collect();
        let mut bins = Bins::default();
        bins.sort(&grid, &points);
        assert_eq!(*bins.start.last().unwrap(), COUNT);
        for bin in 0..grid.bins() {
            let range = bins.start[bin] as usize..bins.start[bin + 1] as usize;
            let members = &bins.order[range.clone()];
            assert!(members.windows(2).all(|w| w[0] < w[1]));
            assert!(members.iter().all(|&i| grid.bin(points[i as usize]) as usize == bin));
            assert!(bins.bin_at[range].iter().all(|&b| b as usize == bin));
        }
    }
}
