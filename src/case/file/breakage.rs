//! Settings of the breakage analysis, as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Joints, StrengthFile};

/// Breakage analysis: the hardest impacts of a run are re-run at prototype scale with units that deform and crack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BreakageFile {
    /// Length scale: prototype length / length in the case [-]. Velocities and times grow with the square root of
    /// this scale, masses with its cube (Froude scaling). 1 keeps the size of the units.
    #[serde(default = "one")]
    pub scale: f64,
    /// Path of a mesh file (Gmsh format MSH 4.1) of one unit, relative to the folder of the case file. The mesh must be
    /// in the body axes of the unit and may have any size.
    pub mesh: String,
    /// Name of the group of units. Required if the case has several groups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Concrete of the prototype units. Its density follows from `units.mass_kg` and the volume of a unit.
    pub material: BreakageMaterialFile,
    /// Material of bed and mound, which are modelled as an elastic block. Default: the concrete of the units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<BaseFile>,
    /// Coulomb friction coefficient between unit and bed, between two units, and between crack faces [-].
    #[serde(default = "default_friction")]
    pub friction: f64,
    /// Method by which impacts are re-run.
    #[serde(default)]
    pub way: RerunMethod,
    /// Selection of the impacts that are re-run.
    #[serde(default)]
    pub select: ImpactSelectionFile,
    /// Kind of the joints between tetrahedra before the concrete cracks.
    #[serde(default)]
    pub joints: Joints,
    /// Simulated time after first contact, at prototype scale [s]. Default: 1.5 times the duration of the impact by
    /// Hertz's law, but at least 10 times the travel time of an elastic wave along the height of the unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Number of impacts that are computed at the same time. Default: the number of threads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cores: Option<usize>,
}

/// Concrete of the prototype units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BreakageMaterialFile {
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

/// Method by which an impact is re-run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RerunMethod {
    /// The two bodies collide again, from their poses and velocities just before the impact.
    #[default]
    ReEnact,
    /// Only the unit is computed, loaded by the recorded contact forces.
    LoadHistory,
    /// Both methods, one after the other.
    Both,
}

/// Selection of the impacts that are re-run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImpactSelectionFile {
    /// Quantity by which the impacts are ranked.
    #[serde(default)]
    pub by: ImpactMeasure,
    /// Largest number of impacts that are re-run, the hardest first. Default: all recorded impacts; 3 if the case has
    /// no entry `select`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<usize>,
    /// Smallest value of the quantity `by` for which an impact is re-run, at the scale of the case: force [N], velocity
    /// [m/s] or energy [J].
    #[serde(default)]
    pub at_least: f64,
}

impl Default for ImpactSelectionFile {
    fn default() -> Self {
        Self { by: ImpactMeasure::default(), worst: Some(3), at_least: 0.0 }
    }
}

/// Quantity by which impacts are ranked, the hardest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ImpactMeasure {
    /// Largest contact force.
    #[default]
    PeakForce,
    /// Normal velocity at which the surfaces approach each other.
    ApproachVelocity,
    /// Kinetic energy of the approach: half the effective mass times the square of the approach velocity.
    KineticEnergy,
}

fn one() -> f64 {
    1.0
}

fn default_friction() -> f64 {
    0.6
}
