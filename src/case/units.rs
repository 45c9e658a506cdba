//! The armour units, validated.

use super::check::{Checker, above, show};
use super::domain::Domain;
use super::file::{Sides, UnitsFile};
use super::flume::Flume;
use super::materials::{self, FrictionPair, Material};
use super::unit_shape::{self, UnitShape};
use super::{centres, row};

/// Units in one case at most.
pub(super) const MOST_UNITS: u32 = 10_000;

/// The armour units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Where each unit stands: a row from y = 0 upwards, or as the file lists them.
    pub placements: Vec<Placement>,
    /// A unit is damaged when it has moved further than this [m].
    pub damage_distance: f64,
    /// Material of the units, an index into `Case::materials`.
    pub material: usize,
    /// Material of bed and mound, an index into `Case::materials`.
    pub ground_material: usize,
    /// Friction of unit on unit [-].
    pub friction_unit: f64,
    /// Friction of unit on bed or mound [-].
    pub friction_ground: f64,
}

/// Where a unit stands, its axis vertical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Place of the axis along the flume [m].
    pub x: f64,
    /// Place of the axis across the flume [m].
    pub y: f64,
    /// Level of its centre [m]; without it, the unit stands on the ground.
    pub centre_z: Option<f64>,
    /// Turn about the vertical [rad]: 0 has a leg seaward, pi a leg shoreward.
    pub azimuth: f64,
}

/// What the units need to know of the rest of the case.
pub(super) struct Surroundings<'a> {
    pub flume: Option<&'a Flume>,
    pub domain: Option<&'a Domain>,
    pub materials: &'a [Material],
    pub friction: &'a [FrictionPair],
    pub ground_material: Option<usize>,
    /// `flume.material` is written in the file (perhaps wrongly).
    pub ground_named: bool,
    pub rho0: f64,
}

/// Validate the units.
pub(super) fn validate(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let before = check.count();
    let shape = unit_shape::validate(file, check);
    if let Some(shape) = &shape {
        unit_shape::validate_mass(file.mass_kg, shape, around.rho0, check);
    }
    if let Some(distance) = file.damage_distance_m {
        check.number("units.damage_distance_m", distance, above(0.0).up_to(1000.0), "m", "the unit's height is usual");
    }
    let material = materials::find(around.materials, &file.material, "units.material", check);
    if !around.ground_named {
        check.refuse(
            "flume.material",
            "(missing)",
            "one of `materials` when there are units",
            "write the material of bed and mound",
        );
    }
    let friction = validate_friction(material, around, check);
    let placements = place(file, shape.as_ref(), around, check);
    if check.count() > before {
        return None;
    }
    let (friction_unit, friction_ground) = friction?;
    Some(Units {
        shape: shape?,
        mass: file.mass_kg,
        placements: placements?,
        damage_distance: file.damage_distance_m.unwrap_or(shape?.height()),
        material: material?,
        ground_material: around.ground_material?,
        friction_unit,
        friction_ground,
    })
}

/// Where the units stand: a row, or the centres of the file. `None` where that cannot be told.
fn place(
    file: &UnitsFile,
    shape: Option<&UnitShape>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Vec<Placement>> {
    let row = if file.centres_m.is_none() { Some(row::validate(file, shape, check)?) } else { None };
    let (shape, flume, domain) = (shape?, around.flume?, around.domain?);
    if domain.sides == Sides::TwoDimensional {
        check.refuse(
            "domain.sides",
            "\"two_dimensional\"",
            "\"periodic\" or \"walls\" in a case with units",
            "units move and turn in three dimensions: write `domain.width_m` and one of the two",
        );
        return None;
    }
    if !domain.obstacles.is_empty() {
        check.refuse(
            "domain.obstacles",
            format!("{} obstacles", domain.obstacles.len()),
            "none in a case with units",
            "units would move through an obstacle: contact between them is not computed",
        );
    }
    if shape.height() < 8.0 * domain.dp {
        check.warn(format!(
            "domain.dp_m = {}: {:.1} particles in the height of a unit; below 8 the forces on it are rough",
            show(domain.dp),
            shape.height() / domain.dp
        ));
    }
    Some(match (row, &file.centres_m) {
        (Some(row), _) => row::place(&row, shape, flume, domain, check),
        (None, Some(centres)) => centres::place(centres, file, shape, flume, domain, check),
        (None, None) => return None,
    })
}

fn validate_friction(material: Option<usize>, around: &Surroundings, check: &mut Checker) -> Option<(f64, f64)> {
    let (unit, ground) = (material?, around.ground_material?);
    let mut lookup = |a: usize, b: usize| {
        let found = materials::coefficient(around.friction, a, b);
        if found.is_none() {
            let (a, b) = (&around.materials[a].name, &around.materials[b].name);
            check.refuse(
                "friction",
                format!("no entry for {a:?} on {b:?}"),
                "complete for the pairs that can touch",
                format!("add {{ \"between\": [{a:?}, {b:?}], \"coefficient\": ... }}"),
            );
        }
        found
    };
    let on_unit = lookup(unit, unit);
    let on_ground = if ground == unit { on_unit } else { lookup(unit, ground) };
    Some((on_unit?, on_ground?))
}
