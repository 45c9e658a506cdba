//! Sums over the water particles around each ghost node. One generic loop serves all kinds of sums.

use rayon::prelude::*;

use crate::sph::lanes::{Lanes, MAX_LANES, WithLanes};
use crate::sph::neighbours::lists::{CHUNK, Chunk, Cluster, NeighbourLists, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::Parameters;

/// A ghost node and a water particle near it.
pub struct Pair<L> {
    /// Vector from the node to the particle [m].
    pub r: [L; 3],
    /// W V: kernel times volume of the particle, without the constant factor of W.
    pub wv: L,
    /// G V, with the factor G of the kernel gradient grad_a W_ab = G r_ab (not the `G` of [`NodeTerms`]), without the
    /// constant factor of G.
    pub gv: L,
}

/// `N` sums over the water particles around a ghost node. The caller gives `G` numbers per node, which
/// the terms can use.
pub trait NodeTerms<const N: usize, const G: usize>: Copy + Default + Send {
    /// Adds the contribution of the water particle `b` to the sums, without constant factors.
    fn add<L: Lanes>(sums: &mut [L; N], node: &[L; G], pair: &Pair<L>, b: &Record);

    /// Returns the constant factors of the sums. `w` and `g` are the constant factors of W and -G h^2. The results have
    /// lengths in units of `h` [m].
    fn factors(w: f32, g: f32, h: f32) -> [f32; N];

    /// Creates the result from the sums, which are in the order of [`NodeTerms::add`].
    fn of_sums(sums: [f32; N]) -> Self;
}

/// Computes the sums of all nodes. `nodes` are split positions (see
/// [`split_position`](crate::sph::neighbours::records::split_position)); `known` has the `G` numbers of each node for
/// the terms; `lists` has the neighbours of each node as indices in `records`. `bin_x` is the length of a bin along x
/// [m].
pub fn sum_around_nodes<S: NodeTerms<N, G>, const N: usize, const G: usize>(
    parameters: &Parameters,
    bin_x: f32,
    nodes: &[[f32; 4]],
    known: &[[f32; G]],
    lists: &NeighbourLists,
    records: &[Record],
    sums: &mut [S],
) {
    let chunks = sums.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate();
    chunks.for_each(|(number, (sums, chunk))| {
        let members = number * CHUNK..number * CHUNK + sums.len();
        let (nodes, known) = (&nodes[members.clone()], &known[members]);
        lists.instructions().dispatch(ChunkSums { parameters, bin_x, chunk, nodes, known, records, sums });
    });
}

/// Computation of the sums for one chunk of nodes.
struct ChunkSums<'a, S, const N: usize, const G: usize> {
    parameters: &'a Parameters,
    bin_x: f32,
    chunk: &'a Chunk,
    nodes: &'a [[f32; 4]],
    known: &'a [[f32; G]],
    records: &'a [Record],
    sums: &'a mut [S],
}

impl<S: NodeTerms<N, G>, const N: usize, const G: usize> WithLanes for ChunkSums<'_, S, N, G> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for (cluster, neighbours) in self.chunk.clusters() {
            let members = cluster.first as usize..(cluster.first + cluster.len) as usize;
            if neighbours.is_empty() {
                self.sums[members].fill(S::default());
                continue;
            }
            let lanes = if cluster.crosses_sides {
                self.cluster_sums::<L, true>(cluster, neighbours)
            } else {
                self.cluster_sums::<L, false>(cluster, neighbours)
            };
            let mut values = [[0.0; MAX_LANES]; N];
            for (values, lanes) in values.iter_mut().zip(lanes) {
                *values = lanes.to_array();
            }
            for (lane, node) in self.sums[members].iter_mut().enumerate() {
                *node = S::of_sums(std::array::from_fn(|k| values[k][lane]));
            }
        }
    }
}

impl<S: NodeTerms<N, G>, const N: usize, const G: usize> ChunkSums<'_, S, N, G> {
    #[inline(always)]
    fn cluster_sums<L: Lanes, const PERIODIC: bool>(&self, cluster: &Cluster, neighbours: &[u32]) -> [L; N] {
        let kernel = &self.parameters.kernel;
        let splat = L::splat;
        let node: [L; 4] = std::array::from_fn(|k| lanes_of::<L, [f32; 4]>(cluster, self.nodes, |n| n[k]));
        let known: [L; G] = std::array::from_fn(|k| lanes_of::<L, [f32; G]>(cluster, self.known, |n| n[k]));
        let width = splat(self.parameters.periodic_width.unwrap_or(0.0) as f32);
        let per_width = splat(self.parameters.periodic_width.map_or(0.0, |width| width.recip() as f32));
        let bin_x = splat(self.bin_x);

        let mut sums = [splat(0.0); N];
        for &j in neighbours {
            let b = &self.records[j as usize];
            let x = (splat(b.bin_x) - node[0]).mul_add(bin_x, splat(b.x) - node[1]);
            let mut y = splat(b.y) - node[2];
            if PERIODIC {
                y = y - width * (y * per_width).round();
            }
            let z = splat(b.z) - node[3];
            let closeness = kernel.closeness(x.mul_add(x, y.mul_add(y, z * z)).sqrt());
            let volume = splat(b.volume);
            let (wv, gv) = (kernel.shape(closeness) * volume, kernel.gradient_shape(closeness) * volume);
            S::add(&mut sums, &known, &Pair { r: [x, y, z], wv, gv }, b);
        }
        let h = kernel.h as f32;
        // Not `from_fn`, which the compiler does not inline for a long array.
        for (sum, factor) in sums.iter_mut().zip(S::factors(kernel.scale(), -kernel.gradient_scale() * h * h, h)) {
            *sum = *sum * splat(factor);
        }
        sums
    }
}
