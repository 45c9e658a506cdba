//! The wave and what makes it, as written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::wave_source::GivenWaveFile;

/// The wave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaveFile {
    /// No wave: still water, or a dam break.
    None {},
    /// A solitary wave.
    Solitary(SolitaryFile),
    /// Regular waves.
    Regular(RegularFile),
    /// A sea of many periods.
    Irregular(IrregularFile),
    /// A wave from another program.
    File(GivenWaveFile),
}

impl Default for WaveFile {
    fn default() -> Self {
        Self::None {}
    }
}

/// A solitary wave: made at the seaward end of the flume and carried to the domain by the flume model, or made by a
/// piston at the seaward end of the domain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolitaryFile {
    /// Height above the still water in the depth at the piston [m].
    pub height_m: f64,
    /// Shape of the wave, and with it what makes it.
    #[serde(default)]
    pub theory: SolitaryTheory,
}

/// Regular waves: waves of permanent form that flow into the flume and are carried to the domain by the flume model, or
/// made by a piston or a flap at the seaward end of the domain. They grow from still water.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegularFile {
    /// Height from trough to crest [m].
    pub height_m: f64,
    /// Period [s].
    pub period_s: f64,
    /// Periods over which the waves grow from nothing [-].
    #[serde(default = "default_ramp_periods")]
    pub ramp_periods: f64,
}

/// A sea with a JONSWAP spectrum that flows into the flume and is carried to the domain by the flume model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IrregularFile {
    /// Significant height H_s = 4 sqrt(m_0) [m].
    pub significant_height_m: f64,
    /// Period of the spectrum's peak [s].
    pub peak_period_s: f64,
    /// Peak enhancement gamma [-]: 3.3 on average, 1 for Pierson & Moskowitz's spectrum.
    #[serde(default = "default_peak_enhancement")]
    pub peak_enhancement: f64,
    /// Number from which the phases are drawn: the same number gives the same sea.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// Time after which the sea repeats itself, in peak periods [-].
    #[serde(default = "default_repeat_periods")]
    pub repeat_periods: f64,
    /// Peak periods over which the waves grow from nothing [-].
    #[serde(default = "default_ramp_periods")]
    pub ramp_periods: f64,
}

fn default_ramp_periods() -> f64 {
    2.0
}

fn default_peak_enhancement() -> f64 {
    3.3
}

fn default_seed() -> u64 {
    1
}

fn default_repeat_periods() -> f64 {
    200.0
}

/// Shape of a solitary wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SolitaryTheory {
    /// Made by a piston that follows k = sqrt(3H / 4d^3) (Goring & Raichlen 1980).
    Boussinesq,
    /// Made by a piston that follows k = sqrt(3H / 4d^2(d+H)), nearer to the exact wave (Guizien & Barthelemy 2002).
    #[default]
    Rayleigh,
    /// Of third order (Grimshaw 1971), flowing into the flume at its seaward end.
    ThirdOrder,
}

/// What makes the wave in the particles; it stands at the seaward end of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WavemakerFile {
    /// A piston in rows that follow the water of the layered flume model (multi-layer piston); for all waves.
    MlPiston(PistonFile),
    /// A rigid piston that moves by wave theory in the depth where it stands; for solitary and regular waves.
    Piston(PistonFile),
    /// A paddle that turns about a hinge, by first-order theory; for regular waves.
    Flap(FlapFile),
}

impl Default for WavemakerFile {
    fn default() -> Self {
        Self::MlPiston(PistonFile { absorption_gauge_m: None })
    }
}

impl WavemakerFile {
    /// Whether it is what a case without this section has.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// What a piston, rigid or in rows, does with the waves that come back to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PistonFile {
    /// Distance of a gauge that moves with the piston [m]; what it shows beyond the wave that is made comes back, and
    /// the piston takes it up. Without it the piston sends it out again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub absorption_gauge_m: Option<f64>,
}

/// A paddle that turns about a hinge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlapFile {
    /// Level of the hinge [m], in the z of `flume.bed_m`; it may lie below the bed. Below a hinge over the bed stands a
    /// wall.
    pub hinge_z_m: f64,
}
