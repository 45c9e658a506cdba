//! Equation 3: artificial viscosity (Monaghan 1992),
//! Pi_ab = -alpha c_ab mu_ab / rho_ab with mu_ab = h v_ab . r_ab / (r_ab^2 + 0.01 h^2) where v_ab . r_ab < 0, else 0;
//! c_ab and rho_ab are means of the pair.
//!
//! Or the viscosity of the fluid itself, in one of two forms. Lo & Shao (2002), the acceleration
//!
//!   sum_b m_b 4 nu (r_ab . grad_a W_ab) / ((rho_a + rho_b) r_ab^2) v_ab,
//!
//! acts along the difference of the velocities; Monaghan & Gingold (1983), in D dimensions with K = 2 (D + 2),
//!
//!   sum_b m_b 2 K nu / (rho_a + rho_b) (v_ab . r_ab) / (r_ab^2 + 0.01 h^2) grad_a W_ab,
//!
//! along the line between the particles. Inside the water both tend to nu laplace v where div v = 0 (Espanol & Revenga
//! 2003; Hu & Adams 2006). But only the second conserves angular momentum, and at a free surface it alone takes what
//! the stress of a Newtonian fluid takes: 2 mu S : S a volume, and not mu |grad v|^2 (Colagrossi et al. 2011).

use super::{lanes::Real, turbulence::Smagorinsky};

/// Resistance of the water to shear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viscosity {
    /// Equation 3.
    Artificial {
        /// alpha [-].
        alpha: f64,
    },
    /// Of the fluid (Lo & Shao 2002), with or without sub-particle-scale turbulence.
    Laminar {
        /// Kinematic viscosity nu [m2/s].
        nu: f64,
        /// Turbulence.
        turbulence: Option<Smagorinsky>,
    },
    /// Of the fluid (Monaghan & Gingold 1983).
    MonaghanGingold {
        /// Kinematic viscosity nu [m2/s].
        nu: f64,
    },
}

/// mu_ab / h [1/s], negative for particles that approach.
#[inline(always)]
pub fn approach_rate<R: Real>(h: f32, v_dot_r: R, r2: R) -> R {
    v_dot_r / (r2 + R::splat(0.01 * h * h))
}

/// rho_a rho_b Pi_ab [Pa]; never negative: it only resists approach.
#[inline(always)]
pub fn viscous_stress<R: Real>(alpha: f32, h: f32, rate: R, c_a: R, c_b: R, rho_a: R, rho_b: R) -> R {
    // The two halves of the means in one constant. rho_a rho_b / rho_ab differs from the mean density by
    // (rho_a - rho_b)^2 / 4 rho_ab, below 1e-5 of it in weakly compressible flow: less than single precision resolves
    // in the sum.
    (c_a + c_b) * (rho_a + rho_b) * (R::splat(-0.25 * alpha * h) * rate.min(R::splat(0.0)))
}

/// Factor of v_ab in the laminar acceleration times rho_a / (V_b G) [Pa s]. With grad_a W_ab = G r_ab the term has no
/// singularity, and 0.01 h^2, which would take 1 % from the viscosity, is left out.
#[inline(always)]
pub fn laminar_factor<R: Real>(nu: f32, rho_a: R, rho_b: R) -> R {
    R::splat(4.0 * nu) * rho_a * rho_b / (rho_a + rho_b)
}

/// rho_a rho_b Pi_ab [Pa] of Monaghan & Gingold's form, Pi_ab = -2 K nu / (rho_a + rho_b) times the [`approach_rate`]
/// [1/s], of either sign: it resists parting as well.
#[inline(always)]
pub fn monaghan_gingold_stress<R: Real>(k_nu: f32, rate: R, rho_a: R, rho_b: R) -> R {
    R::splat(-2.0 * k_nu) * rate * rho_a * rho_b / (rho_a + rho_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resists_approach_only() {
        let h = 0.02_f32;
        let closing = approach_rate(h, -1e-3_f64, 1e-4);
        let parting = approach_rate(h, 1e-3_f64, 1e-4);
        assert_eq!(viscous_stress(0.04, h, parting, 30.0, 30.0, 1000.0, 1000.0), 0.0);
        let stress = viscous_stress(0.04, h, closing, 30.0, 30.0, 1000.0, 1010.0);
        // Equation 3 written out, times rho_a rho_b; 1e-4: the mean density above, and constants in single precision.
        let mu = 0.02 * -1e-3 / (1e-4 + 0.01 * 0.02 * 0.02);
        let exact = -0.04 * 30.0 * mu / 1005.0 * 1000.0 * 1010.0;
        assert!((stress / exact - 1.0).abs() < 1e-4);
    }
}
