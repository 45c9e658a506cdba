//! Validates the armour units.

use glam::{DQuat, DVec3};

use super::check::{Checker, above, show};
use super::file::{ContactLawName, PoseFile, Sides, UnitsFile};
use super::materials::{self, FrictionPair, Material};
use super::site::Site;
use super::unit_shape::{self, UnitKind, UnitShape};
use super::{centres, planar, poses, row};
use crate::rigid::Resistance;

/// Largest number of units in one case.
pub(super) const MOST_UNITS: u32 = 10_000;

/// The armour units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Initial pose of each unit: in a row by rising y, else in the order of the file.
    pub placements: Vec<Placement>,
    /// Width of a unit over the thickness of a two-dimensional domain [-]; 1 in three dimensions.
    pub slices: f64,
    /// A unit is damaged if it moves further than this [m].
    pub damage_distance: f64,
    /// Material of the units, an index into `Case::materials`.
    pub material: usize,
    /// Material of bed and mound, an index into `Case::materials`.
    pub ground_material: usize,
    /// Friction and restitution between two units.
    pub on_unit: Resistance,
    /// Friction and restitution between a unit and bed, mound or walls.
    pub on_ground: Resistance,
}

/// Pose of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Rotation from body axes to space axes.
    pub rotation: DQuat,
}

impl Placement {
    /// Returns a unit that stands with its axis vertical, on the ground unless `z` gives the level of its centre [m].
    /// At azimuth 0 [rad] a Tetrapod has a leg seaward, at pi shoreward.
    pub(super) fn standing(shape: &UnitShape, [x, y]: [f64; 2], z: Option<f64>, azimuth: f64, site: &Site) -> Self {
        let unit = shape.unit();
        let z = z.unwrap_or_else(|| site.level(x, y) + unit.standing_height());
        Self { centre: DVec3::new(x, y, z), rotation: unit.standing_rotation(azimuth) }
    }
}

impl Units {
    /// Returns name and content of the files that a run saves next to its case.
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        if let UnitKind::Stl(unit) = &self.shape.kind { unit.files() } else { &[] }
    }

    /// Makes the entry refer to [`Self::files`] and list all poses, instead of referring to other files.
    /// Adds the content of the files to `read`, for the fingerprint of the case.
    pub(super) fn make_self_contained(&self, file: &mut UnitsFile, read: &mut Vec<u8>) {
        if let UnitKind::Stl(unit) = &self.shape.kind {
            file.stl = Some(unit.entry());
            self.files().iter().for_each(|(_, content)| read.extend(content));
        }
        if file.placement_file.take().is_some() {
            let pose =
                |p: &Placement| PoseFile { centre_m: p.centre.to_array(), quaternion_xyzw: p.rotation.to_array() };
            file.poses = Some(self.placements.iter().map(pose).collect());
        }
    }
}

/// Parts of the case on which the units depend.
pub(super) struct Surroundings<'a> {
    /// Name of the case file.
    pub name: &'a str,
    /// Ground and walls.
    pub site: Option<&'a Site>,
    /// Particle spacing, if there is water [m].
    pub dp: Option<f64>,
    /// Number of obstacles in the water.
    pub obstacles: usize,
    pub materials: &'a [Material],
    pub friction: &'a [FrictionPair],
    pub ground_material: Option<usize>,
    /// Key of the ground's material.
    pub ground_key: &'a str,
    /// Whether the file has this key, valid or not.
    pub ground_named: bool,
    /// Density of the water, if there is water [kg/m3].
    pub rho0: Option<f64>,
    pub rounding_share: f64,
    pub law: ContactLawName,
}

/// Validates the units and places them.
pub(super) fn validate(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let unplaced = validate_unplaced(file, around, check);
    let placements = place(file, unplaced.as_ref().map(|units| &units.shape), around, check);
    let unplaced = unplaced?;
    let slices = around.site.map_or(1.0, |site| planar::slices(&unplaced.shape, site));
    Some(Units { placements: placements?, slices, ..unplaced })
}

/// Validates everything except the positions of the units.
pub(super) fn validate_unplaced(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let before = check.count();
    let shape = unit_shape::validate(file, around.rounding_share, around.name, check);
    if let Some(shape) = &shape {
        unit_shape::validate_mass(file.mass_kg, shape, around.rho0, check);
    }
    if let Some(distance) = file.damage_distance_m {
        check.number("units.damage_distance_m", distance, above(0.0).up_to(1000.0), "m", "the unit's height is usual");
    }
    let material = materials::find(around.materials, &file.material, "units.material", check);
    if !around.ground_named {
        check.refuse(
            around.ground_key,
            "(missing)",
            "one of `materials` when there are units",
            "write the material of bed and mound",
        );
    }
    let friction = validate_friction(material, around, check);
    if check.count() > before {
        return None;
    }
    let [on_unit, on_ground] = friction?;
    let shape = shape?;
    Some(Units {
        mass: file.mass_kg,
        placements: Vec::new(),
        slices: 1.0,
        damage_distance: file.damage_distance_m.unwrap_or(shape.height()),
        shape,
        material: material?,
        ground_material: around.ground_material?,
        on_unit,
        on_ground,
    })
}

/// Places the units in a row or one by one. Returns `None` if errors prevent it.
fn place(
    file: &UnitsFile,
    shape: Option<&UnitShape>,
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Vec<Placement>> {
    let posed = file.poses.is_some() || file.placement_file.is_some();
    if file.armour.is_some() && !posed {
        check.refuse(
            "units.armour",
            "{ ... }",
            "accompanied by `poses` or a `placement_file`",
            "run `breakwater place` on the case and add the `placement_file` that it writes",
        );
        return None;
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
    if around.obstacles > 0 {
        check.refuse(
            "domain.obstacles",
            format!("{} obstacles", around.obstacles),
            "none in a case with units",
            "units would move through an obstacle: contact between them is not computed",
        );
    }
    if let Some(dp) = around.dp.filter(|dp| shape.height() < 8.0 * dp) {
        check.warn(format!(
            "domain.dp_m = {}: a unit is {:.1} particles high; with fewer than 8 the forces on it are inaccurate",
            show(dp),
            shape.height() / dp
        ));
    }
    let placements = match (row, &file.centres_m) {
        (Some(row), _) => row::place(&row, shape, site, check),
        (None, Some(centres)) if !posed => centres::place(centres, file, shape, site, check),
        _ => poses::place(file, around.name, site, check)?,
    };
    Some(if in_layer { planar::lay(placements, site, check) } else { placements })
}

fn validate_friction(material: Option<usize>, around: &Surroundings, check: &mut Checker) -> Option<[Resistance; 2]> {
    let (unit, ground) = (material?, around.ground_material?);
    let mut lookup = |a: usize, b: usize| {
        let found = materials::pair(around.friction, a, b);
        let (a, b) = (&around.materials[a], &around.materials[b]);
        if found.is_none() {
            let (a, b) = (&a.name, &b.name);
            check.refuse(
                "friction",
                format!("no entry for {a:?} on {b:?}"),
                "complete for the pairs that can touch",
                format!("add {{ \"between\": [{a:?}, {b:?}], \"coefficient\": ... }}"),
            );
        }
        for material in [a, b] {
            if around.law == ContactLawName::Linear && material.contact_stiffness.is_none() {
                check.refuse(
                    "materials",
                    format!("no `contact_stiffness_n_m` of {:?}", material.name),
                    "given for each material with the linear contact law",
                    "add the measured stiffness, or use \"hertz_mindlin\"",
                );
            }
        }
        // Springs in series: each body has twice the stiffness of a contact between two bodies of its material.
        let stiffness = a.contact_stiffness.zip(b.contact_stiffness).map(|(a, b)| 2.0 * a * b / (a + b));
        found.map(|pair| Resistance {
            static_friction: pair.coefficient,
            kinetic_friction: pair.kinetic,
            rolling: pair.rolling,
            restitution: pair.restitution,
            stiffness,
        })
    };
    let on_unit = lookup(unit, unit);
    let on_ground = if ground == unit { on_unit } else { lookup(unit, ground) };
    Some([on_unit?, on_ground?])
}
