//! Density and velocity of the boundary particles, from ghost nodes in the water.
//!
//! | file | contents |
//! | --- | --- |
//! | [`mdbc`] | section 2.2 of Mitsui et al. (2023): ghost nodes, and the density of boundary particles |
//! | [`ghost_velocity`] | velocity of the water at the ghost nodes, for the no-slip and free-slip conditions |
//! | [`node_sums`] | sums over the water particles around each ghost node |
//! | [`linear_equations`] | solution of four linear equations, for interpolations that are exact for linear fields |

pub mod ghost_velocity;
pub mod linear_equations;
pub mod mdbc;
pub mod node_sums;
