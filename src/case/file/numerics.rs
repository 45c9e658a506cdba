//! The SPH scheme, as written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Constants of the SPH scheme; the defaults are those of Mitsui et al. (2023).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NumericsFile {
    /// h / (sqrt(3) dp) [-].
    pub smoothing_factor: f64,
    /// How the water resists shear.
    pub viscosity: Viscosity,
    /// Artificial viscosity alpha [-] (equation 3); of no meaning for the other viscosities.
    pub viscosity_alpha: f64,
    /// Kinematic viscosity nu [m2/s]; of no meaning for artificial viscosity.
    pub kinematic_viscosity_m2_s: f64,
    /// How differences of density that are noise are smoothed.
    pub density_diffusion: DensityDiffusion,
    /// Density diffusion delta [-] (equation 4).
    pub diffusion_delta: f64,
    /// Coefficient A of particle shifting [-]; 0: none, 1 to 6: usual.
    pub shifting_coefficient: f64,
    /// Courant number [-].
    pub cfl: f64,
    /// How walls, wavemaker and units act on the water.
    pub boundary: Boundary,
    /// Velocity that boundary particles show to the water; by default free slip under mDBC.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_slip: Option<WallSlip>,
    // This and the next are left out where they are usual: the fingerprints of older cases stay.
    /// Whether water slides along the surfaces of units too; of `wall_slip` `free_slip` only. false: they hold it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub slip_on_units: bool,
    /// Whether bed, walls and other units press on a unit through gaps that hold no water particle, as the water there
    /// would; false: water alone acts on units, as far as described that of the published runs. Of mDBC only.
    #[serde(skip_serializing_if = "Clone::clone")]
    pub gap_pressure: bool,
    /// Layers of particles in walls and bed.
    pub boundary_layers: u32,
    /// Time for which the units are held while the water comes to rest round them [s].
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

/// How the water resists shear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Viscosity {
    /// Artificial viscosity (Monaghan 1992), equation 3.
    Artificial,
    /// Viscosity of the fluid (Lo & Shao 2002): too little friction in waves.
    Laminar,
    /// The same with sub-particle-scale turbulence (Dalrymple & Rogers 2006).
    LaminarSps,
    /// Viscosity of the fluid (Monaghan & Gingold 1983): right at a free surface too.
    LaminarMonaghanGingold,
}

/// Density diffusion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityDiffusion {
    /// None.
    None,
    /// Of the whole density (Molteni & Colagrossi 2009).
    MolteniColagrossi,
    /// Of the density beyond the hydrostatic one (Fourtakas et al. 2019), equation 4.
    Fourtakas,
    /// Delta-SPH with renormalised gradients (Antuono et al. 2010).
    Antuono,
}

/// Velocity that boundary particles show to the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallSlip {
    /// That of the wall (English et al. 2022).
    Original,
    /// Such that the water sticks to the wall.
    NoSlip,
    /// Such that the water slides along the wall.
    FreeSlip,
}

/// Boundary condition of the SPH walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// Dynamic boundary condition (Crespo et al. 2007).
    Dbc,
    /// Modified dynamic boundary condition with ghost nodes (English et al. 2022).
    Mdbc,
}
