//! What stands in the flume, as written: armour units, their materials and contact, gauges.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Armour units, all alike: one row across the flume, or at the places given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsFile {
    /// Shape of a unit.
    pub shape: Shape,
    /// Height H of a tetrapod standing on three legs [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Edges of a cuboid along x, y and z [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Mass of a unit [kg].
    pub mass_kg: f64,
    /// Material, one of `materials`.
    pub material: String,
    /// Number of units in the row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
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

/// Shape of an armour unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Tetrapod (Danel & Greslou 1962).
    Tetrapod,
    /// Block with three pairs of plane faces.
    Cuboid,
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
    /// Coulomb's coefficient [-].
    pub coefficient: f64,
}

/// Contact between units and with the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactFile {
    /// Rounding radius of a unit's edges as a share of its height; also the radius of Hertz's law [-].
    pub rounding_share: f64,
}

impl Default for ContactFile {
    fn default() -> Self {
        Self { rounding_share: 0.05 }
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
