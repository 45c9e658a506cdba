//! Progress of the outputs of a run.

use serde::{Deserialize, Serialize};

/// Progress of each output: how often it was written, and how long its file is. Part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RecorderState {
    /// Number of rows of the series.
    pub(super) series: u64,
    /// Number of snapshots of the surfaces.
    pub(super) surfaces: u64,
    /// Number of snapshots of the water.
    pub(super) water: u64,
    /// Number of checkpoints.
    pub checkpoints: u64,
    /// Lengths of the tables [bytes].
    pub(super) bytes: [u64; 5],
}
