//! Units in two dimensions, validated: cuboids that lie across the flume, of which the layer of particles is a slice.
//!
//! They move in the plane of the layer, along x and z, and turn about y. A unit keeps its own width and mass; the water
//! acts on it with the force on the slice times the number of slices, see [`slices`].

use glam::DQuat;

use super::check::{Checker, show};
use super::file::{Sides, UnitsFile};
use super::site::Site;
use super::unit_shape::{UnitKind, UnitShape};
use super::units::Placement;

/// The part of a quaternion that turns out of the plane may be this large: six written digits [-].
const ROUNDING: f64 = 1e-6;

/// Refuse units that do not have the same outline all across the flume, and rows, which lie across it.
pub(super) fn validate(file: &UnitsFile, shape: &UnitShape, is_row: bool, check: &mut Checker) {
    if !matches!(shape.kind, UnitKind::Cuboid { .. }) {
        check.refuse(
            "units.shape",
            format!("{:?}", file.shape.key()),
            "\"cuboid\" where `domain.sides` is \"two_dimensional\"",
            "a unit there has the same outline all across the flume: write \"periodic\" or \"walls\" for this one",
        );
    }
    if is_row {
        check.refuse(
            "units.centres_m",
            "(missing)",
            "a list of centres where `domain.sides` is \"two_dimensional\"",
            "a row lies across the flume, and a layer has room for one unit there: write `centres_m` or `poses`",
        );
    }
}

/// Lay units into the layer, wherever the case has put them across the flume.
pub(super) fn lay(placements: Vec<Placement>, site: &Site, check: &mut Checker) -> Vec<Placement> {
    let lay = |(index, Placement { mut centre, rotation }): (usize, Placement)| {
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
    placements.into_iter().enumerate().map(lay).collect()
}

/// How many slices as thick as the layer of particles a unit is wide [-]; 1 in three dimensions, where the particles
/// fill the unit.
pub(super) fn slices(shape: &UnitShape, site: &Site) -> f64 {
    match shape.kind {
        UnitKind::Cuboid { edges } if site.sides == Sides::TwoDimensional => edges[1] / site.width,
        _ => 1.0,
    }
}
