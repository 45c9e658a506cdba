//! Validates the structure: named solid parts, and the obstacles of the domain.
//!
//! | file | contents |
//! | --- | --- |
//! | `read` | reads a part: polygon, box, or STL surface |
//! | `sections` | checks parts that are the same across the flume |
//! | `boxes` | checks boxes |

mod boxes;
mod read;
mod sections;

use glam::DVec2;

use super::bed::Flume;
use super::part::{Part, PartShape};
use crate::case::file::{BoxFile, DomainFile, PartFile, Sides};
use crate::case::reading::check::Checker;
use crate::geometry::axis_box::AxisBox;
use crate::geometry::outline::Outline;
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

/// A part that has been read, with its key in the case file.
struct Entry {
    key: String,
    part: Part,
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
    let entries = read::read(file, materials, room, check)?;
    let before = check.count();
    let mut parts = Vec::new();
    for Entry { key, part } in entries {
        let PartShape::Section(polygon) = part.shape else {
            parts.push(part);
            continue;
        };
        let outline = Outline::new(&flume.profile.points().iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>());
        let both = outline.with(&polygon);
        if both.segments() == outline.segments() {
            let advice = "raise the part above the bed, or remove it";
            check.reject(&key, "hidden in the bed", "above the bed at one place at least", advice);
        }
        let shape = match both.as_profile() {
            Some(profile) => {
                let material = part.material.or(flume.material);
                if let (Some(material), Some(x)) = (material, raised(&outline, &both)) {
                    flume.covers.push(Cover { x, material });
                }
                flume.profile = profile;
                PartShape::Bed(polygon)
            }
            None => PartShape::Section(polygon),
        };
        parts.push(Part { shape, ..part });
    }
    (check.count() == before).then_some(parts)
}

/// Returns x of the two ends of the segments that a part adds to the outline of the bed [m].
fn raised(before: &Outline, after: &Outline) -> Option<[f64; 2]> {
    let middle_is_new = |[from, to]: &&[DVec2; 2]| !before.is_solid(0.5 * (from + to) - 1e-9 * (to - from).perp());
    let new = after.segments().iter().filter(|segment| middle_is_new(segment));
    new.map(|[from, to]| [from.x, to.x]).reduce(|[low, high], [from, to]| [low.min(from), high.max(to)])
}

/// Checks the places of the parts and of the obstacles of the domain. `width` is the width of the domain [m]. Returns
/// both; obstacles have the names `obstacle 1`, `obstacle 2`, ...
pub fn validate(
    parts: Vec<Part>,
    obstacles: &[BoxFile],
    flume: &Flume,
    width: f64,
    room: &Room,
    check: &mut Checker,
) -> Option<Vec<Part>> {
    let before = check.count();
    sections::check(&parts, flume, room, check);
    let of_parts = parts.iter().enumerate().filter_map(|(index, part)| match &part.shape {
        PartShape::Box(bounds) => Some((format!("structure[{index}].box"), *bounds)),
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
    let obstacle = |(index, bounds)| Part {
        name: format!("obstacle {}", index + 1),
        shape: PartShape::Box(bounds),
        material: None,
    };
    placed.extend(found.enumerate().map(obstacle));
    (check.count() == before).then_some(placed)
}
