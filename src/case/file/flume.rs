//! The section `flume` of a flume case as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Bed, mound and still water level of the whole flume. x points from the wavemaker to the shore, z upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlumeFile {
    /// Corner points [x, z] of the bed [m], from the wavemaker to the shore; x must increase.
    pub bed_m: Vec<[f64; 2]>,
    /// Still water level [m], as a z coordinate like those of `bed_m`.
    pub still_water_level_m: f64,
    /// A trapezoidal mound on the bed.
    #[serde(default)]
    pub mound: Option<MoundFile>,
    /// A surface on or above the bed, for example a survey of the sea bed. The ground is the higher of the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub terrain: Option<TerrainFile>,
    /// Material of bed and walls: a name in `materials`. Required if the case has units.
    #[serde(default)]
    pub material: Option<String>,
    /// Number of layers over the depth in the flume model, 1 to 8.
    #[serde(default = "default_layers")]
    pub layers: u32,
    /// Cell length of the flume model along the flume [m].
    #[serde(default = "default_cell_m")]
    pub cell_m: f64,
    /// Manning's n of the bed in the flume model [s m^(-1/3)]: 0.010 for glass, 0.013 for smooth concrete. By
    /// default, the bed has no friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manning_s_m13: Option<f64>,
    /// Boundary at the shoreward end of the flume model.
    #[serde(default, skip_serializing_if = "ShorewardEndFile::is_wall")]
    pub right_end: ShorewardEndFile,
}

impl FlumeFile {
    /// Returns a flume without water, for dry tests.
    pub(crate) fn dry(bed_m: Vec<[f64; 2]>, mound: Option<MoundFile>) -> Self {
        let cell_m = default_cell_m();
        let (layers, right_end) = (default_layers(), ShorewardEndFile::default());
        let (terrain, material, manning_s_m13) = (None, None, None);
        Self { bed_m, still_water_level_m: 0.0, mound, terrain, material, layers, cell_m, manning_s_m13, right_end }
    }
}

fn default_layers() -> u32 {
    2
}

fn default_cell_m() -> f64 {
    0.05
}

/// Boundary at the shoreward end of the flume model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum ShorewardEndFile {
    /// A wall. The bed may rise above the still water level in front of the wall.
    Wall {},
    /// An open boundary through which long waves leave the flume. The bed must end below the still water level.
    Radiating {},
    /// A wall with a sponge layer in front of it. The layer damps the waves.
    Sponge(SpongeFile),
}

impl Default for ShorewardEndFile {
    fn default() -> Self {
        Self::Wall {}
    }
}

impl ShorewardEndFile {
    /// Returns true for the default, which is left out of the serialized case, so that cases without this key keep
    /// their hash.
    fn is_wall(&self) -> bool {
        matches!(self, Self::Wall {})
    }
}

/// Sponge layer in front of the wall at the shoreward end of the flume.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpongeFile {
    /// Length of the sponge layer [m]. Two wavelengths are enough to absorb a wave.
    pub length_m: f64,
}

/// A trapezoidal mound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoundFile {
    /// x of the middle of the crest [m].
    pub centre_x_m: f64,
    /// Width of the crest [m].
    pub crest_width_m: f64,
    /// Crest level [m], as a z coordinate like those of `bed_m`, not as a height above the bed.
    pub crest_z_m: f64,
    /// Seaward slope as horizontal run per unit of rise [-]: 2 for a slope of 1:2.
    pub seaward_run_per_rise: f64,
    /// Lee slope as horizontal run per unit of rise [-].
    pub lee_run_per_rise: f64,
    /// Material of the mound's surface: a name in `materials`. By default, the material of the bed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

/// An STL file (ASCII or binary) of an open or closed surface on which units stand. The corners of each triangle must
/// be in counter-clockwise order, seen from the side of the units. With water, the surface must be open and face up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TerrainFile {
    /// Path of the STL file, relative to the folder of the case file.
    pub path: String,
    /// Length unit of the file in metres: 1 for metres, 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// y of the line along which the flume model takes its section of the surface [m]. Default: the middle of the domain.
    /// Dry tests do not have this key.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section_y_m: Option<f64>,
}

fn default_scale() -> f64 {
    1.0
}
