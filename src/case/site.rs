//! Where units stand: the ground and what closes the place, with water or without.

use super::file::Sides;
use crate::geometry::profile::Profile;

/// Ground and limits of the place where units stand; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Level of the ground, mound included.
    pub profile: Profile,
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Width across [m].
    pub width: f64,
    /// What closes it across.
    pub sides: Sides,
    /// Top of the walls [m].
    pub top_z: f64,
}
