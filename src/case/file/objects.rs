//! What stands in the flume, as written: armour units, their materials and contact, gauges.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Armour units, all alike: one row across the flume, or at the places given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsFile {
    /// Shape of a unit.
    pub shape: Shape,
    /// Height H of a Tetrapod standing on three legs, of a Dolos or a grooved cube; size C of a Core-Loc [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Edges of a cuboid along x, y and z [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Width of a Dolos' stem over its height [-]; without it, 0.34.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waist_ratio: Option<f64>,
    /// Files of a unit that is not in the catalogue.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stl: Option<StlFile>,
    /// Mass of a unit [kg].
    pub mass_kg: f64,
    /// Material, one of `materials`.
    pub material: String,
    /// Number of units in the row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Where each unit is, one by one, in the place of a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poses: Option<Vec<PoseFile>>,
    /// File with the poses, as `breakwater place` writes it; seen from the folder of the case file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement_file: Option<String>,
    /// Armour layers on a slope; `breakwater place` works out where their units come to rest and writes the
    /// `placement_file`, without which the case cannot be run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub armour: Option<ArmourFile>,
    /// Distance between the units' axes [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// Place of the row [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_m: Option<f64>,
    /// Centres [x, y, z] of the units one by one [m], in the place of `count`, `pitch_m`, `x_m` and `first_y_m`. Units
    /// may stand on each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centres_m: Option<Vec<[f64; 3]>>,
    /// Place of the first unit across the flume [m]; without it, the row is centred.
    #[serde(default)]
    pub first_y_m: Option<f64>,
    /// How the units are turned about the vertical.
    #[serde(default)]
    pub orientation: Orientation,
    /// A unit is damaged when it has moved further than this [m]; without it, its height.
    #[serde(default)]
    pub damage_distance_m: Option<f64>,
}

/// Armour layers on a slope.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArmourFile {
    /// Seaward and shoreward end of the layers [m].
    pub x_m: [f64; 2],
    /// Number of layers.
    #[serde(default = "default_armour_layers")]
    pub layers: u32,
    /// Units of all layers on an area D_n^2 of the slope [-]; Tetrapods in two layers 1.04, Dolosse 0.83, cubes 1.17
    /// (Shore Protection Manual 1984).
    pub packing_density: f64,
    /// How the units are turned.
    #[serde(default)]
    pub orientation: ArmourOrientation,
    /// Seed of what is random.
    #[serde(default)]
    pub seed: u64,
}

fn default_armour_layers() -> u32 {
    2
}

/// How the units of an armour layer are turned when they are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArmourOrientation {
    /// At random, all directions equally likely.
    #[default]
    Random,
    /// Standing, neighbours turned by half a circle.
    Alternating,
}

/// Place and rotation of a unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Centre of mass [x, y, z] [m].
    pub centre_m: [f64; 3],
    /// Rotation from the unit's own axes, a unit quaternion [x, y, z, w]; without it, none.
    #[serde(default = "no_rotation")]
    pub quaternion_xyzw: [f64; 4],
}

fn no_rotation() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

/// Poses of units, as `breakwater place` writes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlacementFile {
    /// The case that they were made for.
    pub title: String,
    /// Units to the area of the slope, over D_n^-2 [-], if they were placed on one.
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
    /// Block with three pairs of plane faces.
    Cuboid,
    /// Dolos (Merrifield 1974).
    Dolos,
    /// Core-Loc (Melby & Turk 1997).
    CoreLoc,
    /// Cube with a groove down each side, Antifer block.
    GroovedCube,
    /// Any unit, from STL files.
    Stl,
}

impl Shape {
    /// Name in case files.
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

/// STL files of a unit, ASCII or binary; paths are seen from the folder of the case file. The unit stands as in the file,
/// z upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StlFile {
    /// Closed surface of the unit.
    pub path: String,
    /// Metres in a unit of length of the files: 1, or 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// Surfaces of the convex parts that fill the unit; without them it is decomposed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
}

fn default_scale() -> f64 {
    1.0
}

/// How the units of a row are turned about the vertical.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// Neighbours are turned by half a circle; the first has a leg seaward (SPH1 of Mitsui et al.).
    #[default]
    Alternating,
    /// Neighbours are turned by half a circle; the first has a leg shoreward (SPH2).
    AlternatingReversed,
    /// Every unit has a leg seaward.
    Seaward,
    /// Every unit has a leg shoreward.
    Shoreward,
}

/// Elastic constants of a material in contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// Name used by `units.material`, `flume.material` and `friction`.
    pub name: String,
    /// Young's modulus in contact [Pa]. A softer value than the real one lengthens the contact and the time step.
    pub young_modulus_pa: f64,
    /// Measured stiffness of a contact between two bodies of the material [N/m], for the linear law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_stiffness_n_m: Option<f64>,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
}

/// Friction of a pair of materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFile {
    /// The two materials; the same one twice for units against units.
    pub between: [String; 2],
    /// Coulomb's coefficient [-], at rest if that of motion is given as well.
    pub coefficient: f64,
    /// Coulomb's coefficient while sliding [-]; without it, the same as at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetic_coefficient: Option<f64>,
    /// Coefficient of rolling resistance [-]: the moment over force and rounding radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_coefficient: Option<f64>,
    /// Coefficient of restitution of the pair [-]; without it, the smaller one of the two materials.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
}

/// Contact between units and with the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactFile {
    /// Rounding radius of a unit's edges as a share of its height; also the radius of Hertz's law [-].
    pub rounding_share: f64,
    /// Law of the contacts.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(skip_serializing_if = "ContactLawName::is_default")]
    pub law: ContactLawName,
}

impl Default for ContactFile {
    fn default() -> Self {
        Self { rounding_share: 0.05, law: ContactLawName::default() }
    }
}

/// Law of the contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactLawName {
    /// Hertz in the normal, Mindlin's spring with its history in the tangential direction.
    #[default]
    HertzMindlin,
    /// Springs of the measured stiffness `contact_stiffness_n_m` of the materials.
    Linear,
    /// As the published runs had it: every contact with a radius of 0.1 m and a tangential spring of one step, so that
    /// units creep.
    Chrono4,
}

impl ContactLawName {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A point at which the water is measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum GaugeFile {
    /// Surface elevation above the still water [m]; also written by the flume model.
    Elevation(ElevationFile),
    /// Pressure [Pa].
    Pressure(PointFile),
    /// Velocity [m/s].
    Velocity(PointFile),
}

/// A gauge of the surface elevation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElevationFile {
    /// Name in tables and plots.
    pub name: String,
    /// Place along the flume [m].
    pub x_m: f64,
    /// Place across the flume [m]; without it, the middle.
    #[serde(default)]
    pub y_m: Option<f64>,
}

/// A gauge at a point in the water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointFile {
    /// Name in tables and plots.
    pub name: String,
    /// Place at the start [m].
    pub at_m: [f64; 3],
    /// Unit that the point moves with, counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on_unit: Option<u32>,
    /// Way of a point that moves: times from the start of the particles [s] and displacements [m], [t, x, y, z] each;
    /// it moves straight between them and stays at the last.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<[f64; 4]>,
}
