//! State of a fracture run in addition to its world, for tables, summary and checkpoints.

use serde::{Deserialize, Serialize};

use super::peak_stress::PeakStress;
use crate::femdem::world::energy_balance::EnergyBalance;

/// State of a run in addition to its world.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct RunState {
    /// Quantities that the loop tracks.
    pub watched: Watched,
    /// Total of the energy balance at the start [J].
    pub total_at_start: Option<f64>,
    /// Number of rows of the energy balance.
    pub rows: u64,
    /// Number of time steps in each of the ParaView files.
    pub frames: u64,
    /// Number of checkpoints.
    pub checkpoints: u64,
    /// Lengths of the tables of the energy balance and of the bodies [bytes].
    pub bytes: [u64; 2],
    /// Lengths of the other files.
    pub detail: DetailLengths,
}

impl RunState {
    /// Records a row of the energy balance; returns its residual relative to the start [J].
    pub fn note(&mut self, book: &EnergyBalance) -> f64 {
        let residual = book.total() - *self.total_at_start.get_or_insert(book.total());
        let watched = &mut self.watched;
        if watched.steps == 0 {
            watched.kinetic[0] = book.kinetic;
        }
        watched.kinetic[1] = watched.kinetic[1].max(book.kinetic);
        watched.residual = watched.residual.max(residual.abs());
        residual
    }
}

/// Quantities that the loop tracks.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Watched {
    /// Number of time steps.
    pub steps: u64,
    /// Largest residual of the energy balance [J].
    pub residual: f64,
    /// Kinetic energy at the start, and the largest one [J].
    pub kinetic: [f64; 2],
    /// Time at which two bodies first touched [s].
    pub impact: Option<f64>,
    /// Largest tension in each body.
    pub peaks: Vec<PeakStress>,
    /// Wall-clock time, including the time before interruptions [s].
    pub wall: f64,
}

/// Lengths of the files at a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct DetailLengths {
    /// Length of `cracks.csv` [bytes].
    pub cracks_bytes: u64,
    /// Number of rows of `cracks.csv`.
    pub cracks: usize,
    /// Number of time steps in `section.vtkhdf`; 0 without this file.
    pub section_steps: usize,
    /// Number of time steps in `tets.vtkhdf`; 0 without this file.
    pub tets_steps: usize,
}
