//! Pairs of parts near each other, and the motion that decides when their distance must be computed again.

use glam::DVec3;

use super::broad_phase::BodyPair;
use crate::rigid::contact::{ContactKey, Feature, LONGEST_SUBSTEP, WHOLE_PART};

/// Safety factor on the distance that a surface moves in a substep [-]. A body can rotate slightly faster at one end of
/// the substep than on average.
const PATH_SAFETY: f64 = 1.01;

/// Two parts near each other, of two bodies or of a body and its periodic image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartPair {
    /// The two bodies.
    pub bodies: BodyPair,
    /// Number of the part of each body.
    pub parts: [usize; 2],
    /// The gap between the rounded surfaces is at least this value minus the paths of both bodies [m].
    pub clearance: f64,
}

impl PartPair {
    /// Identity of the contact between two features of the parts.
    pub fn key(&self, features: [u16; 2]) -> ContactKey {
        let [part, partner] = [0, 1].map(|k| self.parts[k] as u16 * (WHOLE_PART + 1) + features[k]);
        let BodyPair { first, second, image } = self.bodies;
        ContactKey { body: first as u32, part, feature: Feature::Unit { body: second as u32, image, part: partner } }
    }
}

/// Motion of the bodies since the list of part pairs was built.
#[derive(Debug, Clone, Copy)]
pub struct Travel<'a> {
    /// Upper bound of the distance that the surface of each body has moved [m].
    pub path: &'a [f64],
    /// Velocities of the centres of mass now [m/s].
    pub velocity: &'a [DVec3],
    /// Upper bound of the speed of each surface about the centre of mass now [m/s].
    pub tip_speed: &'a [f64],
    /// A bound of a gap is used only if it leaves this distance, which is larger than the errors of a search [m].
    pub tolerance: f64,
}

impl Travel<'_> {
    /// Adds a substep `h` [s] with the given mean velocities to the path of a body, whose surface lies within `reach`
    /// [m] of the centre of mass.
    pub fn add_to_path(path: &mut f64, h: f64, velocity: DVec3, angular_velocity: DVec3, reach: f64) {
        *path += PATH_SAFETY * h * (velocity.length() + angular_velocity.length() * reach);
    }

    /// Largest gap between a body and a fixed surface that can close within the longest substep [m]. Contacts with such
    /// gaps limit the length of the substep.
    pub fn margin(&self, body: usize) -> f64 {
        let speed = self.velocity[body].length() + self.tip_speed[body];
        PATH_SAFETY * LONGEST_SUBSTEP * speed + self.tolerance
    }

    /// The same for a pair of bodies. Bodies that fall together do not approach each other.
    pub fn pair_margin(&self, BodyPair { first, second, .. }: &BodyPair) -> f64 {
        let speed = (self.velocity[*first] - self.velocity[*second]).length()
            + self.tip_speed[*first]
            + self.tip_speed[*second];
        PATH_SAFETY * LONGEST_SUBSTEP * speed + self.tolerance
    }

    /// Sum of the paths of both bodies [m].
    pub fn pair_path(&self, BodyPair { first, second, .. }: &BodyPair) -> f64 {
        self.path[*first] + self.path[*second]
    }
}
