//! `reference.json` as the user writes it: measured and published displacements of armour units.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Contents of `reference.json`, which describes the measured and published displacements in a reference folder. The
/// CSV files that `reference.json` names are in the same folder. Runs are compared with these displacements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceFile {
    /// Path of the JSON schema, for editors (`breakwater schema --reference` prints it). Not used by the program.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Title of the measurements, one line.
    pub title: String,
    /// Publication of the measurements.
    pub source: String,
    /// Remarks on the data. Every comparison page shows the remarks.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Number of units. Every displacement file has one row per unit.
    pub units: u32,
    /// Numbers of the first and the last unit that do not stand at a side wall, counted from 1. Default: all units.
    #[serde(default)]
    pub inner_units: Option<[u32; 2]>,
    /// A unit counts as damaged if its displacement is larger than this distance [m].
    pub damage_distance_m: f64,
    /// Series of displacements. Every displacement file has one column per series.
    pub series: Vec<SeriesFile>,
    /// Waves of the experiment.
    pub waves: Vec<ReferenceWaveFile>,
}

/// A series of displacements: one repetition of the experiment, or one published simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SeriesFile {
    /// Name of the series, which is its column name in the displacement files.
    pub name: String,
    /// Origin of the displacements: experiment or published simulation.
    pub role: SeriesRole,
    /// Particle spacing of a published simulation [m]. Leave this key out for measurements.
    #[serde(default)]
    pub dp_m: Option<f64>,
}

/// Origin of the displacements in a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeriesRole {
    /// One repetition of the experiment.
    Measured,
    /// A published simulation of the experiment.
    PublishedSimulation,
}

/// A wave of the experiment. A run is compared with this wave if its wave has the same kind, and the same height and
/// period within 0.5 %. The period is ignored if it is not given here.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceWaveFile {
    /// Kind of wave, as in a case file.
    pub kind: ReferenceWaveKind,
    /// Wave height as in a case file [m].
    pub height_m: f64,
    /// Period of regular waves or peak period of irregular waves, as in a case file [s].
    #[serde(default)]
    pub period_s: Option<f64>,
    /// CSV file with the horizontal displacement of each unit [m]: one row per unit, in order of increasing y, and one
    /// column per series, with the name of the series. Lines that begin with `#` are comments.
    pub displacements: String,
    /// CSV file with a published resolution study. Its columns are `dp_m` [m] and `deviation_percent`, the deviation of
    /// the mean displacement from the measured mean [%]. The columns `particles` and `runtime_h` [h] are optional.
    #[serde(default)]
    pub convergence: Option<String>,
}

/// Kind of a wave whose height is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceWaveKind {
    /// A solitary wave.
    Solitary,
    /// A regular wave.
    Regular,
    /// Irregular waves. The height is the significant wave height, the period the peak period.
    Irregular,
}

impl ReferenceWaveKind {
    /// Returns the name of the wave kind in case files and summaries.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solitary => "solitary",
            Self::Regular => "regular",
            Self::Irregular => "irregular",
        }
    }
}
