//! Constants of the scheme, derived once from the case.

use super::{
    density_diffusion::Diffusion, equation_of_state::Tait, kernel::Wendland, shifting::Shifting, viscosity::Viscosity,
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
    /// Particle shifting, if any.
    pub shifting: Option<Shifting>,
    /// Width across the flume if what leaves on one side enters on the other [m].
    pub periodic_width: Option<f64>,
}
