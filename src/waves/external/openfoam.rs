//! Output of OpenFOAM's function objects at one position over time.
//!
//! The formats follow the source code of OpenFOAM v1912 to v2312 (openfoam.com). For probes and `interfaceHeight` they
//! also cover OpenFOAM-dev (openfoam.org), whose files differ only in the comment lines.
//!
//! | module | files |
//! | --- | --- |
//! | [`probes`] | `postProcessing/<name>/<t0>/U` and `alpha.water`: one file per field, one row per time |
//! | [`lines`] | `postProcessing/<name>/<t>/<line>_U.xy`: one folder per time, one row per point |
//! | [`interface_height`] | `postProcessing/<name>/<t0>/position.dat` |
//!
//! Probes and `interfaceHeight` write one folder per start of the run, with the start time t0 as its name. The readers
//! join these folders; where their times overlap, the values of the later start are used. Points outside the mesh have
//! values of about 1e300 and are left out. Velocities are along x of OpenFOAM.

mod frame;
pub mod gauges;
pub mod interface_height;
pub mod lines;
pub mod probes;
mod samples;
mod starts;

pub use frame::{Frame, Up};
pub use samples::Vertical;
