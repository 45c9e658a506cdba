//! Constants of the loop over pairs of particles, and the distance between the particles of a pair.

use rayon::prelude::*;

use crate::sph::lanes::Lanes;
use crate::sph::neighbours::lists::{CHUNK, Chunk, Cluster, NeighbourLists, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::Parameters;

/// Constants that a loop over pairs needs in addition to the records.
#[derive(Debug, Clone, Copy)]
pub struct PairLoop {
    /// Constants of the scheme.
    pub parameters: Parameters,
    bin_x: f32,
    width: f32,
    /// Number of water particles. Their records come first, also in the neighbour lists.
    pub(in crate::sph) water: usize,
}

impl PairLoop {
    /// Creates the constants for bins of length `bin_x` along x [m].
    pub fn new(parameters: Parameters, bin_x: f64) -> Self {
        let width = parameters.periodic_width.unwrap_or(0.0) as f32;
        Self { parameters, bin_x: bin_x as f32, width, water: 0 }
    }

    /// Returns the same constants with other parameters of the scheme.
    pub(in crate::sph) fn with_parameters(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Counts the pairs of a target and a neighbour whose distance is smaller than the kernel support. The targets are
    /// the first entries of `records`.
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

    /// Returns the split positions of the members of a cluster, see
    /// [`split_position`](crate::sph::neighbours::records::split_position).
    #[inline(always)]
    pub(super) fn split_positions<L: Lanes>(&self, cluster: &Cluster, targets: &[Record]) -> [L; 4] {
        [
            lanes_of(cluster, targets, |r: &Record| r.bin_x),
            lanes_of(cluster, targets, |r: &Record| r.x),
            lanes_of(cluster, targets, |r: &Record| r.y),
            lanes_of(cluster, targets, |r: &Record| r.z),
        ]
    }

    /// Returns the vector r_ab [m] from a neighbour b to each member a of a cluster. If `PERIODIC` is true, the vector
    /// starts at the nearest periodic image of b.
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

    /// Returns the vector from b to a and its length [m]. In a periodic flume, the vector starts at the nearest
    /// periodic image of b.
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
