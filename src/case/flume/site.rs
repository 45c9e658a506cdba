//! Ground and boundaries of the area in which units stand, with or without water.

use super::part::Part;
use super::terrain::SiteTerrain;
use crate::case::file::Sides;
use crate::geometry::profile::Profile;
use crate::rigid::Cover;

/// Ground and boundaries of the area in which units stand; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Ground: the bed with the mound and the parts of the structure that lie on it.
    pub profile: Profile,
    /// Materials of mound and parts on the profile.
    pub covers: Vec<Cover>,
    /// Terrain: a triangulated surface on or above the ground, if any.
    pub terrain: Option<SiteTerrain>,
    /// Parts of the structure, and obstacles.
    pub parts: Vec<Part>,
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
    /// Returns the highest of the levels of ground, terrain and parts at the position (x, y) [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let surface = self.terrain.as_ref().and_then(|terrain| terrain.surface.level(x, y));
        let tops = self.parts.iter().filter_map(|part| part.level(x, y));
        tops.chain(surface).fold(self.profile.z(x), f64::max)
    }

    /// Returns an upper bound of the level of ground, terrain and parts at x, for all y [m].
    pub fn highest_at(&self, x: f64) -> f64 {
        let surface = self.terrain.as_ref().map(|terrain| terrain.surface.bounds()[1].z);
        let tops = self.parts.iter().filter_map(|part| part.highest_at(x));
        tops.chain(surface).fold(self.profile.z(x), f64::max)
    }
}
