//! Damping zone: water that slows down before the end of the domain, so that waves do not come back.
//!
//! dv/dt = -f(x) v with f as in [`DampingZone::rate`] (after the passive absorption of Altomare et al. 2017, section 2.4;
//! Molteni et al. 2013 call such zones sponge layers). The equation is solved exactly over a step, after the forces have
//! been: v <- v exp(-f dt). No rate is too large for it, and what the water loses is known to rounding.

use rayon::prelude::*;

use super::Simulation;
use crate::{case::DampingZone, particles::water::Water};

/// Particles of one partial sum: sums over pieces of fixed length are the same for any number of threads.
const PIECE: usize = 4096;

impl Simulation {
    /// Slow the water in the damping zone down over a step of length `dt` [s] and book what it loses.
    pub(super) fn damp(&mut self, dt: f64) {
        if let Some(zone) = &self.case.domain.damping_zone {
            self.statistics.balance.damping += damp(&mut self.water, zone, dt);
        }
    }
}

/// Returns the energy that the water receives, which is negative [J].
fn damp(water: &mut Water, zone: &DampingZone, dt: f64) -> f64 {
    let pieces = (water.position.par_chunks(PIECE), water.velocity.par_chunks_mut(PIECE), water.mass.par_chunks(PIECE));
    let received: Vec<f64> = pieces
        .into_par_iter()
        .map(|(position, velocity, mass)| {
            let mut received = 0.0;
            for ((position, velocity), mass) in position.iter().zip(velocity).zip(mass) {
                if position.x > zone.x[0] {
                    let before = velocity.length_squared();
                    *velocity *= (-zone.rate(position.x) * dt).exp();
                    received += 0.5 * mass * (velocity.length_squared() - before);
                }
            }
            received
        })
        .collect();
    received.iter().sum()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn water_in_the_zone_slows_down_and_its_energy_is_booked() {
        let zone = DampingZone { x: [1.0, 3.0], coefficient: 8.0 };
        let mut water = Water::default();
        for x in [0.5, 2.0, 4.0] {
            water.position.push(DVec3::X * x);
            water.velocity.push(DVec3::new(3.0, 0.0, 4.0));
            water.mass.push(2.0);
        }
        let received = damp(&mut water, &zone, 0.1);
        let factors = water.velocity.iter().map(|v| v.length() / 5.0).collect::<Vec<_>>();
        for (factor, rate) in factors.iter().zip([0.0, 2.0, 8.0]) {
            assert!((factor - (-0.1_f64 * rate).exp()).abs() < 1e-14);
        }
        let energy: f64 = water.velocity.iter().map(|v| v.length_squared()).sum();
        assert!((received - (energy - 75.0)).abs() < 1e-12);
    }
}
