//! Settings for the output of a run, its gauges and its end.
//!
//! | file | contents |
//! | --- | --- |
//! | [`gauges`] | points at which elevation, pressure or velocity of the water is measured |
//! | [`files`] | output files and their intervals |
//! | [`stop`] | duration of the run and rest criterion |

pub mod files;
pub mod gauges;
pub mod stop;
