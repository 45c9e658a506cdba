//! Validates units in two dimensions: cuboids that lie across the flume. The layer of particles is a slice of them.
//!
//! Units move in the plane of the layer, along x and z, and turn about y. A unit keeps its own width and mass. The
//! water force on a unit is the force on its slice times the number of slices, see [`slices`].

use glam::DQuat;

use super::check::{Checker, show};
use super::file::{Sides, UnitsFile};
use super::site::Site;
use super::unit_shape::{UnitKind, UnitShape};
use super::units::Placement;

/// Largest quaternion component that turns out of the plane [-]: rounding to six written digits.
const ROUNDING: f64 = 1e-6;

/// Refuses units whose outline changes across the flume, and rows, which lie across it.
pub(super) fn validate(file: &UnitsFile, shape: &UnitShape, is_row: bool, check: &mut Checker) {
    if !matches!(shape.kind, UnitKind::Cuboid { .. }) {
        check.refuse(
            "units.shape",
            format!("{:?}", file.shape.key()),
            "\"cuboid\" where `domain.sides` is \"two_dimensional\"",
            "in two dimensions the outline must be the same across the flume: write \"periodic\" or \"walls\"",
        );
    }
    if is_row {
        check.refuse(
            "units.centres_m",
            "(missing)",
            "a list of centres where `domain.sides` is \"two_dimensional\"",
            "in two dimensions only one unit fits across the flume: write `centres_m` or `poses` instead of a row",
        );
    }
}

/// Moves the units into the layer, whatever their position across the flume.
pub(super) fn lay(placements: Vec<Placement>, site: &Site, check: &mut Checker) -> Vec<Placement> {
    let lay_one = |(index, Placement { mut centre, rotation }): (usize, Placement)| {
        centre.y = 0.5 * site.width;
        let out_of_plane = rotation.x.hypot(rotation.z);
        if out_of_plane > ROUNDING {
            check.refuse(
                &format!("units.poses[{index}].quaternion_xyzw"),
                format!("turned out of the plane by {}", show(out_of_plane)),
                "a turn about y where `domain.sides` is \"two_dimensional\", [0, y, 0, w]",
                "turn the unit about y only, or write \"periodic\" or \"walls\"",
            );
        }
        Placement { centre, rotation: DQuat::from_xyzw(0.0, rotation.y, 0.0, rotation.w).normalize() }
    };
    placements.into_iter().enumerate().map(lay_one).collect()
}

/// Returns the width of a unit over the thickness of the particle layer [-]; 1 in three dimensions.
pub(super) fn slices(shape: &UnitShape, site: &Site) -> f64 {
    match shape.kind {
        UnitKind::Cuboid { edges } if site.sides == Sides::TwoDimensional => edges[1] / site.width,
        _ => 1.0,
    }
}
