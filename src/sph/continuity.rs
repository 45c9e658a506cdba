//! Equation 2: d rho_a/dt = sum_b m_b v_ab . grad_a W_ab + D.

use super::lanes::Real;

/// Returns `sum` + m_b v_ab . grad_a W_ab [kg/(m3 s)] with m_b = rho_b V_b and v_ab . grad_a W_ab = (v_ab . r_ab) G;
/// `gv` is G V_b.
#[inline(always)]
pub fn add_compression<R: Real>(sum: R, rho_b: R, v_dot_r: R, gv: R) -> R {
    (rho_b * gv).mul_add(v_dot_r, sum)
}
