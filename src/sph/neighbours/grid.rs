//! Cell list: rectangular bins, and the stable counting sort of particles into these bins.
//!
//! A bin is dp long in x, and 2 dp wide and high. A bin that is full of water contains four particles. The bins of a
//! row follow each other in x. Therefore eight consecutive particles of a row form a compact cluster for the SIMD
//! lanes.

use std::ops::RangeInclusive;

use glam::DVec3;
use rayon::prelude::*;

/// Number of points in a chunk, which is one task of the thread pool.
const CHUNK: usize = 4096;

/// Number of ranges of bins per thread. More than one range per thread balances the load, because some ranges lie above
/// the water and are empty.
const RANGES_PER_THREAD: usize = 4;

/// Rectangular bins over the particle domain. Particles outside the domain belong to the nearest bin.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Low corner [m].
    pub low: DVec3,
    /// Size of a bin [m].
    pub size: DVec3,
    /// Inverse of each component of `size` [1/m].
    per_size: DVec3,
    /// Number of bins along x, y and z.
    pub count: [usize; 3],
    /// Width of the domain if it is periodic in y [m].
    pub periodic_width: Option<f64>,
}

impl Grid {
    /// Creates bins for the box from `low` to `high` and the particle spacing `dp` [m]. A domain that is periodic in y
    /// starts at `low.y` and is `periodic_width` [m] wide.
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

    /// Returns the number of bins.
    pub fn bins(&self) -> usize {
        self.count[0] * self.count[1] * self.count[2]
    }

    /// Returns the index along one axis of the bin that contains the coordinate `value` [m]. If `value` is outside the
    /// grid, the function returns the nearest bin.
    pub fn along(&self, axis: usize, value: f64) -> usize {
        // The cast gives 0, the first bin, for a value below the grid and for NaN.
        (((value - self.low[axis]) * self.per_size[axis]) as usize).min(self.count[axis] - 1)
    }

    /// Returns the point itself, or, in a periodic domain, its periodic image between the sides of the domain.
    pub fn wrap(&self, point: DVec3) -> DVec3 {
        let Some(width) = self.periodic_width else { return point };
        DVec3 { y: point.y - width * ((point.y - self.low.y) / width).floor(), ..point }
    }

    /// Returns the shortest of the vectors between two points and their periodic images, from the vector between the
    /// points [m].
    pub fn nearest_image(&self, vector: DVec3) -> DVec3 {
        match self.periodic_width {
            Some(width) if 2.0 * vector.y.abs() > width => {
                DVec3 { y: vector.y - width * (vector.y / width).round(), ..vector }
            }
            _ => vector,
        }
    }

    /// Returns the range of bins along y that contain the coordinates from `low` to `high` [m]; each bin occurs at most
    /// once. In a periodic domain, an index can be larger than the number of bins along y; the caller must take the
    /// index modulo this number.
    pub fn rows_across(&self, low: f64, high: f64) -> RangeInclusive<usize> {
        if self.periodic_width.is_none() {
            return self.along(1, low)..=self.along(1, high);
        }
        let ny = self.count[1];
        let bin = |y: f64| ((y - self.low.y) / self.size.y).floor() as i64;
        let first = bin(low);
        let more = ((bin(high) - first) as usize).min(ny - 1);
        let first = first.rem_euclid(ny as i64) as usize;
        first..=first + more
    }

    /// Returns the index of the bin that contains the point. In a periodic domain, call [`Self::wrap`] on the point
    /// first.
    pub fn bin(&self, point: DVec3) -> u32 {
        let [nx, ny, _] = self.count;
        let row = self.along(2, point.z) * ny + self.along(1, point.y);
        (row * nx + self.along(0, point.x)) as u32
    }
}

/// Points sorted into bins.
#[derive(Debug, Default)]
pub struct Bins {
    /// Index in `order` where each bin starts. The last entry is the number of points.
    pub start: Vec<u32>,
    /// Indices of the points, sorted by bin; the points of one bin keep their order.
    pub order: Vec<u32>,
    /// Bin of each entry of `order`.
    pub bin_at: Vec<u32>,
    bin_of: Vec<u32>,
    /// Lowest and highest bin of each chunk of points.
    extents: Vec<[u32; 2]>,
}

impl Bins {
    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        let numbers = [&self.start, &self.order, &self.bin_at, &self.bin_of];
        numbers.map(|v| v.capacity() * size_of::<u32>()).iter().sum::<usize>()
            + self.extents.capacity() * size_of::<[u32; 2]>()
    }

    /// Sorts the points stably into the bins of `grid`.
    ///
    /// Each task fills a range of bins and reads only the chunks of points whose bins overlap this range. Such chunks
    /// are few, because the points are still nearly sorted from the previous time step. The result does not depend on
    /// the number of tasks.
    pub fn sort(&mut self, grid: &Grid, points: &[DVec3]) {
        self.bin_of.resize(points.len(), 0);
        self.order.resize(points.len(), 0);
        self.bin_at.resize(points.len(), 0);
        self.extents.resize(points.len().div_ceil(CHUNK), [0; 2]);
        self.start.resize(grid.bins() + 1, 0);
        let chunks = self.bin_of.par_chunks_mut(CHUNK).zip(points.par_chunks(CHUNK)).zip(&mut self.extents);
        chunks.for_each(|((bins, points), extent)| {
            *extent = [u32::MAX, 0];
            for (bin, &point) in bins.iter_mut().zip(points) {
                *bin = grid.bin(point);
                *extent = [extent[0].min(*bin), extent[1].max(*bin)];
            }
        });
        let chunks = Chunks { bin_of: &self.bin_of, extents: &self.extents };
        let ranges = RANGES_PER_THREAD * rayon::current_num_threads();
        let span = grid.bins().div_ceil(ranges);
        // start[b + 1] changes its meaning: first it is the number of points in bin b, then the index in `order` for
        // the next point of bin b, and finally the end of bin b.
        let (first, cursors) = self.start.split_first_mut().expect("a grid has a bin");
        *first = 0;
        cursors.par_chunks_mut(span).enumerate().for_each(|(range, counts)| {
            counts.fill(0);
            let first_bin = range * span;
            chunks.for_each_in(first_bin..first_bin + counts.len(), |_, bin| counts[bin as usize - first_bin] += 1);
        });
        let mut total = 0;
        for cursor in cursors.iter_mut() {
            total += std::mem::replace(cursor, total);
        }
        chunks.place(span, 0, cursors, 0, &mut self.order, &mut self.bin_at);
    }
}

/// Bin of each point, and the lowest and highest bin of each chunk.
#[derive(Clone, Copy)]
struct Chunks<'a> {
    bin_of: &'a [u32],
    extents: &'a [[u32; 2]],
}

impl Chunks<'_> {
    /// Calls `f` for each point in a range of bins, with the index and the bin of the point.
    fn for_each_in(self, bins: std::ops::Range<usize>, mut f: impl FnMut(u32, u32)) {
        for (chunk, (members, [lowest, highest])) in self.bin_of.chunks(CHUNK).zip(self.extents).enumerate() {
            if bins.start > *highest as usize || bins.end <= *lowest as usize {
                continue;
            }
            for (point, &bin) in members.iter().enumerate() {
                if bins.contains(&(bin as usize)) {
                    f((chunk * CHUNK + point) as u32, bin);
                }
            }
        }
    }

    /// Writes the points of several bins to `order`, and the bin of each point to `bin_at`. The bins start at
    /// `first_bin`; `cursors` has one entry per bin, the sorted index of its next point. Entry 0 of `order` and
    /// `bin_at` has the sorted index `begin`. If there are more than `span` bins, the function divides them between two
    /// tasks.
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
        self.for_each_in(first_bin..first_bin + bins, |point, bin| {
            let cursor = &mut cursors[bin as usize - first_bin];
            let index = (*cursor - begin) as usize;
            order[index] = point;
            bin_at[index] = bin;
            *cursor += 1;
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of points; they fill more than two chunks.
    const COUNT: u32 = 9000;

    #[test]
    fn sorting_is_stable_and_keeps_every_point() {
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
