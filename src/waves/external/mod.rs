//! Velocity and surface of a wave at one position, in files of other programs.
//!
//! | module | contents |
//! | --- | --- |
//! | [`table`] | velocity over height and time, the result of every reader, with its checks |
//! | [`surface`] | surface level over time |
//! | [`velx`] | DualSPHysics: `_velx` files |
//! | [`swash`] | SWASH: tables of water level and layer velocities |
//! | [`openfoam`] | OpenFOAM: probes, sampled lines and `interfaceHeight` |
//! | [`error`] | errors in these files |

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
