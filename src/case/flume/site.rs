//! Ground and boundaries of the area in which units stand, with or without water.

use super::terrain::SiteTerrain;
use crate::case::file::Sides;
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
    /// Returns the higher of the levels of ground and terrain at the position (x, y) [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let surface = self.terrain.as_ref().and_then(|terrain| terrain.surface.level(x, y));
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }

    /// Returns an upper bound of the level of ground and terrain at x, for all y [m].
    pub fn highest_at(&self, x: f64) -> f64 {
        let surface = self.terrain.as_ref().map(|terrain| terrain.surface.bounds()[1].z);
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }
}
