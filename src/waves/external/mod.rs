//! The velocity of a wave at one place from files of other programs, and written back for them.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`table`] | velocity over height and time, which every reader gives, and the checks it must pass |
//! | [`surface`] | the level of the surface over time |
//! | [`velx`] | `_velx` files of DualSPHysics |
//! | [`swash`] | tables of SWASH: water level, and velocity by layer |
//! | [`openfoam`] | probes, sampled lines and `interfaceHeight` of OpenFOAM |
//! | [`error`] | what can be wrong with such files |

pub mod comparison;
pub mod error;
pub mod openfoam;
pub mod surface;
pub mod swash;
pub mod table;
mod text_file;
pub mod velx;

#[cfg(test)]
mod agreement;
