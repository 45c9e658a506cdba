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
//! Below a flat free surface at the distance s, evenly distributed particles have grad C = K n with the normal n and K(s),
//! the integral of W over the plane of the surface. By the divergence theorem, the moments
//! M = sum_b V_b r_ba (x) grad_a W_ab are C along the surface and C - s K across it, so the difference is s K. In d
//! dimensions, the sum div r = tr M is smaller than d by D = d (1 - C) + s K. D is above 0.25 where s < 0.91 h. There,
//! particles do not shift. Elsewhere, K is at most 1.1 times the difference divided by h. Therefore
//!
//!   g = grad C max(0, 1 - 1.1 (M_t - M_n) / (h |grad C|)),
//!
//! with the mean M_t of the moments across grad C and the moment M_n along it, and a flat surface causes no shift. If it
//! did, the shifts would lift the water and damp waves.
//!
//! A shift lowers the concentration, and with it the density: otherwise the densities, which follow all other motions,
//! would become too large, and the level of the water would rise. The sum of V_a C_a over all particles is
//! sum_ab V_a V_b W_ab, so it changes by 2 sum_a V_a grad C_a . dr_a. Half of this change happens at the particle that
//! moves, the other half at its neighbours. The density of the particle that moves takes both:
//!
//!   d rho / rho = 2 g . dr.

use glam::DVec3;

/// Measures of the particle distribution around a particle.
#[derive(Debug, Clone, Copy)]
pub struct Order {
    /// grad C [1/m].
    pub concentration_gradient: DVec3,
    /// div r [-]; the number of dimensions in a full neighbourhood.
    pub divergence: f64,
    /// n . M n with the direction n of grad C [-]; 1 in a full neighbourhood.
    pub along_gradient: f64,
}

/// Difference D of div r from the number of dimensions above which particles do not shift, because a free surface is
/// near [-].
const AT_SURFACE: f64 = 0.25;

/// Largest value of h K(s) / (M_t - M_n) below a flat free surface, where D is at most [`AT_SURFACE`] [-].
const FLAT_SURFACE: f64 = 1.1;

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
    /// Returns the part g of grad C that a flat free surface does not cause [1/m].
    pub fn disorder(&self, order: &Order) -> DVec3 {
        let dimensions = f64::from(self.dimensions);
        if order.divergence < dimensions - AT_SURFACE {
            return DVec3::ZERO;
        }
        let across_gradient = (order.divergence - order.along_gradient) / (dimensions - 1.0);
        let of_surface = FLAT_SURFACE * (across_gradient - order.along_gradient).max(0.0) / self.h;
        let all = order.concentration_gradient.length();
        if all > of_surface { order.concentration_gradient * (1.0 - of_surface / all) } else { DVec3::ZERO }
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
        let full = Order { concentration_gradient: DVec3::X, divergence: 3.1, along_gradient: 1.1 };
        let disorder = shifting.disorder(&full);
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
            for (i, plane) in planes.iter().enumerate().step_by(20) {
                let s = (i as f64 + 0.5) * width;
                let missing = planes[i..].iter().sum::<f64>() * width - 0.5 * plane * width;
                let order = |gradient: f64| Order {
                    concentration_gradient: DVec3::NEG_Z * gradient,
                    divergence: f64::from(dimensions) * (1.0 - missing) - s * plane,
                    along_gradient: 1.0 - missing - s * plane,
                };
                assert_eq!(shifting.disorder(&order(*plane)), DVec3::ZERO, "{dimensions} {}", s / h);
                // Twice this gradient shifts the particle if it is not at the surface: the explained part is at most
                // 1.1 s / h = 2.2 times the gradient of the surface, at the end of the kernel.
                let shifts = shifting.disorder(&order(2.3 * plane)).length() > 0.0;
                assert!(if shifts { s > 0.9 * h } else { s < 0.95 * h }, "{dimensions} {}", s / h);
            }
        }
    }
}
