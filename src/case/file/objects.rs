//! Armour units, materials, contact and gauges, as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::shape::{RockFile, Shape, StlFile};

/// A group of armour units of the same shape and mass, or of rocks. The case places them in a row across the flume or
/// in armour layers, or it lists their centres or poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsFile {
    /// Name of the group in reports. Default: `units`, or `group N` in a list of groups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Fixed units do not move: they carry other units and stop the water.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "is_false")]
    pub fixed: bool,
    /// Path of fixed units, which then move along it, whatever the forces on them. Each row [t, x, y, z] has the time t
    /// from the start of the particle simulation [s] and the displacement x, y, z from the start [m]. The displacement
    /// is linear between rows and constant before the first and after the last row. The first row has no displacement.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 4]>,
    /// Shape of a unit.
    pub shape: Shape,
    /// Height H of a Tetrapod that stands on three legs, of a Dolos or of a grooved cube, or size C of a Core-Loc [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Edge lengths of a cuboid along x, y and z [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Waist ratio of a Dolos [-]: width of the stem / height of the unit. Default: 0.34.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waist_ratio: Option<f64>,
    /// Sizes of rocks. Required for the shape `rock`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rock: Option<RockFile>,
    /// STL files of a unit. Required for the shape `stl`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stl: Option<StlFile>,
    /// Mass of a unit [kg]; for rocks, the median mass M50 of a rock of the size D_n50.
    pub mass_kg: f64,
    /// Material of the units: a name in `materials`.
    pub material: String,
    /// Number of units in the row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Pose of each unit. Replaces `count`, `pitch_m`, `x_m`, `first_y_m` and `orientation`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poses: Option<Vec<PoseFile>>,
    /// Path of a placement file, relative to the folder of the case file. `breakwater place` writes this file, which
    /// lists the poses of the units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement_file: Option<String>,
    /// Armour layers on a slope. `breakwater place` lowers the units onto the slope one by one and writes a placement
    /// file. A run of this case needs the key `placement_file`, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub armour: Option<ArmourFile>,
    /// A heap. `breakwater place` drops the units from a box, all at the same time, and writes a placement file. A run
    /// of this case needs the key `placement_file`, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heap: Option<HeapFile>,
    /// Distance between the vertical axes of neighbouring units in the row [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// x of the vertical axes of the units in the row [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_m: Option<f64>,
    /// Centre of mass [x, y, z] of each unit [m]. Replaces `count`, `pitch_m`, `x_m` and `first_y_m`. Units may stand
    /// on other units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centres_m: Option<Vec<[f64; 3]>>,
    /// y of the first unit of the row [m]. By default, the row is in the middle of the flume width.
    #[serde(default)]
    pub first_y_m: Option<f64>,
    /// Random deviations of the units of a row from their regular places.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scatter: Option<ScatterFile>,
    /// Rotation of the units about the vertical axis, for a row and for `centres_m`.
    #[serde(default)]
    pub orientation: Orientation,
    /// A unit counts as damaged if it moves further than this [m]. Default: the nominal diameter D_n of a unit.
    #[serde(default)]
    pub damage_distance_m: Option<f64>,
    /// Way that counts for the damage. Default: `spatial`; `horizontal` if `damage_distance_m` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damage_measure: Option<DamageMeasure>,
    /// A unit counts as rotated if it rotates by more than this angle [degrees]. Default: 15.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation_limit_deg: Option<f64>,
    /// A rotation back and forth counts as rocking if it is larger than this angle [degrees]. Default: 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rocking_limit_deg: Option<f64>,
}

/// Way of a unit that counts for its damage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DamageMeasure {
    /// Distance between the first and the last position of the centre in plan (Mitsui et al. 2023).
    #[default]
    Horizontal,
    /// Distance between the first and the last position of the centre in space.
    Spatial,
}

fn is_false(value: &bool) -> bool {
    !value
}

/// Random deviations of the units of a row from their regular places, as if a person had placed the units. All
/// deviations within the limits are equally likely.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScatterFile {
    /// Largest deviation along x and along y [m].
    pub position_m: f64,
    /// Largest rotation about the vertical axis [degrees].
    #[serde(default)]
    pub angle_deg: f64,
    /// Seed of the random numbers. The same seed gives the same deviations.
    #[serde(default)]
    pub seed: u64,
}

/// Armour layers on a slope.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArmourFile {
    /// x of the seaward and of the shoreward end of the layers [m].
    pub x_m: [f64; 2],
    /// Number of armour layers.
    #[serde(default = "default_armour_layers")]
    pub layers: u32,
    /// Packing density [-]: number of units in all layers per slope area of D_n^2, with the nominal diameter
    /// D_n = V^(1/3) of a unit of volume V. Usual for two layers: 1.04 for Tetrapods, 0.83 for Dolosse, 1.17 for cubes
    /// (Shore Protection Manual 1984).
    pub packing_density: f64,
    /// Rotation of the units before they are lowered onto the slope.
    #[serde(default)]
    pub orientation: ArmourOrientation,
    /// Seed of the random numbers. The same seed gives the same rotations.
    #[serde(default)]
    pub seed: u64,
}

fn default_armour_layers() -> u32 {
    2
}

/// A heap of units that fall from a box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeapFile {
    /// Lower corner [x, y, z] of the box [m].
    pub low_m: [f64; 3],
    /// Upper corner [x, y, z] of the box [m].
    pub high_m: [f64; 3],
    /// Number of units. They fill the box from below, in random orientations and without touching each other.
    pub count: u32,
    /// Seed of the random numbers. The same seed gives the same rotations.
    #[serde(default)]
    pub seed: u64,
}

/// Rotation of the units of an armour layer before they are lowered onto the slope.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArmourOrientation {
    /// Random rotation about any axis. All rotations are equally likely.
    #[default]
    Random,
    /// All units are upright. Neighbours differ by a rotation of 180 degrees about the vertical axis.
    Alternating,
}

/// Pose of a unit: position and rotation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Centre of mass [x, y, z] [m].
    pub centre_m: [f64; 3],
    /// Rotation from body axes to space axes, as a quaternion [x, y, z, w] of length 1. Default: no rotation.
    #[serde(default = "no_rotation")]
    pub quaternion_xyzw: [f64; 4],
}

fn no_rotation() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

/// Placement file: the poses that `breakwater place` writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlacementFile {
    /// Title of the case whose units were placed.
    pub title: String,
    /// Packing density of the placed layers [-]: number of units in all layers per slope area of D_n^2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packing_density: Option<f64>,
    /// Pose of each unit, if the case has one group.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseFile>,
    /// The placed groups, if the case has several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<PlacedGroupFile>,
}

/// Poses of a group of units in a placement file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlacedGroupFile {
    /// Name of the group in the case.
    pub name: String,
    /// Packing density of its layers [-]; a heap has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packing_density: Option<f64>,
    /// Pose of each unit.
    pub poses: Vec<PoseFile>,
}

/// Rotation of the units about the vertical axis, for a row and for `centres_m`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// Neighbours differ by 180 degrees. The first unit has a leg that points seaward (SPH1 of Mitsui et al. 2023).
    #[default]
    Alternating,
    /// Neighbours differ by 180 degrees. The first unit has a leg that points shoreward (SPH2 of Mitsui et al. 2023).
    AlternatingReversed,
    /// Every unit has a leg that points seaward.
    Seaward,
    /// Every unit has a leg that points shoreward.
    Shoreward,
}

/// A material of units or bed, with the constants that its contacts need.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// Name of the material. `units.material`, `flume.material` and `friction` refer to this name.
    pub name: String,
    /// Young's modulus of the contacts [Pa]. A value below the real modulus makes contacts last longer and
    /// allows longer time steps.
    pub young_modulus_pa: f64,
    /// Measured stiffness of a contact between two bodies of this material [N/m]. Required for the contact law
    /// `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_stiffness_n_m: Option<f64>,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
}

/// Friction, rolling resistance and restitution between two materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFile {
    /// Names of the two materials. For contacts between units, write the material of the units twice.
    pub between: [String; 2],
    /// Coulomb friction coefficient [-]. If `kinetic_coefficient` is given, this is the static friction coefficient.
    pub coefficient: f64,
    /// Kinetic friction coefficient, for sliding contacts [-]. Default: `coefficient`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetic_coefficient: Option<f64>,
    /// Rolling resistance coefficient [-]: largest resisting moment / (normal force times radius). The radius is the
    /// rounding radius of the units, or half of it for a contact of two units. Default: 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_coefficient: Option<f64>,
    /// Coefficient of restitution of this pair of materials [-]. Default: the smaller of the two materials' values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
}

/// Contact between units, and between units and the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactFile {
    /// Rounding radius of the edges of a unit / height of the unit [-]. Hertz's law uses the same radius.
    pub rounding_share: f64,
    /// Contact law.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(skip_serializing_if = "ContactLawName::is_default")]
    pub law: ContactLawName,
}

impl Default for ContactFile {
    fn default() -> Self {
        Self { rounding_share: 0.05, law: ContactLawName::default() }
    }
}

/// Contact law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactLawName {
    /// Hertz's law for the normal force; Mindlin's spring with history for the tangential force.
    #[default]
    HertzMindlin,
    /// Linear springs whose stiffness follows from the key `contact_stiffness_n_m` of the materials.
    Linear,
    /// Law of the published runs (Chrono 4.0). Every contact has a radius of 0.1 m. The tangential spring is reset in
    /// each substep of the contact computation, so units creep.
    Chrono4,
}

impl ContactLawName {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A gauge: a point at which elevation, pressure or velocity of the water is measured, or the force on a part or on a
/// group of units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum GaugeFile {
    /// Elevation of the free surface above the still water level [m], from the particles and from the flume model.
    Elevation(ElevationFile),
    /// Pressure of the water [Pa].
    Pressure(PointFile),
    /// Velocity of the water [m/s].
    Velocity(PointFile),
    /// Force [N] and moment [N m] of the water on a group of units.
    Force(ForceFile),
}

/// A gauge that measures the force of the water on a group of units, which may be fixed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceFile {
    /// Name in tables and charts.
    pub name: String,
    /// Name of the group.
    pub on: String,
    /// Point [x, y, z] about which the moment acts [m]. Default: the mean of the centres of the units at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about_m: Option<[f64; 3]>,
}

/// A gauge that measures the elevation of the free surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElevationFile {
    /// Name in tables and charts.
    pub name: String,
    /// x of the gauge, along the flume [m].
    pub x_m: f64,
    /// y of the gauge, across the flume [m]. Default: the middle of the flume width.
    #[serde(default)]
    pub y_m: Option<f64>,
}

/// A straight line of gauges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineFile {
    /// End [x, y, z] of the line [m].
    pub to_m: [f64; 3],
    /// Number of gauges, including both ends.
    pub count: u32,
}

/// A gauge that measures pressure or velocity at a point in the water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointFile {
    /// Name in tables and charts.
    pub name: String,
    /// Initial position [x, y, z] [m].
    pub at_m: [f64; 3],
    /// Further gauges on a straight line from `at_m`, at equal distances. They have the names NAME_1, NAME_2, ...
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<LineFile>,
    /// Number of the unit with which the gauge moves, counted from 1. By default, the gauge does not move with a unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on_unit: Option<u32>,
    /// Path of a moving gauge. Each row [t, x, y, z] has the time t from the start of the particle simulation [s] and
    /// the displacement x, y, z from `at_m` [m]. The displacement is linear between rows and constant before the first
    /// and after the last row.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 4]>,
}
