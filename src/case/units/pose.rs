//! Pose of a unit.

use glam::{DQuat, DVec3};

use super::shape::UnitShape;
use crate::case::flume::site::Site;

/// Pose of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitPose {
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Rotation from body axes to space axes.
    pub rotation: DQuat,
}

impl UnitPose {
    /// Returns a unit that stands with its axis vertical, on the ground unless `z` gives the level of its centre [m].
    /// At azimuth 0 [rad] a Tetrapod has a leg seaward, at pi shoreward.
    pub(in crate::case) fn standing(
        shape: &UnitShape,
        [x, y]: [f64; 2],
        z: Option<f64>,
        azimuth: f64,
        site: &Site,
    ) -> Self {
        let unit = shape.unit();
        let z = z.unwrap_or_else(|| site.level(x, y) + unit.standing_height());
        Self { centre: DVec3::new(x, y, z), rotation: unit.standing_rotation(azimuth) }
    }
}
