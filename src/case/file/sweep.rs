//! The file of a sweep as the user writes it: one case with keys that vary.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value};

/// A sweep: many runs of one case with keys that vary.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepFile {
    /// Path of the JSON schema, for editors (`breakwater schema --sweep` prints it). The solver ignores it.
    #[serde(rename = "$schema", default)]
    pub schema: Option<String>,
    /// Title of chart and runs.
    pub title: String,
    /// The case file, relative to the sweep file. Paths in the case file are relative to the case file.
    pub case: PathBuf,
    /// Keys with values that differ from the case but are the same in all runs: `{"domain.dp_m": 0.014}`.
    #[serde(default)]
    pub set: Map<String, Value>,
    /// Keys with their values; the last key varies fastest.
    pub vary: Vec<VaryFile>,
    /// How the values of different keys are combined.
    #[serde(default)]
    pub combine: Combine,
    /// Simulated time [s] until which the units do not move in any run. One common run with the first values covers
    /// this time, and the other runs start from its checkpoint. Only friction, the rest criterion and titles may
    /// then vary.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub common_start_s: Option<f64>,
}

/// How the values of the varied keys are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Combine {
    /// All combinations of all values.
    #[default]
    All,
    /// The base case, then each value alone; shows how much the result depends on each key.
    OneAtATime,
}

/// A key of the case with its values: either `values`, or `from`, `to` and `count`.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VaryFile {
    /// Path of the key, as in `domain.dp_m` or `friction[1].coefficient`.
    pub key: String,
    /// Values of any type that the key allows.
    #[schemars(length(min = 1))]
    pub values: Option<Vec<Value>>,
    /// First value.
    pub from: Option<f64>,
    /// Last value.
    pub to: Option<f64>,
    /// Number of equally spaced values, including both ends.
    #[schemars(range(min = 2, max = 10_000))]
    pub count: Option<usize>,
}
