//! Equation 2: d rho_a/dt = sum_b m_b v_ab . grad_a W_ab + D.

use super::lanes::Real;

/// m_b v_ab . grad_a W_ab [kg/(m3 s)] with m_b = V_b rho_b and v_ab . grad_a W_ab = (v_ab . r_ab) G.
#[inline(always)]
pub fn compression<R: Real>(volume_b: R, rho_b: R, v_dot_r: R, g: R) -> R {
    volume_b * rho_b * v_dot_r * g
}
