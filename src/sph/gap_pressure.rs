//! The pressure that reaches units through gaps too narrow for water particles.
//!
//! Where a foot stands on the bed, no particle fits below it; with the forces of the water alone its pressure would
//! press on the foot from above and never from below, and hold the unit down with several times its weight. Water does
//! reach such gaps and its pressure is continuous through them, so bed, walls and other units act on a unit with the
//! pressure term of equation 1, their densities being those of the water near by (see [`super::mdbc`]). Viscosity is
//! left out: dry friction is the contact's.

use rayon::prelude::*;

use super::{
    momentum::pair_stress,
    neighbours::{CHUNK, NeighbourLists},
    rates::{PairLoop, Rate},
    records::Record,
};

impl PairLoop {
    /// Add the pressure of bed, walls and other units, across gaps that hold no water particles, to the accelerations
    /// of the units; arguments as in [`Self::rates`].
    ///
    /// The unit's own particles are in the lists as well: their forces on each other cancel.
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

    /// The pressure term of equation 1 for one target, in double precision so that inner forces cancel [m/s2].
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
