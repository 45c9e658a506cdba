//! Velocity of the water at the ghost nodes of mDBC, by the same corrected interpolation as the density there, for
//! walls that hold the water or let it slide.

use glam::DVec3;

use super::{
    lanes::Lanes,
    mdbc::{
        DRY, GhostNodes,
        node_sums::{NodeTerms, Pair, sum_round_nodes},
    },
    parameters::Parameters,
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

/// Velocity of the water at a ghost node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GhostVelocity {
    /// [m/s].
    pub velocity: DVec3,
    /// From 0, where the water is too thin to be fitted, to 1.
    pub trust: f64,
}

impl GhostNodes {
    /// What the water does at the node of each boundary particle, `None` where it is dry; to be called after
    /// [`GhostNodes::densities`].
    pub fn velocities(
        &mut self,
        parameters: &Parameters,
        bin_x: f32,
        records: &[Record],
        to_surface: &[DVec3],
        out: &mut Vec<Option<GhostVelocity>>,
    ) {
        self.velocity_sums.resize(self.sums.len(), VelocitySums::default());
        sum_round_nodes(parameters, bin_x, &self.split, &self.lists, records, &mut self.velocity_sums);
        out.resize(self.sums.len(), None);
        for (node, &particle) in self.bins.order.iter().enumerate() {
            out[particle as usize] = self.velocity(node, to_surface[particle as usize]);
        }
    }

    fn velocity(&self, node: usize, to_surface: DVec3) -> Option<GhostVelocity> {
        let (sums, of_velocity) = (&self.sums[node], &self.velocity_sums[node]);
        let occupied = f64::from(sums.value[0]);
        if occupied < DRY {
            return None;
        }
        let trust = sums.trust(to_surface);
        let component = |i: usize| {
            let (value, first) = (f64::from(of_velocity.value[i]), of_velocity.first[i].map(f64::from));
            let mean = value / occupied;
            sums.value_and_gradient(value, first).map_or(mean, |[f, ..]| mean + trust * (f - mean))
        };
        Some(GhostVelocity { velocity: DVec3::from_array(std::array::from_fn(component)), trust })
    }
}

impl NodeTerms<12> for VelocitySums {
    #[inline(always)]
    fn add<L: Lanes>(sums: &mut [L; 12], pair: &Pair<L>, b: &Record) {
        let g = pair.r.map(|r| pair.gv * r);
        for i in 0..3 {
            let v = L::splat(b.velocity[i]);
            sums[i] = pair.wv.mul_add(v, sums[i]);
            for (sum, g) in sums[3 + 3 * i..6 + 3 * i].iter_mut().zip(g) {
                *sum = g.mul_add(v, *sum);
            }
        }
    }

    fn factors(w: f32, g: f32, h: f32) -> [f32; 12] {
        std::array::from_fn(|k| if k < 3 { w } else { g / h })
    }

    fn of_sums(sums: [f32; 12]) -> Self {
        Self {
            value: std::array::from_fn(|i| sums[i]),
            first: std::array::from_fn(|i| std::array::from_fn(|k| sums[3 + 3 * i + k])),
        }
    }
}
