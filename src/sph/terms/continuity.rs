//! Equation 2, continuity: d rho_a/dt = sum_b m_b v_ab . grad_a W_ab + D_a, where D_a is the density diffusion.
//! [`terms`](super) defines the other symbols.

use crate::sph::lanes::Real;

/// Adds the term of one neighbour b: returns `sum` + m_b v_ab . grad_a W_ab [kg/(m3 s)], with m_b = rho_b V_b and
/// v_ab . grad_a W_ab = (v_ab . r_ab) G. `v_dot_r` is v_ab . r_ab, and `gv` is G V_b, with G of the
/// [`kernel`](super::kernel) gradient.
#[inline(always)]
pub fn add_compression<R: Real>(sum: R, rho_b: R, v_dot_r: R, gv: R) -> R {
    (rho_b * gv).mul_add(v_dot_r, sum)
}
