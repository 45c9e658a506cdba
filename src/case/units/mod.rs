//! The armour units: shape, mass, poses, materials and contact.
//!
//! | file | contents |
//! | --- | --- |
//! | [`shape`], [`stl`] | shape of a unit, from the catalogue or from STL files |
//! | [`pose`] | pose of a unit: position and rotation |
//! | [`row`], [`centres`], [`poses`] | the three ways to place units |
//! | [`planar`] | checks for units in two dimensions |
//! | [`materials`], [`contact`], [`resistance`] | materials, contact settings, friction and restitution |

mod centres;
pub mod contact;
pub mod materials;
mod planar;
mod pose;
mod poses;
mod resistance;
mod row;
pub mod shape;
mod stl;

use glam::DVec3;

use self::contact::Contact;
use self::materials::Materials;
pub use self::pose::UnitPose;
use self::resistance::Resistances;
use self::shape::{UnitKind, UnitShape};
use super::file::{Orientation, PoseFile, Sides, UnitsFile};
use super::flume::site::Site;
use super::reading::check::{Checker, as_text, more_than};
use crate::rigid::Resistance;

/// Largest number of units in one case.
pub(super) const MAX_UNITS: u32 = 10_000;

/// The armour units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Initial pose of each unit. In a row, units are sorted by increasing y; otherwise by their order in the file.
    pub placements: Vec<UnitPose>,
    /// In two dimensions, width of a unit / thickness of the particle layer [-]; 1 in three dimensions.
    pub slices: f64,
    /// A unit counts as damaged if its displacement is larger than this distance [m].
    pub damage_distance: f64,
    /// Material of the units, an index into `Case::materials`.
    pub material: usize,
    /// Material of the bed, an index into `Case::materials`.
    pub ground_material: usize,
    /// Material of the mound, an index into `Case::materials`.
    pub mound_material: usize,
    /// Friction and restitution between two units.
    pub on_unit: Resistance,
    /// Friction and restitution between a unit and bed or walls.
    pub on_ground: Resistance,
    /// Friction and restitution between a unit and the mound.
    pub on_mound: Resistance,
}

impl Units {
    /// Returns name and content of the STL files that a run saves next to its case file; empty for other shapes.
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        if let UnitKind::Stl(unit) = &self.shape.kind { unit.files() } else { &[] }
    }

    /// Changes the entry `units` of a stored case: the entry then refers to [`Self::files`], and has poses instead of a
    /// placement file. Adds the content of the files to `read`, for the hash of the case.
    pub(super) fn make_self_contained(&self, file: &mut UnitsFile, read: &mut Vec<u8>) {
        if let UnitKind::Stl(unit) = &self.shape.kind {
            file.stl = Some(unit.entry());
            self.files().iter().for_each(|(_, content)| read.extend(content));
        }
        if file.placement_file.take().is_some() {
            let pose =
                |p: &UnitPose| PoseFile { centre_m: p.centre.to_array(), quaternion_xyzw: p.rotation.to_array() };
            file.poses = Some(self.placements.iter().map(pose).collect());
        }
    }
}

/// Parts of the case on which the units depend.
pub(super) struct Surroundings<'a> {
    /// Path of the case file.
    pub name: &'a str,
    /// Ground and boundaries of the area in which units stand; `None` if invalid.
    pub site: Option<&'a Site>,
    pub materials: &'a Materials,
    /// true if the case file names a material of the ground, even if this name is not in `materials`.
    pub ground_named: bool,
    pub contact: Contact,
    /// Water around the units; `None` in a dry test.
    pub water: Option<WaterAround>,
}

/// Properties of the water around the units.
pub(super) struct WaterAround {
    /// Particle spacing [m].
    pub dp: f64,
    /// Number of obstacles in the domain.
    pub obstacles: usize,
    /// Reference density of the water [kg/m3].
    pub rho0: f64,
}

/// Validates the units and places them at their initial poses.
pub(super) fn validate(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let unplaced = validate_unplaced(file, around, check);
    let placements = place(file, unplaced.as_ref().map(|units| &units.shape), around, check);
    let unplaced = unplaced?;
    let slices = around.site.map_or(1.0, |site| planar::slices(&unplaced.shape, site));
    Some(Units { placements: placements?, slices, ..unplaced })
}

/// Validates the units without their positions. In the result, `placements` is empty.
pub(super) fn validate_unplaced(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let before = check.count();
    let shape = shape::validate(file, around.contact.rounding_share, around.name, check);
    if let Some(shape) = &shape {
        shape::validate_mass(file.mass_kg, shape, around.water.as_ref().map(|water| water.rho0), check);
    }
    if let Some(distance) = file.damage_distance_m {
        check.number(
            "units.damage_distance_m",
            distance,
            more_than(0.0).up_to(1000.0),
            "m",
            "the unit's height is usual",
        );
    }
    let material = materials::find(&around.materials.list, &file.material, "units.material", check);
    if !around.ground_named {
        check.reject(
            "flume.material",
            "(missing)",
            "one of `materials` when there are units",
            "write the material of the bed",
        );
    }
    let friction = resistance::validate(material, around, check);
    if check.count() > before {
        return None;
    }
    let Resistances { on_unit, on_ground, on_mound } = friction?;
    let ground_material = around.materials.ground?;
    let shape = shape?;
    Some(Units {
        mass: file.mass_kg,
        placements: Vec::new(),
        slices: 1.0,
        damage_distance: file.damage_distance_m.unwrap_or(shape.height()),
        shape,
        material: material?,
        ground_material,
        mound_material: around.materials.mound.unwrap_or(ground_material),
        on_unit,
        on_ground,
        on_mound,
    })
}

/// Places the units in a row, at their centres or in their poses. Returns `None` if the case file has errors that
/// prevent the placement.
fn place(
    file: &UnitsFile,
    shape: Option<&UnitShape>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Vec<UnitPose>> {
    let posed = file.poses.is_some() || file.placement_file.is_some();
    if file.armour.is_some() && !posed {
        check.reject(
            "units.armour",
            "{ ... }",
            "accompanied by `poses` or a `placement_file`",
            "run `breakwater place` on the case and add the `placement_file` that it writes",
        );
        return None;
    }
    if posed && file.orientation != Orientation::default() {
        check.warn("units.orientation: has no effect on units with `poses` or a `placement_file`");
    }
    let is_row = file.centres_m.is_none() && !posed;
    let row = if is_row { Some(row::validate(file, shape, check)?) } else { None };
    let (shape, site) = (shape?, around.site?);
    let in_layer = site.sides == Sides::TwoDimensional;
    if in_layer {
        let before = check.count();
        planar::validate(file, shape, is_row, check);
        if check.count() > before {
            return None;
        }
    }
    if let Some(water) = &around.water {
        validate_water(water, shape, check);
    }
    let placements = match (row, &file.centres_m) {
        (Some(row), _) => row::place(&row, shape, site, check),
        (None, Some(centres)) if !posed => centres::place(centres, file, shape, site, check),
        _ => poses::place(file, around.name, shape, site, check)?,
    };
    validate_above_terrain(&placements, site, check);
    Some(if in_layer { planar::lay(placements, site, check) } else { placements })
}

/// Refuses a unit whose centre is below the terrain: it would fall.
fn validate_above_terrain(placements: &[UnitPose], site: &Site, check: &mut Checker) {
    let Some(terrain) = &site.terrain else { return };
    let level_above = |centre: DVec3| terrain.surface.level(centre.x, centre.y).filter(|level| *level > centre.z);
    let below = placements.iter().enumerate().find_map(|(index, pose)| Some((index, level_above(pose.centre)?)));
    if let Some((index, level)) = below {
        let [x, y, z] = placements[index].centre.to_array().map(as_text);
        check.reject(
            "units",
            format!("unit {} with its centre at ({x}, {y}, {z}) m", index + 1),
            format!("above the terrain, which is at z = {} m there", as_text(level)),
            "raise the unit or lower the terrain",
        );
    }
}

/// Refuses obstacles in a case with units. Warns of units that are small compared with the particle spacing.
fn validate_water(water: &WaterAround, shape: &UnitShape, check: &mut Checker) {
    if water.obstacles > 0 {
        check.reject(
            "domain.obstacles",
            format!("{} obstacles", water.obstacles),
            "none in a case with units",
            "units would move through an obstacle: contact between them is not computed",
        );
    }
    if shape.height() < 8.0 * water.dp {
        check.warn(format!(
            "domain.dp_m = {}: a unit is {:.1} particles high; with fewer than 8, the water forces are inaccurate",
            as_text(water.dp),
            shape.height() / water.dp
        ));
    }
}
