//! The file of a dry test as the user writes it: units on a bed without water.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ContactFile, FrictionFile, HandoverFile, MaterialFile, MoundFile, Sides, StopFile, UnitsFile};

/// A dry test: units on a bed without water, for a tilt, drop or settling test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryFile {
    /// Path of the JSON schema, for editors (`breakwater schema --dry` prints it). The solver ignores it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Name of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that no source gives. The report lists them.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// The test.
    pub dry: DryTestFile,
    /// Bed, mound and terrain.
    pub flume: DryFlumeFile,
    /// Extent of the test area and its boundaries.
    pub domain: DryDomainFile,
    /// Gravitational acceleration [m/s2].
    #[serde(default = "default_gravity_m_s2")]
    pub gravity_m_s2: f64,
    /// The units.
    pub units: UnitsFile,
    /// Materials of units and bed, with their elastic constants.
    pub materials: Vec<MaterialFile>,
    /// Friction for each pair of materials that can touch.
    pub friction: Vec<FrictionFile>,
    /// Contact between units, and between units and the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// Breakage analysis: re-runs the hardest impacts at prototype scale with breakable units.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fracture: Option<HandoverFile>,
    /// Output files and their intervals.
    #[serde(default)]
    pub output: DryOutputFile,
    /// When the run ends.
    pub stop: StopFile,
}

fn default_gravity_m_s2() -> f64 {
    9.81
}

/// Kind of dry test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum DryTestFile {
    /// Settling test: the units are released from their initial poses.
    Settle {},
    /// Drop test: the units are lifted and released.
    Drop(DropFile),
    /// Tilt test: the bed is tilted slowly, its shoreward end down, until the units slide.
    Tilt(TiltFile),
}

/// A drop test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DropFile {
    /// Height by which every unit is lifted [m].
    pub height_m: f64,
}

/// A tilt test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltFile {
    /// Rate at which the slope grows [degrees/s]; a slower tilt resolves the sliding angle better.
    #[serde(default = "default_rate_deg_s")]
    pub rate_deg_s: f64,
    /// Largest slope; the test ends there [degrees].
    #[serde(default = "default_to_deg")]
    pub to_deg: f64,
    /// Speed above which a unit counts as sliding [m/s].
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

/// Bed, mound and terrain of a dry test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryFlumeFile {
    /// Corner points [x, z] of the bed [m]; x must increase.
    pub bed_m: Vec<[f64; 2]>,
    /// A trapezoidal mound on the bed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mound: Option<MoundFile>,
    /// A triangulated surface on or above the bed: rubble, a survey, a model of a mound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub terrain: Option<TerrainFile>,
    /// Material of bed, mound, terrain and walls, one of `materials`.
    pub material: String,
}

/// An STL file of a surface that carries units, ASCII or binary, open or closed. Seen from the units, its triangles
/// must run counter-clockwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TerrainFile {
    /// Path of the file, relative to the folder of the case file.
    pub path: String,
    /// Length unit of the file in metres: 1, or 0.001 for millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
}

fn default_scale() -> f64 {
    1.0
}

/// Test area of a dry test. Walls stand at both ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryDomainFile {
    /// x of the seaward and of the shoreward end [m].
    pub x_m: [f64; 2],
    /// Width of the area in y [m].
    pub width_m: f64,
    /// Boundaries at the two sides: `periodic` or `walls`.
    pub sides: Sides,
    /// Top of the walls [m]; no unit may be higher at the start.
    pub top_z_m: f64,
}

/// Output files of a dry test and their intervals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DryOutputFile {
    /// Interval of the unit surfaces [s]; 0 for none.
    pub units_interval_s: f64,
    /// Interval of the tables of motion and energy [s].
    pub series_interval_s: f64,
    /// Interval of the checkpoints in simulated time [s]; 0 for none.
    pub checkpoint_interval_s: f64,
}

impl Default for DryOutputFile {
    fn default() -> Self {
        Self { units_interval_s: 0.02, series_interval_s: 0.01, checkpoint_interval_s: 1.0 }
    }
}
