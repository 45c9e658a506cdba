//! Equation 3: artificial viscosity (Monaghan 1992),
//! Pi_ab = (-alpha c_ab mu_ab + beta mu_ab^2) / rho_ab with mu_ab = h v_ab . r_ab / (r_ab^2 + 0.01 h^2) where
//! v_ab . r_ab < 0, else 0; alpha and beta are coefficients; c_ab and rho_ab are the mean speed of sound and the mean
//! density of the particles a and b. [`terms`](super) defines the other symbols. The linear part acts like a constant
//! viscosity. The quadratic part acts like a viscosity of the order of beta h^2 |S| with the strain rate S: forces on
//! bodies then go with the square of the velocity.
//!
//! The alternative is laminar viscosity nu, in two forms. The acceleration of Lo & Shao (2002),
//!
//!   sum_b m_b 4 nu (r_ab . grad_a W_ab) / ((rho_a + rho_b) r_ab^2) v_ab,
//!
//! acts along the velocity difference. The acceleration of Monaghan & Gingold (1983), with K = 2 (D + 2) in D
//! dimensions,
//!
//!   sum_b m_b 2 K nu / (rho_a + rho_b) (v_ab . r_ab) / (r_ab^2 + 0.01 h^2) grad_a W_ab,
//!
//! acts along the line between the particles. Inside the water, both forms converge to nu div grad v where div v = 0
//! (Espanol & Revenga 2003; Hu & Adams 2006). Only the second form conserves angular momentum. At a free surface, only
//! the second form has the dissipation of a Newtonian fluid: 2 rho nu S : S per volume with the strain rate S, not
//! rho nu |grad v|^2 (Colagrossi et al. 2011).

use super::turbulence::Smagorinsky;
use crate::sph::lanes::Real;

/// Viscosity model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viscosity {
    /// Artificial viscosity, equation 3.
    Artificial {
        /// Coefficient alpha of equation 3 [-].
        alpha: f64,
        /// Coefficient beta of the quadratic part [-].
        beta: f64,
    },
    /// Laminar viscosity (Lo & Shao 2002), with or without sub-particle-scale turbulence.
    Laminar {
        /// Kinematic viscosity nu [m2/s].
        nu: f64,
        /// Sub-particle-scale turbulence, if any.
        turbulence: Option<Smagorinsky>,
    },
    /// Laminar viscosity (Monaghan & Gingold 1983).
    MonaghanGingold {
        /// Kinematic viscosity nu [m2/s].
        nu: f64,
    },
}

/// Returns v_ab . r_ab / (r_ab^2 + 0.01 h^2), which is mu_ab / h [1/s] for any sign of v_ab . r_ab; negative for
/// particles that approach each other.
#[inline(always)]
pub fn approach_rate<R: Real>(h: f32, v_dot_r: R, r2: R) -> R {
    v_dot_r / (r2 + R::splat(0.01 * h * h))
}

/// Returns rho_a rho_b Pi_ab of equation 3 [Pa], never negative, because artificial viscosity resists only approach.
/// `coefficients` are alpha and beta; `rate` is the [`approach_rate`] [1/s].
#[inline(always)]
pub fn viscous_stress<R: Real>(coefficients: [f32; 2], h: f32, rate: R, c_a: R, c_b: R, rho_a: R, rho_b: R) -> R {
    // 0.5 is the factor of the mean density rho_ab, which replaces rho_a rho_b / rho_ab; the difference is
    // (rho_a - rho_b)^2 / (4 rho_ab). In weakly compressible flow, this difference is below 1e-5 of rho_ab, which is
    // less than single precision resolves in the sum.
    let [alpha, beta] = coefficients;
    let approach = rate.min(R::splat(0.0));
    let linear = R::splat(-0.25 * alpha * h) * (c_a + c_b);
    (rho_a + rho_b) * approach * R::splat(0.5 * beta * h * h).mul_add(approach, linear)
}

/// Returns the factor of v_ab in the acceleration of Lo & Shao, multiplied by rho_a / (V_b G) [Pa s]. Because
/// grad_a W_ab = G r_ab, the denominator r_ab^2 cancels. Therefore this form needs no term 0.01 h^2 in the denominator,
/// which would reduce the viscosity by 1 %.
#[inline(always)]
pub fn laminar_factor<R: Real>(nu: f32, rho_a: R, rho_b: R) -> R {
    R::splat(4.0 * nu) * rho_a * rho_b / (rho_a + rho_b)
}

/// Returns rho_a rho_b Pi_ab [Pa] of Monaghan & Gingold's form, Pi_ab = -2 K nu / (rho_a + rho_b) times the
/// [`approach_rate`] `rate` [1/s]. `k_nu` is K nu [m2/s]. The stress can have either sign, because this form also
/// resists separation.
#[inline(always)]
pub fn monaghan_gingold_stress<R: Real>(k_nu: f32, rate: R, rho_a: R, rho_b: R) -> R {
    R::splat(-2.0 * k_nu) * rate * rho_a * rho_b / (rho_a + rho_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn artificial_viscosity_resists_only_approach() {
        let h = 0.02_f32;
        let closing = approach_rate(h, -1e-3_f64, 1e-4);
        let separating = approach_rate(h, 1e-3_f64, 1e-4);
        assert_eq!(viscous_stress([0.04, 0.3], h, separating, 30.0, 30.0, 1000.0, 1000.0), 0.0);
        let stress = viscous_stress([0.04, 0.3], h, closing, 30.0, 30.0, 1000.0, 1010.0);
        // `exact` is equation 3 times rho_a rho_b. Limit 1e-4: replacement of rho_a rho_b / rho_ab by the mean density,
        // and single-precision constants.
        let mu = 0.02 * -1e-3 / (1e-4 + 0.01 * 0.02 * 0.02);
        let exact = (-0.04 * 30.0 * mu + 0.3 * mu * mu) / 1005.0 * 1000.0 * 1010.0;
        assert!((stress / exact - 1.0).abs() < 1e-4);
    }
}
