//! Converts the validated units of a case to rigid bodies.

use std::sync::Arc;

use glam::DVec3;

use crate::{
    case::{self, ContactLawName, Sides, Site, UnitGroup, UnitPose, Units},
    geometry::{axis_box::AxisBox, terrain::Terrain},
    rigid::{self, Body, BodyKind, BodyShape, BodyState, ContactModel, Cover, Ground, RigidSetup, TriangleSurface},
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
    let obstacles =
        site.obstacles.iter().flat_map(|obstacle| images(obstacle, site)).map(|bounds| Arc::new(terrain(&bounds)));
    let surface = |terrain| TriangleSurface { terrain, material: units.ground_material };
    let kind = |group: &UnitGroup| BodyKind {
        shape: BodyShape::from_unit(group.shape.unit(), group.mass),
        material: group.material,
        is_fixed: group.is_fixed,
    };
    let kind_of_each =
        units.groups.iter().enumerate().flat_map(|(kind, group)| group.members.clone().map(move |_| kind));
    let body = |(kind, pose): (usize, &UnitPose)| Body { kind, state: BodyState::at_rest(pose.centre, pose.rotation) };
    RigidSetup {
        kinds: units.groups.iter().map(kind).collect(),
        bodies: kind_of_each.zip(&units.placements).map(body).collect(),
        materials: (0..materials.len()).map(material).collect(),
        pairs: units.pairs.clone(),
        ground: Some(Ground {
            profile: site.profile.clone(),
            material: units.ground_material,
            cover: site.mound_x.map(|x| Cover { x, material: units.mound_material }),
        }),
        surfaces: site.terrain.iter().map(|terrain| terrain.surface.clone()).chain(obstacles).map(surface).collect(),
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

/// Returns an obstacle as units meet it. In a periodic flume, an obstacle across the whole width continues beyond both
/// sides, and other obstacles have an image on each side.
fn images(obstacle: &AxisBox, site: &Site) -> Vec<AxisBox> {
    let across = DVec3::Y * site.width;
    match site.sides {
        Sides::Walls => vec![*obstacle],
        Sides::Periodic if obstacle.open[1] == [true; 2] => {
            [-1.0, 0.0, 1.0].map(|image| obstacle.shifted(image * across)).to_vec()
        }
        // In two dimensions, units are wider than the flume, which is one particle wide.
        Sides::Periodic | Sides::TwoDimensional => {
            let beyond = ACROSS * across.max(DVec3::Y * obstacle.edges().max_element());
            vec![AxisBox { low: obstacle.low - beyond, high: obstacle.high + beyond, open: obstacle.open }]
        }
    }
}

/// Distance by which an obstacle across a periodic flume continues beyond its sides, divided by the width of the flume
/// or, if it is longer, the longest edge of the obstacle [-].
const ACROSS: f64 = 10.0;

fn terrain(bounds: &AxisBox) -> Terrain {
    let (vertices, triangles) = bounds.surface();
    // The case validation has checked that the edges are positive.
    Terrain::new(vertices, triangles).expect("a box has a closed surface")
}
