//! The summary of a dry test.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::DryTest;
use crate::output::{Execution, OutputError, Stopped, write_atomically};

/// Content of `summary.json` of a dry test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DryTestSummary {
    /// Title of the case.
    pub title: String,
    /// Version of breakwater that computed the run.
    pub breakwater_version: String,
    /// Hash of the case.
    pub case_hash: String,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Reason why the run ended.
    pub stopped: Stopped,
    /// Number of substeps of the contact solver.
    pub substeps: u64,
    /// Number of contacts at the end.
    pub contacts_now: usize,
    /// Number of contacts since the start: first those with bed and walls, then those between units.
    pub contacts: [u64; 2],
    /// Largest force of any contact [N].
    pub peak_force_n: f64,
    /// Deepest overlap of a contact at the end, divided by the height of a unit [-].
    pub deepest_overlap: f64,
    /// Kinetic energy at the end [J].
    pub kinetic_j: f64,
    /// Mechanical energy at the start: sum of kinetic, potential and elastic energy [J].
    pub energy_start_j: f64,
    /// Mechanical energy at the end [J].
    pub energy_end_j: f64,
    /// Largest rise of the mechanical energy within a millisecond [J]; none in a tilt test, because the tilting bed
    /// does work on the units.
    pub largest_rise_j: Option<f64>,
    /// Time at which all units came to rest [s]; none if a unit still moves, or if the case has no rest criterion.
    pub at_rest_since_s: Option<f64>,
    /// The units.
    pub units: Vec<DryUnit>,
    /// Assumptions of the case.
    pub assumptions: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Wall-clock time of the last session, and machine.
    pub execution: Execution,
}

/// Result for one unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DryUnit {
    /// Number of the unit, from 1.
    pub unit: usize,
    /// Centre at the start [m].
    pub start_m: [f64; 3],
    /// Centre at the end [m].
    pub end_m: [f64; 3],
    /// Horizontal displacement of the centre, as in flume runs [m].
    pub moved_m: f64,
    /// Height by which the centre sank [m]; negative if it rose.
    pub sank_m: f64,
    /// Rotation from start to end [degrees].
    pub turned_deg: f64,
    /// Slope at which the unit began to slide in a tilt test [degrees].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slides_at_deg: Option<f64>,
    /// Friction coefficient from a tilt test: the tangent of `slides_at_deg` [-].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
}

impl DryTestSummary {
    /// File name in the run folder.
    pub const FILE: &str = "summary.json";

    /// Summarises a dry test that has ended.
    pub fn of(run: &DryTest, stopped: Stopped) -> Self {
        let (measured, energy) = (&run.measured, run.world.energy());
        let unit = |number: usize| {
            let (start, end) = (&run.start[number], &run.world.states()[number]);
            let slides_at = measured.slides_at[number];
            DryUnit {
                unit: number + 1,
                start_m: start.position.to_array(),
                end_m: end.position.to_array(),
                moved_m: (end.position - start.position).truncate().length(),
                sank_m: start.position.z - end.position.z,
                turned_deg: start.rotation.angle_between(end.rotation).to_degrees(),
                slides_at_deg: slides_at.map(f64::to_degrees),
                friction: slides_at.map(f64::tan),
            }
        };
        let tilts = matches!(run.case.test, crate::case::DryTestKind::Tilt { .. });
        Self {
            title: run.case.title.clone(),
            breakwater_version: env!("CARGO_PKG_VERSION").to_owned(),
            case_hash: run.case.hash.clone(),
            simulated_s: run.time(),
            stopped,
            substeps: run.world.substeps(),
            contacts_now: run.world.contact_count(),
            contacts: measured.contacts,
            peak_force_n: measured.peak_force,
            deepest_overlap: run.world.deepest_overlap() / run.case.units.tallest(),
            kinetic_j: energy.kinetic,
            energy_start_j: measured.energy_start,
            energy_end_j: measured.energy,
            largest_rise_j: (!tilts).then_some(measured.largest_rise),
            at_rest_since_s: measured.at_rest_since,
            units: (0..run.start.len()).map(unit).collect(),
            assumptions: run.case.assumptions.clone(),
            warnings: run.case.warnings.clone(),
            execution: Execution::here(run.measured.wall_s, run.world.substeps() as f64, None),
        }
    }

    /// Reads `summary.json` from a run folder.
    ///
    /// # Errors
    /// If the file is missing or does not belong to a dry test.
    pub fn read(dir: &Path) -> Result<Self, OutputError> {
        let path = dir.join(Self::FILE);
        let text = std::fs::read_to_string(&path).map_err(OutputError::io(&path))?;
        serde_json::from_str(&text).map_err(OutputError::json(&path))
    }

    /// Writes `summary.json` into the run folder.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, dir: &Path) -> Result<(), OutputError> {
        let path = dir.join(Self::FILE);
        let mut text = serde_json::to_string_pretty(self).map_err(OutputError::json(&path))?;
        text.push('\n');
        write_atomically(&path, text.as_bytes())
    }
}
