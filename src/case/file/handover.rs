//! The hand-over of impacts to the fracture of units, as written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Joints, StrengthFile};

/// What is done with the hardest impacts of a run: they are computed again with units that deform and crack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HandoverFile {
    /// Lengths of the prototype over those of the case [-]; 1 takes the units as they are. Velocities and times scale
    /// with its root, masses with its cube (Froude).
    #[serde(default = "one")]
    pub scale: f64,
    /// MSH 4.1 mesh of one unit in its body axes, of any size, seen from the folder of the case file.
    pub mesh: String,
    /// Concrete of the prototype's units. Their density follows from the mass in `units`.
    pub material: HandoverMaterialFile,
    /// What they fall on: bed and mound as an elastic block; without it, of the units' concrete.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<BaseFile>,
    /// Coulomb's coefficient of units on bed and neighbours, and of crack faces [-].
    #[serde(default = "default_friction")]
    pub friction: f64,
    /// How an impact is computed again.
    #[serde(default)]
    pub way: HandoverWay,
    /// Which impacts are.
    #[serde(default)]
    pub select: SelectFile,
    /// How tetrahedra hold together before they crack.
    #[serde(default)]
    pub joints: Joints,
    /// Time after the blow, in the prototype [s]; without it, 1.5 times as long as the blow lasts by Hertz, and at least
    /// 10 heights of the unit over the speed of sound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Impacts computed at the same time; without it, as many as there are threads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cores: Option<usize>,
}

/// Concrete of the prototype.
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
    /// Its strength.
    pub strength: StrengthFile,
}

/// What bed and mound of the prototype are made of.
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

/// How an impact is computed again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HandoverWay {
    /// Both bodies collide again, from their poses and velocities just before.
    #[default]
    ReEnact,
    /// The recorded forces of all contacts drive the unit alone.
    LoadHistory,
    /// Both, one after the other.
    Both,
}

/// Which impacts are handed over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SelectFile {
    /// What makes an impact hard.
    #[serde(default)]
    pub by: Hardness,
    /// So many at most, the hardest first; without it, all that were kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<usize>,
    /// Only those with at least this much, in the case, not the prototype: a force [N], a velocity [m/s] or an energy [J].
    #[serde(default)]
    pub at_least: f64,
}

impl Default for SelectFile {
    fn default() -> Self {
        Self { by: Hardness::default(), worst: Some(3), at_least: 0.0 }
    }
}

/// What makes an impact hard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Hardness {
    /// The largest force.
    #[default]
    PeakForce,
    /// The velocity at which the surfaces meet.
    ApproachVelocity,
    /// The kinetic energy of the approach.
    KineticEnergy,
}

fn one() -> f64 {
    1.0
}

fn default_friction() -> f64 {
    0.6
}
