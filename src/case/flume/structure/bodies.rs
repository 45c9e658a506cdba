//! Checks parts of any shape from STL files: their place, their thickness, and their distance from other parts.

use glam::DVec3;

use super::Room;
use super::sections::{NARROWEST, THINNEST};
use crate::case::file::Sides;
use crate::case::flume::bed::Flume;
use crate::case::flume::body::BodyPart;
use crate::case::flume::part::{Part, PartShape};
use crate::case::reading::check::{Checker, as_text, lower_limit};
use crate::geometry::open_space::{OpenSpace, OpenSurface};

/// Distance of the body from bed and walls below which it counts as touching, divided by the particle spacing [-].
const FLUSH: f64 = 1e-3;
/// Smallest spacing of the points at which a body is checked, divided by its size [-].
const FINEST: f64 = 1.0 / 64.0;
/// Rounding of the coordinates of a file, divided by the largest coordinate [-].
const SINGLE: f64 = 1e-6;
/// Smallest cosine of the angle between two opposite faces [-]. Faces at larger angles meet in an edge, which may be
/// sharp.
const OPPOSITE: f64 = 0.9;

/// Checks the places of all bodies. `width` is the width of the domain [m].
pub(super) fn check(parts: &[Part], flume: &Flume, width: f64, room: &Room, check: &mut Checker) {
    for (index, part) in parts.iter().enumerate() {
        if let PartShape::Body(body) = &part.shape {
            let before = check.count();
            let key = format!("structure[{index}].stl");
            check_extent(&key, part, body, width, room, check);
            if check.count() > before {
                continue;
            }
            let [low, high] = body.solid.bounds();
            let size = (high - low).max_element();
            let spacing = room.dp.map_or(FINEST * size, |dp| dp.max(FINEST * size));
            let sides = (room.sides != Sides::Periodic).then_some([0.0, width]);
            let space = OpenSpace::new(&flume.profile, room.x, sides, FLUSH * spacing);
            let Some(surface) = space.part_of(body.triangles()) else {
                let allowed = "above the bed and between the sides at one place at least";
                check.reject(&key, extent(body), allowed, "move the part with `origin_m`, or remove it");
                continue;
            };
            check_overlap(&key, &parts[..index], parts, &surface, spacing, room, check);
            if let Some(dp) = room.dp {
                check_thickness(&key, part, body, &space, &surface, dp, check);
            }
        }
    }
}

fn extent(body: &BodyPart) -> String {
    let [low, high] = body.solid.bounds();
    let range = |axis: usize| format!("{} to {} m", as_text(low[axis]), as_text(high[axis]));
    format!("x = {}, y = {}, z = {}", range(0), range(1), range(2))
}

fn check_extent(key: &str, part: &Part, body: &BodyPart, width: f64, room: &Room, check: &mut Checker) {
    let [low, high] = body.solid.bounds();
    let [from, to] = part.x();
    // Coordinates of a binary STL file have 24 bits.
    let slack = SINGLE * low.abs().max(high.abs()).max_element();
    if from < room.x[0] - slack || to > room.x[1] + slack {
        let allowed = format!("within `domain.x_m`, {} to {} m", as_text(room.x[0]), as_text(room.x[1]));
        check.reject(
            key,
            extent(body),
            allowed,
            "move the part with `origin_m`, correct `scale`, or lengthen the domain",
        );
    }
    if high.z > room.top_z + slack {
        let allowed = format!("at most z = {} m, the top of the walls", as_text(room.top_z));
        check.reject(key, extent(body), allowed, "lower the part, correct `scale`, or raise `domain.top_z_m`");
    }
    let gap = room.dp.map_or(0.0, |dp| NARROWEST * dp);
    if room.sides == Sides::Periodic && !(low.y >= gap && high.y <= width - gap) {
        let allowed = format!("the same across the flume, or at least {} m from both periodic sides", lower_limit(gap));
        let advice = "move the part to the middle of the width, or write \"sides\": \"walls\"";
        check.reject(key, extent(body), allowed, advice);
    }
}

/// Checks that no other part is in the body or near it. The points of `surface` have this `spacing` [m].
pub fn check_overlap(
    key: &str,
    before: &[Part],
    all: &[Part],
    surface: &OpenSurface,
    spacing: f64,
    room: &Room,
    check: &mut Checker,
) {
    let bodies = before.iter().filter(|part| part.as_body().is_some());
    let others = all.iter().filter(|part| matches!(part.shape, PartShape::Section(_) | PartShape::Box(_)));
    let gap = room.dp.map_or(0.0, |dp| NARROWEST * dp);
    let near = |part: &&Part| surface.samples(spacing).any(|(at, _)| part.distance(at) < gap);
    if let Some(other) = bodies.chain(others).find(near) {
        let allowed = format!("at least {} m from {:?}", lower_limit(gap), other.name);
        let advice = "the gap is too narrow for water: join the two in one STL file, or move one of them";
        check.reject(key, "too near", allowed, advice);
    }
}

/// Checks that the body is thick enough for the particles between faces that water can reach.
fn check_thickness(
    key: &str,
    part: &Part,
    body: &BodyPart,
    space: &OpenSpace,
    surface: &OpenSurface,
    dp: f64,
    check: &mut Checker,
) {
    let least = THINNEST * (1.0 - 1e-6) * dp;
    let thickness = |(at, area): (DVec3, DVec3)| {
        let normal = area.normalize_or_zero();
        let (way, cosine) = body.solid.ray(at - FLUSH * dp * normal, -normal, least)?;
        let is_opposite = cosine > OPPOSITE && space.contains(at - (way + FLUSH * dp) * normal);
        is_opposite.then_some((way + FLUSH * dp, at))
    };
    let thinnest = surface.samples(dp).filter_map(thickness).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((thickness, at)) = thinnest {
        let [x, y, z] = at.to_array().map(as_text);
        check.reject(
            key,
            format!("{:?}, {} m thick at ({x}, {y}, {z}) m", part.name, as_text(thickness)),
            format!("at least {} m thick, {THINNEST} particle spacings", lower_limit(THINNEST * dp)),
            format!("make the part thicker, or write `domain.dp_m` of at most {} m", as_text(thickness / THINNEST)),
        );
    }
}
