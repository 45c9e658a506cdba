//! The sections `output` and `stop` of flume cases and dry tests as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Output files and their intervals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputFile {
    /// Interval between snapshots of the water particles [s]; 0 for no snapshots.
    pub fluid_interval_s: f64,
    /// Interval between outputs of the unit surfaces [s]; 0 for no output.
    pub units_interval_s: f64,
    /// Interval between snapshots of the surface of the water, as triangles, for the film in the report and for ParaView
    /// [s]; 0 for none. Two-dimensional runs have none.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(skip_serializing_if = "is_default_surface_interval")]
    pub surface_interval_s: f64,
    /// Interval between rows of the tables with gauges, unit motion, unit forces and energy [s].
    pub series_interval_s: f64,
    /// Simulated time between checkpoints [s]; 0 for only one checkpoint, at the end of the run.
    pub checkpoint_interval_s: f64,
    /// Fields of the water particles in the snapshots, each listed at most once. The position is always written. The
    /// report draws the water only if the list contains `velocity`.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(skip_serializing_if = "is_every_field")]
    pub fluid_fields: Vec<FluidField>,
    /// Lower and upper corner [[x, y, z], [x, y, z]] of a box [m]. The snapshots contain only the water particles in
    /// this box. By default, they contain all water particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluid_box_m: Option<[[f64; 3]; 2]>,
}

impl Default for OutputFile {
    fn default() -> Self {
        Self {
            fluid_interval_s: 0.1,
            units_interval_s: 0.02,
            surface_interval_s: SURFACE_INTERVAL_S,
            series_interval_s: 0.01,
            checkpoint_interval_s: 0.5,
            fluid_fields: FluidField::ALL.to_vec(),
            fluid_box_m: None,
        }
    }
}

/// Default of `surface_interval_s` [s].
const SURFACE_INTERVAL_S: f64 = 0.1;

// serde calls this function with a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_default_surface_interval(interval: &f64) -> bool {
    *interval == SURFACE_INTERVAL_S
}

fn is_every_field(fields: &[FluidField]) -> bool {
    fields == FluidField::ALL
}

/// Field of the water particles in a snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidField {
    /// Velocity [m/s], three components.
    Velocity,
    /// Pressure [Pa].
    Pressure,
    /// Density [kg/m3].
    Density,
    /// Identification number of the particle, constant during the run.
    Id,
}

impl FluidField {
    /// All fields, in their default order.
    pub const ALL: [Self; 4] = [Self::Velocity, Self::Pressure, Self::Density, Self::Id];

    /// Returns the name of the field in case files and in ParaView.
    pub fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Pressure => "pressure",
            Self::Density => "density",
            Self::Id => "id",
        }
    }
}

/// Criteria that end the run. Times count from the start of the particle simulation or of the dry test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopFile {
    /// Simulated time after which the run ends at the latest [s].
    pub duration_s: f64,
    /// Rest criterion: ends the run before `duration_s` if all units are at rest.
    #[serde(default)]
    pub at_rest: Option<AtRestFile>,
}

/// Rest criterion: the run ends when all units have been at rest for `for_s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtRestFile {
    /// A unit is at rest if its centre and its tips are slower than this speed [m/s]. In a flume case, centre and tips
    /// must also stay near their positions at the start of the time at rest: within `speed_m_s` times `for_s`.
    pub speed_m_s: f64,
    /// Time for which all units must be at rest [s].
    pub for_s: f64,
    /// Earliest time at which the rest criterion can end the run [s]. If the flume model carries a solitary wave, its
    /// crest must also have passed all units.
    pub not_before_s: f64,
}
