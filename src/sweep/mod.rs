//! Sweeps: one case with keys that vary, every combination a run.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`plan`] | the sweep file and the runs that follow from it |
//! | [`key`] | paths of the keys that vary |
//! | [`member`] | the folder of one run, and whether it is finished |
//! | [`queue`] | running them side by side on this machine |
//! | [`slurm`] | handing them to the Slurm workload manager as a job array |
//! | [`table`] | the results of all of them as a table and a chart |
//!
//! Every run is a process of its own: one that crashes or is killed takes no other with it. What is finished is kept,
//! what was interrupted goes on from its checkpoint, what failed is tried once more.

pub mod key;
pub mod member;
pub mod plan;
pub mod queue;
pub mod slurm;
pub mod table;
