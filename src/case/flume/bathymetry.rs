//! Terrain under water: a surface from an STL file, for example a survey of the sea bed.
//!
//! The surface faces up everywhere, and the ground is the higher of surface and bed. Where it is the same across the
//! domain, the ground is a profile, like a bed without terrain. Elsewhere the terrain is a body on a profile below the
//! lowest ground: deep enough for the layers of boundary particles, so that these follow the surface. The flume model
//! takes the section of the surface along one line.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::bed::{Bathymetry, Flume};
use super::body::BodyPart;
use super::domain::Domain;
use super::part::{Part, PartShape};
use super::structure::{Room, bodies};
use super::terrain::{self, SiteTerrain};
use crate::case::file::{Sides, TerrainFile};
use crate::case::reading::check::{Checker, as_text};
use crate::geometry::height_field::{Levels, body_below, levels_across, overhang, simplified};
use crate::geometry::open_space::{OpenSpace, OpenSurface};
use crate::geometry::outline::{Outline, polygon::Polygon};
use crate::geometry::profile::Profile;
use crate::sph::particles::standing::TOUCHING;

/// Largest number of triangles. The particles search the surface in every step.
const MOST_TRIANGLES: usize = 200_000;
/// Largest number of corners of the lowest ground. The search for the nearest ground goes through all corners.
const MOST_CORNERS: usize = 2000;
/// Depth of the profile below the lowest ground where the terrain is not the same across the domain, divided by the
/// particle spacing [-]: at least that of the layers of boundary particles.
const BELOW: f64 = 4.0;
/// Depth of the profile below the lowest ground, divided by the difference of lowest and highest ground [-], for small
/// differences. The profile then has no step.
const STEEP: f64 = 10.0;
/// Distance of the lowest ground from the terrain, where this is the same across the flume, divided by the particle
/// spacing [-].
const TOLERANCE: f64 = 1e-3;
/// Thickness of the body below the lowest ground, divided by the particle spacing [-]: more than the layers of boundary
/// particles.
const DEPTH: f64 = 10.0;
/// Largest difference of the ground across a moving end from that of the flume model, divided by the particle spacing
/// [-].
const UNEVEN: f64 = 1.0;
/// Number of points across a moving end at which the ground is compared.
const SAMPLES: u32 = 100;
/// Key of the terrain in the case file.
const KEY: &str = "flume.terrain";

/// Reads the terrain of the case `name`, and changes the ground of the flume. Returns the terrain if a part of it is not
/// the same across the flume.
pub(super) fn place(
    file: &TerrainFile,
    name: &str,
    flume: &mut Flume,
    room: &Room,
    check: &mut Checker,
) -> Option<Option<Part>> {
    let terrain = terrain::validate(file, name, check)?;
    check_shape(&terrain, room, check)?;
    let dp = room.dp.filter(|dp| *dp > 0.0)?;
    let y = section_line(file, &terrain, room, check)?;
    let section = raised(flume, &terrain, [y, y], dp, check)?;
    let Some(width) = room.width else {
        if section == flume.profile {
            let advice = "raise the surface above the bed, or correct its scale";
            check.reject(KEY, "hidden in the bed along the section", "above the bed at one place at least", advice);
            return None;
        }
        (flume.profile, flume.terrain) = (section, Some(terrain));
        return Some(None);
    };
    let before = check.count();
    terrain::validate_place(&terrain, &flume.profile, room.x, width, room.top_z, check);
    if check.count() > before {
        return None;
    }
    let lowest = raised(flume, &terrain, [0.0, width], dp, check)?;
    flume.terrain = Some(terrain.clone());
    let ground = std::mem::replace(&mut flume.profile, lowest);
    let inset = TOUCHING * dp;
    let Some(above) = surface_above(flume, &terrain, room, width, inset) else {
        return Some(None);
    };
    flume.bathymetry = Some(Bathymetry { ground, section, y });
    let points = above.triangles().flatten().map(|corner| corner.x);
    let terrain_x = points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let [low, high] = terrain.surface.bounds();
    let bottom = flume.profile.extremes_between([low.x, high.x]).0.min(low.z) - DEPTH * dp;
    let solid = match body_below(&terrain.surface, bottom) {
        Ok(solid) => solid,
        Err(error) => {
            let advice = "export the surface again, without parts that touch in single corners";
            check.reject("flume.terrain.path", error, "one connected surface", advice);
            return None;
        }
    };
    let body = BodyPart {
        solid: Arc::new(solid),
        surface: terrain.surface,
        content: terrain.content,
        file_name: SiteTerrain::FILE.to_owned(),
        scale: terrain.scale,
        origin: DVec3::ZERO,
        terrain_x: Some(terrain_x),
    };
    Some(Some(Part { name: "terrain".to_owned(), shape: PartShape::Body(body), material: None }))
}

/// Checks that the surface faces up, and that the domain has walls at its sides.
fn check_shape(terrain: &SiteTerrain, room: &Room, check: &mut Checker) -> Option<()> {
    let before = check.count();
    let count = terrain.surface.triangles().len();
    if count > MOST_TRIANGLES {
        let advice = "use triangles about as large as the particle spacing";
        check.reject("flume.terrain.path", count, format!("at most {MOST_TRIANGLES} triangles"), advice);
    }
    if let Some(at) = overhang(&terrain.surface) {
        let [x, y, z] = at.to_array().map(as_text);
        check.reject(
            "flume.terrain.path",
            format!("a triangle at ({x}, {y}, {z}) m that does not face up"),
            "a surface without overhangs and vertical faces, its triangles counter-clockwise seen from above",
            "write walls and closed bodies as parts of the `structure`",
        );
    }
    if room.sides == Sides::Periodic {
        let advice = "the two sides of a terrain differ: write \"sides\": \"walls\"";
        check.reject("domain.sides", "\"periodic\"", "\"walls\" or \"two_dimensional\" with a terrain", advice);
    }
    (check.count() == before).then_some(())
}

/// Returns y of the line along which the flume model takes its section [m].
fn section_line(file: &TerrainFile, terrain: &SiteTerrain, room: &Room, check: &mut Checker) -> Option<f64> {
    let [low, high] = terrain.surface.bounds();
    let middle = room.width.map(|width| 0.5 * width);
    let given = file.section_y_m.or(middle);
    let y = given.filter(|y| *y >= low.y && *y <= high.y);
    if y.is_none() {
        let given = given.map_or("(missing)".to_owned(), as_text);
        let allowed = format!("{} to {} m, where the terrain is", as_text(low.y), as_text(high.y));
        let advice = "write y of the line along which the flume model takes the section of the terrain";
        check.reject("flume.terrain.section_y_m", given, allowed, advice);
    }
    y
}

/// Returns the ground of a flume with the terrain between two y [m]: its section, or a profile below it.
fn raised(flume: &Flume, terrain: &SiteTerrain, y: [f64; 2], dp: f64, check: &mut Checker) -> Option<Profile> {
    let outline = Outline::new(&flume.profile.points().iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>());
    let deep = flume.profile.extremes_between(flume.ends()).0.min(terrain.surface.bounds()[0].z) - 1.0 - BELOW * dp;
    let mut raised = outline;
    let below = |levels: &Levels| {
        let depth = (STEEP * (levels.highest - levels.lowest)).min(BELOW * dp);
        DVec2::new(levels.x, levels.lowest - depth)
    };
    for line in levels_across(&terrain.surface, y) {
        let line: Vec<DVec2> = line.iter().map(below).collect();
        let line = in_flume(&simplified(&line, TOLERANCE * dp), flume);
        let (Some(first), Some(last)) = (line.first(), line.last()) else { continue };
        let ends = [DVec2::new(last.x, deep), DVec2::new(first.x, deep)];
        let corners: Vec<[f64; 2]> = line.iter().copied().chain(ends).map(Into::into).collect();
        if let Ok(polygon) = Polygon::new(&corners) {
            raised = raised.with(&polygon);
        }
    }
    let profile = raised.as_profile();
    let count = profile.as_ref().map_or(0, |profile| profile.points().len());
    if profile.is_none() {
        let place =
            if y[0] == y[1] { format!("along y = {} m", as_text(y[0])) } else { "across the domain".to_owned() };
        check.reject(
            KEY,
            format!("a surface that ends in a step {place}"),
            "a surface that meets the bed where it ends, or reaches to the ends of the bed",
            "extend the surface until it lies below `flume.bed_m`",
        );
    } else if count > MOST_CORNERS {
        let advice = "use triangles about as large as the particle spacing";
        check.reject(KEY, format!("{count} corners of the lowest ground"), format!("at most {MOST_CORNERS}"), advice);
        return None;
    }
    profile
}

/// Returns the part of a line [x, z] between the ends of the flume.
fn in_flume(line: &[DVec2], flume: &Flume) -> Vec<DVec2> {
    let [from, to] = flume.ends();
    let mut inside = Vec::new();
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        if b.x <= from || a.x >= to {
            continue;
        }
        let at = |x: f64| a.lerp(b, ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0));
        if inside.is_empty() {
            inside.push(if a.x < from { DVec2::new(from, at(from).y) } else { a });
        }
        inside.push(if b.x > to { DVec2::new(to, at(to).y) } else { b });
    }
    inside
}

/// Returns the part of the terrain that is more than `inset` [m] above the lowest ground.
fn surface_above(flume: &Flume, terrain: &SiteTerrain, room: &Room, width: f64, inset: f64) -> Option<OpenSurface> {
    let space = OpenSpace::new(&flume.profile, room.x, Some([0.0, width]), inset);
    let corners = |triangle: &[u32; 3]| triangle.map(|v| terrain.surface.vertices()[v as usize]);
    space.part_of(terrain.surface.triangles().iter().map(corners))
}

/// Checks that no part of the structure is near what rises above the bed.
pub(super) fn check_place(part: &Part, flume: &Flume, domain: &Domain, room: &Room, check: &mut Checker) {
    let Some(body) = part.as_body() else { return };
    let space = OpenSpace::new(&flume.profile, room.x, Some([0.0, domain.width]), TOUCHING * domain.dp);
    let Some(surface) = space.part_of(body.surface_triangles()) else { return };
    bodies::check_overlap(KEY, &flume.parts, &flume.parts, &surface, domain.dp, room, check);
}

/// Checks that the ground across each moving `end` of the domain (0 seaward, 1 shoreward) is that of the flume model.
pub fn check_ends(flume: &Flume, domain: &Domain, ends: &[usize], check: &mut Checker) {
    let Some(Bathymetry { section, y, .. }) = &flume.bathymetry else { return };
    for end in ends {
        let x = domain.x[*end];
        let across = (0..=SAMPLES).map(|k| domain.width * f64::from(k) / f64::from(SAMPLES));
        let apart = across.map(|y| flume.level(x, y) - section.z(x)).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(apart) = apart.filter(|apart| apart.abs() > UNEVEN * domain.dp) {
            check.reject(
                &format!("domain.x_m[{end}]"),
                as_text(x),
                format!(
                    "where the terrain is within `domain.dp_m` of its section along y = {} m; it differs by {} m there",
                    as_text(*y),
                    as_text(apart)
                ),
                "the waves of the flume model enter here: level the surface at this end, or move the end",
            );
        }
    }
}
