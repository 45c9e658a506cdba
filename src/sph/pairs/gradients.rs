//! Gradients of density and velocity at the targets a, and measures of the particle distribution around them. With the
//! neighbours b, their volumes V_b, the kernel W_ab, r_ba = r_b - r_a, the tensor product (x), a field f and the
//! particle concentration C, the code computes:
//!
//!   M      = sum_b V_b r_ba (x) grad_a W_ab,              the identity in a full, uniform neighbourhood
//!   grad f = M^-1 sum_b V_b (f_b - f_a) grad_a W_ab,      exact for linear fields
//!   grad C = sum_b V_b grad_a W_ab,                       zero in a uniform neighbourhood
//!   div r  = tr M,                                        the number of dimensions in a full neighbourhood.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::pair_loop::PairLoop;
use crate::sph::lanes::{Lanes, MAX_LANES, WithLanes};
use crate::sph::neighbours::lists::{CHUNK, Chunk, Cluster, NeighbourLists, lanes_of};
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::Parameters;
use crate::sph::terms::density_diffusion::DensityDiffusion;
use crate::sph::terms::shifting::Order;
use crate::sph::terms::viscosity::Viscosity;

/// Smallest determinant of M for which M is inverted [-]. In a block of water with the default smoothing length, det M
/// is 1 inside, 0.23 for the outermost particles of a face, and 0.045 for the particles along a straight edge.
const MIN_DETERMINANT: f64 = 0.05;

/// Data of a particle that its neighbours need in addition to its record. For boundary particles, gradient and stress
/// are zero.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct NeighbourData {
    /// Renormalised gradient of the density [kg/m4].
    pub density_gradient: [f32; 3],
    /// 1 if the gradient of the target replaces the gradient of this particle (boundary particles), 0 if not (water).
    pub uses_target_gradient: f32,
    /// Sub-particle-scale stress tau / rho^2: xx, yy, zz, xy, xz, yz [m5/(kg s2)].
    pub stress: [f32; 6],
}

impl NeighbourData {
    /// The data of a boundary particle.
    pub(super) const OF_BOUNDARY: Self =
        Self { density_gradient: [0.0; 3], uses_target_gradient: 1.0, stress: [0.0; 6] };
}

/// Gradients at the water particles.
#[derive(Debug, Default)]
pub struct Gradients {
    sums: Vec<Sums>,
    /// Additional data, one entry per record; empty if the scheme does not need these data.
    neighbour_data: Vec<NeighbourData>,
}

/// Sums over the neighbours of one target.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    /// Components of M: xx, yy, zz, xy, xz, yz [-].
    moments: [f32; 6],
    /// grad C [1/m].
    concentration: [f32; 3],
    /// sum_b V_b (rho_b - rho_a) grad_a W_ab [kg/m4].
    density: [f32; 3],
    /// sum_b V_b (v_b - v_a)_i (grad_a W_ab)_j, with the component i of the velocity and j of the gradient [1/s].
    velocity: [[f32; 3]; 3],
}

impl Gradients {
    /// Returns true if a scheme needs the gradients of density or velocity to compute the rates.
    pub fn are_needed(parameters: &Parameters) -> bool {
        let turbulent = matches!(parameters.viscosity, Viscosity::Laminar { turbulence: Some(_), .. });
        turbulent || parameters.diffusion.kind == DensityDiffusion::Antuono
    }

    /// Computes the gradients and the measures of the particle distribution at the water particles, which are the first
    /// `targets` of the `records`.
    pub fn compute(&mut self, pairs: &PairLoop, lists: &NeighbourLists, records: &[Record], targets: usize) {
        self.sum::<true>(pairs, lists, records, targets);
        self.neighbour_data.resize(records.len(), NeighbourData::OF_BOUNDARY);
        let (of_water, of_boundary) = self.neighbour_data.split_at_mut(targets);
        let parameters = &pairs.parameters;
        (of_water, &self.sums, &records[..targets])
            .into_par_iter()
            .for_each(|(data, sums, record)| *data = sums.neighbour_data(parameters, record));
        of_boundary.fill(NeighbourData::OF_BOUNDARY);
    }

    /// Computes the measures of the particle distribution alone.
    pub fn compute_order(&mut self, pairs: &PairLoop, lists: &NeighbourLists, records: &[Record], targets: usize) {
        self.sum::<false>(pairs, lists, records, targets);
    }

    /// Computes the sums; those over density and velocity only if `FIELDS` is true.
    fn sum<const FIELDS: bool>(
        &mut self,
        pairs: &PairLoop,
        lists: &NeighbourLists,
        records: &[Record],
        targets: usize,
    ) {
        self.sums.resize(targets, Sums::default());
        self.sums.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (sums, chunk))| {
            let begin = number * CHUNK;
            let targets = &records[begin..begin + sums.len()];
            lists.instructions().dispatch(ChunkSums::<FIELDS> { pairs, chunk, targets, records, sums });
        });
    }

    /// Returns the additional data of each record; empty if the scheme does not need these data.
    pub fn neighbour_data(&self) -> &[NeighbourData] {
        &self.neighbour_data
    }

    /// Returns the measures of the particle distribution around a target.
    pub fn order(&self, target: usize) -> Order {
        let sums = &self.sums[target];
        let concentration_gradient = DVec3::from_array(sums.concentration.map(f64::from));
        let n = concentration_gradient.normalize_or_zero();
        let [xx, yy, zz, xy, xz, yz] = sums.moments.map(f64::from);
        let mixed = xy * n.x * n.y + xz * n.x * n.z + yz * n.y * n.z;
        Order {
            concentration_gradient,
            divergence: xx + yy + zz,
            along_gradient: xx * n.x * n.x + yy * n.y * n.y + zz * n.z * n.z + 2.0 * mixed,
        }
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.sums.capacity() * size_of::<Sums>() + self.neighbour_data.capacity() * size_of::<NeighbourData>()
    }
}

impl Sums {
    /// Returns the inverse of the renormalisation matrix M, or the identity if det M <= [`MIN_DETERMINANT`]: the
    /// particle has too few neighbours, or they lie nearly in one plane.
    fn renormalisation(&self) -> DMat3 {
        let [xx, yy, zz, xy, xz, yz] = self.moments.map(f64::from);
        // In a two-dimensional flume all neighbours lie in one plane, and fields do not vary normal to this plane.
        let yy = if yy == 0.0 { 1.0 } else { yy };
        let moments = DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz));
        if moments.determinant() > MIN_DETERMINANT { moments.inverse() } else { DMat3::IDENTITY }
    }

    fn neighbour_data(&self, parameters: &Parameters, record: &Record) -> NeighbourData {
        let renormalisation = self.renormalisation();
        let corrected = |sum: [f32; 3]| renormalisation * DVec3::from_array(sum.map(f64::from));
        let stress = match parameters.viscosity {
            Viscosity::Laminar { turbulence: Some(turbulence), .. } => {
                let gradient = self.velocity.map(|component| corrected(component).to_array());
                turbulence.specific_stress(gradient, parameters.tait.rho0 + f64::from(record.excess_density))
            }
            _ => [0.0; 6],
        };
        NeighbourData {
            density_gradient: corrected(self.density).as_vec3().to_array(),
            uses_target_gradient: 0.0,
            stress: stress.map(|component| component as f32),
        }
    }
}

/// Computation of the sums for one chunk of targets. If `FIELDS` is false, the sums over density and velocity are zero.
struct ChunkSums<'a, const FIELDS: bool> {
    pairs: &'a PairLoop,
    chunk: &'a Chunk,
    targets: &'a [Record],
    records: &'a [Record],
    sums: &'a mut [Sums],
}

impl<const FIELDS: bool> WithLanes for ChunkSums<'_, FIELDS> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for (cluster, neighbours) in self.chunk.clusters() {
            let members = cluster.first as usize..(cluster.first + cluster.len) as usize;
            let sums = if cluster.crosses_sides {
                self.cluster_sums::<L, true>(cluster, neighbours)
            } else {
                self.cluster_sums::<L, false>(cluster, neighbours)
            };
            let mut lanes = [[0.0; MAX_LANES]; 21];
            for (lanes, sum) in lanes.iter_mut().zip(sums) {
                *lanes = sum.to_array();
            }
            for (lane, sums) in self.sums[members].iter_mut().enumerate() {
                let sum = |k: usize| lanes[k][lane];
                *sums = Sums {
                    moments: std::array::from_fn(sum),
                    concentration: std::array::from_fn(|k| sum(6 + k)),
                    density: std::array::from_fn(|k| sum(9 + k)),
                    velocity: std::array::from_fn(|i| std::array::from_fn(|j| sum(12 + 3 * i + j))),
                };
            }
        }
    }
}

impl<const FIELDS: bool> ChunkSums<'_, FIELDS> {
    /// Returns the sums of a cluster in the order of [`Sums`].
    #[inline(always)]
    fn cluster_sums<L: Lanes, const PERIODIC: bool>(&self, cluster: &Cluster, neighbours: &[u32]) -> [L; 21] {
        let kernel = &self.pairs.parameters.kernel;
        let splat = L::splat;
        let a: [L; 4] = self.pairs.split_positions(cluster, self.targets);
        let velocity_a: [L; 3] =
            std::array::from_fn(|k| lanes_of::<L, Record>(cluster, self.targets, |r| r.velocity[k]));
        let excess_a: L = lanes_of(cluster, self.targets, |r: &Record| r.excess_density);
        let mut sums = [splat(0.0); 21];
        for &j in neighbours {
            let b = &self.records[j as usize];
            let [x, y, z] = self.pairs.difference::<L, PERIODIC>(a, b);
            let closeness = kernel.closeness(x.mul_add(x, y.mul_add(y, z * z)).sqrt());
            // grad_a W_ab = G r_ab. The constant factor of G is applied after the loop.
            let gv = kernel.gradient_shape(closeness) * splat(b.volume);
            let (gx, gy, gz) = (gv * x, gv * y, gv * z);
            // The sign is minus, because M contains r_ba = -r_ab, and x, y, z are the components of r_ab.
            let of_moments = [gx * x, gy * y, gz * z, gx * y, gx * z, gy * z];
            for (sum, moment) in sums[..6].iter_mut().zip(of_moments) {
                *sum = *sum - moment;
            }
            for (sum, g) in sums[6..9].iter_mut().zip([gx, gy, gz]) {
                *sum += g;
            }
            if FIELDS {
                let fields = [
                    splat(b.excess_density) - excess_a,
                    splat(b.velocity[0]) - velocity_a[0],
                    splat(b.velocity[1]) - velocity_a[1],
                    splat(b.velocity[2]) - velocity_a[2],
                ];
                for (f, sums) in fields.into_iter().zip(sums[9..].chunks_exact_mut(3)) {
                    for (sum, g) in sums.iter_mut().zip([gx, gy, gz]) {
                        *sum = f.mul_add(g, *sum);
                    }
                }
            }
        }
        // Not `map`, which the compiler does not inline for a long array.
        for sum in &mut sums {
            *sum = *sum * splat(kernel.gradient_scale());
        }
        sums
    }
}
