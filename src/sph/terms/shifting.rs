//! Particle shifting (Lind et al. 2012; Skillen et al. 2013): particles move by
//!
//!   dr = -A h u dt g
//!
//! from dense to sparse regions of particles. A is a coefficient, h the smoothing length, dt the time step and g the
//! gradient of the particle concentration C = sum_b V_b W_ab, without the part that a free surface causes.
//! u = max_b |mu_ab| is the largest speed of approach of equation 3. Skillen et al. take the speed of the particle
//! instead, which depends on the motion of the observer, and is zero at a stagnation point, where the particles are
//! deformed most.
//!
//! Below a flat free surface at the distance s, evenly distributed particles have grad C = K(s) n with the normal n and
//! K(s), the integral of W over the plane of the surface. The sum div r = sum_b V_b r_ba . grad_a W_ab is there smaller
//! than the number of dimensions d, by D = d (1 - C) + s K (divergence theorem). For the Wendland kernel, h K is at most
//! c D at any s, with c = 0.65 in three and 0.83 in two dimensions. Therefore
//!
//!   g = grad C max(0, 1 - c D / (h |grad C|)),
//!
//! and a flat surface causes no shift. If it did, the shifts would lift the water and damp waves.
//!
//! A shift lowers the concentration, and with it the density: otherwise the densities, which follow all other motions,
//! would become too large, and the level of the water would rise. The sum of V_a C_a over all particles is
//! sum_ab V_a V_b W_ab, so it changes by 2 sum_a V_a grad C_a . dr_a. Half of this change happens at the particle that
//! moves, the other half at its neighbours. The density of the particle that moves takes both:
//!
//!   d rho / rho = 2 g . dr.

use glam::DVec3;

/// Largest value of h K(s) / D(s) below a flat free surface, in two and in three dimensions [-].
const FLAT_SURFACE: [f64; 2] = [0.83, 0.65];

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
    /// Returns the part g of grad C [1/m] that a flat free surface does not cause, from grad C [1/m] and div r [-].
    pub fn disorder(&self, concentration_gradient: DVec3, divergence: f64) -> DVec3 {
        let missing = (f64::from(self.dimensions) - divergence).max(0.0);
        let of_surface = FLAT_SURFACE[self.dimensions as usize - 2] * missing / self.h;
        let all = concentration_gradient.length();
        if all > of_surface { concentration_gradient * (1.0 - of_surface / all) } else { DVec3::ZERO }
    }

    /// Returns the velocity of the shift [m/s] from the speed of approach [m/s] and g [1/m].
    pub fn velocity(&self, approach: f64, disorder: DVec3) -> DVec3 {
        -self.coefficient * self.h * approach * disorder
    }

    /// Returns the shift [m] over a time step `dt` [s] with the given velocity [m/s].
    pub fn shift(&self, dt: f64, velocity: DVec3) -> DVec3 {
        (dt * velocity).clamp_length_max(MAX_SHIFT * self.dp)
    }

    /// Returns the relative change of the density by a shift [-], from the shift [m] and g [1/m]; or its rate [1/s] from
    /// the velocity of the shift [m/s].
    pub fn density_change(shift: DVec3, disorder: DVec3) -> f64 {
        2.0 * shift.dot(disorder)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sph::terms::kernel::Wendland;

    #[test]
    fn particles_shift_to_lower_concentration() {
        let shifting = Shifting { coefficient: 2.0, h: 0.02, dp: 0.01, dimensions: 3 };
        let disorder = shifting.disorder(DVec3::X, 3.1);
        let velocity = shifting.velocity(1.0, disorder);
        assert_eq!(disorder, DVec3::X);
        assert!((shifting.shift(1e-4, velocity) - DVec3::X * -4e-6).length() < 1e-18);
        assert!(shifting.shift(1e-1, 1e3 * velocity).length() <= 0.1 * 0.01 * (1.0 + 1e-12));
        assert!((Shifting::density_change(1e-4 * velocity, disorder) + 8e-6).abs() < 1e-18);
    }

    #[test]
    fn particles_near_a_flat_surface_do_not_shift() {
        // Moments of W over planes at the distance s from the particle, by the midpoint rule; q = r / h.
        let h = 0.02;
        for (dimensions, kernel) in [(2, Wendland::in_layer(h, 1.0)), (3, Wendland::new(h))] {
            let shifting = Shifting { coefficient: 2.0, h, dp: 0.01, dimensions };
            let cells = 400;
            let width = 2.0 * h / f64::from(cells);
            let over_plane = |s: f64| -> f64 {
                let radii = (0..cells).map(|i| (f64::from(i) + 0.5) * width);
                let ring = |t: f64| if dimensions == 3 { 2.0 * std::f64::consts::PI * t } else { 2.0 };
                radii.map(|t| kernel.value(kernel.closeness(t.hypot(s))) * ring(t) * width).sum()
            };
            let planes: Vec<f64> = (0..cells).map(|i| over_plane((f64::from(i) + 0.5) * width)).collect();
            for (i, plane) in planes.iter().enumerate().step_by(40) {
                let missing_concentration: f64 = planes[i..].iter().sum::<f64>() * width - 0.5 * plane * width;
                let s = (i as f64 + 0.5) * width;
                let missing = f64::from(dimensions) * missing_concentration + s * plane;
                let gradient = DVec3::NEG_Z * *plane;
                let full = f64::from(dimensions);
                assert_eq!(shifting.disorder(gradient, full - missing), DVec3::ZERO, "{dimensions} {}", s / h);
                // The explained part is not much larger than the gradient: limit 1.7 from the constants of the surface
                // (0.75 / 0.5 for s = 0 in three dimensions).
                assert!(shifting.disorder(1.7 * gradient, full - missing).length() > 0.0 || *plane * h < 1e-3);
            }
        }
    }
}
