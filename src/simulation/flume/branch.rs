//! Runs that start from the checkpoint of another run with the same flume and wave, before any unit has moved.

use std::{path::Path, sync::Arc};

use super::{
    Simulation, Units,
    measures::rest::Rest,
    outputs::{checkpoint::Checkpoint, recorder::Recorder, recorder_state::RecorderState},
    run::{FlumeRun, RunOptions},
    setup::SetupError,
};
use crate::{
    case::{self, Case, difference},
    output::{
        Summary,
        driver::{RunError, drive},
    },
};

/// Largest displacement of a unit that counts as still, divided by the height of the unit [-]. A unit that rolls or
/// slides moves further.
pub const STILL: f64 = 0.01;

/// A simulation that starts from the state of another run with the same flume and wave.
pub struct Start<'a> {
    simulation: Simulation,
    outputs: RecorderState,
    from: &'a Path,
}

impl<'a> Start<'a> {
    /// Sets up a case, and restores the checkpoint of another run in the folder `from`. The cases of the two runs may
    /// differ only in the keys [`Case::KEYS_FREE_AT_START`]. Writes no file.
    ///
    /// # Errors
    /// If the other run has no checkpoint, its case differs in other keys, or its units have moved.
    pub fn at(case: Arc<Case>, from: &'a Path, options: &RunOptions) -> Result<Self, RunError> {
        let refused =
            |reason: String| RunError::setup(format!("{}: the run cannot begin there: {reason}", from.display()));
        if !from.join(Checkpoint::FILE).exists() {
            return Err(refused(format!("there is no {}", Checkpoint::FILE)));
        }
        let other = Case::load(from.join("case.json")).map_err(|errors| refused(errors.to_string()))?;
        if other.start_hash != case.start_hash {
            return Err(refused(difference(&case.text, &other.text, &Case::KEYS_FREE_AT_START)));
        }
        let checkpoint = Checkpoint::read(from, &other.identity)?;
        let mut simulation = checkpoint.set_up(&options.device, case).map_err(RunError::setup)?;
        let outputs = checkpoint.restore(&mut simulation, from)?;
        simulation.load().map_err(|error| RunError::setup(SetupError::Device(error)))?;
        let (time, height) = (simulation.flume_time(), simulation.case.units.as_ref().map(case::Units::tallest));
        let moved = simulation.units.iter().flat_map(Units::displacements).fold(0.0, f64::max);
        if height.is_some_and(|height| moved > STILL * height) {
            let moved = 1e3 * moved;
            return Err(refused(format!(
                "at {time:.3} s, a unit has already moved by {moved:.1} mm; begin while all units are still"
            )));
        }
        simulation.statistics.rest = Rest::default();
        let warning =
            format!("results until {time:.3} s are those with the friction of another run; no unit had moved by then");
        simulation.statistics.warnings.push(warning);
        Ok(Self { simulation, outputs, from })
    }

    /// Runs the case from this state into an existing, empty folder. Copies the outputs of the other run up to this
    /// state.
    ///
    /// # Errors
    /// As for [`super::run::run`].
    pub fn run(self, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
        let Self { simulation, outputs, from } = self;
        let recorder = Recorder::branch(&simulation, from, dir, outputs)?;
        Checkpoint::of(&simulation, recorder.state()).write(dir, Checkpoint::FILE)?;
        drive(FlumeRun::new(simulation, recorder, dir, options.until), dir, &options.control)
    }
}
