//! Checks parts that are the same across the flume: their extent, thickness, and gaps between them.

use glam::DVec2;

use super::Room;
use crate::case::flume::bed::Flume;
use crate::case::flume::part::{Part, PartShape};
use crate::case::reading::check::{Checker, as_text, lower_limit};
use crate::geometry::outline::{Outline, polygon::Polygon, segments::left_normal};

/// Smallest allowed thickness of a part, divided by the particle spacing dp [-]. Water particles on opposite sides of a
/// thinner part interact with each other.
pub(super) const THINNEST: f64 = 3.0;
/// Width of the narrowest gap that water can enter, divided by the particle spacing dp [-].
pub(super) const NARROWEST: f64 = 2.0;
/// Smallest allowed size of a part [m].
const SMALLEST: f64 = 1e-3;
/// Parts overlap if points this far inside one of them are inside the other, divided by its size [-].
const OVERLAP: f64 = 1e-4;

/// Checks the places of all parts that are the same across the flume.
pub(super) fn check(parts: &[Part], flume: &Flume, room: &Room, check: &mut Checker) {
    let polygons: Vec<(usize, &Part, &Polygon)> =
        parts.iter().enumerate().filter_map(|(index, part)| Some((index, part, part.polygon()?))).collect();
    for (index, part, polygon) in &polygons {
        check_extent(&format!("structure[{index}]"), part, polygon, flume, room, check);
        let other = polygons[..].iter().find(|(other, _, polygon)| other < index && overlap(polygon, part));
        if let Some((other, ..)) = other {
            let allowed = format!("outside structure[{other}]");
            check.reject(
                &format!("structure[{index}]"),
                format!("{:?}", part.name),
                allowed,
                "parts may touch: move one of them",
            );
        }
    }
    let Some(dp) = room.dp else { return };
    let outline = outline(parts, flume, room);
    for (index, part, polygon) in polygons.iter().filter(|(_, part, _)| part.medium().is_none()) {
        check_room(&format!("structure[{index}]"), part, polygon, &outline, dp, check);
    }
}

/// Returns the outline of bed, end walls and all parts that are the same across the flume.
fn outline(parts: &[Part], flume: &Flume, room: &Room) -> Outline {
    let [from, to] = room.x;
    let inner = flume.profile.points().iter().filter(|point| point[0] > from && point[0] < to);
    let at = |x: f64| DVec2::new(x, flume.profile.z(x));
    let bed = [at(from)].into_iter().chain(inner.map(|point| DVec2::from_array(*point))).chain([at(to)]);
    let wall = |x: f64| [DVec2::new(x, room.top_z)];
    let points: Vec<DVec2> = wall(from).into_iter().chain(bed).chain(wall(to)).collect();
    parts.iter().filter_map(Part::section).fold(Outline::new(&points), |outline, polygon| outline.with(polygon))
}

fn check_extent(key: &str, part: &Part, polygon: &Polygon, flume: &Flume, room: &Room, check: &mut Checker) {
    let ([low, high], is_bed) = (polygon.bounds(), matches!(part.surface(), PartShape::Bed(_)));
    let (ends, name) = if is_bed { (flume.ends(), "flume.bed_m") } else { (room.x, "domain.x_m") };
    if low.x < ends[0] || high.x > ends[1] {
        let given = format!("from x = {} to {} m", as_text(low.x), as_text(high.x));
        let allowed = format!("within `{name}`, {} to {} m", as_text(ends[0]), as_text(ends[1]));
        check.reject(key, given, allowed, format!("move the part or lengthen `{name}`"));
    }
    let size = (high - low).max_element();
    if size < SMALLEST {
        let allowed = format!("at least {SMALLEST} m long or high");
        check.reject(key, format!("{} m", as_text(size)), allowed, "write the coordinates in metres");
    }
    // The domain checks the level of the bed between its ends.
    if high.y > room.top_z && !is_bed {
        let given = format!("up to z = {} m", as_text(high.y));
        let allowed = format!("at most {} m, the top of the walls", as_text(room.top_z));
        check.reject(key, given, allowed, "lower the part or raise `domain.top_z_m`");
    }
}

/// Returns true if a part overlaps a polygon. Parts that touch do not overlap.
fn overlap(polygon: &Polygon, part: &Part) -> bool {
    let Some(other) = part.polygon() else { return false };
    let reaches_into = |one: &Polygon, other: &Polygon| {
        let depth = OVERLAP * one.bounds()[1].distance(one.bounds()[0]);
        samples(one, one.bounds()[1].distance(one.bounds()[0]) / 64.0)
            .any(|(at, normal)| other.distance(at - depth * normal) < -0.5 * depth)
    };
    reaches_into(polygon, other) || reaches_into(other, polygon)
}

/// Returns points on the edges of a polygon, at most `spacing` [m] apart, with the outward normals.
fn samples(polygon: &Polygon, spacing: f64) -> impl Iterator<Item = (DVec2, DVec2)> {
    polygon.edges().flat_map(move |edge| {
        let count = (edge[0].distance(edge[1]) / spacing).ceil().max(1.0);
        (0..count as u32).map(move |k| (edge[0].lerp(edge[1], (f64::from(k) + 0.5) / count), left_normal(&edge)))
    })
}

/// Checks that a part is thick enough for the particles, and that gaps next to it are wide enough for water.
fn check_room(key: &str, part: &Part, polygon: &Polygon, outline: &Outline, dp: f64, check: &mut Checker) {
    let in_front = (1e-3 * dp).max(2.0 * outline.touch());
    let is_open = |(at, normal): &(DVec2, DVec2)| !outline.is_solid(at + in_front * normal);
    let (thinnest, narrowest) = (THINNEST * (1.0 - 1e-6) * dp, NARROWEST * (1.0 - 1e-6) * dp);
    let faces: Vec<(DVec2, DVec2)> = samples(polygon, dp).filter(is_open).collect();
    let nearest = |directed: f64, reach: f64| {
        let found = |(at, normal): &(DVec2, DVec2)| Some((*at, outline.facing(*at, directed * normal, reach)?));
        faces.iter().filter_map(found).min_by(|a, b| a.1.total_cmp(&b.1))
    };
    if let Some((at, thickness)) = nearest(-1.0, thinnest) {
        check.reject(
            key,
            format!(
                "{:?}, {} m thick at x = {}, z = {} m",
                part.name,
                as_text(thickness),
                as_text(at.x),
                as_text(at.y)
            ),
            format!("at least {} m thick, {THINNEST} particle spacings", lower_limit(THINNEST * dp)),
            format!("make the part thicker, or write `domain.dp_m` of at most {} m", as_text(thickness / THINNEST)),
        );
    }
    if let Some((at, gap)) = nearest(1.0, narrowest) {
        check.reject(
            key,
            format!(
                "{:?}, {} m from the next face at x = {}, z = {} m",
                part.name,
                as_text(gap),
                as_text(at.x),
                as_text(at.y)
            ),
            format!("0, or at least {} m, {NARROWEST} particle spacings", lower_limit(NARROWEST * dp)),
            "the gap is too narrow for water: close it or make it wider",
        );
    }
}
