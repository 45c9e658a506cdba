//! Converts the validated units of a case to rigid bodies.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::{
    case::{self, ContactLawName, Part, PartShape, Sides, Site, UnitGroup, UnitModel, UnitPose, Units, group},
    geometry::{axis_box::AxisBox, outline::polygon::Polygon, terrain::Terrain},
    rigid::{self, Body, BodyKind, BodyShape, BodyState, ContactModel, Ground, RigidSetup, TriangleSurface},
};

/// Returns the set-up of the rigid-body solver: units, bed, walls, materials and contact law.
pub fn rigid_setup(
    units: &Units,
    site: &Site,
    materials: &[case::Material],
    law: ContactLawName,
    gravity: f64,
) -> RigidSetup {
    let material = |index: usize| {
        let case::Material { young_modulus, poisson_ratio, restitution, .. } = materials[index];
        rigid::Material { young_modulus, poisson_ratio, restitution }
    };
    let terrain = site.terrain.iter().map(|terrain| (terrain.surface.clone(), units.ground_material));
    let of_part = |part: &Part| {
        let material = part.material.unwrap_or(units.ground_material);
        surfaces_of(part, site).into_iter().map(move |surface| (surface, material))
    };
    let surfaces = terrain.chain(site.parts.iter().flat_map(of_part));
    let kind = |(group, model): (&UnitGroup, &UnitModel)| BodyKind {
        shape: BodyShape::from_unit(model.shape.unit(), model.mass),
        material: group.material,
        is_fixed: group.is_fixed,
    };
    let body = |(kind, pose): (usize, &UnitPose)| Body { kind, state: BodyState::at_rest(pose.centre, pose.rotation) };
    RigidSetup {
        kinds: group::models(&units.groups).map(kind).collect(),
        bodies: group::model_of_each(&units.groups).zip(&units.placements).map(body).collect(),
        materials: (0..materials.len()).map(material).collect(),
        pairs: units.pairs.clone(),
        ground: Some(Ground {
            profile: site.profile.clone(),
            material: units.ground_material,
            covers: site.covers.clone(),
        }),
        surfaces: surfaces.map(|(terrain, material)| TriangleSurface { terrain, material }).collect(),
        sides: match site.sides {
            Sides::Periodic => rigid::Sides::Periodic { width: site.width },
            Sides::Walls => rigid::Sides::Walls { width: site.width },
            Sides::TwoDimensional => rigid::Sides::TwoDimensional,
        },
        end_walls: Some(site.x),
        wall_material: units.ground_material,
        model: match law {
            ContactLawName::HertzMindlin => ContactModel::HertzMindlin,
            ContactLawName::Linear => ContactModel::Linear,
            ContactLawName::Chrono4 => ContactModel::Chrono4,
        },
        gravity: DVec3::NEG_Z * gravity,
    }
}

/// Returns the surfaces of a part as units meet them; the ground has the parts of the bed. In a periodic flume, a part
/// across the whole width continues beyond both sides, and other parts have an image on each side.
fn surfaces_of(part: &Part, site: &Site) -> Vec<Arc<Terrain>> {
    match part.surface() {
        PartShape::Bed(_) | PartShape::Porous(..) => Vec::new(),
        PartShape::Section(polygon) => {
            let [low, high] = polygon.bounds();
            let beyond = beyond(site, (high - low).max_element());
            vec![Arc::new(extruded(polygon, [-beyond, site.width + beyond]))]
        }
        PartShape::Box(bounds) => {
            images(bounds, site).iter().map(AxisBox::surface).map(terrain).map(Arc::new).collect()
        }
        PartShape::Body(body) if site.sides == Sides::Periodic => {
            let image = |number: f64| {
                let vertices = body.solid.vertices().iter().map(|v| *v + number * site.width * DVec3::Y).collect();
                Arc::new(terrain((vertices, body.solid.triangles().to_vec())))
            };
            vec![image(-1.0), body.surface.clone(), image(1.0)]
        }
        PartShape::Body(body) => vec![body.surface.clone()],
    }
}

/// Returns a box as units meet it.
fn images(bounds: &AxisBox, site: &Site) -> Vec<AxisBox> {
    let across = DVec3::Y * site.width;
    match site.sides {
        Sides::Walls => vec![*bounds],
        Sides::Periodic if bounds.open[1] == [true; 2] => {
            [-1.0, 0.0, 1.0].map(|image| bounds.shifted(image * across)).to_vec()
        }
        // In two dimensions, units are wider than the flume, which is one particle wide.
        Sides::Periodic | Sides::TwoDimensional => {
            let beyond = DVec3::Y * beyond(site, bounds.edges().max_element());
            vec![AxisBox { low: bounds.low - beyond, high: bounds.high + beyond, open: bounds.open }]
        }
    }
}

/// Distance by which a part across a periodic flume continues beyond its sides, divided by the width of the flume or,
/// if it is longer, the longest edge of the part [-].
const ACROSS: f64 = 10.0;

/// Returns the distance by which a part across the flume continues beyond its sides [m]; `longest` is the length of its
/// longest edge [m].
fn beyond(site: &Site, longest: f64) -> f64 {
    ACROSS * site.width.max(longest)
}

/// Shortest edge of a face across the flume, divided by its length across the flume [-]. Shorter edges are left out.
const THINNEST: f64 = 1e-6;

/// Returns the faces of a body with this section between two y [m].
fn extruded(section: &Polygon, y: [f64; 2]) -> Terrain {
    // A triangle that is much longer than wide has no reliable normal.
    let least = THINNEST * (y[1] - y[0]);
    let mut points: Vec<DVec2> = Vec::new();
    for point in section.points() {
        if [points.first(), points.last()].into_iter().flatten().all(|other| other.distance(*point) > least) {
            points.push(*point);
        }
    }
    let vertices = points.iter().flat_map(|point| y.map(|y| DVec3::new(point.x, y, point.y))).collect();
    let count = points.len() as u32;
    let face = |from: u32| {
        let to = (from + 1) % count;
        [[2 * from, 2 * to, 2 * to + 1], [2 * from, 2 * to + 1, 2 * from + 1]]
    };
    terrain((vertices, (0..count).flat_map(face).collect()))
}

fn terrain((vertices, triangles): (Vec<DVec3>, Vec<[u32; 3]>)) -> Terrain {
    // The case validation has checked that all edges are positive.
    Terrain::new(vertices, triangles).expect("the faces of a part have areas")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_of_a_section_point_outwards() {
        let section = Polygon::new(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 3.0]]).unwrap();
        let surface = extruded(&section, [-1.0, 1.0]);
        let corner = |v: u32| surface.vertices()[v as usize];
        assert_eq!(surface.triangles().len(), 8);
        for [a, b, c] in surface.triangles().iter().map(|triangle| triangle.map(corner)) {
            let outside = (a + b + c) / 3.0 + 1e-6 * (b - a).cross(c - a).normalize();
            assert!(section.distance(DVec2::new(outside.x, outside.z)) > 0.0, "{outside}");
        }
    }
}
