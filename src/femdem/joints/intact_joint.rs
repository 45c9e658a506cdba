//! Forces of intact joints (without damage or plastic slip). Most joints remain intact during a run, so the code
//! computes four of them at a time in SIMD lanes.
//!
//! Except for rounding, these forces equal those of [`super::joint::forces`] with a new, undamaged state. If a joint
//! reaches its strength, this module only reports the joint, and [`super::joint::forces`] computes its forces.

use crate::femdem::material::cohesive_law::Cohesion;
use crate::femdem::parallel::lanes::{Lanes, Vectors};

/// Cohesive laws of the joints in the SIMD lanes.
#[derive(Debug, Clone, Copy)]
pub struct IntactLaw<L> {
    /// Joint penalty p_0 [Pa].
    penalty: L,
    tensile: L,
    /// 1 / (2 f_t), with the tensile strength f_t [1/Pa].
    per_tensile: L,
    cohesion: L,
    friction: L,
}

/// Forces of the joints in the SIMD lanes.
#[derive(Debug, Clone, Copy)]
pub struct IntactForces<L> {
    /// Forces on the corners of side 0 [N]; the forces on side 1 are opposite.
    pub forces: [Vectors<L>; 3],
    /// Positive if the opening of a joint exceeds its opening at peak stress, or its shear stress exceeds the shear
    /// strength. The forces of this joint are then not valid.
    pub beyond: L,
}

impl<L: Lanes> IntactLaw<L> {
    /// Builds the laws from a function of the lane number.
    #[inline(always)]
    pub fn from_fn<'a>(f: impl Fn(usize) -> &'a Cohesion) -> Self {
        Self {
            penalty: L::from_fn(|lane| f(lane).penalty),
            tensile: L::from_fn(|lane| f(lane).strength.tensile),
            per_tensile: L::from_fn(|lane| 0.5 / f(lane).strength.tensile),
            cohesion: L::from_fn(|lane| f(lane).strength.cohesion),
            friction: L::from_fn(|lane| f(lane).strength.friction),
        }
    }

    /// Computes the forces from mean edge lengths h [m], undeformed areas [m2] and the corners of both sides [m].
    #[inline(always)]
    pub fn forces(&self, edge: L, area: L, [a, b]: &[[Vectors<L>; 3]; 2]) -> IntactForces<L> {
        let jump = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        // Twice the first corner of the mid-surface. The factor 2 does not change the direction of `normal`.
        let corner = a[0] + b[0];
        let normal = (a[1] + b[1] - corner).cross(a[2] + b[2] - corner);
        let normal = normal * (L::splat(1.0) / normal.dot(normal).sqrt());
        let stiffness = self.penalty / edge;
        let half = L::splat(0.5);
        let p = self.respond(stiffness, (jump[0] + jump[1]) * half, normal);
        let q = self.respond(stiffness, (jump[1] + jump[2]) * half, normal);
        let r = self.respond(stiffness, (jump[2] + jump[0]) * half, normal);
        // Each integration point represents a third of the area. Each end of its edge gets half of its force.
        let share = area * L::splat(1.0 / 6.0);
        IntactForces {
            forces: [(p.0 + r.0) * share, (p.0 + q.0) * share, (q.0 + r.0) * share],
            beyond: p.1.max(q.1).max(r.1),
        }
    }

    /// Returns the traction [Pa] for a jump of the positions [m] (eq. 2 for the opening, elastic slip), and a number
    /// that is positive if the joint is no longer intact.
    #[inline(always)]
    fn respond(&self, stiffness: L, jump: Vectors<L>, normal: Vectors<L>) -> (Vectors<L>, L) {
        let zero = L::splat(0.0);
        let opening = jump.dot(normal);
        let slip_squared = jump.dot(jump) - opening * opening;
        let elastic = stiffness * opening;
        // delta is the opening, delta_np the opening at peak stress, and K = 2 f_t / delta_np the stiffness. The ratio
        // r = delta / delta_np is then K delta / (2 f_t), and the normal stress of eq. 2, f_t (2 - r) r, is
        // K delta (1 - r / 2).
        let r = (elastic * self.per_tensile).max(zero);
        let stress = elastic - elastic * (r * L::splat(0.5));
        let strength = (self.cohesion - stress.min(self.tensile) * self.friction).max(zero);
        let sliding = stiffness * stiffness * slip_squared - strength * strength;
        (jump * stiffness + normal * (stress - elastic), sliding.max(r - L::splat(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::joint::{self, JointState};
    use super::*;
    use crate::femdem::material::Strength;
    use crate::femdem::material::cohesive_law::Range;
    use crate::femdem::parallel::lanes::{LANES, Portable};
    use crate::random::SplitMix64;

    #[test]
    fn intact_joint_forces_equal_those_of_the_general_joint() {
        let strength =
            Strength { tensile: 3.3e6, cohesion: 16.5e6, friction: 0.577, opening_energy: 50.0, sliding_energy: 50.0 };
        let cohesion = Cohesion { strength, penalty: 50.0 * 26e9, range: Range::Exact, tied: false };
        let corners = [DVec3::ZERO, DVec3::new(0.03, 0.0, 0.004), DVec3::new(0.002, 0.028, 0.0)];
        let (edge, area) = joint::size(&corners);
        let mut random = SplitMix64::new(5);
        let (mut intact, mut damaged) = (0, 0);
        for _ in 0..2000 {
            // The random offsets are of the order of the opening at peak stress (0.17 micrometres) and of the slip at
            // the shear strength (0.37 to 0.42 micrometres), so that some joints stay intact and others do not.
            let mut offset = || 4e-7 * DVec3::new(random.next_share(), random.next_share(), random.next_share());
            let sides = [corners.map(|corner| corner - offset()), corners.map(|corner| corner + offset() - offset())];
            let mut state = JointState::default();
            let expected = joint::forces(&cohesion.law(edge), area, &mut state, &sides);
            let lanes = sides.map(|side| side.map(|corner| Vectors::<Portable>::from_fn(|_| corner)));
            let law = IntactLaw::from_fn(|_| &cohesion);
            let found = law.forces(Portable::splat(edge), Portable::splat(area), &lanes);
            let beyond = found.beyond.to_array()[LANES - 1] > 0.0;
            assert_eq!(beyond, state.is_damaged);
            if beyond {
                damaged += 1;
                continue;
            }
            intact += 1;
            for (found, expected) in found.forces.into_iter().zip(expected.forces) {
                // Tolerance: rounding. The jumps of about 0.1 micrometres are differences of positions of about 3 cm.
                assert!((found.to_array()[0] - expected).length() < 1e-9 * expected.length() + 1e-6);
            }
        }
        assert!(intact > 200 && damaged > 200, "{intact} {damaged}");
    }
}
