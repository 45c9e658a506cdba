//! Contact law: Hertz normal force, Mindlin tangential force, Coulomb's limit (Sunday et al. 2020; Mitsui et al. 2023,
//! equations 10 and 11).
//!
//! F_n = (2/3) S_n d - g_n v_n and F_t = S_t d_t + g_t v_t with |F_t| <= mu F_n; F_n < 0 makes both zero.
//! d overlap [m], v_n normal velocity [m/s] (positive when the bodies part), d_t tangential spring [m], v_t tangential
//! velocity [m/s].
//!
//! The damping factor: beta = ln e / sqrt(ln^2 e + pi^2) gives the restitution e for a contact that may pull at its
//! end. Here it may not, and that formula would give 0.55 for e = 0.5. [`damping_factor`] inverts the restitution of
//! the law as it is used, so that what comes out is what was put in.

use std::f64::consts::PI;

use glam::DVec3;

/// Elastic constants of a material in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio nu [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution e [-].
    pub restitution: f64,
}

/// 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [1/Pa], returned as E* [Pa].
pub fn effective_young_modulus(a: &Material, b: &Material) -> f64 {
    let compliance = |m: &Material| (1.0 - m.poisson_ratio.powi(2)) / m.young_modulus;
    1.0 / (compliance(a) + compliance(b))
}

/// 1/G* = 2 (2 - nu_1)(1 + nu_1)/E_1 + 2 (2 - nu_2)(1 + nu_2)/E_2 [1/Pa], returned as G* [Pa].
pub fn effective_shear_modulus(a: &Material, b: &Material) -> f64 {
    let compliance = |m: &Material| 2.0 * (2.0 - m.poisson_ratio) * (1.0 + m.poisson_ratio) / m.young_modulus;
    1.0 / (compliance(a) + compliance(b))
}

/// S_n = 2 E* sqrt(R d) [N/m].
pub fn normal_stiffness(e_star: f64, radius: f64, overlap: f64) -> f64 {
    2.0 * e_star * (radius * overlap).sqrt()
}

/// S_t = 8 G* sqrt(R d) [N/m].
pub fn tangential_stiffness(g_star: f64, radius: f64, overlap: f64) -> f64 {
    8.0 * g_star * (radius * overlap).sqrt()
}

/// g = 2 sqrt(5/6) |beta| sqrt(S m*) [N s/m].
pub fn damping(beta: f64, stiffness: f64, mass: f64) -> f64 {
    2.0 * (5.0f64 / 6.0).sqrt() * beta * (stiffness * mass).sqrt()
}

/// Largest overlap of an elastic impact at speed v: d = (15 m* v^2 / (16 E* sqrt R))^(2/5) [m].
pub fn impact_overlap(e_star: f64, radius: f64, mass: f64, speed: f64) -> f64 {
    (15.0 * mass * speed * speed / (16.0 * e_star * radius.sqrt())).powf(0.4)
}

/// |beta| of Sunday et al.: -ln e / sqrt(ln^2 e + pi^2) [-].
pub fn damping_factor_with_pull(e: f64) -> f64 {
    -e.ln() / (e.ln().powi(2) + PI * PI).sqrt()
}

/// |beta| for which an impact whose force ends when it would begin to pull has the restitution `e` [-].
pub fn damping_factor(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // 4 is past the damping at which 2 % of the speed is left; a smaller restitution than that cannot be told apart.
    let (mut low, mut high) = (0.0, 4.0);
    // 40 halvings: 4e-12.
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if restitution_without_pull(middle) > e { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Restitution of x'' = -x^(3/2) - sqrt(5) beta x^(1/4) x', x(0) = 0, x'(0) = 1, up to the time at which the force
/// vanishes: the law in units of the impact, in which it does not depend on mass, stiffness or speed.
fn restitution_without_pull(beta: f64) -> f64 {
    let acceleration = |x: f64, v: f64| {
        let x = x.max(0.0);
        -x.powf(1.5) - 5f64.sqrt() * beta * x.powf(0.25) * v
    };
    // A contact lasts about 3.2; the step is refined by the fourth-order method far below the 1e-4 that matters.
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
        // Overdamped: the body creeps back and no speed is left.
        if v.abs() < 1e-4 && acceleration(x, v).abs() < 1e-4 {
            return 0.0;
        }
    }
}

/// Constants of the contact of one pair of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// Effective Young's modulus E* [Pa].
    pub e_star: f64,
    /// Effective shear modulus G* [Pa].
    pub g_star: f64,
    /// Damping factor |beta| [-].
    pub beta: f64,
    /// Coulomb's coefficient mu [-].
    pub friction: f64,
    /// Effective mass m* [kg].
    pub mass: f64,
    /// Effective radius R [m].
    pub radius: f64,
}

/// What a contact does in one evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Normal force F_n [N], never negative.
    pub normal: f64,
    /// Tangential force on the body whose velocity was given [N].
    pub tangential: DVec3,
    /// Tangential spring after the limit was applied [m].
    pub spring: DVec3,
    /// Whether the limit was reached.
    pub sliding: bool,
}

impl ContactLaw {
    /// Law of two materials; the smaller restitution of the two counts.
    pub fn new(a: &Material, b: &Material, friction: f64, mass: f64, radius: f64) -> Self {
        Self {
            e_star: effective_young_modulus(a, b),
            g_star: effective_shear_modulus(a, b),
            beta: damping_factor(a.restitution.min(b.restitution)),
            friction,
            mass,
            radius,
        }
    }

    /// S_n at the given overlap [N/m].
    pub fn normal_stiffness(&self, overlap: f64) -> f64 {
        normal_stiffness(self.e_star, self.radius, overlap)
    }

    /// Elastic part (2/3) S_n d of the normal force [N].
    pub fn elastic_force(&self, overlap: f64) -> f64 {
        2.0 / 3.0 * self.normal_stiffness(overlap) * overlap
    }

    /// Energy stored by the overlap, (2/5) F d [J].
    pub fn normal_energy(&self, overlap: f64) -> f64 {
        0.4 * self.elastic_force(overlap) * overlap
    }

    /// Energy stored by the tangential spring, S_t d_t^2 / 2 [J].
    pub fn tangential_energy(&self, overlap: f64, spring: DVec3) -> f64 {
        0.5 * tangential_stiffness(self.g_star, self.radius, overlap) * spring.length_squared()
    }

    /// Forces for an overlap d > 0, normal velocity v_n (positive when parting), tangential velocity and spring.
    pub fn respond(&self, overlap: f64, v_n: f64, v_t: DVec3, spring: DVec3) -> Response {
        let s_n = self.normal_stiffness(overlap);
        let s_t = tangential_stiffness(self.g_star, self.radius, overlap);
        let normal = 2.0 / 3.0 * s_n * overlap - damping(self.beta, s_n, self.mass) * v_n;
        if normal <= 0.0 {
            return Response { normal: 0.0, tangential: DVec3::ZERO, spring: DVec3::ZERO, sliding: true };
        }
        let trial = spring * s_t + v_t * damping(self.beta, s_t, self.mass);
        let limit = self.friction * normal;
        let size = trial.length();
        if size <= limit {
            return Response { normal, tangential: -trial, spring, sliding: false };
        }
        let held = trial * (limit / size);
        Response { normal, tangential: -held, spring: held / s_t, sliding: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mass on a fixed plane, R 20 mm, E 1 GPa, nu 0.25, rho 2650 kg/m3.
    fn law(e: f64) -> ContactLaw {
        let material = Material { young_modulus: 1e9, poisson_ratio: 0.25, restitution: e };
        ContactLaw::new(&material, &material, 0.5, 2650.0 * 4.0 / 3.0 * PI * 0.02f64.powi(3), 0.02)
    }

    #[test]
    fn moduli_of_equal_materials() {
        let law = law(1.0);
        assert!((law.e_star - 1e9 / (2.0 * (1.0 - 0.0625))).abs() < 1.0);
        assert!((law.g_star - 1e9 / (4.0 * 1.75 * 1.25)).abs() < 1.0);
    }

    #[test]
    fn force_is_hertz_and_its_energy_is_its_integral() {
        let law = law(1.0);
        let k = 4.0 / 3.0 * law.e_star * law.radius.sqrt();
        let d = 261.3e-6;
        assert!((law.elastic_force(d) / (k * d.powf(1.5)) - 1.0).abs() < 1e-12);
        assert!((law.normal_energy(d) / (0.4 * k * d.powf(2.5)) - 1.0).abs() < 1e-12);
        // Reference figures are given to four digits.
        assert!((law.elastic_force(impact_overlap(law.e_star, law.radius, law.mass, 1.0)) / 424.8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn without_pull_the_closed_form_gives_too_much() {
        for e in [0.1, 0.3, 0.5, 0.8, 0.95] {
            // 1e-4: a tenth of what the impact tests ask for.
            assert!((restitution_without_pull(damping_factor(e)) - e).abs() < 1e-4);
            assert!(restitution_without_pull(damping_factor_with_pull(e)) > e);
            assert!(damping_factor(e) > damping_factor_with_pull(e));
        }
        assert_eq!(damping_factor(1.0), 0.0);
        assert!(damping_factor(0.0).is_finite());
    }

    #[test]
    fn tangential_force_holds_up_to_the_limit_and_the_spring_follows() {
        let law = law(1.0);
        let d = 1e-4;
        let s_t = tangential_stiffness(law.g_star, law.radius, d);
        let limit = law.friction * law.elastic_force(d);
        let below = law.respond(d, 0.0, DVec3::ZERO, DVec3::X * 0.9 * limit / s_t);
        assert!(!below.sliding && (below.tangential.x + 0.9 * limit).abs() < 1e-9 * limit);
        let above = law.respond(d, 0.0, DVec3::ZERO, DVec3::X * 5.0 * limit / s_t);
        assert!(above.sliding && (above.tangential.x + limit).abs() < 1e-9 * limit);
        assert!((above.spring.x * s_t / limit - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_contact_never_pulls() {
        let response = law(0.3).respond(1e-6, 10.0, DVec3::X, DVec3::X * 1e-6);
        assert_eq!((response.normal, response.tangential, response.spring), (0.0, DVec3::ZERO, DVec3::ZERO));
    }
}
