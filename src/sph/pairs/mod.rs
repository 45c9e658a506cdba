//! Sums over pairs of neighbours.
//!
//! | file | contents |
//! | --- | --- |
//! | [`pair_loop`] | constants of a loop over pairs, distance of a pair |
//! | [`rate`] | result of the loop: acceleration and density rate of a particle |
//! | [`rates`] | right-hand sides of equations 1 and 2 for all targets |
//! | `pair_sums` | the terms of a pair, added for a cluster at once |
//! | [`gradients`] | gradients of density and velocity, particle distribution |
//! | `gap_pressure` | pressure on units through gaps without water particles |

mod gap_pressure;
pub mod gradients;
pub mod pair_loop;
mod pair_sums;
pub mod rate;
pub mod rates;
