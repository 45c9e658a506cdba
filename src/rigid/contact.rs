//! Data of a contact: identity, contact point and history.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Largest number of corners plus edges of a polyhedron. Their feature numbers start at 0 and are less than
/// [`WHOLE_PART`].
pub const MAX_FEATURES: usize = WHOLE_PART as usize - 1;
/// Feature number of a whole part. The corners of a polyhedron have the numbers from 0; its edges follow.
pub const WHOLE_PART: u16 = 1023;

/// The contact partner of a part. `end` is the index of the touching core point in `ConvexPart::ends`; 0 at ridges and
/// corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// A part of another body, or of an image of the same body, shifted by `image` flume widths. `part` is 1024 times
    /// the part number plus the feature number (a corner, an edge, or 1023 for the whole part).
    Unit { body: u32, image: i32, part: u16 },
    /// The bed profile: `place` is 2 k for strip k (a plane segment, counted from 0 at the seaward end), and 2 k + 1
    /// for the convex corner after strip k.
    Ground { place: u32, end: u16 },
    /// A triangle surface: `place` is the number of the triangle, ridge or corner. The numbers of a surface follow those
    /// of the surface before.
    Terrain { place: u32, end: u16 },
    /// A wall: 0 at y = 0, 1 at y = width, 2 seaward, 3 shoreward.
    Wall { wall: u8, end: u16 },
}

/// Identity of a contact: body, part and contact partner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ContactKey {
    /// Number of the body from 0.
    pub body: u32,
    /// Number of the part of this body, from 0. If the partner is a unit, the value is encoded as in [`Feature::Unit`].
    pub part: u16,
    /// Contact partner.
    pub feature: Feature,
}

/// A point where two surfaces overlap or are near each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactPoint {
    /// Identity of the contact.
    pub key: ContactKey,
    /// Middle of the overlap [m]. The partner is at its periodic image near the first body.
    pub position: DVec3,
    /// Normal from the partner into the first body.
    pub normal: DVec3,
    /// Overlap d [m]; negative for a gap.
    pub overlap: f64,
    /// Shift of the partner to its periodic image [m].
    pub shift: DVec3,
    /// Nearest point of the partner's core, in the partner's body axes [m]; on the ground or a wall, the foot of
    /// the perpendicular.
    pub core: DVec3,
}

/// Longest substep [s]. Contacts that can start within this time also limit the length of the next substep, so that no
/// contact starts with a large overlap. This does not depend on the time step of the water.
pub const LONGEST_SUBSTEP: f64 = 1e-3;

/// Substep over which an evaluation advances the contact history.
#[derive(Debug, Clone, Copy)]
pub struct Substep {
    /// Length of the substep [s]; 0 for the first evaluation.
    pub dt: f64,
    /// Time at the end of the substep [s].
    pub time: f64,
}

impl Substep {
    /// Time at the start of the substep [s].
    pub fn start(&self) -> f64 {
        self.time - self.dt
    }
}

/// An active contact with its history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Contact point at the last evaluation; the next search starts from its `core`.
    pub point: ContactPoint,
    /// Elongation of the tangential spring [m].
    pub spring: DVec3,
    /// Rotation of the rolling spring [rad].
    pub rolling_spring: DVec3,
    /// Overlap at which the contact force is zero [m]. It can be above 0 only on a triangle surface; see
    /// [`Self::started`] and [`Self::continued_as`].
    pub initial_overlap: f64,
    /// Force [N] and torque of the rolling resistance [N m] on the first body.
    pub force: DVec3,
    pub rolling_torque: DVec3,
    /// Dashpot part of the normal force [N].
    pub dashpot: f64,
    /// Energy stored in the normal, tangential and rolling springs [J].
    pub elastic: [f64; 3],
    /// Time at rest that the record of the contact does not contain yet [s].
    pub unrecorded: f64,
}

impl Contact {
    /// Returns the contact with unloaded springs, for an overlap that does not exceed the initial overlap.
    pub fn idle(self, point: &ContactPoint, substep: Substep) -> Self {
        let Self { initial_overlap, .. } = self;
        Self { initial_overlap, ..Self::started(point, substep) }
    }

    /// Returns the contact after a substep in which neither body moves.
    pub fn held(self, substep: Substep) -> Self {
        Self { unrecorded: self.unrecorded + substep.dt, ..self }
    }

    /// Returns the contact with the key of `point`. If the part has moved to another element of a triangle surface,
    /// the initial overlap changes to keep the effective overlap (overlap minus initial overlap).
    pub fn continued_as(self, point: &ContactPoint) -> Self {
        let stays = self.point.key == point.key || !matches!(point.key.feature, Feature::Terrain { .. });
        let effective = self.point.overlap - self.initial_overlap;
        let initial_overlap = if stays { self.initial_overlap } else { (point.overlap - effective).max(0.0) };
        Self { initial_overlap, ..self }
    }

    /// Creates a contact that has just started.
    ///
    /// A part that moves along a triangle surface can already overlap the next ridge when it reaches this ridge. A
    /// contact force from this overlap would create energy. Therefore the contact force is zero at this overlap. An
    /// overlap at the start of a run is not subtracted.
    pub fn started(point: &ContactPoint, substep: Substep) -> Self {
        let on_terrain = matches!(point.key.feature, Feature::Terrain { .. });
        let initial_overlap = if on_terrain && substep.dt > 0.0 { point.overlap } else { 0.0 };
        Self {
            point: *point,
            initial_overlap,
            spring: DVec3::ZERO,
            rolling_spring: DVec3::ZERO,
            force: DVec3::ZERO,
            rolling_torque: DVec3::ZERO,
            dashpot: 0.0,
            elastic: [0.0; 3],
            unrecorded: 0.0,
        }
    }
}
