//! Sums over pairs of a target (the particle for which a sum is computed) and one of its neighbours.
//!
//! | file | contents |
//! | --- | --- |
//! | [`pair_loop`] | constants of the loop over pairs, distance between two particles |
//! | [`rate`] | result of the loop: acceleration and density rate of a particle |
//! | [`rates`] | right-hand sides of equations 1 and 2 for all targets |
//! | `pair_sums` | sums over the neighbours of a cluster, computed for all its members at once |
//! | [`gradients`] | gradients of density and velocity, measures of the particle distribution |
//! | [`gap_pressure`] | pressure on units through gaps without water particles |

pub mod gap_pressure;
pub mod gradients;
pub mod pair_loop;
mod pair_sums;
pub mod rate;
pub mod rates;
