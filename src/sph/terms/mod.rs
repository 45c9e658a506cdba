//! The physical terms: one equation per file, written once for scalars and SIMD lanes.
//!
//! | file | equation |
//! | --- | --- |
//! | [`kernel`] | quintic Wendland kernel |
//! | [`momentum`] | 1: momentum |
//! | [`continuity`] | 2: continuity |
//! | [`viscosity`] | 3: artificial viscosity; laminar viscosity |
//! | [`turbulence`] | sub-particle-scale stress |
//! | [`density_diffusion`] | 4 and 5: density diffusion |
//! | [`equation_of_state`] | 6: Tait |
//! | [`wall_slip`] | velocity of boundary particles in the equations of the water |
//! | [`shifting`] | particle shifting |

pub mod continuity;
pub mod density_diffusion;
pub mod equation_of_state;
pub mod kernel;
pub mod momentum;
pub mod shifting;
pub mod turbulence;
pub mod viscosity;
pub mod wall_slip;
