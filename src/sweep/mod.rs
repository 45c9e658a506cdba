//! Sweeps: many runs of one case in which the values of some keys vary.
//!
//! | module | contents |
//! | --- | --- |
//! | [`plan`] | reads the sweep file and creates the cases of its runs |
//! | [`key`] | paths of the keys that vary |
//! | [`values`] | values of the keys and their combinations |
//! | [`random`] | random values |
//! | [`member`] | the folder, the log and the state of one run |
//! | [`queue`] | runs in parallel on this machine |
//! | [`slurm`] | runs as a job array of the Slurm workload manager |
//! | [`table`] | the results of all runs as a table |
//! | [`ensemble`] | statistics over runs that differ only in their random values |
//!
//! Each run is a separate process, so a crash does not affect the other runs. Finished runs are kept, and interrupted
//! runs resume from their checkpoint. On this machine, a failed run gets a second attempt.

pub mod ensemble;
pub mod key;
pub mod member;
pub mod plan;
pub mod queue;
pub mod random;
pub mod slurm;
pub mod table;
pub mod values;
