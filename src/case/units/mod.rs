//! The armour units: shape, mass, poses, materials and contact.
//!
//! | file | contents |
//! | --- | --- |
//! | [`group`] | a group of units |
//! | [`shape`], [`stl`], [`rock`] | shape of a unit, from the catalogue or from STL files; shapes of rocks |
//! | [`pose`] | pose of a unit: position and rotation |
//! | [`row`], [`centres`], [`poses`] | the three ways to place units |
//! | [`planar`] | checks for units in two dimensions |
//! | [`way`] | paths of gauges and fixed units |
//! | [`damage`] | limits above which a unit counts as damaged, rotated or rocking |
//! | [`materials`], [`contact`], [`resistance`] | materials, contact settings, friction and restitution |

mod centres;
pub mod contact;
pub mod damage;
pub mod group;
pub mod materials;
mod planar;
mod pose;
mod poses;
mod resistance;
mod rock;
mod row;
pub mod shape;
mod stl;
pub mod way;

use glam::DVec3;

use self::contact::Contact;
use self::group::{UnitGroup, UnitModel};
use self::materials::Materials;
pub use self::pose::UnitPose;
use self::shape::{UnitKind, UnitShape};
use self::way::Way;
use super::file::{Orientation, PoseFile, Sides, UnitGroupsFile, UnitsFile};
use super::flume::part::Part;
use super::flume::site::Site;
use super::reading::check::{Checker, as_text};
use crate::rigid::MaterialPair;

/// Largest number of units in one case.
pub(super) const MAX_UNITS: u32 = 10_000;
/// Largest number of groups of units in one case.
const MOST_GROUPS: usize = 100;

/// The armour units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Groups of units, at least one.
    pub groups: Vec<UnitGroup>,
    /// Initial pose of each unit, group by group. In a row, units are sorted by increasing y; otherwise by their order
    /// in the file.
    pub placements: Vec<UnitPose>,
    /// Material of the bed, an index into `Case::materials`.
    pub ground_material: usize,
    /// Friction and restitution of each pair of materials that can touch; indices into `Case::materials`.
    pub pairs: Vec<MaterialPair>,
}

impl Units {
    /// Returns the number of units.
    pub fn count(&self) -> usize {
        self.placements.len()
    }

    /// Returns group and model of each unit.
    pub fn each(&self) -> impl Iterator<Item = (&UnitGroup, &UnitModel)> {
        group::each(&self.groups)
    }

    /// Returns the height of the highest unit [m].
    pub fn tallest(&self) -> f64 {
        self.groups.iter().map(UnitGroup::height).fold(0.0, f64::max)
    }

    /// Returns name and content of the STL files that a run saves next to its case file; empty for other shapes.
    pub fn files(&self) -> impl Iterator<Item = &(String, Vec<u8>)> {
        self.groups.iter().flat_map(UnitGroup::files)
    }

    /// Changes the entry `units` of a stored case: the entry then refers to [`Self::files`], and has poses instead of a
    /// placement file. Adds the content of the files to `read`, for the hash of the case.
    pub(super) fn make_self_contained(&self, file: &mut UnitGroupsFile, read: &mut Vec<u8>) {
        for (group, file) in self.groups.iter().zip(file.groups_mut()) {
            if let UnitKind::Stl(unit) = &group.shape().kind {
                file.stl = Some(unit.entry());
                group.files().iter().for_each(|(_, content)| read.extend(content));
            }
            if file.placement_file.take().is_some() {
                let pose =
                    |p: &UnitPose| PoseFile { centre_m: p.centre.to_array(), quaternion_xyzw: p.rotation.to_array() };
                file.poses = Some(self.placements[group.members.clone()].iter().map(pose).collect());
            }
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
    /// Reference density of the water [kg/m3].
    pub rho0: f64,
    /// Time at the start during which units do not move [s].
    pub hold: f64,
}

/// Validates the units and places them at their initial poses.
pub(super) fn validate(file: &UnitGroupsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let groups = file.groups();
    if !(1..=MOST_GROUPS).contains(&groups.len()) {
        let advice = "leave out `units` for a case without units";
        check.reject("units", format!("{} groups", groups.len()), format!("1 to {MOST_GROUPS} groups"), advice);
        return None;
    }
    let mut placements = Vec::new();
    // All groups are validated, so that the user sees all errors at once.
    let mut validated = Vec::new();
    for (index, group) in groups.iter().enumerate() {
        validated.push(check.in_section(&file.path(index), |check| {
            let unplaced = validate_unplaced(group, file, index, around, check);
            placed(group, unplaced, &mut placements, around, check)
        }));
    }
    let groups: Vec<UnitGroup> = validated.into_iter().collect::<Option<_>>()?;
    validate_names(file, &groups, check);
    if placements.len() > MAX_UNITS as usize {
        let advice = "remove some units";
        check.reject("units", format!("{} units", placements.len()), format!("at most {MAX_UNITS} units"), advice);
    }
    with_ground(groups, placements, around, check)
}

/// Validates friction and restitution of all surfaces that can touch, and adds them to the units.
pub(super) fn with_ground(
    groups: Vec<UnitGroup>,
    placements: Vec<UnitPose>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Units> {
    let ground_material = around.materials.ground?;
    let others = [around.materials.mound].into_iter().chain(around.materials.parts.iter().copied()).flatten();
    let ground: Vec<usize> = [ground_material].into_iter().chain(others).collect();
    let pairs = resistance::validate(&groups, &ground, around, check)?;
    Some(Units { groups, placements, ground_material, pairs })
}

/// Places the units of a group and appends their poses to `placements`. Returns the group with its members.
pub(super) fn placed(
    file: &UnitsFile,
    unplaced: Option<UnitGroup>,
    placements: &mut Vec<UnitPose>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<UnitGroup> {
    let poses = place(file, unplaced.as_ref(), around, check);
    let (unplaced, poses) = (unplaced?, poses?);
    if let (Some(way), Some(site)) = (&unplaced.way, around.site) {
        way.check_inside(&poses, site, check);
    }
    let slices = around.site.map_or(1.0, |site| planar::slices(unplaced.shape(), site));
    let members = placements.len()..placements.len() + poses.len();
    placements.extend(poses);
    Some(UnitGroup { members, slices, ..unplaced })
}

/// Refuses groups without a name, and two groups with the same name.
fn validate_names(file: &UnitGroupsFile, groups: &[UnitGroup], check: &mut Checker) {
    for (index, UnitGroup { name, .. }) in groups.iter().enumerate() {
        if name.trim().is_empty() || groups[..index].iter().any(|other| other.name == *name) {
            let path = format!("{}.name", file.path(index));
            check.reject(&path, format!("{name:?}"), "a name that no other group has", "rename the group");
        }
    }
}

/// Validates the group with this index in `all`, without its positions and its friction. In the result, `members` is
/// empty.
pub(super) fn validate_unplaced(
    file: &UnitsFile,
    all: &UnitGroupsFile,
    index: usize,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<UnitGroup> {
    let before = check.count();
    let stem = if index == 0 { "unit".to_owned() } else { format!("unit_{}", index + 1) };
    let shapes = shape::validate(file, around.contact.rounding_share, around.name, &stem, check);
    // Rocks have the size D_n50.
    let nominal_diameter = file.rock.map(|rock| rock.d_n50_m).or(shapes.as_ref().map(|all| all[0].nominal_diameter()));
    let limits = nominal_diameter.map(|diameter| {
        let volume = shapes.as_ref().filter(|all| all.len() == 1).map_or(diameter.powi(3), |all| all[0].volume());
        shape::validate_mass(file.mass_kg, volume, around.water.as_ref().map(|water| water.rho0), check);
        damage::validate(file, diameter, check)
    });
    let material = materials::find(&around.materials.list, &file.material, ".material", check);
    if !around.ground_named {
        check.reject(
            "flume.material",
            "(missing)",
            "one of `materials` when there are units",
            "write the material of the bed",
        );
    }
    let way = Way::of_units(file, around, check);
    if check.count() > before {
        return None;
    }
    let (shapes, nominal_diameter) = (shapes?, nominal_diameter?);
    let mass = |shape: &UnitShape| match file.rock {
        Some(rock) => file.mass_kg * shape.volume() / rock.d_n50_m.powi(3),
        None => file.mass_kg,
    };
    Some(UnitGroup {
        name: file.name.clone().unwrap_or_else(|| match all {
            UnitGroupsFile::One(_) => "units".to_owned(),
            UnitGroupsFile::Several(_) => format!("group {}", index + 1),
        }),
        models: shapes.into_iter().map(|shape| UnitModel { mass: mass(&shape), shape }).collect(),
        nominal_diameter,
        mass: file.mass_kg,
        members: 0..0,
        is_fixed: file.fixed,
        is_placed: file.armour.is_some() || file.heap.is_some(),
        way,
        slices: 1.0,
        limits: limits?,
        material: material?,
    })
}

/// Places the units in a row, at their centres or in their poses. Returns `None` if the case file has errors that
/// prevent the placement.
fn place(
    file: &UnitsFile,
    group: Option<&UnitGroup>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Vec<UnitPose>> {
    let shape = group.map(UnitGroup::shape);
    let posed = file.poses.is_some() || file.placement_file.is_some();
    if (file.armour.is_some() || file.heap.is_some()) && !posed {
        check.reject(
            if file.armour.is_some() { ".armour" } else { ".heap" },
            "{ ... }",
            "accompanied by `poses` or a `placement_file`",
            "run `breakwater place` on the case and add the `placement_file` that it writes",
        );
        return None;
    }
    if posed && file.orientation != Orientation::default() {
        check.warn(".orientation: has no effect on units with `poses` or a `placement_file`");
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
        validate_water(water, group?, check);
    }
    let placements = match (row, &file.centres_m) {
        (Some(row), _) => row::place(&row, shape, site, check),
        (None, Some(centres)) if !posed => centres::place(centres, file, shape, site, check),
        _ => poses::place(file, group?, around.name, site, check)?,
    };
    validate_above_terrain(&placements, site, check);
    validate_outside_parts(&placements, group?, site, check);
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
            ".",
            format!("unit {} with its centre at ({x}, {y}, {z}) m", index + 1),
            format!("above the terrain, which is at z = {} m there", as_text(level)),
            "raise the unit or lower the terrain",
        );
    }
}

/// Largest depth of a unit inside a part, divided by the height of the unit [-]: the contact forces then separate
/// them gently.
const LARGEST_OVERLAP: f64 = 0.01;

/// Distance of a sharp corner of three perpendicular faces from its rounding, divided by the radius of the rounding:
/// sqrt(3) - 1 [-]. Contacts see the rounding.
const OF_ROUNDING: f64 = 0.732;

/// Refuses a unit that is inside a part of the structure or an obstacle.
fn validate_outside_parts(placements: &[UnitPose], group: &UnitGroup, site: &Site, check: &mut Checker) {
    let images = if site.sides == Sides::Periodic { vec![-1.0, 0.0, 1.0] } else { vec![0.0] };
    let is_in = |shape: &UnitShape, pose: &UnitPose, part: &Part| {
        images.iter().any(|image| {
            let from = pose.centre + DVec3::Y * (image * site.width);
            let rounding = shape.unit().parts().iter().map(|part| part.rounding()).fold(0.0, f64::max);
            let deepest = -LARGEST_OVERLAP * shape.height() - OF_ROUNDING * rounding;
            shape.unit().solid().vertices().iter().any(|v| part.distance(from + pose.rotation * *v) < deepest)
        })
    };
    let inside = placements.iter().enumerate().find_map(|(index, pose)| {
        let shape = &group.models[group.model_of(index)].shape;
        Some((index, pose, site.parts.iter().find(|part| is_in(shape, pose, part))?))
    });
    if let Some((index, pose, part)) = inside {
        let [x, y, z] = pose.centre.to_array().map(as_text);
        check.reject(
            ".",
            format!("unit {} with its centre at ({x}, {y}, {z}) m", index + 1),
            format!("outside {:?}", part.name),
            "move one of the two",
        );
    }
}

/// Warns of units that are small compared with the particle spacing.
fn validate_water(water: &WaterAround, group: &UnitGroup, check: &mut Checker) {
    let smallest = group.models.iter().map(|model| model.shape.nominal_diameter()).fold(f64::MAX, f64::min);
    if group.models.len() > 1 && smallest < water.dp {
        check.reject(
            ".",
            format!("rocks of D_n = {} m and larger", as_text(smallest)),
            format!("at least `domain.dp_m` = {} m", as_text(water.dp)),
            "so small a rock has hardly any particles: use a finer dp_m or larger rocks",
        );
    }
    let height = if group.models.len() == 1 { group.height() } else { smallest };
    if height < 8.0 * water.dp {
        let of_group = match check.path(".").as_str() {
            "units" => String::new(),
            group => format!(" of {group}"),
        };
        check.warn(format!(
            "domain.dp_m = {}: a unit{of_group} is {:.1} particles high; with fewer than 8, the water forces are inaccurate",
            as_text(water.dp),
            height / water.dp
        ));
    }
}
