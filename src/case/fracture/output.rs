//! End of a fracture run and intervals of its outputs, validated.

use super::super::check::{Checker, from};
use super::super::file::FractureFile;
use super::super::output::validate_interval;

/// Interval of the checkpoints over the duration [-], where the case does not give it: each costs some ten steps.
const CHECKPOINTS_SHARE: f64 = 0.02;

/// Rows of the energy book at most [-].
const MOST_ROWS: f64 = 1e6;

/// End of the run and intervals of the outputs; returns those of the surfaces, of the tetrahedra and of the
/// checkpoints [s].
pub(super) fn validate(file: &FractureFile, check: &mut Checker) -> [Option<f64>; 3] {
    let (duration, output) = (file.stop.duration_s, &file.output);
    check.number("stop.duration_s", duration, from(1e-9).up_to(1e3), "s", "an impact lasts some milliseconds");
    let advice = "a hundredth of the duration draws a smooth curve";
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
