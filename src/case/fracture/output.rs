//! Validates the end of a fracture run and its output intervals.

use super::super::check::{Checker, from};
use super::super::file::FractureFile;
use super::super::output::validate_interval;

/// Default checkpoint interval over the duration [-]. A checkpoint costs as much as about ten time steps.
const CHECKPOINTS_SHARE: f64 = 0.02;

/// Largest number of rows of the energy balance [-].
const MOST_ROWS: f64 = 1e6;

/// Validates the end and the intervals; returns the intervals of surfaces, tetrahedra and checkpoints [s].
pub(super) fn validate(file: &FractureFile, check: &mut Checker) -> [Option<f64>; 3] {
    let (duration, output) = (file.stop.duration_s, &file.output);
    check.number("stop.duration_s", duration, from(1e-9).up_to(1e3), "s", "an impact lasts a few milliseconds");
    let advice = "a hundredth of the duration gives a smooth curve";
    let shortest = from(duration.max(1e-9) / MOST_ROWS);
    check.number("output.energy_interval_s", output.energy_interval_s, shortest.up_to(1e3), "s", advice);
    [
        validate_interval("surfaces_interval_s", output.surfaces_interval_s, duration, check),
        validate_interval("tets_interval_s", output.tets_interval_s, duration, check),
        match output.checkpoint_interval_s {
            Some(given) => validate_interval("checkpoint_interval_s", given, duration, check),
            None => Some(duration * CHECKPOINTS_SHARE),
        },
    ]
}
