//! The wave and what makes it, as written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The wave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaveFile {
    /// No wave: still water, or a dam break.
    None {},
    /// A solitary wave.
    Solitary(SolitaryFile),
    /// Regular waves, made by a paddle at the seaward end of the domain.
    Regular(RegularFile),
}

impl Default for WaveFile {
    fn default() -> Self {
        Self::None {}
    }
}

/// A solitary wave: made by a piston at x = 0 of the flume and carried to the domain by the layered model, or made by a
/// piston at the seaward end of the domain. `layers`, `flume_cell_m`, `start_s` and `start_at_share` are the layered
/// model's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolitaryFile {
    /// Height above the still water in the depth at the piston [m].
    pub height_m: f64,
    /// Shape of the wave, and with it the piston's motion.
    #[serde(default)]
    pub theory: SolitaryTheory,
    /// Layers of the non-hydrostatic flume model.
    #[serde(default = "default_layers")]
    pub layers: u32,
    /// Cell of the flume model [m].
    #[serde(default = "default_flume_cell_m")]
    pub flume_cell_m: f64,
    /// Flume time at which the particles start [s]; without it, when the velocity at the wavemaker's place
    /// reaches `start_at_share` of its maximum.
    #[serde(default)]
    pub start_s: Option<f64>,
    /// Share of the largest velocity at which the particles start [-].
    #[serde(default = "default_start_share")]
    pub start_at_share: f64,
}

/// Regular waves; the paddle starts from rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegularFile {
    /// Height from trough to crest [m].
    pub height_m: f64,
    /// Period [s].
    pub period_s: f64,
    /// Periods over which the stroke of the paddle grows from nothing [-].
    #[serde(default = "default_ramp_periods")]
    pub ramp_periods: f64,
}

fn default_ramp_periods() -> f64 {
    2.0
}

pub(in crate::case) fn default_layers() -> u32 {
    2
}

pub(in crate::case) fn default_flume_cell_m() -> f64 {
    0.05
}

pub(in crate::case) fn default_start_share() -> f64 {
    0.03
}

/// Shape of a solitary wave (Goring & Raichlen 1980; Guizien & Barthelemy 2002).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SolitaryTheory {
    /// k = sqrt(3H / 4d^3).
    Boussinesq,
    /// k = sqrt(3H / 4d^2(d+H)); nearer to the exact wave.
    #[default]
    Rayleigh,
}

/// What makes the wave in the particles; it stands at the seaward end of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WavemakerFile {
    /// A piston in rows that follow the water of the layered flume model (multi-layer piston); for solitary waves.
    MlPiston {},
    /// A rigid piston that moves by wave theory in the depth where it stands; for solitary and regular waves.
    Piston {},
    /// A paddle that turns about a hinge, by first-order theory; for regular waves.
    Flap(FlapFile),
}

impl Default for WavemakerFile {
    fn default() -> Self {
        Self::MlPiston {}
    }
}

impl WavemakerFile {
    /// Whether it is what a case without this section has.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A paddle that turns about a hinge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlapFile {
    /// Level of the hinge [m], in the z of `flume.bed_m`; it may lie below the bed. Below a hinge over the bed stands a
    /// wall.
    pub hinge_z_m: f64,
}
