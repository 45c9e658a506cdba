//! Places units in a row across the flume and validates their positions.

use std::f64::consts::PI;

use super::shape::{UnitKind, UnitShape};
use super::{MAX_UNITS, UnitPose};
use crate::case::file::{Orientation, Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit, more_than, upper_limit};

/// The row that the case file describes; SI units.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    count: u32,
    pitch: f64,
    x: f64,
    first_y: Option<f64>,
    orientation: Orientation,
}

/// Validates the numbers of a row, without comparing them with the domain.
pub fn validate(file: &UnitsFile, shape: Option<&UnitShape>, check: &mut Checker) -> Option<Row> {
    let before = check.count();
    for (key, missing) in
        [("count", file.count.is_none()), ("pitch_m", file.pitch_m.is_none()), ("x_m", file.x_m.is_none())]
    {
        if missing {
            check.reject(
                &format!("units.{key}"),
                "(missing)",
                "given for a row of units",
                "write `count`, `pitch_m` and `x_m`, or list the positions of the units as `centres_m`",
            );
        }
    }
    let (count, pitch, x) = (file.count?, file.pitch_m?, file.x_m?);
    if let Some(shape) = shape {
        let range = match shape.kind {
            UnitKind::Cuboid { .. } => at_least(shape.least_pitch()).up_to(1000.0),
            _ => more_than(shape.least_pitch()).up_to(1000.0),
        };
        let advice = match shape.kind {
            UnitKind::Tetrapod { .. } => "units closer than 0.75 of their height overlap",
            UnitKind::Cuboid { .. } => "units closer than their edge across the flume overlap",
            _ => "units closer than their width across the flume may overlap",
        };
        check.number("units.pitch_m", pitch, range, "m", advice);
    }
    if !(1..=MAX_UNITS).contains(&count) {
        check.reject("units.count", count, format!("1 to {MAX_UNITS}"), "leave out `units` for a case without units");
    }
    let row = Row { count, pitch, x, first_y: file.first_y_m, orientation: file.orientation };
    (check.count() == before).then_some(row)
}

/// Places the units of the row and checks that the row fits into the domain.
pub fn place(row: &Row, shape: &UnitShape, site: &Site, check: &mut Checker) -> Vec<UnitPose> {
    let [margin, reach] = shape.reach();
    check.number(
        "units.x_m",
        row.x,
        more_than(site.x[0] + margin).below(site.x[1] - margin),
        "m",
        "the whole unit must stand inside `domain.x_m`",
    );
    let top = site.profile.z(row.x) + shape.height();
    if top > site.top_z {
        check.reject(
            "domain.top_z_m",
            as_text(site.top_z),
            format!("above the top of the units, {} m", as_text(top)),
            "raise the walls",
        );
    }
    let length = f64::from(row.count - 1) * row.pitch;
    let first_y = row.first_y.unwrap_or(0.5 * (site.width - length));
    match site.sides {
        Sides::Periodic => validate_periodic_row(row, site.width, first_y, check),
        // Rows are refused in two dimensions.
        Sides::Walls | Sides::TwoDimensional => {
            let widest = length + 2.0 * reach;
            if widest > site.width {
                check.reject(
                    "units.count",
                    row.count,
                    format!("such that the row, {} m wide, fits between the walls", as_text(widest)),
                    format!("write fewer units, a smaller pitch or a width of at least {} m", lower_limit(widest)),
                );
            } else if first_y < reach || first_y + length > site.width - reach {
                let last = site.width - reach - length;
                check.reject(
                    "units.first_y_m",
                    as_text(first_y),
                    format!("at least {} and at most {} m between the walls", lower_limit(reach), upper_limit(last)),
                    "leave it out to centre the row",
                );
            }
        }
    }
    let place_one = |index: u32| {
        let y = first_y + f64::from(index) * row.pitch;
        UnitPose::standing(shape, [row.x, y], None, azimuth(row.orientation, index), site)
    };
    (0..row.count).map(place_one).collect()
}

fn validate_periodic_row(row: &Row, width: f64, first_y: f64, check: &mut Checker) {
    let length = f64::from(row.count) * row.pitch;
    // Tolerance for rounding of count * pitch.
    let slack = 1e-9;
    if length > width + slack || f64::from(row.count) != (width / row.pitch).round() {
        check.reject(
            "units.count",
            row.count,
            format!("such that count x pitch = {} m fills the periodic width, {} m", as_text(length), as_text(width)),
            "the row must fit the periodic width: change `units.count`, `units.pitch_m` or `domain.width_m`",
        );
        return;
    }
    if length < width - 1e-6 {
        check.warn(format!(
            "units.pitch_m = {}: neighbours across the periodic sides are {} m apart",
            as_text(row.pitch),
            as_text(width - length + row.pitch)
        ));
    }
    let turned = matches!(row.orientation, Orientation::Alternating | Orientation::AlternatingReversed);
    if turned && row.count > 1 && row.count % 2 == 1 {
        check.reject(
            "units.count",
            row.count,
            "even when the units alternate and the sides are periodic",
            "add or remove one unit, so that neighbours across the periodic sides alternate too",
        );
    }
    let last = width - (length - row.pitch);
    if !(first_y >= 0.0 && first_y <= last + slack) {
        check.reject(
            "units.first_y_m",
            as_text(first_y),
            format!("at least 0 and at most {} m", upper_limit(last)),
            "leave it out to centre the row",
        );
    }
}

/// Returns the rotation of unit `index` of the row (counted from 0) about the vertical axis [rad].
pub fn azimuth(orientation: Orientation, index: u32) -> f64 {
    let shoreward = match orientation {
        Orientation::Alternating => !index.is_multiple_of(2),
        Orientation::AlternatingReversed => index.is_multiple_of(2),
        Orientation::Seaward => false,
        Orientation::Shoreward => true,
    };
    if shoreward { PI } else { 0.0 }
}
