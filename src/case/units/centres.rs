//! Places units at the centres in the case file and validates their positions.

use super::row::azimuth;
use super::shape::UnitShape;
use super::{MAX_UNITS, UnitPose};
use crate::case::file::{Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text, lower_limit, upper_limit};

/// Tolerance on the position of a unit [m]. It allows for rounding of the numbers in the file.
const SLACK: f64 = 1e-6;

/// Places the units at the given centres. Checks that they fit into the domain and do not overlap.
pub fn place(
    centres: &[[f64; 3]],
    file: &UnitsFile,
    shape: &UnitShape,
    site: &Site,
    check: &mut Checker,
) -> Vec<UnitPose> {
    for (key, written) in [
        ("count", file.count.is_some()),
        ("pitch_m", file.pitch_m.is_some()),
        ("x_m", file.x_m.is_some()),
        ("first_y_m", file.first_y_m.is_some()),
        ("scatter", file.scatter.is_some()),
    ] {
        if written {
            check.reject(&format!(".{key}"), "...", "left out with `centres_m`", "the centres give all positions");
        }
    }
    if !(1..=MAX_UNITS as usize).contains(&centres.len()) {
        check.reject(
            ".centres_m",
            format!("{} centres", centres.len()),
            format!("1 to {MAX_UNITS}"),
            "leave out `units` for a case without units",
        );
        return Vec::new();
    }
    let before = check.count();
    for (index, centre) in centres.iter().enumerate() {
        validate_centre(&format!(".centres_m[{index}]"), centre, shape, site, check);
    }
    if check.count() == before {
        validate_distances(centres, shape, site, check);
    }
    let placement = |(index, [x, y, z]): (usize, &[f64; 3])| {
        // In two dimensions, all units are cuboids. A rotation by 180 degrees does not change them.
        let turns = site.sides != Sides::TwoDimensional;
        let azimuth = if turns { azimuth(file.orientation, index as u32) } else { 0.0 };
        UnitPose::standing(shape, [*x, *y], Some(*z), azimuth, site)
    };
    centres.iter().enumerate().map(placement).collect()
}

fn validate_centre(path: &str, centre: &[f64; 3], shape: &UnitShape, site: &Site, check: &mut Checker) {
    let [x, y, z] = *centre;
    let [reach_x, reach_y] = shape.reach();
    let across = match site.sides {
        Sides::Periodic => [0.0, site.width],
        Sides::Walls => [reach_y, site.width - reach_y],
        // In two dimensions any y is allowed, because `planar::lay` moves the unit into the particle layer.
        Sides::TwoDimensional => [f64::MIN, f64::MAX],
    };
    let along = [site.x[0] + reach_x, site.x[1] - reach_x];
    let highest = site.profile.extremes_between([x - reach_x, x + reach_x]).1;
    let up = [highest + shape.centre_height(), site.top_z + shape.centre_height() - shape.height()];
    for (axis, (value, [low, high])) in [(x, along), (y, across), (z, up)].into_iter().enumerate() {
        if !(value >= low - SLACK && value <= high + SLACK) {
            check.reject(
                &format!("{path}[{axis}]"),
                as_text(value),
                format!("at least {} and at most {} m", lower_limit(low), upper_limit(high)),
                "the whole unit must stand on or above the ground, between the walls and below their top",
            );
        }
    }
}

fn validate_distances(centres: &[[f64; 3]], shape: &UnitShape, site: &Site, check: &mut Checker) {
    for (index, a) in centres.iter().enumerate() {
        let overlapped = centres[..index].iter().position(|b| {
            let mut offset = [0, 1, 2].map(|axis| a[axis] - b[axis]);
            match site.sides {
                Sides::Periodic => offset[1] -= site.width * (offset[1] / site.width).round(),
                Sides::TwoDimensional => offset[1] = 0.0,
                Sides::Walls => {}
            }
            shape.overlaps(offset)
        });
        if let Some(other) = overlapped {
            let allowed = format!("clear of {}", check.path(&format!(".centres_m[{other}]")));
            check.reject(
                &format!(".centres_m[{index}]"),
                format!("[{}, {}, {}]", as_text(a[0]), as_text(a[1]), as_text(a[2])),
                allowed,
                "units may touch but must not overlap",
            );
        }
    }
}
