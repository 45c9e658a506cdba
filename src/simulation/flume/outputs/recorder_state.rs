//! Progress of the outputs of a flume run.

use serde::{Deserialize, Serialize};

/// Number of times that each output was written, and lengths of the tables; part of every checkpoint.
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
