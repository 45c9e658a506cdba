//! Weakly compressible smoothed particle hydrodynamics (Mitsui et al. 2023, sections 2.1 and 2.2).
//!
//! | file | equation |
//! | --- | --- |
//! | [`kernel`] | quintic Wendland kernel |
//! | [`momentum`] | 1: pressure acceleration |
//! | [`continuity`] | 2: continuity |
//! | [`viscosity`] | 3: artificial viscosity; laminar viscosity |
//! | [`turbulence`] | sub-particle-scale stress |
//! | [`density_diffusion`] | 4 and 5: density diffusion |
//! | [`equation_of_state`] | 6: Tait |
//! | [`step`] | 7 to 9: symplectic position Verlet |
//! | [`mdbc`] | section 2.2: density of boundary particles from ghost nodes |
//! | [`ghost_velocity`], [`wall_slip`] | velocity of boundary particles from ghost nodes |
//! | [`gradients`] | gradients of density and velocity, particle distribution |
//! | [`shifting`] | particle shifting |
//! | `gap_pressure` | pressure on units through gaps without water particles |
//! | [`time_step`] | variable time step |
//! | [`backend`], [`device`] | computing on the processor (CPU) or a graphics card (GPU) |
//! | [`power`] | power of walls, viscosity and density diffusion |
//!
//! Each time step sorts the particles into the bins of a cell list ([`grid`]). A cluster holds as many particles as
//! there are SIMD [`lanes`] and has one neighbour list ([`neighbours`]); `pair_sums` adds a neighbour to all members at
//! once. Each particle gathers its own sums in a fixed order, so results are bit-identical for any number of threads.

pub mod backend;
pub mod continuity;
pub mod density_diffusion;
pub mod device;
pub mod equation_of_state;
mod gap_pressure;
pub mod ghost_velocity;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod gradients;
pub mod grid;
mod group;
pub mod kernel;
pub mod lanes;
pub mod mdbc;
pub mod momentum;
pub mod neighbours;
mod pair_sums;
pub mod parameters;
pub mod particles;
pub mod power;
pub mod rates;
pub mod records;
pub mod sampling;
pub mod shifting;
pub mod solve;
pub mod step;
pub mod time_step;
pub mod turbulence;
pub mod viscosity;
pub mod wall_slip;
