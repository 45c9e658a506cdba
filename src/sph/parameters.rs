//! Constants of the scheme, derived once from the case.

use super::{
    density_diffusion::{DensityDiffusion, Diffusion},
    equation_of_state::Tait,
    kernel::Wendland,
    shifting::Shifting,
    viscosity::Viscosity,
    wall_slip::WallSlip,
};

/// How boundary particles get their density.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundaryCondition {
    /// From the continuity equation (Crespo et al. 2007).
    Dynamic,
    /// From ghost nodes in the water (English et al. 2022).
    ModifiedDynamic,
}

/// Everything the solver needs to know that does not change during a run.
#[derive(Debug, Clone, Copy)]
pub struct Parameters {
    /// Distance between particles [m].
    pub dp: f64,
    /// Kernel.
    pub kernel: Wendland,
    /// Equation of state.
    pub tait: Tait,
    /// Resistance to shear.
    pub viscosity: Viscosity,
    /// Density diffusion.
    pub diffusion: Diffusion,
    /// Gravitational acceleration, downwards [m/s2].
    pub gravity: f64,
    /// Courant number [-].
    pub cfl: f64,
    /// Boundary condition.
    pub boundary: BoundaryCondition,
    /// Velocity that boundary particles show to the water under mDBC.
    pub slip: WallSlip,
    /// Whether bed, walls and other units press on units through gaps that hold no water particle, under mDBC.
    pub gap_pressure: bool,
    /// Particle shifting, if any.
    pub shifting: Option<Shifting>,
    /// Width across the flume if what leaves on one side enters on the other [m].
    pub periodic_width: Option<f64>,
}

impl Parameters {
    /// The scheme of Mitsui et al. (2023) for a particle distance, a smoothing length [m], a speed of sound [m/s], a
    /// gravity [m/s2] and, if the domain is periodic across, its width [m].
    pub fn published(dp: f64, h: f64, c0: f64, gravity: f64, periodic_width: Option<f64>) -> Self {
        let tait = Tait { rho0: 1000.0, c0, gamma: 7.0 };
        Self {
            dp,
            kernel: Wendland::new(h),
            tait,
            viscosity: Viscosity::Artificial { alpha: 0.04 },
            diffusion: Diffusion::new(DensityDiffusion::Fourtakas, 0.1, h, &tait, gravity),
            gravity,
            cfl: 0.2,
            boundary: BoundaryCondition::ModifiedDynamic,
            slip: WallSlip::Original,
            gap_pressure: true,
            shifting: None,
            periodic_width,
        }
    }
}
