//! Checks boxes: obstacles, and parts of a structure that are boxes.

use glam::{DVec2, DVec3};

use super::Room;
use super::sections::{NARROWEST, THINNEST};
use crate::case::file::Sides;
use crate::case::flume::bed::Flume;
use crate::case::flume::part::Part;
use crate::case::reading::check::{Checker, as_text, lower_limit, upper_limit};
use crate::geometry::axis_box::AxisBox;

/// Smallest allowed edge of a box without water [m]. The faces across the flume are long: much shorter edges would have
/// no reliable normals.
const THINNEST_DRY: f64 = 1e-3;

/// Largest number of boxes in one case.
const MOST_BOXES: usize = 1000;

/// Distance below which two faces count as touching, divided by the particle spacing dp [-].
const FLUSH: f64 = 1e-6;

/// Names of the axes in messages.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Checks the boxes, each with its key in the case file. Marks the faces that touch the ground or a wall as closed to
/// the water. `width` is the width of the domain [m].
pub(super) fn check(
    boxes: &[(String, AxisBox)],
    parts: &[Part],
    flume: &Flume,
    width: f64,
    room: &Room,
    check: &mut Checker,
) -> Option<Vec<AxisBox>> {
    let before = check.count();
    if boxes.len() > MOST_BOXES {
        check.reject("domain.obstacles", boxes.len(), format!("at most {MOST_BOXES} boxes"), "remove some obstacles");
        return None;
    }
    let mut found: Vec<(&str, AxisBox)> = Vec::new();
    for (path, bounds) in boxes {
        let Some(bounds) = check_one(path, bounds, flume, width, room, check) else { continue };
        let Some(dp) = room.dp else {
            found.push((path, bounds));
            continue;
        };
        let too_near = found.iter().find(|(_, other)| gap(&bounds, other) < NARROWEST * dp).map(|(path, _)| *path);
        let section = parts.iter().find(|part| is_near_section(part, &bounds, NARROWEST * dp));
        if let Some(other) = too_near.map(str::to_owned).or(section.map(|part| format!("{:?}", part.name))) {
            check.reject(
                path,
                corners(&bounds),
                format!("at least {} m from {other}", lower_limit(NARROWEST * dp)),
                "the gap is too narrow for water: merge the two, or move one of them",
            );
        } else {
            found.push((path, bounds));
        }
    }
    (check.count() == before).then(|| found.into_iter().map(|(_, bounds)| bounds).collect())
}

/// Returns true if a box is nearer than `gap` [m] to a part that is the same across the flume but not part of the bed.
fn is_near_section(part: &Part, bounds: &AxisBox, gap: f64) -> bool {
    let [low, high] = [bounds.low, bounds.high].map(|corner| DVec2::new(corner.x, corner.z));
    part.section().is_some_and(|polygon| polygon.is_near_box(low, high, gap))
}

fn check_one(
    path: &str,
    bounds: &AxisBox,
    flume: &Flume,
    width: f64,
    room: &Room,
    check: &mut Checker,
) -> Option<AxisBox> {
    let before = check.count();
    let dp = room.dp.unwrap_or(THINNEST_DRY / THINNEST);
    let ends = [room.x, [0.0, width], [f64::NEG_INFINITY, room.top_z]];
    let planar = room.sides == Sides::TwoDimensional;
    for (axis, ends) in ends.into_iter().enumerate().filter(|(axis, _)| !(planar && *axis == 1)) {
        validate_extent(path, axis, [bounds.low[axis], bounds.high[axis]], ends, dp, check);
    }
    if check.count() > before {
        return None;
    }
    let (mut low, mut high) = (bounds.low, bounds.high);
    if planar {
        // In two dimensions, an obstacle crosses the whole particle layer, whatever its y coordinates are in the file.
        (low.y, high.y) = (0.0, width);
    }
    let open_ends = [room.x, [0.0, width]];
    let mut open = [[true; 2]; 3];
    for (axis, ends) in open_ends.into_iter().enumerate() {
        let gaps = [low[axis] - ends[0], ends[1] - high[axis]];
        open[axis] = gaps.map(|gap| gap > FLUSH * dp);
        validate_gaps(path, axis, gaps, dp, check);
    }
    if room.sides == Sides::Periodic && open[1][0] != open[1][1] {
        check.reject(
            path,
            corners(&AxisBox::free(low, high)),
            "across the whole width, or clear of both periodic sides",
            "an obstacle at one periodic side continues at the opposite side: move it to the middle of the width",
        );
    }
    let (lowest, highest) = flume.profile.extremes_between([low.x, high.x]);
    open[2][0] = low.z > lowest + FLUSH * dp;
    if open[2][0] && low.z < highest + NARROWEST * dp {
        check.reject(
            &format!("{path}.low_m[2]"),
            as_text(low.z),
            format!(
                "at most {} m, the ground, or at least {} m",
                upper_limit(lowest),
                lower_limit(highest + NARROWEST * dp)
            ),
            "let the obstacle stand on the ground, or leave room for the water below it",
        );
    }
    if high.z < highest + THINNEST * dp {
        check.reject(
            &format!("{path}.high_m[2]"),
            as_text(high.z),
            format!("at least {THINNEST} particle spacings above the ground, {} m", as_text(highest + THINNEST * dp)),
            "raise the top of the obstacle, or write the obstacle as part of `flume.bed_m`",
        );
    }
    let low = DVec3 { z: low.z.max(lowest), ..low };
    (check.count() == before).then_some(AxisBox { low, high, open })
}

/// Checks the extent of an obstacle along one axis: finite numbers, their order, thickness, position inside the domain.
fn validate_extent(path: &str, axis: usize, [low, high]: [f64; 2], ends: [f64; 2], dp: f64, check: &mut Checker) {
    let name = AXES[axis];
    if !(low.is_finite() && high - low >= (THINNEST - FLUSH) * dp) {
        check.reject(
            &format!("{path}.high_m[{axis}]"),
            as_text(high),
            format!(
                "at least {} m, {THINNEST} particle spacings above the {name} of `low_m`",
                lower_limit(low + THINNEST * dp)
            ),
            "write the lower corner as `low_m`, and make the box thick enough",
        );
    } else if low < ends[0] || high > ends[1] {
        let (key, value) = if low < ends[0] { ("low_m", low) } else { ("high_m", high) };
        let allowed = if ends[0].is_finite() {
            format!("inside the domain, {} to {} m", as_text(ends[0]), as_text(ends[1]))
        } else {
            format!("at most {} m, the top of the walls", upper_limit(ends[1]))
        };
        check.reject(
            &format!("{path}.{key}[{axis}]"),
            as_text(value),
            allowed,
            "move the obstacle or enlarge the domain",
        );
    }
}

/// Checks along one axis that an obstacle touches the ends of the domain or leaves enough room for water.
fn validate_gaps(path: &str, axis: usize, gaps: [f64; 2], dp: f64, check: &mut Checker) {
    for (gap, key) in gaps.into_iter().zip(["low_m", "high_m"]) {
        if gap > FLUSH * dp && gap < (NARROWEST - FLUSH) * dp {
            check.reject(
                &format!("{path}.{key}[{axis}]"),
                format!("{} m from the end of the domain", as_text(gap)),
                format!("0, or at least {} m", lower_limit(NARROWEST * dp)),
                "let the obstacle touch the end of the domain, or leave room for the water in the gap",
            );
        }
    }
}

/// Computes the distance between two obstacles [m].
fn gap(a: &AxisBox, b: &AxisBox) -> f64 {
    (a.low - b.high).max(b.low - a.high).max(DVec3::ZERO).length()
}

fn corners(obstacle: &AxisBox) -> String {
    let point = |p: DVec3| format!("[{}, {}, {}]", as_text(p.x), as_text(p.y), as_text(p.z));
    format!("{} to {}", point(obstacle.low), point(obstacle.high))
}
