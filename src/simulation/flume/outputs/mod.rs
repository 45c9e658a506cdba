//! Outputs of a flume run: tables, ParaView files, checkpoints and the summary.

pub mod checkpoint;
mod gauge_rows;
pub mod recorder;
pub mod recorder_state;
pub mod snapshots;
pub mod summary;
mod surface;
