//! The sweep file as the user writes it: a case and the keys whose values vary from run to run.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A sweep: many runs of one case, in which the values of some keys vary.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepFile {
    /// Path of the JSON schema, for editors (`breakwater schema --sweep` prints it). The solver ignores it.
    #[serde(rename = "$schema", default)]
    pub schema: Option<String>,
    /// Title of the sweep, used in its chart and as the title of its runs.
    pub title: String,
    /// Path of the case file, relative to the folder of the sweep file. Paths in the case file are relative to the
    /// folder of the case file.
    pub case: PathBuf,
    /// Keys with new values, which replace the values of the case file in all runs: `{"domain.dp_m": 0.014}`.
    #[serde(default)]
    pub set: Map<String, Value>,
    /// Keys that vary, with their values. The last key varies fastest.
    pub vary: Vec<VaryFile>,
    /// Rule that combines the values of different keys.
    #[serde(default)]
    pub combine: Combine,
    /// Number of runs of each combination, each with new `random` values. Required if a key has `random` values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 2, max = 10_000))]
    pub repetitions: Option<usize>,
    /// Seed of the `random` values. The same seed gives the same values.
    #[serde(default)]
    pub seed: u64,
    /// Simulated time [s] until which the units do not move in any run. One common run with the first value of each
    /// key computes the case up to this time. All runs start from the checkpoint of the common run. With this key,
    /// only `friction`, `stop.at_rest`, `title`, `assumptions` and `reference` may vary.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub common_start_s: Option<f64>,
}

/// Rule that combines the values of the keys that vary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Combine {
    /// All combinations of all values.
    #[default]
    All,
    /// First the base case. Then, for each value of each key, one run that changes only this key.
    OneAtATime,
}

/// A key that varies, with its values: either `values`, or `from`, `to` and `count`, or `random`.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VaryFile {
    /// Path of the key in the case file, for example `domain.dp_m` or `friction[1].coefficient`.
    pub key: String,
    /// Values of the key, of any type that the key allows.
    #[schemars(length(min = 1))]
    pub values: Option<Vec<Value>>,
    /// First of the equally spaced values.
    pub from: Option<f64>,
    /// Last of the equally spaced values.
    pub to: Option<f64>,
    /// Number of equally spaced values, including `from` and `to`.
    #[schemars(range(min = 2, max = 10_000))]
    pub count: Option<usize>,
    /// Random values, one for each repetition. All combinations of the other keys have the same random values.
    #[serde(default)]
    pub random: Option<RandomFile>,
}

/// Distribution of random values.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RandomFile {
    /// All values between the two limits are equally likely.
    Uniform([f64; 2]),
    /// Normal distribution, without the values outside the limits.
    Normal(NormalFile),
    /// A whole number for a key that is a seed, such as `units.scatter.seed`.
    Seed,
}

/// Normal distribution.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalFile {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub deviation: f64,
    /// Least value.
    pub least: Option<f64>,
    /// Greatest value.
    pub most: Option<f64>,
}
