//! Validates fixed obstacles in the particle domain.

use glam::DVec3;

use super::bed::Flume;
use crate::case::file::{BoxFile, DomainFile, Sides};
use crate::case::reading::check::{Checker, as_text, lower_limit, upper_limit};
use crate::geometry::axis_box::AxisBox;

/// Largest number of obstacles in one case.
const MOST_OBSTACLES: usize = 1000;

/// Smallest allowed thickness of an obstacle, divided by the particle spacing dp [-]. Water particles on opposite sides
/// of a thinner obstacle interact with each other.
const THINNEST: f64 = 3.0;

/// Width of the narrowest gap that water can enter, divided by the particle spacing dp [-].
const NARROWEST: f64 = 2.0;

/// Distance below which two faces count as touching, divided by the particle spacing dp [-].
const FLUSH: f64 = 1e-6;

/// Names of the axes in messages.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Validates the obstacles. Marks the obstacle faces that touch the ground or a wall as closed to the water. `width` is
/// the width of the domain [m].
pub fn validate(file: &DomainFile, width: f64, flume: &Flume, check: &mut Checker) -> Vec<AxisBox> {
    if file.obstacles.len() > MOST_OBSTACLES {
        check.reject(
            "domain.obstacles",
            file.obstacles.len(),
            format!("at most {MOST_OBSTACLES} obstacles"),
            "remove some obstacles",
        );
        return Vec::new();
    }
    let mut found: Vec<AxisBox> = Vec::new();
    for (index, obstacle) in file.obstacles.iter().enumerate() {
        let path = format!("domain.obstacles[{index}]");
        let Some(obstacle) = validate_one(&path, obstacle, file, width, flume, check) else { continue };
        let too_near = found.iter().position(|other| gap(&obstacle, other) < NARROWEST * file.dp_m);
        match too_near {
            Some(other) => check.reject(
                &path,
                corners(&obstacle),
                format!("at least {} m from domain.obstacles[{other}]", lower_limit(NARROWEST * file.dp_m)),
                "the gap is too narrow for water: merge the two obstacles, or move one of them",
            ),
            None => found.push(obstacle),
        }
    }
    found
}

fn validate_one(
    path: &str,
    file: &BoxFile,
    domain: &DomainFile,
    width: f64,
    flume: &Flume,
    check: &mut Checker,
) -> Option<AxisBox> {
    let before = check.count();
    let dp = domain.dp_m;
    let ends = [domain.x_m, [0.0, width], [f64::NEG_INFINITY, domain.top_z_m]];
    let planar = domain.sides == Sides::TwoDimensional;
    for (axis, ends) in ends.into_iter().enumerate().filter(|(axis, _)| !(planar && *axis == 1)) {
        validate_extent(path, axis, [file.low_m[axis], file.high_m[axis]], ends, dp, check);
    }
    if check.count() > before {
        return None;
    }
    let (mut low, mut high) = (DVec3::from_array(file.low_m), DVec3::from_array(file.high_m));
    if planar {
        // In two dimensions, an obstacle crosses the whole particle layer, whatever its y coordinates are in the file.
        (low.y, high.y) = (0.0, width);
    }
    let open_ends = [domain.x_m, [0.0, width]];
    let mut open = [[true; 2]; 3];
    for (axis, ends) in open_ends.into_iter().enumerate() {
        let gaps = [low[axis] - ends[0], ends[1] - high[axis]];
        open[axis] = gaps.map(|gap| gap > FLUSH * dp);
        validate_gaps(path, axis, gaps, dp, check);
    }
    if domain.sides == Sides::Periodic && open[1][0] != open[1][1] {
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
