//! Converts the validated units of a case to rigid bodies.

use glam::DVec3;

use crate::{
    case::{self, ContactLawName, Sides, Site, Units},
    rigid::{self, BodyShape, BodyState, ContactModel, Cover, Friction, Ground, RigidSetup},
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
    let ground = material(units.ground_material);
    RigidSetup {
        shape: BodyShape::from_unit(units.shape.unit(), units.mass),
        bodies: units.placements.iter().map(|p| BodyState::at_rest(p.centre, p.rotation)).collect(),
        material: material(units.material),
        ground: Some(Ground {
            profile: site.profile.clone(),
            terrain: site.terrain.as_ref().map(|terrain| terrain.surface.clone()),
            material: ground,
            cover: site.mound_x.map(|x| Cover {
                x,
                material: material(units.mound_material),
                resistance: units.on_mound,
            }),
        }),
        sides: match site.sides {
            Sides::Periodic => rigid::Sides::Periodic { width: site.width },
            Sides::Walls => rigid::Sides::Walls { width: site.width },
            Sides::TwoDimensional => rigid::Sides::TwoDimensional,
        },
        end_walls: Some(site.x),
        wall_material: ground,
        friction: Friction { unit_unit: units.on_unit, unit_ground: units.on_ground, unit_wall: units.on_ground },
        model: match law {
            ContactLawName::HertzMindlin => ContactModel::HertzMindlin,
            ContactLawName::Linear => ContactModel::Linear,
            ContactLawName::Chrono4 => ContactModel::Chrono4,
        },
        gravity: DVec3::NEG_Z * gravity,
    }
}
