//! Velocity of the water at the ghost nodes of mDBC, by the same corrected interpolation as the density there, for walls
//! that hold the water or let it slide.

use glam::DVec3;
use rayon::prelude::*;

use super::{
    lanes::{Lanes, WithLanes},
    mdbc::{DRY, GhostNodes},
    neighbours::{CHUNK, Chunk, Cluster},
    parameters::Parameters,
    rates::lanes_of,
    records::Record,
};

/// For each component of the velocity, sums over the water round a node, lengths in h.
#[derive(Debug, Clone, Copy, Default)]
pub struct VelocitySums {
    /// sum W V v_i.
    value: [f32; 3],
    /// sum g V (x, y, z) v_i with g = -G h^2.
    first: [[f32; 3]; 3],
}

impl GhostNodes {
    /// Velocity of the water at the node of each boundary particle [m/s], `None` where it is dry; to be called after
    /// [`GhostNodes::densities`].
    pub fn velocities(
        &mut self,
        parameters: &Parameters,
        bin_x: f32,
        records: &[Record],
        out: &mut Vec<Option<DVec3>>,
    ) {
        self.velocity_sums.resize(self.sums.len(), VelocitySums::default());
        let (split, lists) = (&self.split, &self.lists);
        self.velocity_sums.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (sums, chunk))| {
            let begin = number * CHUNK;
            let nodes = &split[begin..begin + sums.len()];
            lists.instructions().dispatch(ChunkSums { parameters, bin_x, chunk, nodes, records, sums });
        });
        out.resize(self.sums.len(), None);
        for (node, &particle) in self.bins.order.iter().enumerate() {
            out[particle as usize] = self.velocity(node);
        }
    }

    fn velocity(&self, node: usize) -> Option<DVec3> {
        let (sums, of_velocity) = (&self.sums[node], &self.velocity_sums[node]);
        let occupied = f64::from(sums.value[0]);
        if occupied < DRY {
            return None;
        }
        let component = |i: usize| {
            let (value, first) = (f64::from(of_velocity.value[i]), of_velocity.first[i].map(f64::from));
            sums.value_and_gradient(value, first).map_or(value / occupied, |[f, ..]| f)
        };
        Some(DVec3::from_array(std::array::from_fn(component)))
    }
}

/// The sums of one chunk of nodes.
struct ChunkSums<'a> {
    parameters: &'a Parameters,
    bin_x: f32,
    chunk: &'a Chunk,
    nodes: &'a [[f32; 4]],
    records: &'a [Record],
    sums: &'a mut [VelocitySums],
}

impl WithLanes for ChunkSums<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for (cluster, neighbours) in self.chunk.clusters() {
            let members = cluster.first as usize..(cluster.first + cluster.len) as usize;
            let lanes = self.cluster_sums::<L>(cluster, neighbours).map(L::to_array);
            for (lane, node) in self.sums[members].iter_mut().enumerate() {
                *node = VelocitySums {
                    value: std::array::from_fn(|i| lanes[i][lane]),
                    first: std::array::from_fn(|i| std::array::from_fn(|k| lanes[3 + 3 * i + k][lane])),
                };
            }
        }
    }
}

impl ChunkSums<'_> {
    /// The sums of a cluster's nodes in the order of [`VelocitySums`].
    #[inline(always)]
    fn cluster_sums<L: Lanes>(&self, cluster: &Cluster, neighbours: &[u32]) -> [L; 12] {
        let kernel = &self.parameters.kernel;
        let splat = L::splat;
        let node: [L; 4] = std::array::from_fn(|k| lanes_of::<L, [f32; 4]>(cluster, self.nodes, |n| n[k]));
        let width = splat(self.parameters.periodic_width.unwrap_or(0.0) as f32);
        let per_width = splat(self.parameters.periodic_width.map_or(0.0, |width| width.recip() as f32));
        let mut sums = [splat(0.0); 12];
        for &j in neighbours {
            let b = &self.records[j as usize];
            let x = (splat(b.bin_x) - node[0]).mul_add(splat(self.bin_x), splat(b.x) - node[1]);
            let mut y = splat(b.y) - node[2];
            y = y - width * (y * per_width).round();
            let z = splat(b.z) - node[3];
            let closeness = kernel.closeness(x.mul_add(x, y.mul_add(y, z * z)).sqrt());
            let wv = kernel.shape(closeness) * splat(b.volume);
            let gv = kernel.gradient_shape(closeness) * splat(b.volume);
            let g = [gv * x, gv * y, gv * z];
            for i in 0..3 {
                let v = splat(b.velocity[i]);
                sums[i] = wv.mul_add(v, sums[i]);
                for (sum, g) in sums[3 + 3 * i..6 + 3 * i].iter_mut().zip(g) {
                    *sum = g.mul_add(v, *sum);
                }
            }
        }
        let h = kernel.h as f32;
        let (of_value, of_first) = (splat(kernel.scale()), splat(-kernel.gradient_scale() * h));
        std::array::from_fn(|k| sums[k] * if k < 3 { of_value } else { of_first })
    }
}
