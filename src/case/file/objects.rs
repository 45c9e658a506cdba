//! Armour units, materials, contact and gauges as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Armour units, all of the same shape and mass: a row across the flume, given centres or poses, or armour layers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsFile {
    /// Shape of a unit.
    pub shape: Shape,
    /// Height H of a Tetrapod on three legs, of a Dolos or of a grooved cube; size C of a Core-Loc [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Edge lengths of a cuboid along x, y and z [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Waist ratio of a Dolos: width of the stem over the height [-]. Default: 0.34.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waist_ratio: Option<f64>,
    /// STL files of a unit, for the shape `stl`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stl: Option<StlFile>,
    /// Mass of a unit [kg].
    pub mass_kg: f64,
    /// Material of the units, one of `materials`.
    pub material: String,
    /// Number of units in the row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Pose of each unit, instead of a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poses: Option<Vec<PoseFile>>,
    /// Placement file from `breakwater place`, which lists the poses. Its path is relative to the folder of the case
    /// file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement_file: Option<String>,
    /// Armour layers on a slope. `breakwater place` lowers their units onto the slope one by one and writes the
    /// `placement_file`, which a run needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub armour: Option<ArmourFile>,
    /// Distance between the axes of neighbouring units in the row [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// x of the row [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_m: Option<f64>,
    /// Centre [x, y, z] of each unit [m], instead of `count`, `pitch_m`, `x_m` and `first_y_m`. Units may stand on each
    /// other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centres_m: Option<Vec<[f64; 3]>>,
    /// y of the first unit of the row [m]; by default the row is centred.
    #[serde(default)]
    pub first_y_m: Option<f64>,
    /// Rotation of the units of the row about the vertical axis.
    #[serde(default)]
    pub orientation: Orientation,
    /// Displacement above which a unit counts as damaged [m]. Default: the height of the unit.
    #[serde(default)]
    pub damage_distance_m: Option<f64>,
}

/// Armour layers on a slope.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArmourFile {
    /// x of the seaward and of the shoreward end of the layers [m].
    pub x_m: [f64; 2],
    /// Number of layers.
    #[serde(default = "default_armour_layers")]
    pub layers: u32,
    /// Packing density: units of all layers per area D_n^2 of the slope [-]. Two layers of Tetrapods 1.04, of Dolosse
    /// 0.83, of cubes 1.17 (Shore Protection Manual 1984).
    pub packing_density: f64,
    /// Rotation of the units.
    #[serde(default)]
    pub orientation: ArmourOrientation,
    /// Seed of the random rotations.
    #[serde(default)]
    pub seed: u64,
}

fn default_armour_layers() -> u32 {
    2
}

/// Rotation of the units of an armour layer before they are lowered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArmourOrientation {
    /// Random; all rotations are equally likely.
    #[default]
    Random,
    /// Upright; neighbours differ by 180 degrees about the vertical axis.
    Alternating,
}

/// Pose of a unit: position and rotation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Centre of mass [x, y, z] [m].
    pub centre_m: [f64; 3],
    /// Rotation from the unit's own axes, a unit quaternion [x, y, z, w]. Default: no rotation.
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
    /// Title of the case.
    pub title: String,
    /// Packing density reached: units per area D_n^2 of the slope [-], for armour layers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packing_density: Option<f64>,
    /// The poses.
    pub poses: Vec<PoseFile>,
}

/// Shape of an armour unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Tetrapod (Danel & Greslou 1962).
    Tetrapod,
    /// Cuboid.
    Cuboid,
    /// Dolos (Merrifield 1974).
    Dolos,
    /// Core-Loc (Melby & Turk 1997).
    CoreLoc,
    /// Cube with a groove in each side: Antifer block.
    GroovedCube,
    /// Any shape, from STL files.
    Stl,
}

impl Shape {
    /// Returns the name in case files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Tetrapod => "tetrapod",
            Self::Cuboid => "cuboid",
            Self::Dolos => "dolos",
            Self::CoreLoc => "core_loc",
            Self::GroovedCube => "grooved_cube",
            Self::Stl => "stl",
        }
    }
}

/// STL files of a unit, ASCII or binary. Paths are relative to the folder of the case file. The files show the upright
/// unit, z upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StlFile {
    /// Closed surface of the unit.
    pub path: String,
    /// Length unit of the files in metres: 1, or 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// Surfaces of convex parts that together fill the unit. Default: the program decomposes the unit itself.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
}

fn default_scale() -> f64 {
    1.0
}

/// Rotation of the units of a row about the vertical axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// Neighbours differ by 180 degrees; the first unit has a leg pointing seaward (SPH1 of Mitsui et al.).
    #[default]
    Alternating,
    /// Neighbours differ by 180 degrees; the first unit has a leg pointing shoreward (SPH2).
    AlternatingReversed,
    /// Every unit has a leg pointing seaward.
    Seaward,
    /// Every unit has a leg pointing shoreward.
    Shoreward,
}

/// A material of units or bed: its constants in contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// Name used by `units.material`, `flume.material` and `friction`.
    pub name: String,
    /// Young's modulus in contact [Pa]. A smaller value than the real one makes contacts and time steps longer.
    pub young_modulus_pa: f64,
    /// Measured stiffness of a contact between two bodies of this material [N/m], for the contact law `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_stiffness_n_m: Option<f64>,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
}

/// Friction between two materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFile {
    /// Names of the two materials; the same name twice for contacts between units.
    pub between: [String; 2],
    /// Coulomb friction coefficient [-]; the static one if `kinetic_coefficient` is given.
    pub coefficient: f64,
    /// Coulomb friction coefficient of sliding contacts [-]. Default: `coefficient`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetic_coefficient: Option<f64>,
    /// Rolling resistance coefficient [-]: moment over normal force and rounding radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_coefficient: Option<f64>,
    /// Coefficient of restitution of the pair [-]. Default: the smaller value of the two materials.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
}

/// Contact between units, and between units and the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactFile {
    /// Rounding radius of a unit's edges over its height [-]; it is also the radius in Hertz's law.
    pub rounding_share: f64,
    /// Contact law.
    // Not written at its default, so that the hash of cases without this key does not change.
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
    /// Hertz in the normal direction; Mindlin's spring with history in the tangential direction.
    #[default]
    HertzMindlin,
    /// Linear springs with the measured stiffness `contact_stiffness_n_m` of the materials.
    Linear,
    /// Law of the published runs (Chrono 4.0): every contact has a radius of 0.1 m, and its tangential spring lasts
    /// only one time step, so that units creep.
    Chrono4,
}

impl ContactLawName {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A gauge: a point at which the water is measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum GaugeFile {
    /// Elevation of the free surface above the still water level [m]. The flume model writes it, too.
    Elevation(ElevationFile),
    /// Pressure [Pa].
    Pressure(PointFile),
    /// Velocity [m/s].
    Velocity(PointFile),
}

/// A gauge for the elevation of the free surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElevationFile {
    /// Name in tables and charts.
    pub name: String,
    /// x of the gauge, along the flume [m].
    pub x_m: f64,
    /// y of the gauge, across the flume [m]. Default: the middle.
    #[serde(default)]
    pub y_m: Option<f64>,
}

/// A gauge at a point in the water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointFile {
    /// Name in tables and charts.
    pub name: String,
    /// Initial position [x, y, z] [m].
    pub at_m: [f64; 3],
    /// Number of the unit that the gauge moves with, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on_unit: Option<u32>,
    /// Path of a moving gauge: rows [t, x, y, z] of the time from the start of the particles [s] and the displacement
    /// [m]. The gauge moves linearly between rows and stays at the last one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 4]>,
}
