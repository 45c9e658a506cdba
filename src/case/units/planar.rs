//! Validates units in two dimensions: cuboids that lie across the flume. The layer of particles is a slice of them.
//!
//! Units move in the plane of the layer, along x and z, and turn about y. A unit keeps its own width and mass. The
//! water force on a unit is the force on its slice times the number of slices, see [`slices`].

use glam::DQuat;

use super::UnitPose;
use super::shape::{UnitKind, UnitShape};
use crate::case::file::{Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text};

/// Largest quaternion component that turns out of the plane [-]: rounding to six written digits.
const ROUNDING: f64 = 1e-6;

/// Refuses units whose outline changes across the flume, and rows, which lie across it.
pub fn validate(file: &UnitsFile, shape: &UnitShape, is_row: bool, check: &mut Checker) {
    if !matches!(shape.kind, UnitKind::Cuboid { .. }) {
        check.reject(
            "units.shape",
            format!("{:?}", file.shape.key()),
            "\"cuboid\" where `domain.sides` is \"two_dimensional\"",
            "in two dimensions the outline must be the same across the flume: write \"periodic\" or \"walls\"",
        );
    }
    if is_row {
        check.reject(
            "units.centres_m",
            "(missing)",
            "a list of centres where `domain.sides` is \"two_dimensional\"",
            "in two dimensions only one unit fits across the flume: write `centres_m` or `poses` instead of a row",
        );
    }
}

/// Moves the units into the layer, whatever their position across the flume.
pub fn lay(placements: Vec<UnitPose>, site: &Site, check: &mut Checker) -> Vec<UnitPose> {
    let lay_one = |(index, UnitPose { mut centre, rotation }): (usize, UnitPose)| {
        centre.y = 0.5 * site.width;
        let out_of_plane = rotation.x.hypot(rotation.z);
        if out_of_plane > ROUNDING {
            check.reject(
                &format!("units.poses[{index}].quaternion_xyzw"),
                format!("turned out of the plane by {}", as_text(out_of_plane)),
                "a turn about y where `domain.sides` is \"two_dimensional\", [0, y, 0, w]",
                "turn the unit about y only, or write \"periodic\" or \"walls\"",
            );
        }
        UnitPose { centre, rotation: DQuat::from_xyzw(0.0, rotation.y, 0.0, rotation.w).normalize() }
    };
    placements.into_iter().enumerate().map(lay_one).collect()
}

/// Returns the width of a unit over the thickness of the particle layer [-]; 1 in three dimensions.
pub fn slices(shape: &UnitShape, site: &Site) -> f64 {
    match shape.kind {
        UnitKind::Cuboid { edges } if site.sides == Sides::TwoDimensional => edges[1] / site.width,
        _ => 1.0,
    }
}
