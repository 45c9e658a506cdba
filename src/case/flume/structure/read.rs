//! Reads the parts of a structure: polygons, boxes and STL surfaces.

use std::collections::{HashMap, HashSet};
use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Room, porous};
use crate::case::file::{PartFile, PartStlFile};
use crate::case::flume::body::BodyPart;
use crate::case::flume::part::{Part, PartShape};
use crate::case::reading::check::{Checker, more_than};
use crate::geometry::axis_box::AxisBox;
use crate::geometry::outline::polygon::Polygon;
use crate::geometry::solid::Solid;
use crate::geometry::stl;
use crate::geometry::terrain::Terrain;

/// Largest number of parts in one case.
const MOST_PARTS: usize = 1000;
/// Largest number of corners of a polygon.
const MOST_CORNERS: usize = 10_000;
/// Largest number of triangles of a part that is neither a section nor a box.
const MOST_TRIANGLES: usize = 200_000;
/// Coordinates that differ by less than this are equal, divided by the largest coordinate [-]. A binary STL file stores
/// coordinates with 24 bits, to 6e-8 of their value.
const SAME: f64 = 1e-6;

/// Reads all parts. `materials` lists the material of each part.
pub(super) fn read(
    file: &[PartFile],
    materials: &[Option<usize>],
    room: &Room,
    check: &mut Checker,
) -> Option<Vec<Part>> {
    if file.len() > MOST_PARTS {
        check.reject("structure", file.len(), format!("at most {MOST_PARTS} parts"), "join some parts");
        return None;
    }
    let mut parts = Vec::new();
    for (index, part) in file.iter().enumerate() {
        let key = format!("structure[{index}]");
        if part.name.trim().is_empty() || file[..index].iter().any(|other| other.name == part.name) {
            let allowed = "not empty, and different from those of other parts";
            check.reject(&format!("{key}.name"), format!("{:?}", part.name), allowed, "rename the part");
        }
        let material = materials.get(index).copied().flatten();
        let shape = check.in_section(&key, |check| {
            let shape = read_shape(part, index, room, check)?;
            match &part.porous {
                None => Some(shape),
                Some(medium) => {
                    let medium = check.in_section(&format!("{key}.porous"), |check| porous::validate(medium, check))?;
                    Some(PartShape::Porous(medium, Box::new(shape)))
                }
            }
        });
        parts.push(shape.map(|shape| Part { name: part.name.clone(), shape, material }));
    }
    parts.into_iter().collect()
}

fn read_shape(part: &PartFile, index: usize, room: &Room, check: &mut Checker) -> Option<PartShape> {
    match (&part.polygon_m, &part.cuboid, &part.stl) {
        (Some(points), None, None) => read_polygon(points, check).map(PartShape::Section),
        (None, Some(bounds), None) => Some(PartShape::Box(AxisBox::free(bounds.low_m.into(), bounds.high_m.into()))),
        (None, None, Some(stl)) => read_stl(stl, index, room, check),
        (polygon, bounds, stl) => {
            let given =
                [polygon.is_some(), bounds.is_some(), stl.is_some()].iter().filter(|is_given| **is_given).count();
            let advice = "write the section as `polygon_m`, a block as `box`, any other shape as `stl`";
            check.reject(
                ".",
                format!("{given} of the three shapes"),
                "exactly one of `polygon_m`, `box` and `stl`",
                advice,
            );
            None
        }
    }
}

fn read_polygon(points: &[[f64; 2]], check: &mut Checker) -> Option<Polygon> {
    if points.len() > MOST_CORNERS {
        let allowed = format!("at most {MOST_CORNERS} points");
        check.reject(".polygon_m", format!("{} points", points.len()), allowed, "leave out points");
        return None;
    }
    match Polygon::new(points) {
        Ok(polygon) => Some(polygon),
        Err(error) => {
            let advice =
                "write the corner points [x, z] in their order around the section, without repeating the first one";
            check.reject(".polygon_m", error, "a polygon whose edges do not cross", advice);
            None
        }
    }
}

fn read_stl(file: &PartStlFile, index: usize, room: &Room, check: &mut Checker) -> Option<PartShape> {
    let advice = "1 for a file in metres, 0.001 for a file in millimetres";
    let mut is_valid = check.number(".stl.scale", file.scale, more_than(0.0).up_to(1000.0), "", advice);
    if let Some(axis) = file.origin_m.iter().position(|value| !value.is_finite()) {
        let path = format!(".stl.origin_m[{axis}]");
        check.reject(&path, "not finite", "a finite number", "write a position in metres");
        is_valid = false;
    }
    if !is_valid {
        return None;
    }
    let path = Path::new(room.name).parent().unwrap_or(Path::new("")).join(&file.path);
    let shown = format!("{:?}", path.display().to_string());
    let content = match std::fs::read(&path) {
        Ok(content) => content,
        Err(error) => {
            let allowed = format!("a file that can be read ({error})");
            check.reject(".stl.path", shown, allowed, "paths are relative to the case file");
            return None;
        }
    };
    let solid = match stl::parse(&content, &path, file.scale) {
        Ok(solid) => solid,
        Err(error) => {
            let advice = "write one closed surface without holes, with triangles counter-clockwise seen from outside";
            check.reject(".stl.path", shown, format!("a closed surface ({error})"), advice);
            return None;
        }
    };
    let origin = DVec3::from_array(file.origin_m);
    // Coordinates of a file are rounded. A face at a side or at an end of the domain lies exactly there.
    let slack = SAME * solid.vertices().iter().map(|v| (*v + origin).abs().max_element()).fold(0.0, f64::max);
    let snapped = |value: f64, to: &[f64]| to.iter().copied().find(|at| (at - value).abs() <= slack).unwrap_or(value);
    if let Some(bounds) = as_box(&solid) {
        let sides: Vec<f64> = [0.0].into_iter().chain(room.width).collect();
        let corner = |at: DVec3| DVec3::new(snapped(at.x, &room.x), snapped(at.y, &sides), at.z);
        let AxisBox { low, high, .. } = bounds.shifted(origin);
        let (mut low, mut high) = (corner(low), corner(high));
        // A box that continues beyond the sides ends there.
        (low.y, high.y) = (low.y.max(0.0), high.y.min(room.width.unwrap_or(f64::INFINITY)));
        return Some(PartShape::Box(AxisBox::free(low, high)));
    }
    let section = as_section(&solid, origin, slack, room);
    if let Some(points) = section {
        let section: Vec<[f64; 2]> = points.into_iter().map(|[x, z]| [snapped(x, &room.x), z]).collect();
        return read_polygon(&section, check).map(PartShape::Section);
    }
    match body(file, index, &solid, content, room) {
        Ok(body) => Some(PartShape::Body(body)),
        Err((allowed, advice)) => {
            check.reject(".stl.path", shown, allowed, advice);
            None
        }
    }
}

/// Returns the part of any shape with this surface, which is the `content` of its file. `index` is its place in the list
/// of parts.
///
/// # Errors
/// If no part can have this surface: what is allowed, and advice.
fn body(
    file: &PartStlFile,
    index: usize,
    solid: &Solid,
    content: Vec<u8>,
    room: &Room,
) -> Result<BodyPart, (String, &'static str)> {
    if room.width.is_none() {
        let advice = "write a section, or use three dimensions";
        return Err(("a surface that is the same across the flume, or a box, in two dimensions".to_owned(), advice));
    }
    if solid.triangles().len() > MOST_TRIANGLES {
        return Err((format!("at most {MOST_TRIANGLES} triangles"), "make the mesh coarser"));
    }
    if let Some(point) = solid.self_intersection() {
        let allowed = format!("a surface that does not intersect itself (it does near {point} m of the file)");
        return Err((allowed, "join the bodies of the file to one body"));
    }
    let advice = "write one closed surface without holes";
    let origin = DVec3::from_array(file.origin_m);
    let solid = solid.translated(origin).map_err(|error| (format!("a closed surface ({error})"), advice))?;
    let surface = Terrain::new(solid.vertices().to_vec(), solid.triangles().to_vec())
        .map_err(|error| (format!("a surface of triangles with areas ({error})"), "repair the mesh"))?;
    Ok(BodyPart {
        solid: Arc::new(solid),
        surface: Arc::new(surface),
        content: Arc::new(content),
        file_name: format!("part_{}.stl", index + 1),
        scale: file.scale,
        origin,
        terrain_x: None,
    })
}

/// Returns a surface as a box with edges along the axes, if it is one.
fn as_box(solid: &Solid) -> Option<AxisBox> {
    let [low, high] = solid.bounds();
    let slack = SAME * low.abs().max(high.abs()).max_element();
    let is_corner = |v: &DVec3| {
        (*v - v.clamp(low, high)).length() <= slack && {
            let ends = (*v - low).abs().min((*v - high).abs());
            ends.max_element() <= slack
        }
    };
    let is_box = solid.vertices().iter().all(is_corner)
        && (solid.volume_properties().volume / (high - low).element_product() - 1.0).abs() < 1e-3;
    is_box.then(|| AxisBox::free(low, high))
}

/// Returns the corners [x, z] of the section of a surface that is the same across the flume [m], and has no holes.
/// Coordinates that differ by less than `slack` [m] are equal.
fn as_section(solid: &Solid, origin: DVec3, slack: f64, room: &Room) -> Option<Vec<[f64; 2]>> {
    let [low, high] = solid.bounds();
    let reaches = room.width.is_none_or(|width| low.y + origin.y <= slack && high.y + origin.y >= width - slack);
    let is_on = |v: u32, y: f64| (solid.vertices()[v as usize].y - y).abs() <= slack;
    let all = 0..solid.vertices().len() as u32;
    if !reaches || !all.clone().all(|v| is_on(v, low.y) || is_on(v, high.y)) {
        return None;
    }
    // The faces at the lower end, and their edges that belong to one of these faces only: start and end of each.
    let at_end = solid.triangles().iter().filter(|triangle| triangle.iter().all(|v| is_on(*v, low.y)));
    let edges = at_end.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let inner: HashSet<[u32; 2]> = edges.clone().collect();
    let border: HashMap<u32, u32> = edges.filter(|[a, b]| !inner.contains(&[*b, *a])).map(|[a, b]| (a, b)).collect();
    let first = *border.keys().min()?;
    let (mut line, mut next) = (vec![first], *border.get(&first)?);
    while next != first && line.len() < border.len() {
        line.push(next);
        next = *border.get(&next)?;
    }
    if next != first || line.len() != border.len() {
        return None;
    }
    let point = |v: u32| {
        let DVec3 { x, z, .. } = solid.vertices()[v as usize] + origin;
        DVec2::new(x, z)
    };
    let corners: Vec<DVec2> = line.iter().map(|v| point(*v)).collect();
    // Points within straight edges are left out.
    let count = corners.len();
    let is_corner = |index: &usize| {
        let [before, at, after] = [count - 1, 0, 1].map(|step| corners[(index + step) % count]);
        let (one, other) = (at - before, after - at);
        one.perp_dot(other).abs() > SAME * (one.length() * other.length() + slack * slack)
    };
    let section: Vec<[f64; 2]> = (0..count).filter(is_corner).map(|index| corners[index].to_array()).collect();
    if section.len() > MOST_CORNERS {
        return None;
    }
    // All vertices at the other end lie on the same section; with a hole, the volume would be too small.
    let polygon = Polygon::new(&section).ok()?;
    let is_same = all.map(point).all(|at| polygon.nearest(at).distance(at) <= 2.0 * slack);
    let volume = polygon.area() * (high.y - low.y);
    (is_same && (solid.volume_properties().volume / volume - 1.0).abs() < 1e-3).then_some(section)
}
