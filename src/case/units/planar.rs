//! Validates units in two dimensions. They must be cuboids, and the particle layer is a slice of each cuboid.
//!
//! Units move along x and z, in the plane of the particle layer, and rotate about y. A unit keeps its own width and
//! mass. The water force on a unit is the force on its slice times the number of slices, see [`slices`].

use glam::DQuat;

use super::UnitPose;
use super::shape::{UnitKind, UnitShape};
use crate::case::file::{Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text};

/// Largest allowed size of the x and z components of the quaternion of a unit [-]. The limit allows for rounding to three
/// digits in the case file.
const ROUNDING: f64 = 1e-3;

/// Refuses units that are not cuboids. Refuses rows, because a row has several units across the flume.
pub fn validate(file: &UnitsFile, shape: &UnitShape, is_row: bool, check: &mut Checker) {
    if !matches!(shape.kind, UnitKind::Cuboid { .. }) {
        check.reject(
            ".shape",
            format!("{:?}", file.shape.key()),
            "\"cuboid\" where `domain.sides` is \"two_dimensional\"",
            "in two dimensions, only cuboids are allowed: use cuboids, or \"periodic\" or \"walls\"",
        );
    }
    if is_row {
        check.reject(
            ".centres_m",
            "(missing)",
            "a list of centres where `domain.sides` is \"two_dimensional\"",
            "in two dimensions only one unit fits across the flume: write `centres_m` or `poses` instead of a row",
        );
    }
}

/// Moves all units to the middle of the particle layer, whatever their y coordinate is in the file.
pub fn lay(placements: Vec<UnitPose>, site: &Site, check: &mut Checker) -> Vec<UnitPose> {
    let lay_one = |(index, UnitPose { mut centre, rotation }): (usize, UnitPose)| {
        centre.y = 0.5 * site.width;
        let out_of_plane = rotation.x.hypot(rotation.z);
        if out_of_plane > ROUNDING {
            check.reject(
                &format!(".poses[{index}].quaternion_xyzw"),
                format!("x and z components of size {}", as_text(out_of_plane)),
                "a rotation about y, [0, y, 0, w], where `domain.sides` is \"two_dimensional\"",
                "rotate the unit only about y, or write \"periodic\" or \"walls\"",
            );
        }
        UnitPose { centre, rotation: DQuat::from_xyzw(0.0, rotation.y, 0.0, rotation.w).normalize() }
    };
    placements.into_iter().enumerate().map(lay_one).collect()
}

/// Returns the width of a unit divided by the thickness of the particle layer [-]; 1 in three dimensions.
pub fn slices(shape: &UnitShape, site: &Site) -> f64 {
    match shape.kind {
        UnitKind::Cuboid { edges } if site.sides == Sides::TwoDimensional => edges[1] / site.width,
        _ => 1.0,
    }
}
