//! A run with its changes from the base case, and the texts of wave heights and particle spacings.

use breakwater::{
    case::ReferenceWave,
    report::{compare::RunResult, plot::short},
};

use crate::change::Change;

/// A run with its changes from the base case.
pub struct Compared<'a> {
    /// The wave.
    pub wave: &'a ReferenceWave,
    /// The results.
    pub run: &'a RunResult,
    /// Changes from the base case.
    pub changes: Vec<Change>,
    /// The places of the open ends [m], which are not listed as changes. None if the domain has a wavemaker.
    pub open_ends: Option<[f64; 2]>,
}

impl Compared<'_> {
    /// Particle spacing [m].
    pub fn dp_m(&self) -> f64 {
        self.run.summary.dp_m
    }
}

/// Wave height in cm, as text.
pub fn centimetres(wave: &ReferenceWave) -> String {
    short(100.0 * wave.height_m, 1)
}

/// Particle spacing in mm, as text.
pub fn millimetres(dp_m: f64) -> String {
    short(1000.0 * dp_m, 2)
}
