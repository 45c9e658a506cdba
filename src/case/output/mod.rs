//! What a run measures and writes, and when it ends.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`gauges`] | points at which the water is measured |
//! | [`files`] | output files and their intervals |
//! | [`stop`] | duration and rest criterion |

pub mod files;
pub mod gauges;
pub mod stop;
