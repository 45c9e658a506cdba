//! Progress of the outputs of a flume run.

use serde::{Deserialize, Serialize};

use crate::{case::Output, output::Schedule};

/// How often each output was written, and the lengths of the tables; part of every checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecorderState {
    /// Times at which the tables receive rows.
    pub(crate) series: Schedule,
    /// Snapshots of the unit surfaces.
    pub(crate) surfaces: Schedule,
    /// Snapshots of the water.
    pub(crate) water: Schedule,
    /// Snapshots of the surface of the water; checkpoints of older versions do not have this count.
    #[serde(default = "Schedule::never")]
    pub(crate) water_surface: Schedule,
    /// Checkpoints. The first is due after one interval: at the start no checkpoint is needed, because the case file
    /// defines the state.
    pub checkpoints: Schedule,
    /// Lengths of the tables [bytes].
    pub(crate) bytes: [u64; 5],
}

impl RecorderState {
    /// Returns the state at the start of a run.
    pub fn new(output: &Output) -> Self {
        Self {
            series: Schedule::every(Some(output.series_interval)),
            surfaces: Schedule::every(output.units_interval),
            water: Schedule::every(output.fluid_interval),
            water_surface: Schedule::every(output.surface_interval),
            checkpoints: Schedule::after_every(output.checkpoint_interval),
            bytes: [0; 5],
        }
    }

    /// Returns the numbers of snapshots of the water, of the unit surfaces and of the surface of the water.
    pub fn snapshots(&self) -> [u64; 3] {
        [self.water.count, self.surfaces.count, self.water_surface.count]
    }

    /// Changes the intervals to those of the case, which may have changed since the checkpoint at `time` [s].
    pub fn set_intervals(&mut self, output: &Output, time: f64) {
        self.series.set_interval(Some(output.series_interval), time);
        self.surfaces.set_interval(output.units_interval, time);
        self.water.set_interval(output.fluid_interval, time);
        self.water_surface.set_interval(output.surface_interval, time);
        self.checkpoints.set_interval(output.checkpoint_interval, time);
    }
}
