//! The time step on the processor, and the interface that the processor and graphics cards have in common.
//!
//! | file | contents |
//! | --- | --- |
//! | [`backend`] | the operations of a time step, on any device |
//! | [`step`] | equations 7 to 9: symplectic position Verlet, on the processor |
//! | `group` | sorted water, walls or units with their neighbour lists |
//! | [`time_step`] | size of the variable time step |
//! | [`power`] | power of boundaries, viscosity and density diffusion |
//! | [`sampling`] | pressure, velocity and free-surface level at given points |

pub mod backend;
mod group;
pub mod power;
pub mod sampling;
pub mod step;
pub mod time_step;
