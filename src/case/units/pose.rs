//! Pose of a unit: position and rotation.

use glam::{DQuat, DVec3};

use super::shape::UnitShape;
use crate::case::flume::site::Site;

/// Pose of a unit: position and rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitPose {
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Rotation from body axes to space axes.
    pub rotation: DQuat,
}

impl UnitPose {
    /// Returns the pose of a standing unit, with its axis vertical. `z` is the level of its centre [m]; without `z`,
    /// the unit stands on the ground. A leg of a Tetrapod points seaward at azimuth 0 [rad] and shoreward at azimuth
    /// pi.
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
