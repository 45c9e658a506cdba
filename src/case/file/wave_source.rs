//! A wave from another program as the user writes it.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wave from another program: the velocity of its water at the wavemaker, over height and time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenWaveFile {
    /// The files of the other program.
    pub source: WaveSourceFile,
    /// Celerity of the wave [m/s]. With it, the rows of the wavemaker follow the moving water. Without it, they move
    /// with the velocity at a fixed position, and their stroke is too short.
    #[serde(default)]
    pub celerity_m_s: Option<f64>,
}

/// Files with velocities. Paths are relative to the folder of the case file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "format", deny_unknown_fields)]
pub enum WaveSourceFile {
    /// A `_velx` file of DualSPHysics' multi-layer piston. `breakwater wave` writes such files, too.
    Dualsphysics(VelxFile),
    /// Tables from SWASH.
    Swash(SwashFile),
    /// Probes or a sampled line from OpenFOAM.
    Openfoam(OpenfoamFile),
}

/// A `_velx` file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VelxFile {
    /// Path of the file.
    pub path: PathBuf,
}

/// Tables from SWASH for one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashFile {
    /// Table with the columns `TSEC` and `WATL`.
    pub level: SwashTableFile,
    /// Table with the columns `TSEC` and `VELK`; it may be the same file.
    pub velocity: SwashTableFile,
    /// Layer thicknesses over the depth [-], from the surface downwards. Default: equal layers.
    #[serde(default)]
    pub layer_shares: Vec<f64>,
}

/// One table from SWASH.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashTableFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Columns in order, required if the file has no header: `tsec`, `watl`, `velk1`, `velk2` (x velocity of a layer,
    /// layer 1 at the surface), `velx` (depth-averaged), `-` for any other column.
    #[serde(default)]
    pub columns: Vec<String>,
}

/// Vertical axis of OpenFOAM's mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UpFile {
    /// y points upwards.
    Y,
    /// z points upwards.
    #[default]
    Z,
}

/// Probes over the height at one position, or a vertical line that was sampled at each time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpenfoamFile {
    /// Folder of the function object, e.g. `postProcessing/probes`. It has one subfolder per start of the run for
    /// probes, one per time for a line.
    pub folder: PathBuf,
    /// Name of the line; leave it out for probes.
    #[serde(default)]
    pub line: Option<String>,
    /// Name of the velocity field.
    #[serde(default = "default_velocity")]
    pub velocity: String,
    /// Name of the field with the water fraction, sampled at the same points; samples in air are ignored.
    #[serde(default)]
    pub water: Option<String>,
    /// Vertical axis.
    #[serde(default)]
    pub up: UpFile,
    /// Level of the origin of OpenFOAM's mesh [m], in the z of `flume.bed_m`.
    #[serde(default)]
    pub origin_z_m: f64,
}

fn default_velocity() -> String {
    "U".to_owned()
}
