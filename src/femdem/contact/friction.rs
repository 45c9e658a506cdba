//! Friction between two overlapping tetrahedra T and C: a tangential spring with a history.
//!
//! The friction force on C is F_t = -k_t d, with |F_t| <= mu F_n: Cundall & Strack (1979), Geotechnique 29, 47-65; for
//! FEMDEM Xiang, Latham & Farsi (2017), eqs. (4), (5). k_t is the tangential stiffness, mu the friction coefficient,
//! and F_n the magnitude of the contact force. The extension d of the spring follows the slip at the point of action of
//! the contact force. If k_t |d| exceeds mu F_n, d is shortened (return mapping). d is normal to the contact force.

use glam::{DQuat, DVec3, DVec4};

use super::overlap::Overlap;
use super::tetrahedron::Tetrahedron;

/// Friction parameters of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLaw {
    /// Tangential stiffness k_t [N/m]; it must not change while a spring is loaded.
    pub stiffness: f64,
    /// Friction coefficient mu [-].
    pub coefficient: f64,
}

/// Friction history of a pair in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialSpring {
    /// Extension d of the spring: elastic displacement of tetrahedron C relative to tetrahedron T [m].
    pub(super) extension: DVec3,
    /// Direction of the contact force on tetrahedron C at the last update of the extension.
    pub(super) normal: DVec3,
}

/// Friction forces and dissipation of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Forces on the vertices of T and of C [N].
    pub forces: [[DVec3; 4]; 2],
    /// Energy dissipated since the last call of [`TangentialSpring::advance`] [J].
    pub dissipated: f64,
}

impl TangentialSpring {
    /// Creates an unloaded spring. `contact_force` is the force on tetrahedron C; only its direction is used.
    pub fn new(contact_force: DVec3) -> Self {
        Self { extension: DVec3::ZERO, normal: contact_force.normalize_or_zero() }
    }

    /// Returns the energy of the spring, k_t d^2 / 2 [J]. This energy counts as dissipated when the contact ends.
    pub fn stored(&self, law: &FrictionLaw) -> f64 {
        0.5 * law.stiffness * self.extension.length_squared()
    }

    /// Updates the spring and returns the friction of the pair (T, C) at the end of a time step. `vertices` [m] and
    /// `overlap` refer to the end of the time step. `moves` are the displacements of the vertices in the time step [m],
    /// and `penalty` is the contact penalty p [Pa].
    ///
    /// Energy: the work of friction is the mean of the forces at the start and at the end of the time step, times the
    /// slip. If the contact does not rotate in the time step, this work is minus the sum of `dissipated` and the change
    /// of [`Self::stored`]. If the spring force reverses within a time step, the dissipation can be negative. It is
    /// then set to zero, and the energy balance has an error of the same amount.
    pub fn advance(
        &mut self,
        law: &FrictionLaw,
        overlap: &Overlap,
        penalty: f64,
        vertices: [&[DVec3; 4]; 2],
        moves: [&[DVec3; 4]; 2],
    ) -> Friction {
        let mut friction = Friction { forces: [[DVec3::ZERO; 4]; 2], dissipated: 0.0 };
        let [Some(t), Some(c)] = vertices.map(Tetrahedron::new) else {
            return friction;
        };
        let contact_force = penalty * overlap.resultant();
        self.turn(contact_force.normalize_or(self.normal), 0.5 * (rotation(&t, moves[0]) + rotation(&c, moves[1])));
        let at_centre = [t.shape_functions(overlap.centre), c.shape_functions(overlap.centre)];
        let slip = sum(moves[1], at_centre[1]) - sum(moves[0], at_centre[0]);
        friction.dissipated = self.stretch(law, slip, law.coefficient * contact_force.length());
        let on_c = -law.stiffness * self.extension;
        friction.forces = [at_centre[0].to_array().map(|n| -n * on_c), at_centre[1].to_array().map(|n| n * on_c)];
        friction
    }

    /// Rotates the spring from the old to the new contact normal. Then rotates it about the normal as the bodies
    /// rotate: `bodies` is the mean of the rotation vectors of T and C in the time step [rad].
    fn turn(&mut self, normal: DVec3, bodies: DVec3) {
        let with_normal = DQuat::from_rotation_arc(self.normal, normal);
        let about_normal = DQuat::from_axis_angle(normal, bodies.dot(normal));
        self.extension = about_normal * (with_normal * self.extension);
        self.normal = normal;
    }

    /// Extends the spring by a slip [m]. The spring force is limited to `cap` [N]. Returns the dissipated energy [J].
    fn stretch(&mut self, law: &FrictionLaw, slip: DVec3, cap: f64) -> f64 {
        let before = self.extension;
        let trial = (before + slip).reject_from_normalized(self.normal);
        self.extension = trial.clamp_length_max(cap / law.stiffness);
        let mean_force = 0.5 * law.stiffness * (before + self.extension);
        mean_force.dot(trial - self.extension).max(0.0)
    }
}

/// Returns the rotation vector of a tetrahedron [rad]: curl(u)/2, with the displacements u (`moves`) of its vertices.
fn rotation(tetrahedron: &Tetrahedron, moves: &[DVec3; 4]) -> DVec3 {
    0.5 * tetrahedron.gradients.iter().zip(moves).map(|(gradient, u)| gradient.cross(*u)).sum::<DVec3>()
}

/// Returns the weighted sum of vectors at the vertices.
fn sum(vectors: &[DVec3; 4], weights: DVec4) -> DVec3 {
    vectors.iter().zip(weights.to_array()).map(|(vector, weight)| weight * vector).sum()
}

#[cfg(test)]
mod tests {
    use super::super::overlap::overlap;
    use super::super::samples::{random_point, regular_tetrahedron};
    use super::*;
    use crate::random::SplitMix64;

    const LAW: FrictionLaw = FrictionLaw { stiffness: 2e9, coefficient: 0.6 };
    const PENALTY: f64 = 1e9;

    /// Returns a large tetrahedron and a small one on its top face. The small one lies `depth` [m] deep in this face,
    /// at the position `along` [m] on the x axis.
    fn tetrahedron_on_base(depth: f64, along: f64) -> [[DVec3; 4]; 2] {
        let base = [[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, -9.0]].map(DVec3::from_array);
        let corner = |angle: f64| DVec3::new(along + 0.5 * angle.cos(), 0.5 * angle.sin(), -depth);
        let third = std::f64::consts::TAU / 3.0;
        [base, [corner(0.0), corner(third), corner(2.0 * third), DVec3::new(along, 0.0, 0.7 - depth)]]
    }

    fn force_on(forces: &[DVec3; 4]) -> DVec3 {
        forces.iter().sum()
    }

    #[test]
    fn the_spring_follows_the_slip_up_to_the_cap() {
        let mut spring = TangentialSpring::new(DVec3::Z);
        let step = 1e-5;
        let (mut work, mut heat, mut before) = (0.0, 0.0, 0.0);
        for i in 1..=1000 {
            let pair = tetrahedron_on_base(0.01, f64::from(i) * step);
            let found = overlap(&pair[0], &pair[1]).unwrap();
            let moves = [&[DVec3::ZERO; 4], &[DVec3::X * step; 4]];
            let friction = spring.advance(&LAW, &found, PENALTY, [&pair[0], &pair[1]], moves);
            let force = force_on(&friction.forces[1]);
            let cap = LAW.coefficient * PENALTY * found.resultant().length();
            // Tolerance: the top face is horizontal, but the direction of the contact force has rounding errors.
            assert!((force.x + (LAW.stiffness * f64::from(i) * step).min(cap)).abs() < 1e-9 * cap);
            assert!((force_on(&friction.forces[0]) + force).length() < 1e-12 * cap);
            assert!(friction.dissipated >= 0.0);
            work += 0.5 * (before + force.x) * step;
            heat += friction.dissipated;
            before = force.x;
        }
        assert!(heat > 0.0);
        // Tolerance: only rounding, because the trapezoidal rule is exact here.
        assert!((work + heat + spring.stored(&LAW)).abs() < 1e-9 * heat, "{work} {heat}");
    }

    #[test]
    fn dissipation_is_never_negative_and_energy_balances_on_a_random_walk() {
        let mut random = SplitMix64::new(8);
        let mut spring = TangentialSpring::new(DVec3::Z);
        let (mut heat, mut work, mut force) = (0.0, 0.0, DVec3::ZERO);
        for _ in 0..10_000 {
            // The limit of the spring force, `cap`, varies from 50 to 100 N. A slip increment is at most 0.7 times the
            // extension at 50 N.
            let cap = 50.0 + 50.0 * random.next_share();
            let slip = (0.5 * 50.0 / LAW.stiffness) * random_point(&mut random).with_z(0.0);
            let released = spring.stretch(&LAW, slip, cap);
            assert!(released >= 0.0);
            let after = -LAW.stiffness * spring.extension;
            assert!(after.length() < cap * (1.0 + 1e-12));
            heat += released;
            work += 0.5 * (force + after).dot(slip);
            force = after;
        }
        assert!((work + heat + spring.stored(&LAW)).abs() < 1e-12 * heat);
    }

    #[test]
    fn the_spring_rotates_with_a_rigidly_rotating_pair() {
        let mut random = SplitMix64::new(9);
        for _ in 0..20 {
            let axis = random_point(&mut random).normalize();
            let start = tetrahedron_on_base(0.01, 0.0);
            let found = overlap(&start[0], &start[1]).unwrap();
            let mut spring = TangentialSpring::new(found.resultant());
            spring.extension = 1e-6 * DVec3::X;
            let steps = 2000;
            let turned = |i: u32| {
                let rotation = DQuat::from_axis_angle(axis, f64::from(i) / f64::from(steps));
                start.map(|tetrahedron| tetrahedron.map(|vertex| rotation * vertex))
            };
            for i in 1..=steps {
                let (before, now) = (turned(i - 1), turned(i));
                let moves = [0, 1].map(|b| std::array::from_fn(|v| now[b][v] - before[b][v]));
                let found = overlap(&now[0], &now[1]).unwrap();
                let friction = spring.advance(&LAW, &found, PENALTY, [&now[0], &now[1]], [&moves[0], &moves[1]]);
                assert_eq!(friction.dissipated, 0.0);
            }
            let expected = DQuat::from_axis_angle(axis, 1.0) * (1e-6 * DVec3::X);
            // Tolerance: 1e-3 times the extension of 1e-6 m, because the pair rotates in increments of 1/2000 rad.
            assert!((spring.extension - expected).length() < 1e-9, "{} {expected}", spring.extension);
        }
    }

    #[test]
    fn forces_have_no_resultant_and_no_moment() {
        let mut random = SplitMix64::new(10);
        for _ in 0..1000 {
            let t = regular_tetrahedron(DVec3::ZERO, 1.0);
            let q = random.next_rotation();
            let about = 0.4 * random_point(&mut random);
            let c = regular_tetrahedron(DVec3::ZERO, 1.0).map(|vertex| q * vertex + about);
            let Some(found) = overlap(&t, &c) else { continue };
            let mut spring = TangentialSpring::new(found.resultant());
            let moves = [0; 2].map(|_| [0; 4].map(|_| 1e-3 * random_point(&mut random)));
            let friction = spring.advance(&LAW, &found, PENALTY, [&t, &c], [&moves[0], &moves[1]]);
            let at = [(t, friction.forces[0]), (c, friction.forces[1])];
            let pairs = || at.iter().flat_map(|(vertices, forces)| vertices.iter().zip(forces));
            let largest = pairs().map(|(_, f)| f.length()).fold(0.0, f64::max);
            assert!(pairs().map(|(_, f)| *f).sum::<DVec3>().length() <= 1e-13 * largest);
            assert!(pairs().map(|(x, f)| x.cross(*f)).sum::<DVec3>().length() <= 1e-13 * largest);
        }
    }

    #[test]
    fn a_sliding_block_stops_after_v2_over_2_mu_g() {
        // With the initial speed v = 1 m/s, mu = 0.6 and g = 9.8 m/s2, the block stops after v^2 / (2 mu g) = 0.0850 m.
        // All vertices of the block have the same velocity, so the block does not rotate.
        let (mass, gravity, step) = (100.0, 9.8, 2e-5);
        let law = FrictionLaw { stiffness: 2e6, coefficient: 0.6 };
        // Bisection finds the depth `low` at which the contact force carries the weight.
        let (mut low, mut high) = (0.0, 0.1);
        for _ in 0..60 {
            let depth = 0.5 * (low + high);
            let pair = tetrahedron_on_base(depth, 0.0);
            let lift = overlap(&pair[0], &pair[1]).map_or(0.0, |found| PENALTY * found.resultant().z);
            if lift < mass * gravity { low = depth } else { high = depth }
        }
        let (mut x, mut v) = (DVec3::new(0.0, 0.0, -low), DVec3::X);
        let mut spring = TangentialSpring::new(DVec3::Z);
        let mut at_rest = 0;
        while at_rest < 100 {
            let pair = tetrahedron_on_base(-x.z, x.x);
            let found = overlap(&pair[0], &pair[1]).unwrap();
            let moves = [&[DVec3::ZERO; 4], &[v * step; 4]];
            let friction = spring.advance(&law, &found, PENALTY, [&pair[0], &pair[1]], moves);
            let force = PENALTY * found.resultant() + force_on(&friction.forces[1]);
            v += step * (force / mass - gravity * DVec3::Z);
            x += step * v;
            at_rest = if v.x.abs() < 1e-2 { at_rest + 1 } else { 0 };
        }
        // Tolerance: 1 % of the distance of 85 mm, because the spring first extends by mu m g / k_t = 0.3 mm.
        assert!((x.x / 0.0850 - 1.0).abs() < 0.01, "{}", x.x);
    }
}
