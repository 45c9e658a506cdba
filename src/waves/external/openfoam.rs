//! Output of OpenFOAM's function objects at one place over time.
//!
//! Formats are those of the sources of OpenFOAM v1912 to v2312 (openfoam.com) and, for probes and `interfaceHeight`, of
//! OpenFOAM-dev (openfoam.org), which differ only in comments.
//!
//! | module | what it reads |
//! | --- | --- |
//! | [`probes`] | `postProcessing/<name>/<t0>/U` and `alpha.water`: one file a field, a row a time |
//! | [`lines`] | `postProcessing/<name>/<t>/<line>_U.xy`: one folder a time, a row a point |
//! | [`interface_height`] | `postProcessing/<name>/<t0>/position.dat` and `height.dat` |
//!
//! Probes and `interfaceHeight` leave one folder for each start of the run; they are joined, and where they overlap the
//! later start counts. Points outside the mesh have values of about 1e300 and are left out. Velocities are along x of
//! OpenFOAM.

mod frame;
pub mod gauges;
pub mod interface_height;
pub mod lines;
pub mod probes;
mod samples;
mod starts;

pub use frame::{Frame, Up};
pub use samples::Vertical;
