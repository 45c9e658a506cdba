//! Measured and published displacements of armour units, which runs are compared with.

mod read;

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::Value;

pub(super) use read::validate;

pub use crate::case::file::{ReferenceWaveKind, SeriesRole};

/// Heights and periods within this share of the reference match it: papers give two figures.
const TOLERANCE: f64 = 0.005;

/// A reference folder, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// What was measured, in one line.
    pub title: String,
    /// Where it was published.
    pub source: String,
    /// Remarks on the data.
    pub notes: Vec<String>,
    /// The waves, lowest first.
    pub waves: Vec<ReferenceWave>,
    /// Name and content of each file, so that a run can keep them.
    pub files: Vec<(String, Vec<u8>)>,
}

/// What was measured and published for one wave.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceWave {
    /// Kind.
    pub kind: ReferenceWaveKind,
    /// Height [m].
    pub height_m: f64,
    /// Period [s], if runs must have the same.
    pub period_s: Option<f64>,
    /// A unit is damaged when it has moved further than this [m].
    pub damage_distance_m: f64,
    /// Indices of the units that do not stand at a side wall.
    pub inner: Range<usize>,
    /// Displacements; at least one series is measured.
    pub series: Vec<Series>,
    /// Published resolution study, in the order of the file.
    pub convergence: Vec<Resolution>,
}

/// Displacements of all units in one repetition or simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name.
    pub name: String,
    /// Where the numbers come from.
    pub role: SeriesRole,
    /// Particle spacing of a published simulation [m].
    pub dp_m: Option<f64>,
    /// Displacement of each unit [m].
    pub displacement_m: Vec<f64>,
}

/// One run of a published resolution study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Particle spacing [m].
    pub dp_m: f64,
    /// Deviation of the mean displacement from the measured mean, (published - measured) / measured [%].
    pub deviation_percent: f64,
    /// Number of particles, if published.
    pub particles: Option<f64>,
    /// Wall clock time [h], if published.
    pub runtime_h: Option<f64>,
}

impl Reference {
    /// Name of the folder in a run's folder.
    pub const FOLDER: &str = "reference";
    /// Name of the file that describes the folder.
    pub const FILE: &str = "reference.json";

    /// The reference folder that the case of a run names, if it names one.
    pub fn folder_of_run(run: &Path) -> Option<PathBuf> {
        let case: Value = serde_json::from_slice(&std::fs::read(run.join("case.json")).ok()?).ok()?;
        Some(run.join(case.get("reference")?.as_str()?))
    }

    /// The wave of this kind with this height [m] and period [s].
    pub fn wave(&self, kind: &str, height_m: f64, period_s: Option<f64>) -> Option<&ReferenceWave> {
        let is_near = |value: f64, wanted: f64| (wanted - value).abs() <= TOLERANCE * wanted;
        self.waves.iter().find(|wave| {
            let has_period = wave.period_s.is_none_or(|wanted| period_s.is_some_and(|period| is_near(period, wanted)));
            wave.kind.name() == kind && is_near(height_m, wave.height_m) && has_period
        })
    }

    /// All waves in words: `solitary 0.026 m; regular 0.1 m, 2 s`.
    pub fn waves_in_words(&self) -> String {
        let waves: Vec<String> = self.waves.iter().map(ReferenceWave::in_words).collect();
        waves.join("; ")
    }
}

impl ReferenceWave {
    /// The wave in words: `regular 0.1 m, 2 s`.
    pub fn in_words(&self) -> String {
        let period = self.period_s.map(|period| format!(", {period} s")).unwrap_or_default();
        format!("{} {} m{period}", self.kind.name(), self.height_m)
    }

    /// Number of units.
    pub fn units(&self) -> usize {
        self.series[0].displacement_m.len()
    }

    /// The repetitions of the experiment.
    pub fn measured(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(|series| series.is_measured())
    }

    /// Measured mean displacement, the mean of the repetitions' means [m].
    pub fn measured_mean_m(&self) -> f64 {
        self.measured_mean(Series::mean_m)
    }

    /// Share of the units that moved further than the damage distance, mean of the repetitions [-].
    pub fn measured_damage_ratio(&self) -> f64 {
        self.measured_mean(|series| self.damage_ratio(&series.displacement_m))
    }

    /// Measured mean displacement of the inner units [m].
    pub fn measured_inner_mean_m(&self) -> f64 {
        self.measured_mean(|series| mean(&series.displacement_m[self.inner.clone()]))
    }

    /// Share of displacements beyond the damage distance [-].
    pub fn damage_ratio(&self, displacement_m: &[f64]) -> f64 {
        displacement_m.iter().filter(|d| **d > self.damage_distance_m).count() as f64 / displacement_m.len() as f64
    }

    fn measured_mean(&self, value: impl Fn(&Series) -> f64) -> f64 {
        self.measured().map(value).sum::<f64>() / self.measured().count() as f64
    }
}

impl Series {
    /// Whether it was measured.
    pub fn is_measured(&self) -> bool {
        self.role == SeriesRole::Measured
    }

    /// Mean displacement [m].
    pub fn mean_m(&self) -> f64 {
        mean(&self.displacement_m)
    }
}

/// Mean of a list; zero for an empty one.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
