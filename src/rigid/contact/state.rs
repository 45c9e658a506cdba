//! Active contacts with their history.

use glam::DVec3;

use super::key::{ContactKey, Feature};
use super::point::ContactPoint;

/// Substep over which an evaluation advances the contact history.
#[derive(Debug, Clone, Copy)]
pub struct Substep {
    /// Length of the substep [s]; 0 for the first evaluation.
    pub dt: f64,
    /// Time at the end of the substep [s].
    pub time: f64,
    /// Time for which the resulting substep length may be used [s]; contacts that may start within it count.
    pub horizon: f64,
}

/// An active contact with its history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Identity of the contact.
    pub key: ContactKey,
    /// Contact normal at the last evaluation.
    pub normal: DVec3,
    /// Tangential spring d_t [m].
    pub spring: DVec3,
    /// Rolling spring [rad].
    pub rolling_spring: DVec3,
    /// Overlap [m].
    pub overlap: f64,
    /// Overlap at which the contact force starts [m]: the initial overlap on a triangle surface is subtracted.
    pub initial_overlap: f64,
    /// Nearest point of the partner's core, in the partner's axes [m]: start of the next search.
    pub core: DVec3,
    /// Force on the first body [N].
    pub force: DVec3,
    /// Dashpot part of the normal force [N].
    pub dashpot: f64,
    /// Energy stored in the normal, tangential and rolling springs [J].
    pub elastic: [f64; 3],
}

impl Contact {
    /// Returns the same contact with unloaded springs, for an overlap that does not exceed the initial one.
    pub fn idle(self, point: &ContactPoint, substep: Substep) -> Self {
        let Self { key, initial_overlap, .. } = self;
        Self { key, initial_overlap, ..Self::started(point, substep) }
    }

    /// Returns the contact at its new position; the effective overlap stays the same on another element of a surface.
    pub fn continued_as(self, point: &ContactPoint) -> Self {
        let stays = self.key == point.key || !matches!(point.key.feature, Feature::Terrain { .. });
        let initial_overlap =
            if stays { self.initial_overlap } else { (point.overlap - (self.overlap - self.initial_overlap)).max(0.0) };
        Self { key: point.key, initial_overlap, ..self }
    }

    /// Creates a contact that has just started.
    ///
    /// On a triangle surface, a part in contact with neighbouring elements can reach another ridge with an overlap.
    /// This overlap is subtracted, because it would create energy. An overlap at the start of the world counts.
    pub fn started(point: &ContactPoint, substep: Substep) -> Self {
        let on_terrain = matches!(point.key.feature, Feature::Terrain { .. });
        let initial_overlap = if on_terrain && substep.dt > 0.0 { point.overlap } else { 0.0 };
        Self {
            initial_overlap,
            key: point.key,
            normal: point.normal,
            spring: DVec3::ZERO,
            rolling_spring: DVec3::ZERO,
            overlap: point.overlap,
            core: point.core,
            force: DVec3::ZERO,
            dashpot: 0.0,
            elastic: [0.0; 3],
        }
    }
}
