//! Stable counting sort of particles into bins on a card. The order is the same as on the processor, see
//! [`crate::sph::neighbours::grid`].

use bytemuck::{Pod, Zeroable};

use super::card::{Card, groups};
use super::shaders::{Bound, GRID, Shader};
use crate::sph::solver::backend::DeviceError;

/// Number of bins for which a workgroup computes the prefix sum (scan).
const SCANNED: usize = 1024;

/// The struct `Sort` of `grid.wgsl`, with the same fields in the same order.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct SortConstants {
    points: u32,
    bins: u32,
    blocks: u32,
    padding: u32,
}

/// Buffers and kernels for sorting one group of particles.
#[derive(Debug)]
pub struct Sort {
    /// Index in `order` where each bin starts. The last entry is the number of points.
    pub start: wgpu::Buffer,
    /// Indices of the points, sorted by bin; the points of one bin keep their order.
    pub order: wgpu::Buffer,
    counts: wgpu::Buffer,
    count: Bound,
    scan_blocks: Bound,
    scan_sums: Bound,
    add_sums: Bound,
    scatter: Bound,
    rank: Bound,
    points: usize,
    bins: usize,
}

impl Sort {
    /// Creates buffers and kernels that sort `points` particles into `bins` bins. `cells` has the bin indices of the
    /// particles.
    ///
    /// # Errors
    /// If the card does not have enough memory.
    pub fn new(
        card: &Card,
        parameters: &wgpu::Buffer,
        cells: &wgpu::Buffer,
        points: usize,
        bins: usize,
    ) -> Result<Self, DeviceError> {
        let blocks = bins.div_ceil(SCANNED);
        let [n, b, k] = [points, bins, blocks].map(|n| n as u32);
        let sort = card.uniform("sort", &SortConstants { points: n, bins: b, blocks: k, padding: 0 });
        let counts = card.buffer::<u32>("particle counts of bins", bins)?;
        let start = card.buffer::<u32>("starts of bins", bins + 1)?;
        let sums = card.buffer::<u32>("sums over bins", blocks)?;
        let bin_of = card.buffer::<u32>("bins of particles", points)?;
        let scattered = card.buffer::<u32>("scattered particles", points)?;
        let order = card.buffer::<u32>("particle order", points)?;
        let shader = Shader::new(card, GRID);
        let bind = |name, buffers: &[(u32, &wgpu::Buffer)]| shader.kernel(name).bind(card, buffers);
        Ok(Self {
            count: bind("count", &[(0, parameters), (1, &sort), (2, cells), (3, &counts), (6, &bin_of)]),
            scan_blocks: bind("scan_blocks", &[(1, &sort), (3, &counts), (4, &start), (5, &sums)]),
            scan_sums: bind("scan_sums", &[(1, &sort), (5, &sums)]),
            add_sums: bind("add_sums", &[(1, &sort), (3, &counts), (4, &start), (5, &sums)]),
            scatter: bind("scatter", &[(1, &sort), (3, &counts), (4, &start), (6, &bin_of), (7, &scattered)]),
            rank: bind("rank", &[(1, &sort), (4, &start), (6, &bin_of), (7, &scattered), (8, &order)]),
            start,
            order,
            counts,
            points,
            bins,
        })
    }

    /// Appends the commands of the sort to `encoder`.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.counts, 0, None);
        self.count.run(encoder, groups(self.points, 64));
        self.scan_blocks.run(encoder, groups(self.bins, SCANNED));
        self.scan_sums.run(encoder, [1, 1]);
        self.add_sums.run(encoder, groups(self.bins + 1, 64));
        self.scatter.run(encoder, groups(self.points, 64));
        self.rank.run(encoder, groups(self.points, 64));
    }

    /// Returns the memory that a sort uses on the card [bytes].
    pub fn bytes(points: usize, bins: usize) -> usize {
        4 * (3 * points + 2 * bins + bins / SCANNED)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{super::constants::Constants, *};
    use crate::sph::neighbours::grid::{Bins, Grid};
    use crate::sph::parameters::Parameters;

    #[test]
    fn card_and_processor_sort_into_the_same_order() {
        let Ok(card) = Card::open(0) else { return println!("skipped: no card") };
        let size = DVec3::new(1.4, 1.0, 1.2);
        let parameters = Parameters::published(0.01, 0.02, 30.0, 9.81, None);
        let grid = Grid::new(DVec3::ZERO, size, parameters.dp, None);
        // The test needs more than 256 blocks of bins (`scan_sums` reads 256 at once), and points that share bins.
        assert!(grid.bins() > 300 * SCANNED);
        let spread = |i: u32, factor: u32| f64::from(i.wrapping_mul(factor) % 9973) / 9973.0;
        let mut points: Vec<DVec3> =
            (0..7000).map(|i| DVec3::new(spread(i, 7919), spread(i, 104_729), spread(i, 1_299_709)) * size).collect();
        points.extend((0..500).map(|i| DVec3::splat(0.5 + 1e-6 * f64::from(i % 7))));
        // Add a point outside the grid.
        points.push(DVec3::new(-1.0, 0.5, 9.0));
        let cells: Vec<[i32; 4]> = points
            .iter()
            .map(|&point| {
                let ([x, y, z], _) = super::super::state::to_cell(&grid, point);
                [x, y, z, 0]
            })
            .collect();
        let constants = Constants::new(&parameters, &grid, [DVec3::ZERO, size], [points.len(), 0]);
        let (constants, cells) = (card.uniform("parameters", &constants), card.filled("cells", &cells).unwrap());
        let sort = Sort::new(&card, &constants, &cells, points.len(), grid.bins()).unwrap();
        let mut encoder = card.encoder();
        // Sort twice, to check that data of the first sort do not change the second sort.
        sort.run(&mut encoder);
        sort.run(&mut encoder);
        let order: Vec<u32> = card.read(encoder, &sort.order, 0, points.len()).unwrap();
        let start: Vec<u32> = card.read(card.encoder(), &sort.start, 0, grid.bins() + 1).unwrap();
        let mut bins = Bins::default();
        bins.sort(&grid, &points);
        assert_eq!(start, bins.start);
        assert_eq!(order, bins.order);
    }
}
