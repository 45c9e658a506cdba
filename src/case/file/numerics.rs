//! The settings of the SPH scheme as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options and constants of the SPH scheme. Equation numbers are those of Mitsui et al. (2023), and so are defaults that
/// do not depend on the scheme, except where noted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NumericsFile {
    /// Set of defaults for the keys that say so.
    pub scheme: Scheme,
    /// Smoothing factor h / (sqrt(3) dp) [-], with the smoothing length h and the particle spacing dp.
    pub smoothing_factor: f64,
    /// Viscosity model.
    pub viscosity: Viscosity,
    /// Coefficient alpha of artificial viscosity [-] (equation 3). Default: 0.005; scheme `mitsui_2023`: 0.04. The other
    /// viscosity models ignore this key.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_alpha: Option<f64>,
    /// Coefficient beta of the quadratic part of artificial viscosity [-] (Monaghan 1992). Its stress grows with the
    /// square of the velocity differences. Default: 0.3; scheme `mitsui_2023`: 0. The other viscosity models ignore
    /// this key.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_beta: Option<f64>,
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
    /// Largest suction in the water and at walls, divided by rho0 g h [-]. Water under more suction fills with air.
    /// Default: 1. If the slip condition of the walls is `original`, there is no default: no limit in the water, and no
    /// suction at walls, as in Mitsui et al.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suction_limit: Option<f64>,
    /// Coefficient A of particle shifting [-]: 0 for no shifting. Default: 2; scheme `mitsui_2023`: 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shifting_coefficient: Option<f64>,
    /// Courant number C, which limits the time step [-].
    pub cfl: f64,
    /// Boundary condition at bed, walls, wavemaker and units.
    pub boundary: Boundary,
    /// Velocity condition at bed and walls. Default: `inviscid`; scheme `mitsui_2023`, or `boundary` = `dbc`: `original`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_slip: Option<WallSlip>,
    /// Friction coefficient c_f of bed, walls and obstacles [-]: their stress on the water is rho / 2 c_f u^2. Only used
    /// if `wall_slip` is `free_slip` or `inviscid`. Default: 0.003, as for smooth walls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall_friction: Option<f64>,
    /// true: free slip at the units, too. false: boundary particles of a unit have the tangential velocity of the unit.
    /// Only used if `wall_slip` is `free_slip`.
    pub slip_on_units: bool,
    /// true: water pressure also acts on a unit in gaps that are too narrow for water particles. false: only water
    /// particles act on units, probably as in the runs of Mitsui et al. Has an effect only with `mdbc`.
    pub gap_pressure: bool,
    /// Number of particle layers in walls and bed.
    pub boundary_layers: u32,
    /// Time at the start of the run during which the units are fixed, so that the water around them comes to rest [s].
    pub hold_units_s: f64,
}

impl Default for NumericsFile {
    fn default() -> Self {
        Self {
            scheme: Scheme::LowDissipation,
            smoothing_factor: 1.2,
            viscosity: Viscosity::Artificial,
            viscosity_alpha: None,
            viscosity_beta: None,
            kinematic_viscosity_m2_s: 1e-6,
            density_diffusion: DensityDiffusion::Fourtakas,
            diffusion_delta: 0.1,
            acoustic_damping: None,
            suction_limit: None,
            shifting_coefficient: None,
            cfl: 0.4,
            boundary: Boundary::Mdbc,
            wall_slip: None,
            wall_friction: None,
            slip_on_units: false,
            gap_pressure: true,
            boundary_layers: 3,
            hold_units_s: 0.2,
        }
    }
}

/// Set of defaults of the SPH scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// Little viscosity, mainly quadratic, and none at walls and units, so that forces on units grow with the square of
    /// the velocity.
    LowDissipation,
    /// The scheme of Mitsui et al. (2023): linear artificial viscosity, also at walls and units.
    #[serde(rename = "mitsui_2023")]
    Mitsui2023,
}

/// Defaults that depend on the scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SchemeDefaults {
    /// Coefficient alpha of artificial viscosity [-].
    pub viscosity_alpha: f64,
    /// Coefficient beta of the quadratic part of artificial viscosity [-].
    pub viscosity_beta: f64,
    /// Coefficient A of particle shifting [-].
    pub shifting_coefficient: f64,
    /// Velocity condition at bed and walls with the boundary condition `mdbc`.
    pub wall_slip: WallSlip,
}

impl Scheme {
    /// Returns the defaults of the scheme. With `low_dissipation`, water slides along walls, because its viscosity would
    /// make boundary layers much thicker than in real water. With such layers, long waves lose height and speed.
    pub fn defaults(self) -> SchemeDefaults {
        let (viscosity_alpha, viscosity_beta, shifting_coefficient, wall_slip) = match self {
            Self::LowDissipation => (0.005, 0.3, 2.0, WallSlip::Inviscid),
            Self::Mitsui2023 => (0.04, 0.0, 0.0, WallSlip::Original),
        };
        SchemeDefaults { viscosity_alpha, viscosity_beta, shifting_coefficient, wall_slip }
    }
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
