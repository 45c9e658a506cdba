//! Pencil bins and the stable counting sort that puts particles into them.
//!
//! A bin is dp long and 2dp wide and high; bins of one row follow each other in x. Eight consecutive particles of a
//! row are then a compact cluster, which is what the SIMD lanes want.

use glam::DVec3;

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
}

impl Bins {
    /// Bytes in use.
    pub fn bytes(&self) -> usize {
        [&self.start, &self.order, &self.bin_at, &self.bin_of].map(|v| v.capacity() * size_of::<u32>()).iter().sum()
    }

    /// Sort the points stably into the bins of `grid`.
    pub fn sort(&mut self, grid: &Grid, points: &[DVec3]) {
        use rayon::prelude::*;
        self.bin_of.resize(points.len(), 0);
        self.order.resize(points.len(), 0);
        self.bin_at.resize(points.len(), 0);
        self.bin_of.par_iter_mut().zip(points).with_min_len(4096).for_each(|(bin, &point)| *bin = grid.bin(point));
        self.start.clear();
        self.start.resize(grid.bins() + 1, 0);
        for &bin in &self.bin_of {
            self.start[bin as usize + 1] += 1;
        }
        for bin in 0..grid.bins() {
            self.start[bin + 1] += self.start[bin];
        }
        // `start` serves as the cursor and is shifted back afterwards: no second array.
        for (point, &bin) in self.bin_of.iter().enumerate() {
            let place = self.start[bin as usize] as usize;
            self.order[place] = point as u32;
            self.bin_at[place] = bin;
            self.start[bin as usize] += 1;
        }
        self.start.copy_within(0..grid.bins(), 1);
        self.start[0] = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_stably_and_keeps_everyone() {
        let grid = Grid::new(DVec3::ZERO, DVec3::splat(1.0), 0.1, None);
        let points: Vec<DVec3> =
            (0..500).map(|i| DVec3::splat(f64::from(i * 7919 % 997) / 997.0) * DVec3::new(1.0, 0.7, 1.3)).collect();
        let mut bins = Bins::default();
        bins.sort(&grid, &points);
        assert_eq!(*bins.start.last().unwrap(), 500);
        for bin in 0..grid.bins() {
            let range = bins.start[bin] as usize..bins.start[bin + 1] as usize;
            let members = &bins.order[range.clone()];
            assert!(members.windows(2).all(|w| w[0] < w[1]));
            assert!(members.iter().all(|&i| grid.bin(points[i as usize]) as usize == bin));
            assert!(bins.bin_at[range].iter().all(|&b| b as usize == bin));
        }
    }
}
