//! Equation 1: dv_a/dt = - sum_b m_b ((p_b + p_a)/(rho_b rho_a) + Pi_ab) grad_a W_ab + g.

use super::lanes::Real;

/// Returns the bracket of equation 1 times rho_a rho_b: p_a + p_b + rho_a rho_b Pi_ab [Pa]. The acceleration is
/// -1/rho_a sum_b V_b (...) grad_a W_ab with V_b = m_b / rho_b.
#[inline(always)]
pub fn pair_stress<R: Real>(p_a: R, p_b: R, viscous: R) -> R {
    p_a + p_b + viscous
}
