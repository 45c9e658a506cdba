//! The summary of a run: what happened to the units, and how the run went.

use std::{fmt, path::Path};

use serde::{Deserialize, Serialize};

use super::{Execution, OutputError, write_atomically};

/// `summary.json`: damage and displacements first, then what they rest on.
///
/// Two runs of one case agree in everything but the keys of [`Execution`].
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// Title of the case.
    pub title: String,
    /// Version of breakwater that made the run.
    pub breakwater_version: String,
    /// Hash of the case file as it was run, hexadecimal.
    pub case_hash: String,
    /// Share of the units that moved further than `damage_distance_m` [-]; none without units.
    pub damage_ratio: Option<f64>,
    /// Mean of the units' displacements [m]; none without units.
    pub mean_displacement_m: Option<f64>,
    /// A unit is damaged when it has moved further than this [m]; none without units.
    pub damage_distance_m: Option<f64>,
    /// Which share of the units broke; none if no impacts were handed over.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub breakage: Option<BreakageSummary>,
    /// The units from the first to the last across the flume.
    pub units: Vec<UnitSummary>,
    /// The wave; none for still water or a dam break.
    pub wave: Option<WaveSummary>,
    /// Highest water at the elevation gauges.
    pub gauges: Vec<GaugeSummary>,
    /// Contact events of the whole run.
    pub contacts: ContactSummary,
    /// Energy balance.
    pub energy: Option<EnergySummary>,
    /// What had to be assumed because no source gives it.
    pub assumptions: Vec<String>,
    /// What makes the result doubtful: warnings of the case file and of the run.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Largest speed of the water over its speed of sound [-]; none in runs that did not record it.
    #[serde(default)]
    pub largest_mach: Option<f64>,
    /// Number of particles of all kinds.
    pub particles: u64,
    /// Number of particles of each kind.
    pub particle_counts: ParticleCounts,
    /// Distance between particles [m].
    pub dp_m: f64,
    /// Artificial speed of sound [m/s].
    pub speed_of_sound_m_s: f64,
    /// Level of the still water [m].
    pub still_water_level_m: f64,
    /// Seaward and shoreward end of the domain of particles [m].
    pub domain_x_m: [f64; 2],
    /// Width of the domain [m].
    pub domain_width_m: f64,
    /// Whether the domain is closed by solid side walls; else what leaves on one side enters on the other.
    pub side_walls: bool,
    /// Whether the domain is a layer of particles, computed in two dimensions.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub two_dimensional: bool,
    /// Lower and upper corner of each fixed obstacle [m].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles_m: Vec<[[f64; 3]; 2]>,
    /// Number of time steps.
    pub steps: u64,
    /// Simulated time, from the start of the particles [s].
    pub simulated_s: f64,
    /// Flume time at which the particles started [s].
    pub start_s: f64,
    /// Length of the time steps.
    pub time_step_s: TimeStepSummary,
    /// Why the run ended.
    pub stopped: Stopped,
    /// Time and machine.
    #[serde(flatten)]
    pub execution: Execution,
}

/// What happened to one unit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct UnitSummary {
    /// Number of the unit, from 1 at y = 0.
    pub unit: u32,
    /// Horizontal distance between first and last position of the centre of mass, seen from above [m].
    pub displacement_m: f64,
    /// Whether it moved further than the damage distance.
    pub damaged: bool,
    /// Direction of the displacement seen from above [deg]: 0 shoreward, positive towards larger y; 0 if it did not
    /// move.
    pub direction_deg: f64,
    /// Centre of mass at the start [m].
    pub start_m: [f64; 3],
    /// Centre of mass at the end [m].
    pub end_m: [f64; 3],
    /// Angle of the single rotation from first to last orientation [deg], 0 to 180.
    pub rotation_deg: f64,
    /// Largest force of the water beyond the mean force of the still water, as a mean over an interval of the series
    /// [N].
    pub peak_fluid_force_n: f64,
    /// Largest force of bed and neighbours together, as such a mean [N].
    pub peak_contact_force_n: f64,
    /// Number of contact events with the bed.
    pub bed_contacts: u64,
    /// Number of contact events with other units.
    pub unit_contacts: u64,
}

impl UnitSummary {
    /// Displacement, direction and damage from first and last position [m]; forces and contacts are left at zero.
    pub fn moved(unit: u32, start_m: [f64; 3], end_m: [f64; 3], rotation_deg: f64, damage_distance_m: f64) -> Self {
        let (dx, dy) = (end_m[0] - start_m[0], end_m[1] - start_m[1]);
        let displacement_m = dx.hypot(dy);
        Self {
            unit,
            displacement_m,
            damaged: displacement_m > damage_distance_m,
            direction_deg: if displacement_m > 0.0 { dy.atan2(dx).to_degrees() } else { 0.0 },
            start_m,
            end_m,
            rotation_deg,
            ..Self::default()
        }
    }
}

/// Damage by movement and by breakage, from `breakage.json`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BreakageSummary {
    /// Lengths of the prototype over those of the run [-].
    pub scale: f64,
    /// Share of the units that moved further than the damage distance [-].
    pub damaged_ratio: f64,
    /// Share of the units that broke [-].
    pub broken_ratio: f64,
}

/// The wave of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WaveSummary {
    /// Kind as in the case file (`solitary`, `regular`).
    pub kind: String,
    /// Theory that shapes it (`rayleigh`, `boussinesq`) or the motion of the paddle (`biesel`: first order; `madsen`:
    /// second order).
    pub theory: String,
    /// Height [m]: of a solitary wave above the still water in the depth at the piston.
    pub height_m: f64,
    /// Period of regular waves [s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
}

/// Highest water at an elevation gauge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GaugeSummary {
    /// Name of the gauge.
    pub name: String,
    /// Place along the flume [m].
    pub x_m: f64,
    /// Highest elevation above the still water of the particles [m]; none outside their domain.
    pub crest_sph_m: Option<f64>,
    /// Highest elevation above the still water of the flume model [m]; none without it.
    pub crest_flume_m: Option<f64>,
}

/// Contact events of all units.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactSummary {
    /// Number of events of a unit with the bed.
    pub with_bed: u64,
    /// Number of events of a unit with another.
    pub between_units: u64,
    /// Largest force of one event [N].
    pub peak_force_n: f64,
    /// Largest approach velocity at the begin of an event [m/s].
    pub peak_normal_velocity_m_s: f64,
}

/// Energy of water and units.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergySummary {
    /// At the first moment [J].
    pub start_j: f64,
    /// At the last moment [J].
    pub end_j: f64,
}

/// Number of particles of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct ParticleCounts {
    /// Water.
    pub water: u64,
    /// Bed, mound and walls.
    pub bed: u64,
    /// Wavemaker.
    pub wavemaker: u64,
    /// Units.
    pub units: u64,
}

/// Length of the time steps [s].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct TimeStepSummary {
    /// Shortest [s].
    pub min: f64,
    /// Mean [s].
    pub mean: f64,
    /// Longest [s].
    pub max: f64,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stopped {
    /// The simulated time of the case file is over.
    #[default]
    Duration,
    /// The units had come to rest.
    AtRest,
    /// A tilt test: all units slide, or the slope is the steepest of the test.
    TestOver,
}

impl fmt::Display for Stopped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Duration => "time of the case over",
            Self::AtRest => "units at rest",
            Self::TestOver => "test over",
        })
    }
}

impl Summary {
    /// Name of the file in a run folder.
    pub const FILE: &str = "summary.json";

    /// Takes in the units and derives damage ratio and mean displacement from them.
    pub fn set_units(&mut self, units: Vec<UnitSummary>, damage_distance_m: f64) {
        let count = units.len() as f64;
        self.damage_distance_m = (!units.is_empty()).then_some(damage_distance_m);
        self.damage_ratio =
            (!units.is_empty()).then(|| units.iter().filter(|unit| unit.damaged).count() as f64 / count);
        self.mean_displacement_m =
            (!units.is_empty()).then(|| units.iter().map(|unit| unit.displacement_m).sum::<f64>() / count);
        self.units = units;
    }

    /// Number of damaged units.
    pub fn damaged(&self) -> usize {
        self.units.iter().filter(|unit| unit.damaged).count()
    }

    /// The same without time and machine: what two runs of one case must agree in.
    pub fn without_execution(&self) -> Self {
        Self { execution: Execution::default(), ..self.clone() }
    }

    /// Writes `summary.json` into the run folder.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, run_dir: &Path) -> Result<(), OutputError> {
        let path = run_dir.join(Self::FILE);
        let mut text = serde_json::to_string_pretty(self).map_err(OutputError::json(&path))?;
        text.push('\n');
        write_atomically(&path, text.as_bytes())
    }

    /// Reads `summary.json` of a run folder.
    ///
    /// # Errors
    /// If there is none or it is not a summary.
    pub fn read(run_dir: &Path) -> Result<Self, OutputError> {
        let path = run_dir.join(Self::FILE);
        let bytes = std::fs::read(&path).map_err(OutputError::io(&path))?;
        serde_json::from_slice(&bytes).map_err(OutputError::json(&path))
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
    fn displacement_is_seen_from_above() {
        let summary = two_units();
        // 3-4-5 triangle: 0.03 m along and 0.04 m across; the fall of 0.04 m does not count.
        assert!((summary.units[0].displacement_m - 0.05).abs() < 1e-12);
        assert!((summary.units[0].direction_deg - (4.0_f64 / 3.0).atan().to_degrees()).abs() < 1e-9);
        assert_eq!((summary.units[0].damaged, summary.units[1].damaged), (false, true));
        assert_eq!(summary.damage_ratio, Some(0.5));
        assert!((summary.mean_displacement_m.unwrap() - 0.075).abs() < 1e-12);
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
