//! Sweeps: many runs of one case with keys that vary.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`plan`] | the sweep file and the runs that follow from it |
//! | [`key`] | paths of the keys that vary |
//! | [`member`] | the folder of one run, and whether it is finished |
//! | [`queue`] | runs in parallel on this machine |
//! | [`slurm`] | runs as a job array of the Slurm workload manager |
//! | [`table`] | the results of all runs as a table |
//!
//! Each run is a separate process, so a crash does not affect the others. Finished runs are kept, interrupted runs
//! resume from their checkpoint, failed runs are tried once more.

pub mod key;
pub mod member;
pub mod plan;
pub mod queue;
pub mod slurm;
pub mod table;
