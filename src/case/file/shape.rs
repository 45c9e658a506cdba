//! Shapes of armour units, as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shape of an armour unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Tetrapod (Danel & Greslou 1962).
    Tetrapod,
    /// Cuboid (rectangular block).
    Cuboid,
    /// Dolos (Merrifield 1974).
    Dolos,
    /// Core-Loc (Melby & Turk 1997).
    CoreLoc,
    /// Cube with a groove in each side face (Antifer block).
    GroovedCube,
    /// Quarried rock: random convex shapes of several sizes.
    Rock,
    /// Any shape, given by STL files.
    Stl,
}

impl Shape {
    /// Returns the name of the shape in case files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Tetrapod => "tetrapod",
            Self::Cuboid => "cuboid",
            Self::Dolos => "dolos",
            Self::CoreLoc => "core_loc",
            Self::GroovedCube => "grooved_cube",
            Self::Rock => "rock",
            Self::Stl => "stl",
        }
    }
}

/// STL files of a unit, ASCII or binary. Paths are relative to the folder of the case file. In the files, the
/// unit stands upright and z points upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StlFile {
    /// Path of the STL file with the closed surface of the unit.
    pub path: String,
    /// Length unit of the files in metres: 1 for metres, 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// Paths of STL files with convex parts that together fill the unit. This is the precise way. By default, the
    /// program divides the unit into convex parts by plane cuts; `breakwater check` prints their volume error.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
}

fn default_scale() -> f64 {
    1.0
}

/// Sizes of rocks. Each group has 16 random shapes, which the rocks have in turn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockFile {
    /// Median nominal diameter D_n50 [m]: half of the mass is in rocks with a smaller cube root of their volume.
    pub d_n50_m: f64,
    /// Grading D85 / D15 [-]: 15 % of the mass is in rocks smaller than D15, and 85 % in rocks smaller than D85.
    #[serde(default = "default_grading")]
    pub grading: f64,
    /// Seed of the random shapes. The same seed gives the same rocks.
    #[serde(default)]
    pub seed: u64,
}

fn default_grading() -> f64 {
    1.25
}
