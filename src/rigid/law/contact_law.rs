//! Contact law of a pair of surfaces: stiffness, damping, Coulomb friction, rolling resistance.
//!
//! | law | normal | tangential |
//! | --- | --- | --- |
//! | Hertz-Mindlin (default) | [`super::hertz_mindlin`] | spring with history: stores the tangential displacement |
//! | linear | [`super::linear`], measured stiffness | spring with history |
//! | `chrono4` | Hertz with R = 0.1 m for every contact | spring of one substep; no force at speeds below 0.1 mm/s |
//!
//! The tangential force is limited to |F_t| <= mu F_n. If F_n would be negative, both forces are zero. At the sliding
//! speed v_t, mu = mu_k + (mu_s - mu_k) exp(-(v_t / v_c)^2); mu_s is the coefficient at rest, mu_k during sliding.
//! Rolling resistance is a spring whose torque M has the limit |M| <= mu_r R F_n, with the rolling coefficient mu_r and
//! the effective radius R (Ai et al. 2011).
//!
//! `chrono4` reproduces Mitsui et al. (2023). Chrono 4.0 uses one radius for all contacts between meshes and does not
//! store the tangential spring, so units creep under any load.

use glam::DVec3;

use super::parameters::{ContactModel, Material, Resistance};
use super::{hertz_mindlin, linear};

/// Sliding speed v_c of the transition from static to kinetic friction [m/s]. It is five times the speed with which
/// a unit at rest in water fluctuates (0.2 mm/s), and far below the speeds of moving units.
const TRANSITION_SPEED: f64 = 1e-3;
/// Radius of every contact under `chrono4` [m].
const CHRONO_RADIUS: f64 = 0.1;
/// Tangential speed below which friction is zero under `chrono4` [m/s].
const CHRONO_LEAST_SPEED: f64 = 1e-4;

/// Stiffness of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stiffness {
    /// Effective moduli E* and G* [Pa], effective radius R [m].
    Hertz { e_star: f64, g_star: f64, radius: f64 },
    /// Constant stiffnesses [N/m].
    Linear { normal: f64, tangential: f64 },
}

/// Contact law of one pair of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    stiffness: Stiffness,
    /// Damping factor |beta| [-].
    beta: f64,
    resistance: Resistance,
    /// Effective mass m* [kg].
    mass: f64,
    /// Effective radius R of the surfaces [m].
    radius: f64,
    /// True if the tangential spring is kept from substep to substep; false for `chrono4`.
    keeps_spring: bool,
}

/// Forces of a contact in one evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForces {
    /// Normal force F_n [N], never negative.
    pub normal: f64,
    /// Tangential force on the first body [N].
    pub tangential: DVec3,
    /// Elongation of the tangential spring, reduced to the friction limit [m].
    pub spring: DVec3,
    /// True if the tangential force reached the friction limit, or if the normal force is zero.
    pub sliding: bool,
}

/// Rolling resistance of a contact in one evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// Torque on the first body [N m].
    pub torque: DVec3,
    /// Rotation of the rolling spring, reduced to the rolling limit [rad].
    pub spring: DVec3,
    /// True if the torque reached the rolling limit.
    pub rolling: bool,
}

impl ContactLaw {
    /// Creates the contact law of two materials with their [damping factor](Self::damping_factor) `beta` [-]; `mass` [kg]
    /// and `radius` [m] are the effective values of the pair.
    pub fn new(
        model: ContactModel,
        a: &Material,
        b: &Material,
        resistance: Resistance,
        beta: f64,
        [mass, radius]: [f64; 2],
    ) -> Self {
        let hertz = |radius: f64| Stiffness::Hertz {
            e_star: hertz_mindlin::effective_young_modulus(a, b),
            g_star: hertz_mindlin::effective_shear_modulus(a, b),
            radius,
        };
        let stiffness = match model {
            ContactModel::HertzMindlin => hertz(radius),
            ContactModel::Chrono4 => hertz(CHRONO_RADIUS),
            ContactModel::Linear => {
                let normal = resistance.stiffness.unwrap_or_default();
                let ratio = linear::stiffness_ratio(0.5 * (a.poisson_ratio + b.poisson_ratio));
                Stiffness::Linear { normal, tangential: ratio * normal }
            }
        };
        Self { stiffness, beta, resistance, mass, radius, keeps_spring: model != ContactModel::Chrono4 }
    }

    /// Damping factor |beta| [-] of two materials; it takes milliseconds to compute. If `resistance` has no restitution,
    /// the smaller restitution of the two materials applies.
    pub fn damping_factor(model: ContactModel, a: &Material, b: &Material, resistance: Resistance) -> f64 {
        let restitution = resistance.restitution.unwrap_or(a.restitution.min(b.restitution));
        match model {
            ContactModel::HertzMindlin => hertz_mindlin::damping_factor(restitution),
            ContactModel::Chrono4 => hertz_mindlin::damping_factor_with_tension(restitution),
            ContactModel::Linear => linear::damping_factor(restitution),
        }
    }

    /// Returns true if the tangential spring is kept from substep to substep.
    pub fn keeps_spring(&self) -> bool {
        self.keeps_spring
    }

    /// Effective mass m* [kg].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Normal stiffness dF_n/dd at the given overlap [N/m].
    pub fn normal_stiffness(&self, overlap: f64) -> f64 {
        match self.stiffness {
            Stiffness::Hertz { e_star, radius, .. } => hertz_mindlin::normal_stiffness(e_star, radius, overlap),
            Stiffness::Linear { normal, .. } => normal,
        }
    }

    /// Stiffness of the tangential spring at the given overlap [N/m].
    pub fn tangential_stiffness(&self, overlap: f64) -> f64 {
        match self.stiffness {
            Stiffness::Hertz { g_star, radius, .. } => hertz_mindlin::tangential_stiffness(g_star, radius, overlap),
            Stiffness::Linear { tangential, .. } => tangential,
        }
    }

    fn damping(&self, stiffness: f64) -> f64 {
        match self.stiffness {
            Stiffness::Hertz { .. } => hertz_mindlin::damping(self.beta, stiffness, self.mass),
            Stiffness::Linear { .. } => linear::damping(self.beta, stiffness, self.mass),
        }
    }

    /// Elastic part of the normal force [N].
    pub fn elastic_force(&self, overlap: f64) -> f64 {
        match self.stiffness {
            Stiffness::Hertz { .. } => 2.0 / 3.0 * self.normal_stiffness(overlap) * overlap,
            Stiffness::Linear { normal, .. } => normal * overlap,
        }
    }

    /// Elastic energy of the normal force at the given overlap [J].
    pub fn normal_energy(&self, overlap: f64) -> f64 {
        let share = match self.stiffness {
            Stiffness::Hertz { .. } => 0.4,
            Stiffness::Linear { .. } => 0.5,
        };
        share * self.elastic_force(overlap) * overlap
    }

    /// Energy of the tangential spring [J]; 0 if the spring is not kept.
    pub fn tangential_energy(&self, overlap: f64, spring: DVec3) -> f64 {
        if self.keeps_spring { 0.5 * self.tangential_stiffness(overlap) * spring.length_squared() } else { 0.0 }
    }

    /// Largest overlap [m] of an elastic impact with the given normal speed [m/s].
    pub fn impact_overlap(&self, speed: f64) -> f64 {
        match self.stiffness {
            Stiffness::Hertz { e_star, radius, .. } => hertz_mindlin::impact_overlap(e_star, radius, self.mass, speed),
            Stiffness::Linear { normal, .. } => speed * (self.mass / normal).sqrt(),
        }
    }

    /// Friction coefficient mu at the given sliding speed [m/s].
    fn friction(&self, speed: f64) -> f64 {
        let Resistance { static_friction, kinetic_friction, .. } = self.resistance;
        kinetic_friction + (static_friction - kinetic_friction) * (-(speed / TRANSITION_SPEED).powi(2)).exp()
    }

    /// Computes the forces for an overlap d > 0 [m] and the elongation of the tangential spring [m]. v_n (positive
    /// when separating) and v_t are velocities of the first body relative to the second [m/s].
    pub fn forces(&self, overlap: f64, v_n: f64, v_t: DVec3, spring: DVec3) -> ContactForces {
        let s_n = self.normal_stiffness(overlap);
        let s_t = self.tangential_stiffness(overlap);
        let normal = self.elastic_force(overlap) - self.damping(s_n) * v_n;
        if normal <= 0.0 {
            return ContactForces { normal: 0.0, tangential: DVec3::ZERO, spring: DVec3::ZERO, sliding: true };
        }
        let speed = v_t.length();
        if !self.keeps_spring && speed < CHRONO_LEAST_SPEED {
            return ContactForces { normal, tangential: DVec3::ZERO, spring: DVec3::ZERO, sliding: false };
        }
        let trial = spring * s_t + v_t * self.damping(s_t);
        let limit = self.friction(speed) * normal;
        let size = trial.length();
        if size <= limit {
            return ContactForces { normal, tangential: -trial, spring, sliding: false };
        }
        // The same factor reduces spring and dashpot force. A spring that also carried the dashpot force would create
        // energy.
        let held = limit / size;
        ContactForces { normal, tangential: -trial * held, spring: spring * held, sliding: true }
    }

    /// Computes the rolling resistance for the normal force F_n [N], with the stiffness k_r = R^2 S_t and the damping
    /// coefficient c_r = R^2 g_t. `omega` [rad/s] and `spring` [rad] are perpendicular to the contact normal. `None` if
    /// the rolling coefficient is zero.
    pub fn rolling_resistance(&self, overlap: f64, normal: f64, omega: DVec3, spring: DVec3) -> Option<Rolling> {
        if self.resistance.rolling == 0.0 {
            return None;
        }
        let k = self.rolling_stiffness(overlap);
        let trial = spring * k + omega * (self.radius * self.radius * self.damping(self.tangential_stiffness(overlap)));
        let limit = self.resistance.rolling * self.radius * normal;
        let size = trial.length();
        if size <= limit {
            return Some(Rolling { torque: -trial, spring, rolling: false });
        }
        let held = limit / size;
        Some(Rolling { torque: -trial * held, spring: spring * held, rolling: true })
    }

    /// Rolling stiffness k_r = R^2 S_t at the given overlap [N m/rad].
    pub fn rolling_stiffness(&self, overlap: f64) -> f64 {
        self.radius * self.radius * self.tangential_stiffness(overlap)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Contact law of a ball on a fixed plane: R = 20 mm, E = 1 GPa, nu = 0.25, density 2650 kg/m3.
    fn law(model: ContactModel, e: f64) -> ContactLaw {
        let material = Material { young_modulus: 1e9, poisson_ratio: 0.25, restitution: e };
        let resistance = Resistance { rolling: 0.1, stiffness: Some(1e6), ..0.5.into() };
        let beta = ContactLaw::damping_factor(model, &material, &material, resistance);
        let mass = 2650.0 * 4.0 / 3.0 * PI * 0.02f64.powi(3);
        ContactLaw::new(model, &material, &material, resistance, beta, [mass, 0.02])
    }

    #[test]
    fn hertz_energy_is_the_integral_of_the_force() {
        let law = law(ContactModel::HertzMindlin, 1.0);
        let Stiffness::Hertz { e_star, g_star, radius } = law.stiffness else { panic!("Hertz") };
        assert!((e_star - 1e9 / (2.0 * (1.0 - 0.0625))).abs() < 1.0);
        assert!((g_star - 1e9 / (4.0 * 1.75 * 1.25)).abs() < 1.0);
        let k = 4.0 / 3.0 * e_star * radius.sqrt();
        let d = 261.3e-6;
        assert!((law.elastic_force(d) / (k * d.powf(1.5)) - 1.0).abs() < 1e-12);
        assert!((law.normal_energy(d) / (0.4 * k * d.powf(2.5)) - 1.0).abs() < 1e-12);
        // The reference value, 424.8 N, has four digits.
        assert!((law.elastic_force(law.impact_overlap(1.0)) / 424.8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn linear_impact_stores_its_kinetic_energy() {
        let law = law(ContactModel::Linear, 1.0);
        assert!((law.normal_energy(law.impact_overlap(2.0)) / (2.0 * law.mass) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn tangential_force_and_spring_are_limited_by_friction() {
        for model in [ContactModel::HertzMindlin, ContactModel::Linear] {
            let law = law(model, 1.0);
            let d = 1e-4;
            let s_t = law.tangential_stiffness(d);
            let limit = 0.5 * law.elastic_force(d);
            let below = law.forces(d, 0.0, DVec3::ZERO, DVec3::X * 0.9 * limit / s_t);
            assert!(!below.sliding && (below.tangential.x + 0.9 * limit).abs() < 1e-9 * limit);
            let above = law.forces(d, 0.0, DVec3::ZERO, DVec3::X * 5.0 * limit / s_t);
            assert!(above.sliding && (above.tangential.x + limit).abs() < 1e-9 * limit);
            assert!((above.spring.x * s_t / limit - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn friction_changes_from_static_to_kinetic() {
        let law = ContactLaw {
            resistance: Resistance { static_friction: 0.6, kinetic_friction: 0.4, ..0.0.into() },
            ..law(ContactModel::HertzMindlin, 1.0)
        };
        assert_eq!(law.friction(0.0), 0.6);
        assert!((law.friction(0.01) - 0.4).abs() < 1e-12);
        assert!((law.friction(TRANSITION_SPEED) - (0.4 + 0.2 / std::f64::consts::E)).abs() < 1e-12);
    }

    #[test]
    fn contact_force_is_never_tensile() {
        for model in [ContactModel::HertzMindlin, ContactModel::Linear, ContactModel::Chrono4] {
            let response = law(model, 0.3).forces(1e-6, 10.0, DVec3::X, DVec3::X * 1e-6);
            assert_eq!((response.normal, response.tangential, response.spring), (0.0, DVec3::ZERO, DVec3::ZERO));
        }
    }

    #[test]
    fn chrono4_has_no_friction_at_rest() {
        let law = law(ContactModel::Chrono4, 0.5);
        assert_eq!(law.forces(1e-4, 0.0, DVec3::X * 0.9e-4, DVec3::ZERO).tangential, DVec3::ZERO);
        assert!(law.forces(1e-4, 0.0, DVec3::X * 0.1, DVec3::X * 1e-6).tangential.x < 0.0);
        assert_eq!(law.tangential_energy(1e-4, DVec3::X), 0.0);
    }

    #[test]
    fn rolling_resistance_is_limited() {
        let law = law(ContactModel::HertzMindlin, 0.5);
        let k = law.rolling_stiffness(1e-4);
        let limit = 0.1 * 0.02 * 100.0;
        let held = law.rolling_resistance(1e-4, 100.0, DVec3::ZERO, DVec3::X * 0.5 * limit / k).unwrap();
        assert!(!held.rolling && (held.torque.x + 0.5 * limit).abs() < 1e-12);
        let rolls = law.rolling_resistance(1e-4, 100.0, DVec3::X, DVec3::X * 5.0 * limit / k).unwrap();
        assert!(rolls.rolling && (rolls.torque.x + limit).abs() < 1e-12);
        assert!(
            ContactLaw { resistance: 0.5.into(), ..law }.rolling_resistance(1e-4, 1.0, DVec3::X, DVec3::X).is_none()
        );
    }
}
