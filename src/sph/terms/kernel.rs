//! Quintic Wendland kernel W (Wendland 1995). The radius of its support is 2h.
//!
//! W = alpha_D (1 - q/2)^4 (2q + 1) for q = r/h <= 2, with the distance r of two particles a and b and the smoothing
//! length h. In three dimensions, alpha_D = 21 / (16 pi h^3). A two-dimensional flume is a single layer of particles
//! with thickness t. With alpha_D = 7 / (4 pi h^2 t), volumes, masses and forces keep their units, and every sum over
//! the layer equals the two-dimensional sum. The gradient with respect to r_a is grad_a W_ab = G(r) r_ab with
//! r_ab = r_a - r_b and G = -5 alpha_D / h^2 (1 - q/2)^3. This form needs no division by r.

use std::f64::consts::PI;

use crate::sph::lanes::Real;

/// Wendland kernel with a given smoothing length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wendland {
    /// Smoothing length h [m].
    pub h: f64,
    inv_2h: f32,
    alpha: f32,
    gradient: f32,
    /// Number of dimensions, 2 or 3.
    dimensions: u32,
}

impl Wendland {
    /// Creates the three-dimensional kernel with smoothing length `h` [m].
    pub fn new(h: f64) -> Self {
        Self::with_scale(h, 21.0 / (16.0 * PI * h.powi(3)), 3)
    }

    /// Creates the two-dimensional kernel with smoothing length `h` [m] for a layer of particles that is `thickness`
    /// [m] thick.
    pub fn in_layer(h: f64, thickness: f64) -> Self {
        Self::with_scale(h, 7.0 / (4.0 * PI * h * h * thickness), 2)
    }

    fn with_scale(h: f64, alpha: f64, dimensions: u32) -> Self {
        let gradient = -5.0 * alpha / (h * h);
        Self { h, inv_2h: (0.5 / h) as f32, alpha: alpha as f32, gradient: gradient as f32, dimensions }
    }

    /// Returns the number of dimensions: 2 for a layer of particles, otherwise 3.
    pub fn dimensions(&self) -> u32 {
        self.dimensions
    }

    /// Returns the radius of the support, 2h [m].
    pub fn support(&self) -> f64 {
        2.0 * self.h
    }

    /// Returns the closeness 1 - q/2 [-] for the distance r [m]; zero outside the support.
    #[inline(always)]
    pub fn closeness<R: Real>(&self, r: R) -> R {
        (R::splat(1.0) - r * R::splat(self.inv_2h)).max(R::splat(0.0))
    }

    /// Returns W [1/m3] from the closeness 1 - q/2.
    #[inline(always)]
    pub fn value<R: Real>(&self, closeness: R) -> R {
        R::splat(self.alpha) * self.shape(closeness)
    }

    /// Returns W [-] without its constant factor, [`Self::scale`], from the closeness 1 - q/2.
    #[inline(always)]
    pub fn shape<R: Real>(&self, closeness: R) -> R {
        let square = closeness * closeness;
        // The second factor is 2q + 1 = 5 - 4 (1 - q/2).
        square * square * closeness.mul_add(R::splat(-4.0), R::splat(5.0))
    }

    /// Returns alpha_D, the constant factor of W [1/m3].
    pub fn scale(&self) -> f32 {
        self.alpha
    }

    /// Returns G [1/m5] from the closeness 1 - q/2; grad_a W_ab = G r_ab.
    #[inline(always)]
    pub fn gradient_factor<R: Real>(&self, closeness: R) -> R {
        R::splat(self.gradient) * self.gradient_shape(closeness)
    }

    /// Returns G [-] without its constant factor, [`Self::gradient_scale`], from the closeness 1 - q/2.
    #[inline(always)]
    pub fn gradient_shape<R: Real>(&self, closeness: R) -> R {
        closeness * closeness * closeness
    }

    /// Returns -5 alpha_D / h^2, the constant factor of G [1/m5].
    #[inline(always)]
    pub fn gradient_scale(&self) -> f32 {
        self.gradient
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the integral of 4 pi r^2 f(r) over the support, by the midpoint rule.
    fn integral(h: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 20_000;
        let dr = 2.0 * h / f64::from(n);
        (0..n).map(|i| (f64::from(i) + 0.5) * dr).map(|r| 4.0 * PI * r * r * f(r) * dr).sum()
    }

    #[test]
    fn kernel_integrates_to_one() {
        let kernel = Wendland::new(0.02);
        // Limit 1e-6: the constants of the kernel are stored in single precision.
        assert!((integral(0.02, |r| kernel.value(kernel.closeness(r))) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn layer_kernel_integrates_to_one_over_the_layer() {
        let kernel = Wendland::in_layer(0.02, 0.01);
        // The factor 0.01 / (2 r) converts the area 4 pi r^2 in `integral` to 2 pi r times the thickness of 0.01 m.
        let over_layer = |r: f64| kernel.value(kernel.closeness(r)) * 0.01 / (2.0 * r);
        assert!((integral(0.02, over_layer) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn gradient_of_a_linear_field_is_exact() {
        // The gradient of the field x is exact if the integral of (grad W)_x (-x) over the volume is 1. By symmetry,
        // this integral is a third of the integral of -G r^2.
        let kernel = Wendland::new(0.02);
        let sum = integral(0.02, |r| -kernel.gradient_factor(kernel.closeness(r)) * r * r / 3.0);
        assert!((sum - 1.0).abs() < 1e-6);
    }

    #[test]
    fn gradient_is_the_derivative_of_the_kernel() {
        let kernel = Wendland::new(0.02);
        for r in [0.003, 0.017, 0.031] {
            let w = |r: f64| kernel.value(kernel.closeness(r));
            let difference = (w(r + 1e-6) - w(r - 1e-6)) / 2e-6;
            // Limit 1e-5: error of the difference quotient over 2e-6 m, and single-precision constants.
            let exact = kernel.gradient_factor(kernel.closeness(r)) * r;
            assert!((difference - exact).abs() < 1e-5 * exact.abs());
        }
    }

    #[test]
    fn kernel_vanishes_outside_the_support() {
        let kernel = Wendland::new(0.02);
        assert_eq!(kernel.value(kernel.closeness(0.041_f64)), 0.0);
        assert_eq!(kernel.gradient_factor(kernel.closeness(0.041_f64)), 0.0);
    }
}
