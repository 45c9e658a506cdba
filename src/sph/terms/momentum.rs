//! Equation 1, momentum: dv_a/dt = - sum_b m_b ((p_b + p_a)/(rho_b rho_a) + Pi_ab) grad_a W_ab + g.
//! Pi_ab is the viscous term (equation 3); [`terms`](super) defines the other symbols.

use crate::sph::lanes::Real;

/// Returns s_ab = p_a + p_b + rho_a rho_b Pi_ab [Pa], which is the bracket of equation 1 times rho_a rho_b. `viscous`
/// is the last term. The acceleration without gravity is -1/rho_a sum_b V_b s_ab grad_a W_ab with V_b = m_b / rho_b.
#[inline(always)]
pub fn pair_stress<R: Real>(p_a: R, p_b: R, viscous: R) -> R {
    p_a + p_b + viscous
}
