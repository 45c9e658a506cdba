//! Ground and boundaries of the area in which units stand, with or without water.

use super::terrain::SiteTerrain;
use crate::case::file::Sides;
use crate::geometry::axis_box::AxisBox;
use crate::geometry::profile::Profile;

/// Ground and boundaries of the area in which units stand; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Ground: the bed with the mound.
    pub profile: Profile,
    /// x of the seaward and of the lee toe of the mound, if any [m].
    pub mound_x: Option<[f64; 2]>,
    /// Terrain: a triangulated surface on or above the ground, if any.
    pub terrain: Option<SiteTerrain>,
    /// Fixed boxes.
    pub obstacles: Vec<AxisBox>,
    /// x of the seaward and of the shoreward end of the area [m].
    pub x: [f64; 2],
    /// Width of the area in y [m].
    pub width: f64,
    /// Boundaries at the two sides of the flume.
    pub sides: Sides,
    /// Level of the top of the walls [m].
    pub top_z: f64,
}

impl Site {
    /// Returns the highest of the levels of ground, terrain and obstacles at the position (x, y) [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let surface = self.terrain.as_ref().and_then(|terrain| terrain.surface.level(x, y));
        let is_below = |obstacle: &&AxisBox| {
            (obstacle.low.x..=obstacle.high.x).contains(&x) && (obstacle.low.y..=obstacle.high.y).contains(&y)
        };
        let tops = self.obstacles.iter().filter(is_below).map(|obstacle| obstacle.high.z);
        tops.chain(surface).fold(self.profile.z(x), f64::max)
    }

    /// Returns an upper bound of the level of ground, terrain and obstacles at x, for all y [m].
    pub fn highest_at(&self, x: f64) -> f64 {
        let surface = self.terrain.as_ref().map(|terrain| terrain.surface.bounds()[1].z);
        let is_at = |obstacle: &&AxisBox| (obstacle.low.x..=obstacle.high.x).contains(&x);
        let tops = self.obstacles.iter().filter(is_at).map(|obstacle| obstacle.high.z);
        tops.chain(surface).fold(self.profile.z(x), f64::max)
    }
}
