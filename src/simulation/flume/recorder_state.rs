//! Where the outputs of a run stand.

use serde::{Deserialize, Serialize};

/// Where each output stands: how often it was written, and how long its file is. Part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RecorderState {
    /// Rows of the series.
    pub(super) series: u64,
    /// Steps of the moving surfaces.
    pub(super) surfaces: u64,
    /// Steps of the water.
    pub(super) water: u64,
    /// Checkpoints.
    pub checkpoints: u64,
    /// Bytes of the tables.
    pub(super) bytes: [u64; 5],
}
