//! Validates the duration and the output intervals of a fracture run.

use crate::case::file::FractureFile;
use crate::case::output::files::validate_interval;
use crate::case::reading::check::{Checker, at_least};

/// Default checkpoint interval as a share of the duration of the run [-]. Writing a checkpoint takes as long as about
/// ten time steps.
const CHECKPOINTS_SHARE: f64 = 0.02;

/// Largest number of rows of the energy balance [-].
const MOST_ROWS: f64 = 1e6;

/// Validates duration and output intervals. Returns the intervals of surfaces, tetrahedra and checkpoints [s]; `None`
/// for no output.
pub fn validate(file: &FractureFile, check: &mut Checker) -> [Option<f64>; 3] {
    let (duration, output) = (file.stop.duration_s, &file.output);
    check.number("stop.duration_s", duration, at_least(1e-9).up_to(1e3), "s", "an impact lasts a few milliseconds");
    let advice = "a hundredth of the duration gives a smooth curve";
    let shortest = at_least(duration.max(1e-9) / MOST_ROWS);
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
