//! The counting sort of particles into bins on a card, as stable as that of [`crate::sph::grid`].

use bytemuck::{Pod, Zeroable};

use super::{
    card::{Card, groups},
    shaders::{Bound, GRID, Shader},
};
use crate::sph::backend::DeviceError;

/// Bins that a group of threads scans.
const SCANNED: usize = 1024;

/// `Sort` of the shader.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct SortConstants {
    points: u32,
    bins: u32,
    blocks: u32,
    padding: u32,
}

/// Memory and kernels for sorting one group of particles.
#[derive(Debug)]
pub struct Sort {
    /// First place of each bin, and the number of points at the end.
    pub start: wgpu::Buffer,
    /// Index of each point, bin after bin; points of one bin keep their order.
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
    /// A sort of as many points as `cells` holds into `bins` bins.
    ///
    /// # Errors
    /// If the card has not enough memory.
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
        let counts = card.buffer::<u32>("the bins' counts", bins)?;
        let start = card.buffer::<u32>("the bins", bins + 1)?;
        let sums = card.buffer::<u32>("the bins' sums", blocks)?;
        let bin_of = card.buffer::<u32>("the particles' bins", points)?;
        let scattered = card.buffer::<u32>("the particles' places", points)?;
        let order = card.buffer::<u32>("the particles' order", points)?;
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

    /// Sort.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.counts, 0, None);
        self.count.run(encoder, groups(self.points, 64));
        self.scan_blocks.run(encoder, groups(self.bins, SCANNED));
        self.scan_sums.run(encoder, [1, 1]);
        self.add_sums.run(encoder, groups(self.bins + 1, 64));
        self.scatter.run(encoder, groups(self.points, 64));
        self.rank.run(encoder, groups(self.points, 64));
    }

    /// Bytes on the card.
    pub fn bytes(points: usize, bins: usize) -> usize {
        4 * (3 * points + 2 * bins + bins / SCANNED)
    }
}
