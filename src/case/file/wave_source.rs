//! Settings for a wave from another program, as the user writes them.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wave from another program, given by the water velocity at the wavemaker as a function of height and time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExternalWaveFile {
    /// Files that the other program has written.
    pub source: WaveSourceFile,
    /// Celerity of the wave [m/s]. If given, each row of the wavemaker moves with the water velocity at the row's
    /// current position. Otherwise, the row moves with the velocity at its initial position, and its stroke is too
    /// short.
    #[serde(default)]
    pub celerity_m_s: Option<f64>,
}

/// Files with water velocities. Paths are relative to the folder of the case file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "format", deny_unknown_fields)]
pub enum WaveSourceFile {
    /// A `_velx` file for the multi-layer piston of DualSPHysics. `breakwater wave` also writes such files.
    Dualsphysics(VelxFile),
    /// Tables from SWASH.
    Swash(SwashFile),
    /// Probes or a sampled vertical line from OpenFOAM.
    Openfoam(OpenfoamFile),
}

/// A `_velx` file for the multi-layer piston of DualSPHysics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VelxFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Level z of the case at the level 0 of the file [m]. By default, the levels of the file are z; if no level is in
    /// the water then, they count from the still water level or from the surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin_z_m: Option<f64>,
}

/// Tables that SWASH has written for one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashFile {
    /// Table of the water level, with the columns `TSEC` and `WATL`.
    pub level: SwashTableFile,
    /// Table of the velocities, with the columns `TSEC` and `VELK`. It may be the same file as for `level`.
    pub velocity: SwashTableFile,
    /// Thickness of each layer / water depth [-], from the surface downwards. Default: all layers are equally thick.
    #[serde(default)]
    pub layer_shares: Vec<f64>,
    /// True if the velocity is depth-averaged (`VEL` or `VKSI`, or one layer). The water at the wavemaker then moves
    /// with the same velocity at all heights, which is correct for long waves only.
    #[serde(default)]
    pub depth_averaged: bool,
    /// Level z of the case at which `WATL` is 0 [m]. Default: the still water level.
    #[serde(default)]
    pub origin_z_m: Option<f64>,
    /// Time between two rows [s], for tables without the column `TSEC`.
    #[serde(default)]
    pub row_interval_s: Option<f64>,
    /// Time of the first row [s], for tables without the column `TSEC`. Default: 0.
    #[serde(default)]
    pub first_row_s: Option<f64>,
}

/// One table from SWASH.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashTableFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Names of the columns from left to right, required if the file has no header. They replace the names in a header:
    /// `tsec` (time), `watl` (water
    /// level), `velk1`, `velk2` and so on (x velocity of a layer, layer 1 at the surface), `velx` (depth-averaged x
    /// velocity), `-` for any other column.
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

/// OpenFOAM output at one position: probes at several heights, or a vertical line that was sampled at each output time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpenfoamFile {
    /// Folder of the function object, e.g. `postProcessing/probes`. For probes, it has one subfolder per start of the
    /// OpenFOAM run; for a line, one subfolder per output time.
    pub folder: PathBuf,
    /// Name of the sampled line. Leave this key out for probes.
    #[serde(default)]
    pub line: Option<String>,
    /// Name of OpenFOAM's velocity field.
    #[serde(default = "default_velocity")]
    pub velocity: String,
    /// Name of the field with the water fraction, sampled at the same points as the velocity. If given, velocities in
    /// air are ignored.
    #[serde(default)]
    pub water: Option<String>,
    /// Vertical axis of OpenFOAM's mesh.
    #[serde(default)]
    pub up: UpFile,
    /// Level of the origin of OpenFOAM's mesh [m], as a z coordinate like those of `flume.bed_m`.
    #[serde(default)]
    pub origin_z_m: f64,
}

fn default_velocity() -> String {
    "U".to_owned()
}
