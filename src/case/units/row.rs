//! Places units in a row across the flume and validates their positions.

use std::f64::consts::PI;

use super::shape::{UnitKind, UnitShape};
use super::{MAX_UNITS, UnitPose};
use crate::case::file::{Orientation, ScatterFile, Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit, more_than, upper_limit};
use crate::random::SplitMix64;

/// The row that the case file describes; SI units.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    count: u32,
    pitch: f64,
    x: f64,
    first_y: Option<f64>,
    orientation: Orientation,
    scatter: ScatterFile,
}

/// Largest rotation of a unit by `units.scatter` [degrees]. Larger rotations could let neighbours overlap.
const LARGEST_SCATTER: f64 = 15.0;

/// Validates the numbers of a row, without comparing them with the domain.
pub fn validate(file: &UnitsFile, shape: Option<&UnitShape>, check: &mut Checker) -> Option<Row> {
    let before = check.count();
    for (key, missing) in
        [("count", file.count.is_none()), ("pitch_m", file.pitch_m.is_none()), ("x_m", file.x_m.is_none())]
    {
        if missing {
            check.reject(
                &format!(".{key}"),
                "(missing)",
                "given for a row of units",
                "write `count`, `pitch_m` and `x_m`, or list the positions of the units as `centres_m`",
            );
        }
    }
    let (count, pitch, x) = (file.count?, file.pitch_m?, file.x_m?);
    let scatter = file.scatter.unwrap_or(ScatterFile { position_m: 0.0, angle_deg: 0.0, seed: 0 });
    let advice = "a few millimetres are usual in a laboratory";
    check.number(".scatter.position_m", scatter.position_m, at_least(0.0).up_to(100.0), "m", advice);
    let advice = "a few degrees are usual in a laboratory";
    check.number(".scatter.angle_deg", scatter.angle_deg, at_least(0.0).up_to(LARGEST_SCATTER), "degrees", advice);
    if let Some(shape) = shape {
        let least = shape.least_pitch() + 2.0 * scatter.position_m;
        let range = match shape.kind {
            UnitKind::Cuboid { .. } => at_least(least).up_to(1000.0),
            _ => more_than(least).up_to(1000.0),
        };
        let advice = match shape.kind {
            _ if file.scatter.is_some() => "neighbours that deviate towards each other must not overlap",
            UnitKind::Tetrapod { .. } => "units closer than 0.75 of their height overlap",
            UnitKind::Cuboid { .. } => "units closer than their edge across the flume overlap",
            _ => "units closer than their width across the flume may overlap",
        };
        check.number(".pitch_m", pitch, range, "m", advice);
    }
    if !(1..=MAX_UNITS).contains(&count) {
        check.reject(".count", count, format!("1 to {MAX_UNITS}"), "leave out `units` for a case without units");
    }
    let row = Row { count, pitch, x, first_y: file.first_y_m, orientation: file.orientation, scatter };
    (check.count() == before).then_some(row)
}

/// Places the units of the row and checks that the row fits into the domain.
pub fn place(row: &Row, shape: &UnitShape, site: &Site, check: &mut Checker) -> Vec<UnitPose> {
    let [margin, reach] = shape.reach().map(|reach| reach + row.scatter.position_m);
    check.number(
        ".x_m",
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
                    ".count",
                    row.count,
                    format!("such that the row, {} m wide, fits between the walls", as_text(widest)),
                    format!("write fewer units, a smaller pitch or a width of at least {} m", lower_limit(widest)),
                );
            } else if first_y < reach || first_y + length > site.width - reach {
                let last = site.width - reach - length;
                check.reject(
                    ".first_y_m",
                    as_text(first_y),
                    format!("at least {} and at most {} m between the walls", lower_limit(reach), upper_limit(last)),
                    "leave it out to centre the row",
                );
            }
        }
    }
    let mut random = SplitMix64::new(row.scatter.seed);
    let mut deviation = |largest: f64| largest * (2.0 * random.next_share() - 1.0);
    let place_one = |index: u32| {
        let [dx, dy] = [row.scatter.position_m; 2].map(&mut deviation);
        let turn = deviation(row.scatter.angle_deg.to_radians());
        let y = first_y + f64::from(index) * row.pitch;
        UnitPose::standing(shape, [row.x + dx, y + dy], None, azimuth(row.orientation, index) + turn, site)
    };
    (0..row.count).map(place_one).collect()
}

fn validate_periodic_row(row: &Row, width: f64, first_y: f64, check: &mut Checker) {
    let length = f64::from(row.count) * row.pitch;
    // Tolerance for rounding of count * pitch.
    let slack = 1e-9;
    if length > width + slack || f64::from(row.count) != (width / row.pitch).round() {
        check.reject(
            ".count",
            row.count,
            format!("such that count x pitch = {} m fills the periodic width, {} m", as_text(length), as_text(width)),
            "the row must fit the periodic width: change `units.count`, `units.pitch_m` or `domain.width_m`",
        );
        return;
    }
    if length < width - 1e-6 {
        check.warn(format!(
            ".pitch_m = {}: neighbours across the periodic sides are {} m apart",
            as_text(row.pitch),
            as_text(width - length + row.pitch)
        ));
    }
    let turned = matches!(row.orientation, Orientation::Alternating | Orientation::AlternatingReversed);
    if turned && row.count > 1 && row.count % 2 == 1 {
        check.reject(
            ".count",
            row.count,
            "even when the units alternate and the sides are periodic",
            "add or remove one unit, so that neighbours across the periodic sides alternate too",
        );
    }
    let last = width - (length - row.pitch);
    if !(first_y >= 0.0 && first_y <= last + slack) {
        check.reject(
            ".first_y_m",
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
