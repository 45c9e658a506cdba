//! Progress of the outputs of a flume run.

use serde::{Deserialize, Serialize};

/// How often each output was written, and the lengths of the tables; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RecorderState {
    /// Number of times at which the tables received rows.
    pub(crate) series: u64,
    /// Number of snapshots of the unit surfaces.
    pub(crate) surfaces: u64,
    /// Number of snapshots of the water.
    pub(crate) water: u64,
    /// Number of checkpoints.
    pub checkpoints: u64,
    /// Lengths of the tables [bytes].
    pub(crate) bytes: [u64; 5],
}
