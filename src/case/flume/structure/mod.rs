//! Validates the structure: named solid parts, and the obstacles of the domain.
//!
//! | file | contents |
//! | --- | --- |
//! | `read` | reads a part: polygon, box, or STL surface |
//! | `sections` | checks parts that are the same across the flume |
//! | `boxes` | checks boxes |
//! | `porous` | validates parts through which water flows |
//! | `bodies` | checks parts of any shape |

pub(super) mod bodies;
mod boxes;
mod porous;
mod read;
mod sections;

use glam::DVec2;

use super::bed::Flume;
use super::part::{Part, PartShape};
use crate::case::file::{BoxFile, DomainFile, PartFile, Sides};
use crate::case::reading::check::Checker;
use crate::geometry::axis_box::AxisBox;
use crate::geometry::outline::{Outline, polygon::Polygon, segments::left_normal};
use crate::geometry::profile::Profile;
use crate::rigid::Cover;

/// Surroundings of the parts.
#[derive(Debug, Clone, Copy)]
pub struct Room<'a> {
    /// Path of the case file; paths in the case are relative to its folder.
    pub name: &'a str,
    /// x of the seaward and of the shoreward end of the domain [m].
    pub x: [f64; 2],
    /// Width of the domain [m]; `None` in two dimensions.
    pub width: Option<f64>,
    /// Boundaries at the two sides of the flume.
    pub sides: Sides,
    /// Level of the top of the walls [m].
    pub top_z: f64,
    /// Particle spacing [m]; `None` without water.
    pub dp: Option<f64>,
}

impl<'a> Room<'a> {
    /// Returns the room in the domain of a flume case.
    pub fn of(file: &DomainFile, name: &'a str) -> Self {
        let width = if file.sides == Sides::TwoDimensional { None } else { file.width_m };
        Self { name, x: file.x_m, width, sides: file.sides, top_z: file.top_z_m, dp: Some(file.dp_m) }
    }
}

/// Reads the parts. Parts that lie on the bed become part of its profile. `materials` lists the material of each part.
/// Returns all parts, whose places have not been checked.
pub fn place_on_bed(
    file: &[PartFile],
    materials: &[Option<usize>],
    flume: &mut Flume,
    room: &Room,
    check: &mut Checker,
) -> Option<Vec<Part>> {
    let mut parts = read::read(file, materials, room, check)?;
    // A part can lie on a part that follows in the list.
    while let Some((part, raised)) = raise_one(&mut parts, &flume.profile, Part::section) {
        if let Some(material) = part.material.or(flume.material) {
            flume.covers.push(Cover { x: raised.x, material });
        }
        flume.profile = raised.profile;
        if let PartShape::Section(polygon) = &part.shape {
            part.shape = PartShape::Bed(polygon.clone());
        }
    }
    // Units rest on porous parts, but the bed of the water is below them.
    let mut rest = flume.profile.clone();
    while let Some((part, raised)) = raise_one(&mut parts, &rest, porous_section) {
        if let Some(material) = part.material.or(flume.material) {
            flume.covers.push(Cover { x: raised.x, material });
        }
        rest = raised.profile;
        if let PartShape::Porous(_, shape) = &mut part.shape
            && let PartShape::Section(polygon) = &**shape
        {
            **shape = PartShape::Bed(polygon.clone());
        }
        flume.rest = Some(rest.clone());
    }
    let before = check.count();
    for (index, part) in parts.iter().enumerate() {
        if part.polygon().is_some_and(|polygon| is_hidden(part, &flume.profile, polygon)) {
            let advice = "raise the part above the bed, or remove it";
            let allowed = "above the bed at one place at least";
            check.reject(&format!("structure[{index}]"), "hidden in the bed", allowed, advice);
        }
    }
    (check.count() == before).then_some(parts)
}

/// The bed with a part on it.
struct Raised {
    profile: Profile,
    /// x of both ends of the part on the bed [m].
    x: [f64; 2],
}

/// Returns the first part that can become part of the bed, and the bed with it. `section` returns the section of a part
/// if it is one to be tried.
fn raise_one<'a>(
    parts: &'a mut [Part],
    bed: &Profile,
    section: fn(&Part) -> Option<&Polygon>,
) -> Option<(&'a mut Part, Raised)> {
    let outline = outline_of(bed);
    parts.iter_mut().find_map(|part| {
        let polygon = section(part)?;
        let raised = Raised { profile: outline.with(polygon).as_profile()?, x: added(&outline, polygon)? };
        Some((part, raised))
    })
}

/// Returns the section of a porous part that is the same across the flume and not yet part of the bed.
fn porous_section(part: &Part) -> Option<&Polygon> {
    match &part.shape {
        PartShape::Porous(_, shape) => match &**shape {
            PartShape::Section(polygon) => Some(polygon),
            _ => None,
        },
        _ => None,
    }
}

/// Returns true if the bed covers the whole section of a part that is not part of the bed.
fn is_hidden(part: &Part, bed: &Profile, polygon: &Polygon) -> bool {
    !matches!(part.shape, PartShape::Bed(_)) && added(&outline_of(bed), polygon).is_none()
}

fn outline_of(bed: &Profile) -> Outline {
    Outline::new(&bed.points().iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>())
}

/// Returns x of both ends of what a polygon adds to the outline of the bed [m]; `None` if it adds nothing.
fn added(bed: &Outline, polygon: &Polygon) -> Option<[f64; 2]> {
    let [low, high] = polygon.bounds();
    let both = bed.with(polygon);
    let is_there = |[from, to]: &&[DVec2; 2]| from.x.max(to.x) >= low.x && from.x.min(to.x) <= high.x;
    // A corner of the polygon on the bed bends the bed by at most the distance at which both touch.
    let is_new = |segment: &&[DVec2; 2]| {
        let [from, to] = segment;
        !bed.is_solid(0.5 * (from + to) - 2.0 * bed.touch() * left_normal(segment))
    };
    let new = both.segments().iter().filter(is_there).filter(is_new);
    new.map(|[from, to]| [from.x.min(to.x), from.x.max(to.x)])
        .reduce(|[low, high], [from, to]| [low.min(from), high.max(to)])
}

/// Checks the places of the parts, which are those of `file`, and of the obstacles of the domain. `width` is the width of
/// the domain [m]. Returns both; obstacles have the names `obstacle 1`, `obstacle 2`, ...
pub fn validate(
    parts: Vec<Part>,
    file: &[PartFile],
    obstacles: &[BoxFile],
    flume: &Flume,
    width: f64,
    room: &Room,
    check: &mut Checker,
) -> Option<Vec<Part>> {
    let before = check.count();
    sections::check(&parts, flume, room, check);
    let of_parts = parts.iter().enumerate().filter_map(|(index, part)| match &part.shape {
        PartShape::Box(bounds) => {
            let shape = if file.get(index).is_some_and(|part| part.stl.is_some()) { "stl" } else { "box" };
            Some((format!("structure[{index}].{shape}"), *bounds))
        }
        _ => None,
    });
    let of_domain = obstacles.iter().enumerate().map(|(index, file)| {
        (format!("domain.obstacles[{index}]"), AxisBox::free(file.low_m.into(), file.high_m.into()))
    });
    let all: Vec<(String, AxisBox)> = of_parts.chain(of_domain).collect();
    let mut found = boxes::check(&all, &parts, flume, width, room, check)?.into_iter();
    let mut placed = Vec::new();
    for part in parts {
        let shape = match part.shape {
            PartShape::Box(_) => PartShape::Box(found.next()?),
            shape => shape,
        };
        placed.push(Part { shape, ..part });
    }
    let obstacle = |(index, bounds): (usize, AxisBox)| Part {
        name: format!("obstacle {}", index + 1),
        shape: PartShape::Box(bounds),
        material: None,
    };
    placed.extend(found.enumerate().map(obstacle));
    bodies::check(&placed, flume, width, room, check);
    porous::check_places(&placed, room, check);
    (check.count() == before).then_some(placed)
}
