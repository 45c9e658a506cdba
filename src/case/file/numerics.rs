//! The SPH scheme as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options and constants of the SPH scheme. Defaults and equation numbers follow Mitsui et al. (2023), unless noted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NumericsFile {
    /// Smoothing factor h / (sqrt(3) dp) [-], with smoothing length h.
    pub smoothing_factor: f64,
    /// Viscosity model.
    pub viscosity: Viscosity,
    /// Coefficient alpha of artificial viscosity [-] (equation 3); the other models ignore it.
    pub viscosity_alpha: f64,
    /// Kinematic viscosity nu [m2/s]; artificial viscosity ignores it.
    pub kinematic_viscosity_m2_s: f64,
    /// Density diffusion, which smooths noise in the density.
    pub density_diffusion: DensityDiffusion,
    /// Coefficient delta of density diffusion [-] (equation 4).
    pub diffusion_delta: f64,
    /// Coefficient A of particle shifting [-]; 0 for none, usually 1 to 6.
    pub shifting_coefficient: f64,
    /// Courant number [-].
    pub cfl: f64,
    /// Boundary condition of walls, wavemaker and units.
    pub boundary: Boundary,
    /// Velocity condition at walls. Default: `free_slip` with `mdbc`, `original` (as in the published runs) with `dbc`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_slip: Option<WallSlip>,
    // This key and the next are not written at their defaults, so that the hash of older cases does not change.
    /// Whether `free_slip` holds for units, too; false: no slip on units. Only with `wall_slip` `free_slip`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub slip_on_units: bool,
    /// Whether the water pressure acts on a unit through gaps that are too narrow for water particles. false: only
    /// water particles act on units, as in the published runs (as far as described). Only with `mdbc`.
    #[serde(skip_serializing_if = "Clone::clone")]
    pub gap_pressure: bool,
    /// Number of particle layers in walls and bed.
    pub boundary_layers: u32,
    /// Time at the start for which the units are held while the water around them settles [s].
    pub hold_units_s: f64,
}

impl Default for NumericsFile {
    fn default() -> Self {
        Self {
            smoothing_factor: 1.2,
            viscosity: Viscosity::Artificial,
            viscosity_alpha: 0.04,
            kinematic_viscosity_m2_s: 1e-6,
            density_diffusion: DensityDiffusion::Fourtakas,
            diffusion_delta: 0.1,
            shifting_coefficient: 0.0,
            cfl: 0.2,
            boundary: Boundary::Mdbc,
            wall_slip: None,
            slip_on_units: false,
            gap_pressure: true,
            boundary_layers: 3,
            hold_units_s: 0.2,
        }
    }
}

/// Viscosity model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Viscosity {
    /// Artificial viscosity (Monaghan 1992), equation 3.
    Artificial,
    /// Laminar viscosity (Lo & Shao 2002); gives too little friction in waves.
    Laminar,
    /// Laminar viscosity with sub-particle-scale turbulence (Dalrymple & Rogers 2006).
    LaminarSps,
    /// Laminar viscosity (Monaghan & Gingold 1983); also correct at the free surface.
    LaminarMonaghanGingold,
}

/// Density diffusion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityDiffusion {
    /// No density diffusion.
    None,
    /// Diffusion of the total density (Molteni & Colagrossi 2009).
    MolteniColagrossi,
    /// Diffusion of the density minus its hydrostatic part (Fourtakas et al. 2019), equation 4.
    Fourtakas,
    /// Delta-SPH with renormalised gradients (Antuono et al. 2010).
    Antuono,
}

/// Velocity condition at walls: the velocity that boundary particles take in the equations of the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallSlip {
    /// Velocity of the wall (English et al. 2022).
    Original,
    /// No slip: the water sticks to the wall.
    NoSlip,
    /// Free slip: the water slides along the wall.
    FreeSlip,
}

/// Boundary condition of walls, wavemaker and units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// Dynamic boundary condition, DBC (Crespo et al. 2007).
    Dbc,
    /// Modified dynamic boundary condition with ghost nodes, mDBC (English et al. 2022).
    Mdbc,
}
