//! Ground and limits of the area where units stand, with or without water.

use super::file::Sides;
use super::terrain::SiteTerrain;
use crate::geometry::profile::Profile;

/// Ground and limits of the area where units stand; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Ground: the bed with the mound.
    pub profile: Profile,
    /// A triangulated surface on or above the ground.
    pub terrain: Option<SiteTerrain>,
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Width in y [m].
    pub width: f64,
    /// Boundaries at the two sides.
    pub sides: Sides,
    /// Top of the walls [m].
    pub top_z: f64,
}

impl Site {
    /// Returns the level of the ground or the terrain, whichever is higher, at a position [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let surface = self.terrain.as_ref().and_then(|terrain| terrain.surface.level(x, y));
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }

    /// Returns an upper bound of the level at x, for all y [m].
    pub fn highest_at(&self, x: f64) -> f64 {
        let surface = self.terrain.as_ref().map(|terrain| terrain.surface.bounds()[1].z);
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }
}
