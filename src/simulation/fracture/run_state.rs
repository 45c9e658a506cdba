//! State of a fracture run in addition to the state of its solver: counts, extremes, and lengths of its files.

use serde::{Deserialize, Serialize};

use super::peak_stress::PeakStress;
use crate::{case::FractureCase, femdem::world::energy_balance::EnergyBalance, output::Schedule};

/// State of a run in addition to the state of its solver [`World`](crate::femdem::world::World).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunState {
    /// Extremes and counts since the start.
    pub watched: Watched,
    /// Total of the energy balance at the start [J]; `None` before the first row of the energy balance.
    pub total_at_start: Option<f64>,
    /// Rows of the energy balance.
    pub rows: Schedule,
    /// Outputs in `surfaces.vtkhdf` and `cracks.vtkhdf`.
    pub frames: Schedule,
    /// Outputs in `tets.vtkhdf`.
    pub tets: Schedule,
    /// Checkpoints. The first is due after one interval: at the start no checkpoint is needed, because the case file
    /// defines the state.
    pub checkpoints: Schedule,
    /// Lengths of the tables of the energy balance and of the bodies [bytes].
    pub bytes: [u64; 2],
    /// Lengths of the files of failed faces, cut plane and tetrahedra.
    pub detail: DetailLengths,
}

impl RunState {
    /// Returns the state at the start of a run.
    pub fn new(case: &FractureCase) -> Self {
        Self {
            watched: Watched::default(),
            total_at_start: None,
            rows: Schedule::every(Some(case.energy_interval)),
            frames: Schedule::every(case.surfaces_interval),
            tets: Schedule::every(case.tets_interval),
            checkpoints: Schedule::after_every(case.checkpoint_interval),
            bytes: [0; 2],
            detail: DetailLengths::default(),
        }
    }

    /// Changes the intervals to those of the case, which may have changed since the checkpoint at `time` [s].
    pub fn set_intervals(&mut self, case: &FractureCase, time: f64) {
        self.rows.set_interval(Some(case.energy_interval), time);
        self.frames.set_interval(case.surfaces_interval, time);
        self.tets.set_interval(case.tets_interval, time);
        self.checkpoints.set_interval(case.checkpoint_interval, time);
    }

    /// Updates the extremes with a row of the energy balance. Returns the residual: the total of this row minus the
    /// total at the start [J].
    pub fn note(&mut self, balance: &EnergyBalance) -> f64 {
        let residual = balance.total() - *self.total_at_start.get_or_insert(balance.total());
        let watched = &mut self.watched;
        if watched.steps == 0 {
            watched.kinetic[0] = balance.kinetic;
        }
        watched.kinetic[1] = watched.kinetic[1].max(balance.kinetic);
        watched.residual = watched.residual.max(residual.abs());
        residual
    }
}

/// Extremes and counts of a fracture run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Watched {
    /// Number of time steps.
    pub steps: u64,
    /// Largest magnitude of the residual of the energy balance [J].
    pub residual: f64,
    /// Kinetic energy at the start, and largest kinetic energy [J].
    pub kinetic: [f64; 2],
    /// Time at which two bodies first touched [s]; `None` until then.
    pub impact: Option<f64>,
    /// Largest tension in each body.
    pub peaks: Vec<PeakStress>,
    /// Wall-clock time of the run, including all earlier sessions [s].
    pub wall: f64,
}

/// Lengths of the files of failed faces, cut plane and tetrahedra at a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct DetailLengths {
    /// Length of `cracks.csv` [bytes].
    pub cracks_bytes: u64,
    /// Number of rows of `cracks.csv`.
    pub cracks: usize,
    /// Number of output times in `section.vtkhdf`; 0 without this file.
    pub section_steps: usize,
    /// Number of output times in `tets.vtkhdf`; 0 without this file.
    pub tets_steps: usize,
}
