//! Pressure on units in gaps too narrow for water particles.
//!
//! No water particle fits between the bed and the foot of a unit. The pressure of water particles alone would act on
//! the foot only from above, and would press the unit down with several times its weight. In reality, water fills such
//! a gap, and the pressure in the gap acts on the foot from below. Therefore bed, walls and other units act on a unit
//! through the pressure term of equation 1. Their densities come from the nearby water (see
//! [`mdbc`](crate::sph::boundary::mdbc)). They exert no viscous force on a unit, because the contact law provides the
//! friction.

use rayon::prelude::*;

use super::{pair_loop::PairLoop, rate::Rate};
use crate::sph::neighbours::lists::{CHUNK, NeighbourLists};
use crate::sph::neighbours::records::Record;
use crate::sph::terms::momentum::pair_stress;

impl PairLoop {
    /// Adds the pressure of bed, walls and other units across gaps to the accelerations of the unit particles. The
    /// arguments have the same meaning as in [`Self::rates`].
    ///
    /// The lists also contain the particles of the same unit. The forces between these particles cancel in the sum over
    /// the unit.
    pub fn add_gap_pressure(
        &self,
        lists: &NeighbourLists,
        records: &[Record],
        first_target: usize,
        rates: &mut [Rate],
    ) {
        rates.par_chunks_mut(CHUNK).zip(lists.chunks()).enumerate().for_each(|(number, (rates, chunk))| {
            let begin = first_target + number * CHUNK;
            let targets = &records[begin..begin + rates.len()];
            for (cluster, neighbours) in chunk.clusters() {
                for target in cluster.first as usize..(cluster.first + cluster.len) as usize {
                    let acceleration = self.pressure_acceleration(&targets[target], neighbours, records);
                    for (sum, part) in rates[target].acceleration.iter_mut().zip(acceleration) {
                        *sum += part as f32;
                    }
                }
            }
        });
    }

    /// Returns the pressure term of equation 1 for one target [m/s2]. The sum is in double precision, so that the
    /// internal forces of a unit cancel.
    fn pressure_acceleration(&self, a: &Record, neighbours: &[u32], records: &[Record]) -> [f64; 3] {
        let kernel = &self.parameters.kernel;
        let mut sum = [0.0; 3];
        for &j in neighbours {
            let b = &records[j as usize];
            let (r, distance) = self.distance(a, b);
            let g = kernel.gradient_factor(kernel.closeness(distance));
            let stress = pair_stress(f64::from(a.pressure), f64::from(b.pressure), 0.0) * f64::from(b.volume) * g;
            sum.iter_mut().zip(r).for_each(|(sum, r)| *sum += stress * r);
        }
        let rho_a = self.parameters.tait.rho0 + f64::from(a.excess_density);
        sum.map(|sum| -sum / rho_a)
    }
}
