//! The time step on the processor, and what it has in common with a graphics card.
//!
//! | file | contents |
//! | --- | --- |
//! | [`backend`] | the operations of a time step, on any device |
//! | [`step`] | 7 to 9: symplectic position Verlet, on the processor |
//! | `group` | sorted water, walls or units with their neighbour lists |
//! | [`time_step`] | variable time step |
//! | [`power`] | power of walls, viscosity and density diffusion |
//! | [`sampling`] | pressure, velocity and free surface at points |

pub mod backend;
mod group;
pub mod power;
pub mod sampling;
pub mod step;
pub mod time_step;
