//! Velocity of the water at the ghost nodes of mDBC, for walls with no slip or free slip. It uses the same corrected
//! interpolation as the density.
//!
//! The interpolation is linear in the interpolated field. The equations are solved for the weights of their left-hand
//! sides; the velocity is then one weighted sum over the water, v = sum_b (a W + b . r_b g) V_b v_b.

use glam::DVec3;
use rayon::prelude::*;

use super::{
    grid::Grid,
    lanes::Lanes,
    mdbc::{
        DRY, GhostNodes, NodeSums, PIECE,
        node_sums::{NodeTerms, Pair, sum_round_nodes},
    },
    parameters::Parameters,
    records::Record,
};
use crate::sph::particles::boundary::Boundary;

/// Velocity of the water at a ghost node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GhostVelocity {
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Trust in the linear fit, from 0 (too few layers of water) to 1.
    pub trust: f64,
}

/// Weighted sum of the velocities around a node [m/s].
#[derive(Debug, Clone, Copy, Default)]
pub struct VelocitySum([f32; 3]);

impl GhostNodes {
    /// Computes the velocity at the ghost node of each boundary particle, `None` where the node is dry. Call it after
    /// [`GhostNodes::densities`].
    pub fn velocities(
        &mut self,
        grid: &Grid,
        parameters: &Parameters,
        records: &[Record],
        boundary: &Boundary,
        out: &mut Vec<Option<GhostVelocity>>,
    ) {
        let (bin_x, to_surface) = (grid.size.x as f32, &boundary.to_surface);
        let Self { sums, velocity_weights, velocity_sums, split, lists, bins, .. } = self;
        velocity_weights.resize(sums.len(), [0.0; 4]);
        (&mut *velocity_weights, &*sums, &bins.order)
            .into_par_iter()
            .with_min_len(PIECE)
            .for_each(|(weights, sums, &i)| *weights = velocity_weights_of(sums, parameters, to_surface[i as usize]));
        velocity_sums.resize(sums.len(), VelocitySum::default());
        sum_round_nodes(parameters, bin_x, split, velocity_weights, lists, records, velocity_sums);
        out.resize(sums.len(), None);
        for ((sums, velocity), &particle) in sums.iter().zip(velocity_sums).zip(&bins.order) {
            let trust = sums.trust(to_surface[particle as usize]);
            let is_wet = f64::from(sums.value[0]) >= DRY;
            let velocity = DVec3::from_array(velocity.0.map(f64::from));
            out[particle as usize] = is_wet.then_some(GhostVelocity { velocity, trust });
        }
    }
}

/// Returns the weights of W V and of r g V for the velocity, without the constant factors of W and g. Trust blends the
/// weighted mean with the four equations. `to_surface` [m] is half the vector from boundary particle to node.
fn velocity_weights_of(sums: &NodeSums, parameters: &Parameters, to_surface: DVec3) -> [f32; 4] {
    let occupied = f64::from(sums.value[0]);
    if occupied < DRY {
        return [0.0; 4];
    }
    let (mean, trust) = ([1.0 / occupied, 0.0, 0.0, 0.0], sums.trust(to_surface));
    let fitted = (trust > 0.0).then(|| sums.weights()).flatten().unwrap_or(mean);
    let kernel = &parameters.kernel;
    // g = -G h^2, r in h.
    let (w, g) = (f64::from(kernel.scale()), -f64::from(kernel.gradient_scale()) * kernel.h);
    std::array::from_fn(|k| {
        let weight = mean[k] + trust * (fitted[k] - mean[k]);
        (weight * if k == 0 { w } else { g }) as f32
    })
}

impl NodeTerms<3, 4> for VelocitySum {
    #[inline(always)]
    fn add<L: Lanes>(sums: &mut [L; 3], weights: &[L; 4], pair: &Pair<L>, b: &Record) {
        let [x, y, z] = pair.r;
        let along = weights[1].mul_add(x, weights[2].mul_add(y, weights[3] * z));
        let weight = weights[0].mul_add(pair.wv, along * pair.gv);
        for (sum, v) in sums.iter_mut().zip(b.velocity) {
            *sum = weight.mul_add(L::splat(v), *sum);
        }
    }

    fn factors(_: f32, _: f32, _: f32) -> [f32; 3] {
        [1.0; 3]
    }

    fn of_sums(sums: [f32; 3]) -> Self {
        Self(sums)
    }
}
