//! The time step on the processor, and the common interface of the processor and of graphics cards.
//!
//! | file | contents |
//! | --- | --- |
//! | [`backend`] | the operations of a time step, on any device |
//! | [`step`] | equations 7 to 9: symplectic position Verlet, on the processor |
//! | `state` | the state of the water that the sums over particle pairs read |
//! | `group` | a group of particles (water, walls or units): sorted positions, neighbour lists, rates |
//! | `water_pores` | the pores of porous media around each water particle |
//! | [`time_step`] | size of the variable time step |
//! | [`power`] | power that the water receives from boundaries, viscosity and density diffusion |
//! | [`sampling`] | pressure, velocity and free-surface level at given points |

pub mod backend;
mod group;
pub mod power;
pub mod sampling;
mod state;
pub mod step;
pub mod time_step;
mod water_pores;
