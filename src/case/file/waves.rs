//! Settings of the wave and the wavemaker, as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::wave_source::ExternalWaveFile;

/// Kind of wave, with its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaveFile {
    /// No wave, for still water or a dam break.
    None {},
    /// A solitary wave.
    Solitary(SolitaryFile),
    /// Regular waves.
    Regular(RegularFile),
    /// Irregular waves.
    Irregular(IrregularFile),
    /// A wave from another program.
    File(ExternalWaveFile),
}

impl Default for WaveFile {
    fn default() -> Self {
        Self::None {}
    }
}

/// A solitary wave. Either the flume model carries the wave from the seaward end of the flume to the domain, or a
/// piston at the seaward end of the domain generates the wave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolitaryFile {
    /// Height of the crest above the still water level where the wave is generated [m].
    pub height_m: f64,
    /// Theory of the solitary wave. It also determines how the wave is generated.
    #[serde(default)]
    pub theory: SolitaryTheory,
}

/// Regular waves, which grow from still water. Either the flume model carries waves of permanent form from the seaward
/// end of the flume to the domain, or a piston or flap at the seaward end of the domain generates the waves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegularFile {
    /// Wave height from trough to crest [m].
    pub height_m: f64,
    /// Wave period [s].
    pub period_s: f64,
    /// Length of the ramp over which the waves grow, in periods [-].
    #[serde(default = "default_ramp_periods")]
    pub ramp_periods: f64,
}

/// Irregular waves with a JONSWAP spectrum. The flume model carries the waves from the seaward end of the flume to the
/// domain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IrregularFile {
    /// Significant wave height H_s = 4 sqrt(m_0) [m], with the variance m_0 of the surface elevation [m2].
    pub significant_height_m: f64,
    /// Peak period T_p of the spectrum [s].
    pub peak_period_s: f64,
    /// Peak enhancement factor gamma of the spectrum [-]: 3.3 for the mean JONSWAP spectrum, 1 for the
    /// Pierson-Moskowitz spectrum.
    #[serde(default = "default_peak_enhancement")]
    pub peak_enhancement: f64,
    /// Seed of the random phases. The same seed gives the same waves.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// Time after which the waves repeat, in peak periods [-].
    #[serde(default = "default_repeat_periods")]
    pub repeat_periods: f64,
    /// Length of the ramp over which the waves grow, in peak periods [-].
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

/// Theory of a solitary wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SolitaryTheory {
    /// Piston motion for the surface elevation H sech^2(k (c t - x)) at time t and position x, k = sqrt(3 H / (4 d^3)),
    /// with wave height H, still water depth d and celerity c (Goring & Raichlen 1980).
    Boussinesq,
    /// As `boussinesq`, but with k = sqrt(3 H / (4 d^2 (d + H))), which is more accurate (Guizien & Barthelemy 2002).
    #[default]
    Rayleigh,
    /// Third-order wave (Grimshaw 1971), which enters the flume model through its seaward end.
    ThirdOrder,
}

/// Wavemaker at the seaward end of the particle domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WavemakerFile {
    /// Multi-layer piston, for all waves. Its rows move with the water of the flume model or of the wave files.
    MlPiston(PistonFile),
    /// Open ends, for waves of the flume model: at both ends of the domain, water flows in and out with the velocity of
    /// the flume model, and waves that the structure sends back leave the domain.
    OpenEnds(OpenEndsFile),
    /// Rigid piston, for solitary and regular waves. Its motion follows from wave theory for the depth at the piston.
    Piston(PistonFile),
    /// Flap that rotates about a hinge, for regular waves. Its motion follows from first-order wave theory.
    Flap(FlapFile),
}

impl Default for WavemakerFile {
    fn default() -> Self {
        Self::MlPiston(PistonFile { absorption_gauge_m: None })
    }
}

impl WavemakerFile {
    /// Returns true for the default wavemaker.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Options of a rigid or multi-layer piston.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PistonFile {
    /// Distance between the piston and an absorption gauge, which moves with the piston [m]. With this key, the piston
    /// absorbs reflected waves. The reflected wave is the elevation measured at this gauge minus the elevation of the
    /// generated wave. By default, there is no absorption.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub absorption_gauge_m: Option<f64>,
}

/// Options of open ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpenEndsFile {
    /// Distance of a gauge from each end [m]. The elevation at the gauge minus the elevation of the flume model is the
    /// wave that leaves the domain. Default: half the still water depth at the seaward end, at least six particle
    /// spacings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gauge_m: Option<f64>,
}

/// A flap that rotates about a hinge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlapFile {
    /// Level of the hinge [m], as a z coordinate like those of `flume.bed_m`. The hinge may be below the bed. If it is
    /// above the bed, a wall closes the gap below the hinge.
    pub hinge_z_m: f64,
}
