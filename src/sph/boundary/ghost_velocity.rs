//! Velocity and acoustic damping of the water at the ghost nodes of mDBC, for no-slip and free-slip walls. The
//! interpolation is corrected in the same way as for the density.
//!
//! The interpolated value is a linear function of the values at the water particles. Therefore the four equations of
//! [`mdbc`](super::mdbc) are solved once per node for the weights of their left-hand sides: the number a and the vector
//! b. The velocity at the node is then one weighted sum over the water particles j:
//! v = sum_j (a W + g b . r_j) V_j v_j. Here r_j is the vector from the node to particle j in units of h. V_j and v_j
//! are the volume and the velocity of this particle. W is the kernel. g is not gravity but -h^2 G, with the factor G of
//! the kernel gradient grad_a W_ab = G r_ab.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::mdbc::{DRY_LIMIT, GhostNodes, MIN_CHUNK, NodeSums};
use super::node_sums::{NodeTerms, Pair, sum_around_nodes};
use crate::sph::lanes::Lanes;
use crate::sph::neighbours::grid::Grid;
use crate::sph::neighbours::records::Record;
use crate::sph::parameters::Parameters;
use crate::sph::particles::boundary::Boundary;
use crate::sph::terms::wall_slip::GhostVelocity;

/// Velocities of the water at the ghost nodes.
#[derive(Debug, Default)]
pub struct GhostVelocities {
    /// Weights a and b of each node, in the order of the sorted nodes.
    weights: Vec<[f32; 4]>,
    /// True if there is water around the node, in the same order.
    is_wet: Vec<bool>,
    /// Weighted sum of the water velocities around each node, in the same order; empty before the first computation.
    sums: Vec<VelocitySum>,
}

/// Weighted sum of the water velocities [m/s] and of the pressure of the acoustic damping [Pa] around a node.
#[derive(Debug, Clone, Copy, Default)]
struct VelocitySum([f32; 4]);

impl GhostVelocities {
    /// Computes the velocity at the ghost node of each boundary particle at the start of a time step. Call it after
    /// [`GhostNodes::densities`].
    pub fn compute(
        &mut self,
        nodes: &GhostNodes,
        grid: &Grid,
        parameters: &Parameters,
        records: &[Record],
        boundary: &Boundary,
    ) {
        let GhostNodes { sums, bins, .. } = nodes;
        let to_surface = &boundary.to_surface;
        self.weights.resize(sums.len(), [0.0; 4]);
        self.is_wet.resize(sums.len(), false);
        (&mut self.weights, &mut self.is_wet, sums, &bins.order).into_par_iter().with_min_len(MIN_CHUNK).for_each(
            |(weights, is_wet, sums, &i)| {
                let of_node = node_weights(sums, parameters, to_surface[i as usize]);
                *is_wet = of_node.is_some();
                *weights = of_node.unwrap_or_default();
            },
        );
        self.sums.resize(sums.len(), VelocitySum::default());
        self.update(nodes, grid, parameters, records);
    }

    /// Computes the velocities again from changed velocities of the water, with the weights of the last call of
    /// [`Self::compute`].
    pub fn update(&mut self, nodes: &GhostNodes, grid: &Grid, parameters: &Parameters, records: &[Record]) {
        let GhostNodes { split, lists, .. } = nodes;
        sum_around_nodes(parameters, grid.size.x as f32, split, &self.weights, lists, records, &mut self.sums);
    }

    /// Returns the velocity at the ghost node of a boundary particle; `None` if the node is dry or no velocities are
    /// computed.
    pub fn at_node_of(&self, particle: usize, nodes: &GhostNodes) -> Option<GhostVelocity> {
        let place = *nodes.place_of.get(particle)? as usize;
        if !*self.is_wet.get(place)? {
            return None;
        }
        let [x, y, z, damping] = self.sums[place].0;
        Some(GhostVelocity { velocity: Vec3::new(x, y, z).as_dvec3(), damping })
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.sums.capacity() * size_of::<VelocitySum>()
            + self.weights.capacity() * size_of::<[f32; 4]>()
            + self.is_wet.capacity() * size_of::<bool>()
    }
}

/// Returns the weights a and b of the velocity sum, including the constant factors of W and g; `None` if the node is
/// dry. If the trust in the fitted gradient is 0, the sum is the weighted mean of the water velocities; if it is 1, the
/// sum is the solution of the four equations. `to_surface` [m] is the vector from the boundary particle to its surface
/// point.
fn node_weights(sums: &NodeSums, parameters: &Parameters, to_surface: DVec3) -> Option<[f32; 4]> {
    let occupied = f64::from(sums.value[0]);
    if occupied < DRY_LIMIT {
        return None;
    }
    let (mean, trust) = ([1.0 / occupied, 0.0, 0.0, 0.0], sums.trust(to_surface));
    let fitted = (trust > 0.0).then(|| sums.weights()).flatten().unwrap_or(mean);
    let kernel = &parameters.kernel;
    // Constant factors of W and of g = -G h^2. The sum uses r_j in metres instead of units of h, so the factor of g is
    // divided by h.
    let (w, g) = (f64::from(kernel.scale()), -f64::from(kernel.gradient_scale()) * kernel.h);
    Some(std::array::from_fn(|k| {
        let weight = mean[k] + trust * (fitted[k] - mean[k]);
        (weight * if k == 0 { w } else { g }) as f32
    }))
}

impl NodeTerms<4, 4> for VelocitySum {
    #[inline(always)]
    fn add<L: Lanes>(sums: &mut [L; 4], weights: &[L; 4], pair: &Pair<L>, b: &Record) {
        let [x, y, z] = pair.r;
        let along = weights[1].mul_add(x, weights[2].mul_add(y, weights[3] * z));
        let weight = weights[0].mul_add(pair.wv, along * pair.gv);
        let [vx, vy, vz] = b.velocity;
        for (sum, value) in sums.iter_mut().zip([vx, vy, vz, b.damping]) {
            *sum = weight.mul_add(L::splat(value), *sum);
        }
    }

    fn factors(_: f32, _: f32, _: f32) -> [f32; 4] {
        [1.0; 4]
    }

    fn of_sums(sums: [f32; 4]) -> Self {
        Self(sums)
    }
}
