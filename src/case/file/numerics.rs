//! The settings of the SPH scheme as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options and constants of the SPH scheme. Defaults and equation numbers are those of Mitsui et al. (2023), except
/// where noted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NumericsFile {
    /// Smoothing factor h / (sqrt(3) dp) [-], with the smoothing length h and the particle spacing dp.
    pub smoothing_factor: f64,
    /// Viscosity model.
    pub viscosity: Viscosity,
    /// Coefficient alpha of artificial viscosity [-] (equation 3). The other viscosity models ignore this key.
    pub viscosity_alpha: f64,
    /// Coefficient beta of the quadratic part of artificial viscosity [-] (Monaghan 1992). Its stress grows with the
    /// square of the velocity differences. The other viscosity models ignore this key.
    // Left out of the serialized case at its default, so that older cases keep their hash, as are `wall_friction`,
    // `slip_on_units` and `gap_pressure`.
    #[serde(skip_serializing_if = "is_zero")]
    pub viscosity_beta: f64,
    /// Kinematic viscosity nu of the laminar models [m2/s]. Artificial viscosity ignores this key.
    pub kinematic_viscosity_m2_s: f64,
    /// Form of the density diffusion, which smooths numerical noise in the density.
    pub density_diffusion: DensityDiffusion,
    /// Coefficient delta of density diffusion [-] (equation 4).
    pub diffusion_delta: f64,
    /// Coefficient alpha_2 of the acoustic damping, which damps the sound of impacts [-]. Default: 0.5, but 0 if the
    /// slip condition of the walls is `original`, as in Mitsui et al.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acoustic_damping: Option<f64>,
    /// Largest suction in the water, divided by rho0 g h [-]. Water under more suction fills with air. Default: 1, but
    /// no limit if the slip condition of the walls is `original`, as in Mitsui et al.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suction_limit: Option<f64>,
    /// Coefficient A of particle shifting [-]: 0 for no shifting. A usual value is 2.
    pub shifting_coefficient: f64,
    /// Courant number C, which limits the time step [-].
    pub cfl: f64,
    /// Boundary condition at bed, walls, wavemaker and units.
    pub boundary: Boundary,
    /// Velocity condition at bed and walls. Default: `free_slip` if `boundary` is `mdbc`, `original` if `boundary` is
    /// `dbc`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_slip: Option<WallSlip>,
    /// Friction coefficient c_f of bed, walls and obstacles [-]: their stress on the water is rho / 2 c_f u^2. Only used
    /// if `wall_slip` is `free_slip` or `inviscid`.
    #[serde(skip_serializing_if = "is_zero")]
    pub wall_friction: f64,
    /// true: free slip at the units, too. false: boundary particles of a unit have the tangential velocity of the unit.
    /// Only used if `wall_slip` is `free_slip`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub slip_on_units: bool,
    /// true: water pressure also acts on a unit in gaps that are too narrow for water particles. false: only water
    /// particles act on units, probably as in the runs of Mitsui et al. Has an effect only with `mdbc`.
    #[serde(skip_serializing_if = "Clone::clone")]
    pub gap_pressure: bool,
    /// Number of particle layers in walls and bed.
    pub boundary_layers: u32,
    /// Time at the start of the run during which the units are fixed, so that the water around them comes to rest [s].
    pub hold_units_s: f64,
}

impl Default for NumericsFile {
    fn default() -> Self {
        Self {
            smoothing_factor: 1.2,
            viscosity: Viscosity::Artificial,
            viscosity_alpha: 0.04,
            viscosity_beta: 0.0,
            kinematic_viscosity_m2_s: 1e-6,
            density_diffusion: DensityDiffusion::Fourtakas,
            diffusion_delta: 0.1,
            acoustic_damping: None,
            suction_limit: None,
            shifting_coefficient: 0.0,
            cfl: 0.4,
            boundary: Boundary::Mdbc,
            wall_slip: None,
            wall_friction: 0.0,
            slip_on_units: false,
            gap_pressure: true,
            boundary_layers: 3,
            hold_units_s: 0.2,
        }
    }
}

/// Returns true for zero.
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Viscosity model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Viscosity {
    /// Artificial viscosity (Monaghan 1992), equation 3.
    Artificial,
    /// Laminar viscosity (Lo & Shao 2002). With this model, waves on a free surface lose too little energy.
    Laminar,
    /// Laminar viscosity with sub-particle-scale turbulence (Dalrymple & Rogers 2006).
    LaminarSps,
    /// Laminar viscosity (Monaghan & Gingold 1983). Its dissipation is also correct near a free surface.
    LaminarMonaghanGingold,
}

/// Form of the density diffusion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityDiffusion {
    /// No density diffusion.
    None,
    /// Diffusion of the total density (Molteni & Colagrossi 2009).
    MolteniColagrossi,
    /// Diffusion of the density minus its hydrostatic part (Fourtakas et al. 2019), equation 4.
    Fourtakas,
    /// Diffusion of the density minus the part that follows from its mean gradient (delta-SPH, Antuono et al. 2010).
    Antuono,
}

/// Velocity condition at bed and walls: the velocity of boundary particles in the equations of the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallSlip {
    /// Boundary particles have the velocity of the wall (English et al. 2022).
    Original,
    /// No slip: the water at the wall has the velocity of the wall.
    NoSlip,
    /// Free slip: the water slides along the wall without friction.
    FreeSlip,
    /// Boundary particles have the velocity of the wall, and no viscosity acts between water and walls or units: the
    /// water slides along both without friction.
    Inviscid,
}

/// Boundary condition at bed, walls, wavemaker and units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// Dynamic boundary condition, DBC (Crespo et al. 2007).
    Dbc,
    /// Modified dynamic boundary condition with ghost nodes, mDBC (English et al. 2022).
    Mdbc,
}
