//! Stiffness and damping of the Hertz-Mindlin law (Sunday et al. 2020; Mitsui et al. 2023, equations 10 and 11).
//!
//! F_n = (2/3) S_n d - g_n v_n and F_t = -(S_t d_t + g_t v_t), with stiffnesses S, damping coefficients g, overlap d
//! [m], normal velocity v_n [m/s] (positive when the bodies separate), elongation d_t of the tangential spring [m] and
//! tangential velocity v_t [m/s]. [`super::contact_law`] limits both forces.
//!
//! Damping factor: |beta| = -ln e / sqrt(ln^2 e + pi^2) gives the restitution e if the law allows a tensile normal
//! force at the end of the contact. Here a tensile force is set to zero, and this formula would give a restitution of
//! 0.55 for e = 0.5. [`damping_factor`] therefore computes |beta| from the law without tension.

use std::f64::consts::PI;

use super::parameters::Material;

/// Effective Young's modulus E* [Pa]: 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
pub fn effective_young_modulus(a: &Material, b: &Material) -> f64 {
    let compliance = |m: &Material| (1.0 - m.poisson_ratio.powi(2)) / m.young_modulus;
    1.0 / (compliance(a) + compliance(b))
}

/// Effective shear modulus G* [Pa]: 1/G* = 2 (2 - nu_1)(1 + nu_1)/E_1 + 2 (2 - nu_2)(1 + nu_2)/E_2.
pub fn effective_shear_modulus(a: &Material, b: &Material) -> f64 {
    let compliance = |m: &Material| 2.0 * (2.0 - m.poisson_ratio) * (1.0 + m.poisson_ratio) / m.young_modulus;
    1.0 / (compliance(a) + compliance(b))
}

/// Normal stiffness S_n = 2 E* sqrt(R d) [N/m].
pub fn normal_stiffness(e_star: f64, radius: f64, overlap: f64) -> f64 {
    2.0 * e_star * (radius * overlap).sqrt()
}

/// Tangential stiffness S_t = 8 G* sqrt(R d) [N/m].
pub fn tangential_stiffness(g_star: f64, radius: f64, overlap: f64) -> f64 {
    8.0 * g_star * (radius * overlap).sqrt()
}

/// Damping coefficient g = 2 sqrt(5/6) |beta| sqrt(S m*) [N s/m], with the stiffness S and the effective mass m*.
pub fn damping(beta: f64, stiffness: f64, mass: f64) -> f64 {
    2.0 * (5.0f64 / 6.0).sqrt() * beta * (stiffness * mass).sqrt()
}

/// Largest overlap of an elastic impact with speed v [m/s] and effective mass m* [kg]:
/// d = (15 m* v^2 / (16 E* sqrt R))^(2/5) [m].
pub fn impact_overlap(e_star: f64, radius: f64, mass: f64, speed: f64) -> f64 {
    (15.0 * mass * speed * speed / (16.0 * e_star * radius.sqrt())).powf(0.4)
}

/// Damping factor |beta| of Sunday et al. (2020) for a law with tensile force: -ln e / sqrt(ln^2 e + pi^2) [-].
pub fn damping_factor_with_tension(e: f64) -> f64 {
    -e.ln() / (e.ln().powi(2) + PI * PI).sqrt()
}

/// Damping factor |beta| for which an impact without tensile force has the restitution `e` [-].
pub fn damping_factor(e: f64) -> f64 {
    damping_factor_of(e, |x, v, beta| -x.powf(1.5) - 5f64.sqrt() * beta * x.powf(0.25) * v)
}

/// Damping factor |beta| for which the dimensionless motion x'' = a(x, x', beta), x >= 0, has the restitution `e` [-].
pub(super) fn damping_factor_of(e: f64, acceleration: impl Fn(f64, f64, f64) -> f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // With beta = 4, the restitution is less than 0.02. For an even smaller `e`, the result is 4.
    let (mut low, mut high) = (0.0, 4.0);
    // 40 bisections resolve beta to 4e-12.
    for _ in 0..40 {
        let mid = 0.5 * (low + high);
        if tensionless_restitution(|x, v| acceleration(x, v, mid)) > e { low = mid } else { high = mid }
    }
    0.5 * (low + high)
}

/// Restitution of the dimensionless impact x'' = a(x, x'), x(0) = 0, x'(0) = 1, integrated until the force is zero. In
/// this form, the law does not depend on mass, stiffness or speed.
fn tensionless_restitution(acceleration: impl Fn(f64, f64) -> f64) -> f64 {
    let acceleration = |x: f64, v: f64| acceleration(x.max(0.0), v);
    // A contact lasts about 3.2 in dimensionless time. With this time step, the error of the restitution is far below
    // the required 1e-4.
    let h = 2e-3;
    let (mut x, mut v) = (0.0, 1.0);
    loop {
        let (k1x, k1v) = (v, acceleration(x, v));
        let (k2x, k2v) = (v + 0.5 * h * k1v, acceleration(x + 0.5 * h * k1x, v + 0.5 * h * k1v));
        let (k3x, k3v) = (v + 0.5 * h * k2v, acceleration(x + 0.5 * h * k2x, v + 0.5 * h * k2v));
        let (k4x, k4v) = (v + h * k3v, acceleration(x + h * k3x, v + h * k3v));
        x += h / 6.0 * (k1x + 2.0 * k2x + 2.0 * k3x + k4x);
        v += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
        if v < 0.0 && (x <= 0.0 || acceleration(x, v) >= 0.0) {
            return -v;
        }
        // The contact is overdamped: the body returns with almost no speed.
        if v.abs() < 1e-4 && acceleration(x, v).abs() < 1e-4 {
            return 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_form_damping_overestimates_tensionless_restitution() {
        let rebound = |beta: f64| tensionless_restitution(|x, v| -x.powf(1.5) - 5f64.sqrt() * beta * x.powf(0.25) * v);
        for e in [0.1, 0.3, 0.5, 0.8, 0.95] {
            // Limit 1e-4: a tenth of the tolerance of the impact tests.
            assert!((rebound(damping_factor(e)) - e).abs() < 1e-4);
            assert!(rebound(damping_factor_with_tension(e)) > e);
            assert!(damping_factor(e) > damping_factor_with_tension(e));
        }
        assert_eq!(damping_factor(1.0), 0.0);
        assert!(damping_factor(0.0).is_finite());
    }
}
