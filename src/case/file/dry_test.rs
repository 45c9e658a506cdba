//! The file of a dry test as the user writes it: units on a bed without water.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    BreakageFile, ContactFile, FrictionFile, MaterialFile, MoundFile, PartFile, Sides, StopFile, TerrainFile,
    UnitGroupsFile,
};

/// A dry test: units on a bed without water, for a tilt, drop or settling test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryFile {
    /// Path of the JSON schema, for editors (`breakwater schema --dry-test` prints it). The solver ignores it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that the user had to assume because no source gives them. The report lists the assumptions.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Kind of test: settling, drop or tilt test.
    #[serde(alias = "dry")]
    pub dry_test: DryTestFile,
    /// Bed, mound and terrain.
    pub flume: DryFlumeFile,
    /// The structure: solid parts, such as a mound, a toe berm or a crown wall.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub structure: Vec<PartFile>,
    /// Extent of the test area and its boundaries.
    pub domain: DryDomainFile,
    /// Gravitational acceleration [m/s2].
    #[serde(default = "default_gravity_m_s2")]
    pub gravity_m_s2: f64,
    /// The armour units.
    pub units: UnitGroupsFile,
    /// Materials of units and bed, with their elastic constants.
    pub materials: Vec<MaterialFile>,
    /// Friction coefficients for each pair of materials that can touch.
    pub friction: Vec<FrictionFile>,
    /// Contact between units, and between units and the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// Breakage analysis: re-runs the hardest impacts of the run at prototype scale with breakable units.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(alias = "fracture", default, skip_serializing_if = "Option::is_none")]
    pub breakage: Option<BreakageFile>,
    /// Output files and their intervals.
    #[serde(default)]
    pub output: DryOutputFile,
    /// Criteria that end the run: duration and rest of the units.
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
    /// Drop test: the units are lifted from their initial poses and released.
    Drop(DropFile),
    /// Tilt test: the bed tilts slowly, with its shoreward end downwards. The result is the angle at which each unit
    /// begins to slide.
    Tilt(TiltFile),
}

/// A drop test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DropFile {
    /// Height by which every unit is lifted above its initial pose [m].
    pub height_m: f64,
}

/// A tilt test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltFile {
    /// Rate at which the tilt angle grows [degrees/s]. A lower rate gives a more accurate sliding angle.
    #[serde(default = "default_rate_deg_s")]
    pub rate_deg_s: f64,
    /// Largest tilt angle, at which the test ends [degrees].
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
    /// A triangulated surface on or above the bed, for example rubble, a surveyed terrain or a detailed mound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub terrain: Option<TerrainFile>,
    /// Material of bed, terrain and walls: a name in `materials`.
    pub material: String,
}

/// Test area of a dry test. Walls stand at its seaward and at its shoreward end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryDomainFile {
    /// x of the seaward and of the shoreward end [m].
    pub x_m: [f64; 2],
    /// Width of the test area in y [m].
    pub width_m: f64,
    /// Boundaries at the two sides: `periodic` or `walls`.
    pub sides: Sides,
    /// Level of the top of the walls [m]. At the start, no unit may be higher.
    pub top_z_m: f64,
}

/// Output files of a dry test and their intervals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DryOutputFile {
    /// Interval between outputs of the unit surfaces [s]; 0 for no output.
    pub units_interval_s: f64,
    /// Interval between rows of the tables with unit motion and energy [s].
    pub series_interval_s: f64,
    /// Simulated time between checkpoints [s]; 0: a checkpoint is written only if the user stops the run.
    pub checkpoint_interval_s: f64,
}

impl Default for DryOutputFile {
    fn default() -> Self {
        Self { units_interval_s: 0.02, series_interval_s: 0.01, checkpoint_interval_s: 1.0 }
    }
}
