//! Where units stand: the ground and what closes the place, with water or without.

use super::file::Sides;
use super::terrain::SiteTerrain;
use crate::geometry::profile::Profile;

/// Ground and limits of the place where units stand; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Level of the ground, mound included.
    pub profile: Profile,
    /// A triangle surface on or over it.
    pub terrain: Option<SiteTerrain>,
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Width across [m].
    pub width: f64,
    /// What closes it across.
    pub sides: Sides,
    /// Top of the walls [m].
    pub top_z: f64,
}

impl Site {
    /// Level of the ground, or of what lies on it, at a place [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let surface = self.terrain.as_ref().and_then(|terrain| terrain.surface.level(x, y));
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }

    /// Highest level of the ground, and of what lies on it, at the places x [m].
    pub fn highest_at(&self, x: f64) -> f64 {
        let surface = self.terrain.as_ref().map(|terrain| terrain.surface.bounds()[1].z);
        surface.map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }
}
