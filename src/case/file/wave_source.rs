//! Where a wave of another program lies, as written.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wave from another program: the velocity of its water over height and time where the wavemaker stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenWaveFile {
    /// The files.
    pub source: WaveSourceFile,
    /// Speed at which the wave travels [m/s]. With it the rows of the wavemaker move as water that leaves the place
    /// where the velocity is known; without it they move with the velocity at that place, and their stroke is too
    /// short.
    #[serde(default)]
    pub celerity_m_s: Option<f64>,
}

/// Files with velocities; paths are seen from the folder of the case file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "format", deny_unknown_fields)]
pub enum WaveSourceFile {
    /// A `_velx` file of DualSPHysics' multi-layer piston; `breakwater wave` writes one, too.
    Dualsphysics(VelxFile),
    /// Tables of SWASH.
    Swash(SwashFile),
    /// Probes or a sampled line of OpenFOAM.
    Openfoam(OpenfoamFile),
}

/// A `_velx` file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VelxFile {
    /// The file.
    pub path: PathBuf,
}

/// Tables of SWASH for one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashFile {
    /// The table with `TSEC` and `WATL`.
    pub level: SwashTableFile,
    /// The table with `TSEC` and `VELK`; it may be the same file.
    pub velocity: SwashTableFile,
    /// Thicknesses of the layers as shares of the depth from the surface down; without them all are equal.
    #[serde(default)]
    pub layer_shares: Vec<f64>,
}

/// One table of SWASH.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwashTableFile {
    /// The file.
    pub path: PathBuf,
    /// Its columns in their order, needed where no header names them: `tsec`, `watl`, `velk1`, `velk2` (x of a layer,
    /// the first at the surface), `velx` (averaged over the depth), `-` for anything else.
    #[serde(default)]
    pub columns: Vec<String>,
}

/// Axis of OpenFOAM's mesh that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UpFile {
    /// y.
    Y,
    /// z.
    #[default]
    Z,
}

/// Probes over the height at one place, or a line there that was sampled at each time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpenfoamFile {
    /// The folder of the function object, e.g. `postProcessing/probes`, with one folder for each start of the run; of a
    /// line, one for each time.
    pub folder: PathBuf,
    /// Name of the line; without it there are probes.
    #[serde(default)]
    pub line: Option<String>,
    /// Name of the velocity.
    #[serde(default = "default_velocity")]
    pub velocity: String,
    /// Name of the share of water, by which samples in air are left out; sampled at the same points.
    #[serde(default)]
    pub water: Option<String>,
    /// Axis that points up.
    #[serde(default)]
    pub up: UpFile,
    /// Level of OpenFOAM's origin [m], in the z of `flume.bed_m`.
    #[serde(default)]
    pub origin_z_m: f64,
}

fn default_velocity() -> String {
    "U".to_owned()
}
