//! Linear springs and dashpots for measured stiffnesses: F_n = k_n d - c_n v_n,
//! F_t = -(k_t d_t + c_t v_t), with the symbols of [`super::hertz_mindlin`].
//!
//! The ratio of tangential to normal stiffness is Mindlin's (1949): k_t / k_n = 2 (1 - nu)/(2 - nu).

use super::hertz_mindlin::damping_factor_of;

/// Stiffness ratio k_t / k_n of two materials with mean Poisson's ratio nu [-].
pub fn stiffness_ratio(nu: f64) -> f64 {
    2.0 * (1.0 - nu) / (2.0 - nu)
}

/// Damping factor |beta| for which an impact without tensile force has the restitution `e` [-].
pub fn damping_factor(e: f64) -> f64 {
    damping_factor_of(e, |x, v, beta| -x - 2.0 * beta * v)
}

/// Damping coefficient c = 2 |beta| sqrt(k m*) [N s/m], with the stiffness k and the effective mass m*.
pub fn damping(beta: f64, stiffness: f64, mass: f64) -> f64 {
    2.0 * beta * (stiffness * mass).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damping_matches_the_closed_form_of_schwager_and_poschel() {
        // Closed form without tension for an impact with the damping factor b < 1/sqrt 2 (Schwager & Poschel 2007):
        // e = exp(-b/sqrt(1 - b^2) (pi - atan2(2 b sqrt(1 - b^2), 1 - 2 b^2))).
        for b in [0.05f64, 0.2, 0.5, 0.7] {
            let root = (1.0 - b * b).sqrt();
            let e = (-b / root * (std::f64::consts::PI - (2.0 * b * root).atan2(1.0 - 2.0 * b * b))).exp();
            // Limit 1e-4: a tenth of the tolerance of the impact tests.
            assert!((damping_factor(e) - b).abs() < 1e-4, "{b} {e} {}", damping_factor(e));
        }
        assert_eq!(damping_factor(1.0), 0.0);
    }
}
