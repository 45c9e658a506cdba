//! A dry case as written: units on a bed without water.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ContactFile, FrictionFile, HandoverFile, MaterialFile, MoundFile, Sides, StopFile, UnitsFile};

/// A dry case: units on a bed, a test of their contact, no water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryFile {
    /// Where the JSON schema lies, for editors (`breakwater schema --dry` prints it). Not used by the solver.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line that names the case.
    pub title: String,
    /// What had to be assumed because no source gives it.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// What is done with the units.
    pub dry: DryTestFile,
    /// Bed and mound.
    pub flume: DryFlumeFile,
    /// What closes the place.
    pub domain: DryDomainFile,
    /// Gravitational acceleration [m/s2].
    #[serde(default = "default_gravity_m_s2")]
    pub gravity_m_s2: f64,
    /// The units.
    pub units: UnitsFile,
    /// Elastic constants by material name.
    pub materials: Vec<MaterialFile>,
    /// Friction of each pair of materials that can touch.
    pub friction: Vec<FrictionFile>,
    /// Contact between units and with the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// What is done with the hardest impacts of the units: are they broken?
    // Left out where it is not used, so that such cases keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fracture: Option<HandoverFile>,
    /// What is written, and how often.
    #[serde(default)]
    pub output: DryOutputFile,
    /// When the run ends.
    pub stop: StopFile,
}

fn default_gravity_m_s2() -> f64 {
    9.81
}

/// What is done with the units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum DryTestFile {
    /// They are let go where they are.
    Settle {},
    /// They are lifted and let go.
    Drop(DropFile),
    /// The bed is tilted slowly, its shoreward end down, until they slide.
    Tilt(TiltFile),
}

/// A drop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DropFile {
    /// Height by which every unit is lifted [m].
    pub height_m: f64,
}

/// A slope test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltFile {
    /// How fast the slope grows [degrees/s]; the test is the finer the slower it is.
    #[serde(default = "default_rate_deg_s")]
    pub rate_deg_s: f64,
    /// Largest slope [degrees].
    #[serde(default = "default_to_deg")]
    pub to_deg: f64,
    /// A unit faster than this slides [m/s].
    #[serde(default = "default_slide_speed_m_s")]
    pub slide_speed_m_s: f64,
}

fn default_rate_deg_s() -> f64 {
    1.0
}

fn default_to_deg() -> f64 {
    60.0
}

fn default_slide_speed_m_s() -> f64 {
    2e-4
}

/// Bed and mound of a dry case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryFlumeFile {
    /// Corner points [x, z] of the bed [m], x rising.
    pub bed_m: Vec<[f64; 2]>,
    /// A trapezoidal mound on the bed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mound: Option<MoundFile>,
    /// A triangle surface on or over the bed: rock, a survey, a model of a mound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub terrain: Option<TerrainFile>,
    /// Material of bed, mound, terrain and walls, one of `materials`.
    pub material: String,
}

/// An STL file of a surface to stand on, ASCII or binary, open or closed; its path is seen from the folder of the case
/// file, its triangles are counter-clockwise seen from where the units are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TerrainFile {
    /// The file.
    pub path: String,
    /// Metres in a unit of length of the file: 1, or 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
}

fn default_scale() -> f64 {
    1.0
}

/// What closes the place of a dry case; walls stand at both ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryDomainFile {
    /// Seaward and shoreward end [m].
    pub x_m: [f64; 2],
    /// Width across [m].
    pub width_m: f64,
    /// What closes it across: `periodic` or `walls`.
    pub sides: Sides,
    /// Top of the walls [m]; no unit may stand higher at the start.
    pub top_z_m: f64,
}

/// What a dry run writes, and how often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DryOutputFile {
    /// Interval of the moving surfaces of the units [s]; 0 writes none.
    pub units_interval_s: f64,
    /// Interval of motion and energy [s].
    pub series_interval_s: f64,
    /// Interval of the checkpoints in simulated time [s]; 0 writes none.
    pub checkpoint_interval_s: f64,
}

impl Default for DryOutputFile {
    fn default() -> Self {
        Self { units_interval_s: 0.02, series_interval_s: 0.01, checkpoint_interval_s: 1.0 }
    }
}
