//! Reads velocity and surface level of a wave at one position from files of other programs.
//!
//! | module | contents |
//! | --- | --- |
//! | [`table`] | table of velocity over height and time, which every reader returns, and its checks |
//! | [`surface`] | surface level over time |
//! | [`velx`] | DualSPHysics: `_velx` files |
//! | [`swash`] | SWASH: tables of water level and layer velocities |
//! | [`openfoam`] | OpenFOAM: probes, sampled lines and `interfaceHeight` |
//! | [`comparison`] | comparison of a surface level with the flume model at one gauge |
//! | [`error`] | errors in the files of other programs |

pub mod comparison;
pub mod error;
mod numbers;
pub mod openfoam;
pub mod surface;
pub mod swash;
pub mod table;
mod text_file;
pub mod velx;

#[cfg(test)]
mod agreement;
