//! What a run measures and writes, and when it ends.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`gauges`] | points at which the water is measured |
//! | [`files`] | output files and their intervals |
//! | [`stop`] | duration and rest criterion |

pub(in crate::case) mod files;
pub(in crate::case) mod gauges;
pub(in crate::case) mod stop;
