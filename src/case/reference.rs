//! Measured and published displacements of armour units, which runs are compared with.

mod read;

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::Value;

pub(super) use read::validate;

pub use crate::case::file::{ReferenceWaveKind, SeriesRole};

/// Largest relative difference [-] at which the wave heights, or the periods, of a run and of the reference count as
/// equal. Papers give rounded values.
const TOLERANCE: f64 = 0.005;

/// The validated contents of a reference folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Title of the measurements, one line.
    pub title: String,
    /// Publication of the measurements.
    pub source: String,
    /// Remarks on the data.
    pub notes: Vec<String>,
    /// Waves of the experiment, in order of increasing height.
    pub waves: Vec<ReferenceWave>,
    /// Name and content of each file in the folder. A run copies these files into its own folder.
    pub files: Vec<(String, Vec<u8>)>,
}

/// Measured and published displacements for one wave.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceWave {
    /// Kind of wave.
    pub kind: ReferenceWaveKind,
    /// Wave height [m].
    pub height_m: f64,
    /// Wave period [s]. `None` if the wave period of a run does not matter.
    pub period_s: Option<f64>,
    /// A unit counts as damaged if its displacement is larger than this distance [m].
    pub damage_distance_m: f64,
    /// Indices of the inner units, which do not stand at a side wall.
    pub inner: Range<usize>,
    /// Series of displacements. At least one series is measured.
    pub series: Vec<Series>,
    /// Published resolution study, in the order of its file; empty if there is none.
    pub convergence: Vec<Resolution>,
}

/// Displacements of all units in one repetition of the experiment or in one published simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name of the series.
    pub name: String,
    /// Origin of the displacements: experiment or published simulation.
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
    /// Run time (wall clock) [h], if published.
    pub runtime_h: Option<f64>,
}

impl Reference {
    /// Name of the reference folder inside a run folder.
    pub const FOLDER: &str = "reference";
    /// Name of the file that describes a reference folder.
    pub const FILE: &str = "reference.json";

    /// Returns the path of the reference folder that the stored case of a run names, if it names one. `run` is the run
    /// folder.
    pub fn folder_of_run(run: &Path) -> Option<PathBuf> {
        let case: Value = serde_json::from_slice(&std::fs::read(run.join("case.json")).ok()?).ok()?;
        Some(run.join(case.get("reference")?.as_str()?))
    }

    /// Returns the wave of the experiment with this kind, height [m] and period [s], if there is one.
    pub fn wave(&self, kind: &str, height_m: f64, period_s: Option<f64>) -> Option<&ReferenceWave> {
        let is_near = |value: f64, wanted: f64| (wanted - value).abs() <= TOLERANCE * wanted;
        self.waves.iter().find(|wave| {
            let has_period = wave.period_s.is_none_or(|wanted| period_s.is_some_and(|period| is_near(period, wanted)));
            wave.kind.name() == kind && is_near(height_m, wave.height_m) && has_period
        })
    }

    /// Returns a list of all waves for messages, e.g. `solitary 0.026 m; regular 0.1 m, 2 s`.
    pub fn waves_in_words(&self) -> String {
        let waves: Vec<String> = self.waves.iter().map(ReferenceWave::in_words).collect();
        waves.join("; ")
    }
}

impl ReferenceWave {
    /// Returns kind, height and period of the wave for messages, e.g. `regular 0.1 m, 2 s`.
    pub fn in_words(&self) -> String {
        let period = self.period_s.map(|period| format!(", {period} s")).unwrap_or_default();
        format!("{} {} m{period}", self.kind.name(), self.height_m)
    }

    /// Returns the number of units.
    pub fn units(&self) -> usize {
        self.series[0].displacement_m.len()
    }

    /// Returns the measured series: the repetitions of the experiment.
    pub fn measured(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(|series| series.is_measured())
    }

    /// Returns the measured mean displacement [m]: the mean over units and repetitions.
    pub fn measured_mean_m(&self) -> f64 {
        self.measured_mean(Series::mean_m)
    }

    /// Returns the measured damage ratio [-]: the share of damaged units, averaged over the repetitions.
    pub fn measured_damage_ratio(&self) -> f64 {
        self.measured_mean(|series| self.damage_ratio(&series.displacement_m))
    }

    /// Returns the measured mean displacement of the inner units [m].
    pub fn measured_inner_mean_m(&self) -> f64 {
        self.measured_mean(|series| mean(&series.displacement_m[self.inner.clone()]))
    }

    /// Returns the damage ratio [-]: the share of displacements that are larger than the damage distance.
    pub fn damage_ratio(&self, displacement_m: &[f64]) -> f64 {
        displacement_m.iter().filter(|d| **d > self.damage_distance_m).count() as f64 / displacement_m.len() as f64
    }

    fn measured_mean(&self, value: impl Fn(&Series) -> f64) -> f64 {
        self.measured().map(value).sum::<f64>() / self.measured().count() as f64
    }
}

impl Series {
    /// Returns true if the series was measured.
    pub fn is_measured(&self) -> bool {
        self.role == SeriesRole::Measured
    }

    /// Returns the mean displacement of all units [m].
    pub fn mean_m(&self) -> f64 {
        mean(&self.displacement_m)
    }
}

/// Returns the mean of the values; 0 for an empty list.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
