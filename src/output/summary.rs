//! Summary of a run: results for the units, and data about the run.

use std::{fmt, path::Path};

use serde::{Deserialize, Serialize};

use super::gauge_summary::{ForceSummary, GaugeSummary, PressureSummary};
use super::unit_summary::{GroupSummary, UnitSummary, averages};
use super::{Execution, OutputError, write_atomically};

/// Content of `summary.json`: damage and displacements first, then details of the run.
///
/// If a case is run twice, the two summaries differ only in the keys of [`Execution`].
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// Title of the case.
    pub title: String,
    /// Version of breakwater that made the run.
    pub breakwater_version: String,
    /// Hash of the case that was run, as a hexadecimal number.
    pub case_hash: String,
    /// Share of the units that moved further than their damage distance [-]; `None` without units that can move.
    pub damage_ratio: Option<f64>,
    /// Mean displacement of the units [m]; `None` without units that can move.
    pub mean_displacement_m: Option<f64>,
    /// Displacement above which a unit counts as damaged (damage distance) [m]; `None` without units that can move. If
    /// groups differ, that of the first group that can move.
    pub damage_distance_m: Option<f64>,
    /// Results of the breakage analysis; `None` if the run was not analysed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub breakage: Option<BreakageSummary>,
    /// Groups of equal units; empty in the summaries of older versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<GroupSummary>,
    /// The units in order of their numbers.
    pub units: Vec<UnitSummary>,
    /// The wave; `None` if the case has no wave or the wave height is unknown.
    pub wave: Option<WaveSummary>,
    /// Highest surface elevation at each elevation gauge.
    pub gauges: Vec<GaugeSummary>,
    /// Highest pressure at each pressure gauge in the particle domain.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pressure_gauges: Vec<PressureSummary>,
    /// Extremes and impulse at each force gauge.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub force_gauges: Vec<ForceSummary>,
    /// Numbers and largest values of the contact events in the whole run.
    pub contacts: ContactSummary,
    /// Total energy at the start and the end; `None` if it was not recorded.
    pub energy: Option<EnergySummary>,
    /// Assumptions listed in the case file: for example, values for which there is no source.
    pub assumptions: Vec<String>,
    /// Warnings from the case file and the run: reasons why the results may be unreliable.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Largest water speed divided by the speed of sound [-]; `None` if the run did not record the speed.
    #[serde(default)]
    pub largest_mach: Option<f64>,
    /// Total number of particles.
    pub particles: u64,
    /// Number of particles of each kind.
    pub particle_counts: ParticleCounts,
    /// Particle spacing [m].
    pub dp_m: f64,
    /// Artificial speed of sound [m/s].
    pub speed_of_sound_m_s: f64,
    /// Still water level [m].
    pub still_water_level_m: f64,
    /// Seaward and shoreward end of the particle domain [m].
    pub domain_x_m: [f64; 2],
    /// Width of the particle domain [m].
    pub domain_width_m: f64,
    /// True if the domain has solid side walls, false if the domain is periodic across the flume.
    pub side_walls: bool,
    /// True if the run is two-dimensional, with one layer of particles.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub two_dimensional: bool,
    /// Lower corner [x, y, z] and upper corner of each fixed obstacle [m].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles_m: Vec<[[f64; 3]; 2]>,
    /// Parts of the structure that are the same across the flume and not part of the bed profile.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sections: Vec<SectionSummary>,
    /// Parts of any shape, from STL files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodySummary>,
    /// Number of time steps.
    pub steps: u64,
    /// Simulated time since the start of the particles [s].
    pub simulated_s: f64,
    /// Flume time at the start of the particles [s].
    pub start_s: f64,
    /// Shortest, mean and longest time step.
    pub time_step_s: TimeStepSummary,
    /// Reason why the run ended.
    pub stopped: Stopped,
    /// Computing time, and the machine that made the run.
    #[serde(flatten)]
    pub execution: Execution,
}

/// Share of units damaged by movement and by breakage, from `breakage.json`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BreakageSummary {
    /// Length scale: prototype length divided by length in the run [-].
    pub scale: f64,
    /// Share of the units damaged by movement [-].
    pub damaged_ratio: f64,
    /// Share of the units that broke [-].
    pub broken_ratio: f64,
}

/// The wave of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WaveSummary {
    /// Kind of the wave, as in the case file (`solitary`, `regular`, `irregular`).
    pub kind: String,
    /// Theory of a solitary wave (`rayleigh`, `boussinesq`, `third_order`) or of regular waves (`stream_function`);
    /// spectrum of irregular waves (`jonswap`); or theory of the paddle motion for regular waves (`biesel`: first
    /// order, `madsen`: second order).
    pub theory: String,
    /// Wave height H [m]; for irregular waves the significant wave height H_s; for a solitary wave the height of the
    /// crest above still water level where the wave is generated.
    pub height_m: f64,
    /// Period of regular waves, or peak period of irregular waves [s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
}

/// Numbers and largest values of the contact events of all units.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactSummary {
    /// Number of contact events between a unit and bed or walls.
    pub with_bed: u64,
    /// Number of contact events between two units.
    pub between_units: u64,
    /// Largest contact force of all events [N].
    pub peak_force_n: f64,
    /// Largest normal component of the approach velocity at the start of an event [m/s].
    pub peak_normal_velocity_m_s: f64,
}

/// Total energy of water and units at the start and the end of the run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergySummary {
    /// Total energy at the start of the run [J].
    pub start_j: f64,
    /// Total energy at the end of the run [J].
    pub end_j: f64,
}

/// Number of particles of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct ParticleCounts {
    /// Water particles.
    pub water: u64,
    /// Boundary particles of bed, mound and walls.
    pub bed: u64,
    /// Boundary particles of the wavemaker.
    pub wavemaker: u64,
    /// Boundary particles of the units.
    pub units: u64,
}

/// A part of the structure that is the same across the flume.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SectionSummary {
    /// Name.
    pub name: String,
    /// Corners [x, z] of the section [m].
    pub points_m: Vec<[f64; 2]>,
}

/// A part of any shape, from an STL file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodySummary {
    /// Name.
    pub name: String,
    /// STL file in the run folder.
    pub file: String,
    /// Metres per length unit of the file [-].
    pub scale: f64,
    /// Position of the origin of the file in the flume [m].
    pub origin_m: [f64; 3],
    /// Corners [x, z] of the body in side view [m].
    pub side_view_m: Vec<[f64; 2]>,
}

/// Length of the time steps [s].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct TimeStepSummary {
    /// Shortest time step [s].
    pub min: f64,
    /// Mean time step [s].
    pub mean: f64,
    /// Longest time step [s].
    pub max: f64,
}

/// Reason why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stopped {
    /// The run reached the duration given in the case file.
    #[default]
    Duration,
    /// All units are at rest.
    AtRest,
    /// The run has not ended: this is a summary of the run so far.
    Running,
    /// A tilt test ended, because all units slide or the bed reached the steepest slope of the test.
    TestOver,
}

impl fmt::Display for Stopped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Duration => "duration of the case reached",
            Self::AtRest => "units at rest",
            Self::Running => "still running",
            Self::TestOver => "end of the test",
        })
    }
}

impl Summary {
    /// Name of the summary file in a run folder.
    pub const FILE: &str = "summary.json";
    /// Name of the file with a summary of the run so far; a run deletes it at its end.
    pub const PROGRESS_FILE: &str = "progress.json";

    /// Sets the results of units of one group, and computes damage ratio and mean displacement from them.
    pub fn set_units(&mut self, units: Vec<UnitSummary>, damage_distance_m: f64) {
        let numbers = [1, units.len() as u32];
        let group = GroupSummary { name: "units".to_owned(), units: numbers, damage_distance_m, ..Default::default() };
        let groups = if units.is_empty() { Vec::new() } else { vec![group] };
        self.set_groups(groups, units);
    }

    /// Sets the results of the units, and computes damage ratio and mean displacement of all units and of each group.
    pub fn set_groups(&mut self, mut groups: Vec<GroupSummary>, units: Vec<UnitSummary>) {
        for group in &mut groups {
            group.count(&units, self.domain_width_m);
        }
        let moves = |unit: u32| groups.iter().any(|group| !group.fixed && group.contains(unit));
        let all = averages(&units, moves);
        self.damage_ratio = all.map(|[ratio, _]| ratio);
        self.mean_displacement_m = all.map(|[_, mean]| mean);
        self.damage_distance_m = groups.iter().find(|group| !group.fixed).map(|group| group.damage_distance_m);
        self.groups = groups;
        self.units = units;
    }

    /// Returns the number of damaged units.
    pub fn damaged(&self) -> usize {
        self.units.iter().filter(|unit| unit.damaged).count()
    }

    /// Returns the number of units that can move.
    pub fn movable(&self) -> usize {
        let is_fixed = |unit: &&UnitSummary| self.groups.iter().any(|group| group.fixed && group.contains(unit.unit));
        self.units.len() - self.units.iter().filter(is_fixed).count()
    }

    /// Returns a copy without computing time and machine. If a case is run twice, the two copies are equal.
    pub fn without_execution(&self) -> Self {
        Self { execution: Execution::default(), ..self.clone() }
    }

    /// Writes `summary.json` into the run folder, or `progress.json` if the run has not ended.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, run_dir: &Path) -> Result<(), OutputError> {
        let is_running = self.stopped == Stopped::Running;
        let path = run_dir.join(if is_running { Self::PROGRESS_FILE } else { Self::FILE });
        let mut text = serde_json::to_string_pretty(self).map_err(OutputError::json(&path))?;
        text.push('\n');
        write_atomically(&path, text.as_bytes())?;
        let progress = run_dir.join(Self::PROGRESS_FILE);
        if !is_running && progress.exists() {
            std::fs::remove_file(&progress).map_err(OutputError::io(&progress))?;
        }
        Ok(())
    }

    /// Reads `summary.json` of a run folder.
    ///
    /// # Errors
    /// If the file is missing or is not a summary.
    pub fn read(run_dir: &Path) -> Result<Self, OutputError> {
        Self::read_file(&run_dir.join(Self::FILE))
    }

    /// Reads `progress.json` in the folder of a run in progress.
    ///
    /// # Errors
    /// If the file is missing or is not a summary.
    pub fn read_progress(run_dir: &Path) -> Result<Self, OutputError> {
        Self::read_file(&run_dir.join(Self::PROGRESS_FILE))
    }

    fn read_file(path: &Path) -> Result<Self, OutputError> {
        let bytes = std::fs::read(path).map_err(OutputError::io(path))?;
        serde_json::from_slice(&bytes).map_err(OutputError::json(path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_units() -> Summary {
        let mut summary = Summary { title: "two".to_owned(), particles: 10, ..Summary::default() };
        let first = UnitSummary::moved(1, [39.0, 0.04, 0.74], [39.03, 0.08, 0.70], 10.0, 0.077);
        let second = UnitSummary::moved(2, [39.0, 0.12, 0.74], [39.1, 0.12, 0.70], 20.0, 0.077);
        summary.set_units(vec![first, second], 0.077);
        summary
    }

    #[test]
    fn displacement_is_the_horizontal_distance() {
        let summary = two_units();
        // Unit 1 moves by 0.03 m along and 0.04 m across the flume: 0.05 m. Its fall by 0.04 m does not count.
        assert!((summary.units[0].displacement_m - 0.05).abs() < 1e-12);
        assert!((summary.units[0].direction_deg - (4.0_f64 / 3.0).atan().to_degrees()).abs() < 1e-9);
        assert_eq!((summary.units[0].damaged, summary.units[1].damaged), (false, true));
        assert_eq!(summary.damage_ratio, Some(0.5));
        assert!((summary.mean_displacement_m.unwrap() - 0.075).abs() < 1e-12);
    }

    #[test]
    fn groups_have_their_own_damage_and_fixed_units_do_not_count() {
        let mut summary = Summary::default();
        let group = |name: &str, units, damage_distance_m, fixed| GroupSummary {
            name: name.to_owned(),
            units,
            damage_distance_m,
            fixed,
            ..GroupSummary::default()
        };
        let unit = |unit, x, limit| UnitSummary::moved(unit, [0.0; 3], [x, 0.0, 0.0], 0.0, limit);
        let units = vec![unit(1, 0.0, 0.01), unit(2, 0.1, 0.05), unit(3, 0.02, 0.05), unit(4, 0.3, 0.2)];
        let groups = vec![
            group("toe", [1, 1], 0.01, true),
            group("armour", [2, 3], 0.05, false),
            group("cap", [4, 4], 0.2, false),
        ];
        summary.set_groups(groups, units);
        assert_eq!(summary.damage_ratio, Some(2.0 / 3.0));
        assert!((summary.mean_displacement_m.unwrap() - 0.14).abs() < 1e-12);
        assert_eq!((summary.damage_distance_m, summary.movable()), (Some(0.05), 3));
        let ratios: Vec<f64> = summary.groups.iter().map(|group| group.damage_ratio).collect();
        assert_eq!(ratios, [0.0, 0.5, 1.0]);
        assert!((summary.groups[1].mean_displacement_m - 0.06).abs() < 1e-12);
    }

    #[test]
    fn the_file_has_the_required_keys_and_reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let mut summary = two_units();
        summary.execution = Execution { wall_s: 12.5, steps_per_s: 3.0, threads: 4, ..Execution::default() };
        summary.breakage = Some(BreakageSummary { scale: 50.0, damaged_ratio: 0.5, broken_ratio: 0.0 });
        summary.write(folder.path()).unwrap();
        assert_eq!(Summary::read(folder.path()).unwrap(), summary);
        let text = std::fs::read_to_string(folder.path().join(Summary::FILE)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        for key in ["particles", "steps", "simulated_s", "wall_s", "damage_ratio", "mean_displacement_m"] {
            assert!(json[key].is_number(), "{key}");
        }
        assert!(json["units"][1]["displacement_m"].is_number() && json["units"][1]["damaged"].is_boolean());
        assert_eq!(json["breakage"]["scale"], 50.0);
        assert_ne!(summary, two_units());
        summary.breakage = None;
        assert_eq!(summary.without_execution(), two_units());
        summary.stopped = Stopped::Running;
        summary.write(folder.path()).unwrap();
        assert_eq!(Summary::read_progress(folder.path()).unwrap(), summary);
        summary.stopped = Stopped::AtRest;
        summary.write(folder.path()).unwrap();
        assert!(Summary::read_progress(folder.path()).is_err() && Summary::read(folder.path()).unwrap() == summary);
    }

    #[test]
    fn without_units_there_is_no_damage_ratio() {
        let mut summary = Summary::default();
        summary.set_units(Vec::new(), 0.077);
        let json = serde_json::to_value(&summary).unwrap();
        assert!(json.get("breakage").is_none());
        assert!(json["damage_ratio"].is_null() && json["mean_displacement_m"].is_null());
        assert_eq!(json["units"].as_array().map(Vec::len), Some(0));
    }
}
