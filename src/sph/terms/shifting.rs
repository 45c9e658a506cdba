//! Particle shifting (Lind et al. 2012; Skillen et al. 2013): particles move by
//!
//!   dr = -A h |v| dt grad C,   C = sum_b V_b W_ab,
//!
//! from dense to sparse regions of particles. A is a coefficient, h the smoothing length, v the velocity of the
//! particle, dt the time step and C the particle concentration. Near the free surface, the sum
//! div r = sum_b V_b r_ba . grad_a W_ab is smaller than in a full neighbourhood, and the shift decreases to zero.
//!
//! A shift lowers the concentration, and with it the density: otherwise the densities, which follow all other motions,
//! would become too large, and the level of the water would rise. The sum of V_a C_a over all particles is
//! sum_ab V_a V_b W_ab, so it changes by 2 sum_a V_a grad C_a . dr_a. Half of this change happens at the particle that
//! moves, the other half at its neighbours. The density of the particle that moves takes both:
//!
//!   d rho / rho = 2 grad C . dr.

use glam::DVec3;

/// Value of div r at which the shift becomes zero, in two and in three dimensions [-]. Particles with a smaller div r
/// count as free surface and are not shifted.
const SURFACE: [f64; 2] = [1.5, 2.75];

/// Largest shift in one time step, as a share of the particle spacing [-].
const MAX_SHIFT: f64 = 0.1;

/// Constants of the shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shifting {
    /// Coefficient A of the shift [-].
    pub coefficient: f64,
    /// Smoothing length [m].
    pub h: f64,
    /// Particle spacing [m].
    pub dp: f64,
    /// Number of dimensions, 2 or 3; div r of a full neighbourhood has the same value.
    pub dimensions: u32,
}

impl Shifting {
    /// Returns the shift [m] over a time step `dt` [s] from the speed [m/s], grad C [1/m] and div r [-].
    pub fn shift(&self, dt: f64, speed: f64, concentration_gradient: DVec3, divergence: f64) -> DVec3 {
        let (full, surface) = (f64::from(self.dimensions), SURFACE[self.dimensions as usize - 2]);
        let inside = ((divergence - surface) / (full - surface)).clamp(0.0, 1.0);
        let shift = -inside * self.coefficient * self.h * speed * dt * concentration_gradient;
        shift.clamp_length_max(MAX_SHIFT * self.dp)
    }

    /// Returns the density after a shift [m] divided by the density before it [-].
    pub fn density_ratio(shift: DVec3, concentration_gradient: DVec3) -> f64 {
        1.0 + 2.0 * shift.dot(concentration_gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn particles_shift_to_lower_concentration_except_at_the_free_surface() {
        let shifting = Shifting { coefficient: 2.0, h: 0.02, dp: 0.01, dimensions: 3 };
        let shift = shifting.shift(1e-4, 1.0, DVec3::X, 3.1);
        assert!((shift - DVec3::X * -4e-6).length() < 1e-18);
        assert_eq!(shifting.shift(1e-4, 1.0, DVec3::X, 2.5), DVec3::ZERO);
        assert!(shifting.shift(1e-1, 1e3, DVec3::X, 3.0).length() <= 0.1 * 0.01 * (1.0 + 1e-12));
    }
}
