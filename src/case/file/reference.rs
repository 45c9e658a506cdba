//! `reference.json`: measured and published displacements of armour units.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A reference folder: this file, `reference.json`, and the CSV files that it names, in the same folder. Runs are
/// compared with it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceFile {
    /// Path of the JSON schema, for editors (`breakwater schema --reference` prints it). Not used by the program.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What was measured, in one line.
    pub title: String,
    /// Where it was published.
    pub source: String,
    /// Remarks on the data; every comparison shows them.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Number of units; every displacement file has one row for each.
    pub units: u32,
    /// First and last unit, counted from 1, that do not stand at a side wall; all units if left out.
    #[serde(default)]
    pub inner_units: Option<[u32; 2]>,
    /// A unit is damaged when it has moved further than this [m].
    pub damage_distance_m: f64,
    /// The series of displacements; every displacement file has one column for each.
    pub series: Vec<SeriesFile>,
    /// The waves.
    pub waves: Vec<ReferenceWaveFile>,
}

/// A series of displacements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SeriesFile {
    /// Name of its column in the displacement files.
    pub name: String,
    /// Where its numbers come from.
    pub role: SeriesRole,
    /// Particle spacing of a published simulation [m].
    #[serde(default)]
    pub dp_m: Option<f64>,
}

/// Where the numbers of a series come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeriesRole {
    /// One repetition of the experiment.
    Measured,
    /// A published simulation of the experiment.
    PublishedSimulation,
}

/// A wave of the experiment. A run belongs to it that has the same kind, height and, if given, period.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceWaveFile {
    /// Kind of wave, as in a case file.
    pub kind: ReferenceWaveKind,
    /// Wave height as in a case file [m].
    pub height_m: f64,
    /// Period of a regular wave or peak period of an irregular one, as in a case file [s].
    #[serde(default)]
    pub period_s: Option<f64>,
    /// CSV file with the displacement of each unit seen from above [m]: one row per unit, from the unit with the
    /// smallest y; columns by the names of the series. Lines that begin with `#` are comments.
    pub displacements: String,
    /// CSV file with a published resolution study: `dp_m` [m] and `deviation_percent`, the deviation of the mean
    /// displacement from the measured mean [%]; optional columns `particles` and `runtime_h` [h].
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
    /// Irregular waves; height and period are those of the spectrum.
    Irregular,
}

impl ReferenceWaveKind {
    /// The name in case files and summaries.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solitary => "solitary",
            Self::Regular => "regular",
            Self::Irregular => "irregular",
        }
    }
}
