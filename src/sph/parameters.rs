//! Constants of the numerical scheme, derived once from the case.

use super::terms::acoustic_damping::AcousticDamping;
use super::terms::density_diffusion::{DensityDiffusion, Diffusion};
use super::terms::equation_of_state::Tait;
use super::terms::kernel::Wendland;
use super::terms::shifting::Shifting;
use super::terms::viscosity::Viscosity;
use super::terms::wall_slip::WallSlip;

/// Method for the density of boundary particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundaryCondition {
    /// DBC: the density follows from the continuity equation (Crespo et al. 2007).
    Dynamic,
    /// mDBC: the density is extrapolated from ghost nodes in the water (English et al. 2022).
    ModifiedDynamic,
}

/// Constants of the numerical scheme during a run.
#[derive(Debug, Clone, Copy)]
pub struct Parameters {
    /// Particle spacing [m].
    pub dp: f64,
    /// Kernel.
    pub kernel: Wendland,
    /// Equation of state.
    pub tait: Tait,
    /// Viscosity model.
    pub viscosity: Viscosity,
    /// Form and constants of the density diffusion.
    pub diffusion: Diffusion,
    /// Range of x of the water that this solver computes [m]. Water outside is in a buffer, where another solver gives
    /// its velocity and pressure; no density diffuses between this water and the buffer.
    pub own_x: [f64; 2],
    /// Magnitude of the gravitational acceleration, which acts downwards [m/s2].
    pub gravity: f64,
    /// Courant number C of the time step [-].
    pub cfl: f64,
    /// Method for the density of boundary particles.
    pub boundary: BoundaryCondition,
    /// Wall slip condition under mDBC.
    pub slip: WallSlip,
    /// True if, under mDBC, pressure acts on units through gaps that are too narrow for water particles.
    pub gap_pressure: bool,
    /// Lowest density of the water and of boundary particles that pull at it [kg/m3]: water under stronger suction fills
    /// with air. `None` as published: the suction in the water has no limit, and boundaries do not pull.
    pub lowest_density: Option<f64>,
    /// Damping of sound, if any.
    pub acoustic_damping: Option<AcousticDamping>,
    /// Particle shifting, if any.
    pub shifting: Option<Shifting>,
    /// Width of the flume [m] if it is periodic across its width.
    pub periodic_width: Option<f64>,
}

impl Parameters {
    /// Returns the scheme of Mitsui et al. (2023) for particle spacing `dp` [m], smoothing length `h` [m], speed of
    /// sound `c0` [m/s] and gravitational acceleration `gravity` [m/s2]. For a flume that is periodic across its width,
    /// `periodic_width` is this width [m].
    pub fn published(dp: f64, h: f64, c0: f64, gravity: f64, periodic_width: Option<f64>) -> Self {
        let tait = Tait { rho0: 1000.0, c0, gamma: 7.0 };
        Self {
            dp,
            kernel: Wendland::new(h),
            tait,
            viscosity: Viscosity::Artificial { alpha: 0.04, beta: 0.0 },
            diffusion: Diffusion::new(DensityDiffusion::Fourtakas, 0.1, h, &tait, gravity),
            own_x: [f64::NEG_INFINITY, f64::INFINITY],
            gravity,
            cfl: 0.4,
            boundary: BoundaryCondition::ModifiedDynamic,
            slip: WallSlip::Original,
            gap_pressure: true,
            lowest_density: None,
            acoustic_damping: None,
            shifting: None,
            periodic_width,
        }
    }

    /// Returns true if pressure acts on units through gaps that are too narrow for water particles.
    pub fn has_gap_pressure(&self) -> bool {
        self.gap_pressure && self.boundary == BoundaryCondition::ModifiedDynamic
    }
}
