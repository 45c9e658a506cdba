//! Damping and relaxation zones at the ends of the domain, in which the water approaches a target velocity v'.
//!
//! The velocity v of the water follows dv/dt = -f(x) (v - v'), with the rate f [1/s]. After the forces, the program
//! solves this equation exactly over a time step dt: v <- v' + (v - v') exp(-f dt). The solution is stable for any f.
//!
//! - Damping zone, v' = 0: it absorbs waves at the shoreward end (passive absorption of Altomare et al. 2017, section
//!   2.4; called sponge layer by Molteni et al. 2013).
//! - Relaxation zone, v' from the flume model: here the wave enters at the seaward end. The zone reflects a part of the
//!   waves that return from the structure (Altomare et al. 2018).

use glam::DVec3;
use rayon::prelude::*;

use crate::simulation::flume::Simulation;
use crate::sph::particles::water::Water;

/// Number of particles in a chunk. The chunks have a fixed length, so that sums do not depend on the number of threads.
const CHUNK: usize = 4096;

impl Simulation {
    /// Relaxes the water in the zones over a time step of length `dt` [s]. Adds the energy that the water receives to
    /// the energy balance.
    pub(crate) fn relax_in_zones(&mut self, dt: f64) {
        let end = self.flume_time() + dt;
        if let Some(zone) = &self.case.domain.damping_zone {
            self.statistics.balance.zones += relax(&mut self.water, |x| zone.rate(x), |_| DVec3::ZERO, dt);
        }
        if let (Some(zone), Some(flume)) = (&self.case.domain.relaxation_zone, &self.flume) {
            let of_flume = |p: DVec3| {
                let (u, w) = flume.velocity(p.x, p.z, end);
                DVec3::new(u, 0.0, w)
            };
            self.statistics.balance.zones += relax(&mut self.water, |x| zone.rate(x), of_flume, dt);
        }
    }
}

/// Relaxes the velocities of the water to `target` [m/s], a function of position [m], at the `rate` [1/s], a function
/// of x [m]. Returns the energy received by the water [J].
fn relax(water: &mut Water, rate: impl Fn(f64) -> f64 + Sync, target: impl Fn(DVec3) -> DVec3 + Sync, dt: f64) -> f64 {
    let chunks = (water.position.par_chunks(CHUNK), water.velocity.par_chunks_mut(CHUNK), water.mass.par_chunks(CHUNK));
    let received: Vec<f64> = chunks
        .into_par_iter()
        .map(|(position, velocity, mass)| {
            let mut received = 0.0;
            for ((position, velocity), mass) in position.iter().zip(velocity).zip(mass) {
                let rate = rate(position.x);
                if rate > 0.0 {
                    let before = velocity.length_squared();
                    let target = target(*position);
                    *velocity = target + (*velocity - target) * (-rate * dt).exp();
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
    use super::*;
    use crate::case::DampingZone;

    #[test]
    fn water_in_a_zone_approaches_the_target_velocity_and_its_energy_is_counted() {
        let zone = DampingZone { x: [1.0, 3.0], coefficient: 8.0 };
        let mut water = Water::default();
        for x in [0.5, 2.0, 4.0] {
            water.position.push(DVec3::X * x);
            water.velocity.push(DVec3::new(3.0, 0.0, 4.0));
            water.mass.push(2.0);
        }
        let target = DVec3::new(1.0, 0.0, 4.0);
        let received = relax(&mut water, |x| zone.rate(x), |_| target, 0.1);
        for (velocity, rate) in water.velocity.iter().zip([0.0, 2.0, 8.0]) {
            assert!((*velocity - target - DVec3::X * 2.0 * (-0.1_f64 * rate).exp()).length() < 1e-14);
        }
        let energy: f64 = water.velocity.iter().map(|v| v.length_squared()).sum();
        assert!((received - (energy - 75.0)).abs() < 1e-12);
    }
}
