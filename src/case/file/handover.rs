//! The breakage analysis as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Joints, StrengthFile};

/// Breakage analysis: the hardest impacts of a run are re-run at prototype scale with units that deform and crack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HandoverFile {
    /// Length scale, prototype over case [-]; 1 keeps the size of the units. Velocities and times scale with its square
    /// root, masses with its cube (Froude).
    #[serde(default = "one")]
    pub scale: f64,
    /// Path of a mesh (MSH 4.1) of one unit, relative to the folder of the case file. The mesh is in the unit's body
    /// axes and may have any size.
    pub mesh: String,
    /// Concrete of the prototype units. Their density follows from the mass in `units`.
    pub material: HandoverMaterialFile,
    /// Material of bed and mound, modelled as an elastic block; by default the concrete of the units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<BaseFile>,
    /// Coulomb friction coefficient of units on the bed, on other units and of crack faces [-].
    #[serde(default = "default_friction")]
    pub friction: f64,
    /// How an impact is re-run.
    #[serde(default)]
    pub way: HandoverWay,
    /// Which impacts are re-run.
    #[serde(default)]
    pub select: SelectFile,
    /// Joints between the tetrahedra before they crack.
    #[serde(default)]
    pub joints: Joints,
    /// Simulated time from the start of the impact, at prototype scale [s]. Default: 1.5 times the duration of the
    /// impact after Hertz, and at least 10 times the unit's height over the speed of sound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Number of impacts that are computed at the same time; by default the number of threads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cores: Option<usize>,
}

/// Concrete of the prototype units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HandoverMaterialFile {
    /// Young's modulus [Pa].
    pub young_modulus_pa: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Viscosity of the material [Pa s].
    #[serde(default)]
    pub viscosity_pa_s: f64,
    /// Strength of the concrete.
    pub strength: StrengthFile,
}

/// Material of bed and mound of the prototype.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BaseFile {
    /// Density [kg/m3].
    pub density_kg_m3: f64,
    /// Young's modulus [Pa].
    pub young_modulus_pa: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
}

/// How an impact is re-run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HandoverWay {
    /// Both bodies collide again, with the poses and velocities just before the impact.
    #[default]
    ReEnact,
    /// The recorded contact forces load the unit on its own.
    LoadHistory,
    /// Both methods, one after the other.
    Both,
}

/// Which impacts are re-run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SelectFile {
    /// Measure of hardness.
    #[serde(default)]
    pub by: Hardness,
    /// Largest number of impacts, the hardest first. Without it, all recorded impacts are re-run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<usize>,
    /// Smallest hardness, at the scale of the case: a force [N], a velocity [m/s] or an energy [J], as `by` says.
    #[serde(default)]
    pub at_least: f64,
}

impl Default for SelectFile {
    fn default() -> Self {
        Self { by: Hardness::default(), worst: Some(3), at_least: 0.0 }
    }
}

/// Measure of the hardness of an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Hardness {
    /// Largest contact force.
    #[default]
    PeakForce,
    /// Velocity at which the surfaces approach each other.
    ApproachVelocity,
    /// Kinetic energy of the approach.
    KineticEnergy,
}

fn one() -> f64 {
    1.0
}

fn default_friction() -> f64 {
    0.6
}
