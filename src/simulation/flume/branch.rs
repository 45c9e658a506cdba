//! Runs that begin where another one stands: one flume, one wave, and units that have not moved yet.

use std::{path::Path, sync::Arc};

use serde_json::{Map, Value};

use super::{
    Simulation, Units,
    checkpoint::{self, Checkpoint},
    recorder::Recorder,
    recorder_state::RecorderState,
    rest::Rest,
    run::{FlumeRun, RunOptions},
    setup::SetupError,
};
use crate::{
    case::Case,
    output::{
        Summary,
        driver::{RunError, drive},
    },
};

/// Units that have moved less than this share of their height stand still: rolling and sliding begin after it.
pub const STILL: f64 = 0.01;

/// A case where another run of the same wave stands.
pub struct Start<'a> {
    simulation: Simulation,
    outputs: RecorderState,
    from: &'a Path,
}

impl<'a> Start<'a> {
    /// Put a case into the state of the checkpoint in another run's folder, whose case is the same but for
    /// [`Case::MAY_DIFFER`]. Nothing is written.
    ///
    /// # Errors
    /// If the other run has no checkpoint, is one of another case, or its units have moved.
    pub fn at(case: Arc<Case>, from: &'a Path, options: &RunOptions) -> Result<Self, RunError> {
        let refused = |why: String| RunError::setup(format!("{}: the run cannot begin there: {why}", from.display()));
        if !from.join(Checkpoint::FILE).exists() {
            return Err(refused(format!("there is no {}", Checkpoint::FILE)));
        }
        let other = Case::load(from.join("case.json")).map_err(|errors| refused(errors.to_string()))?;
        if other.start_hash != case.start_hash {
            return Err(refused(difference(&case.text, &other.text)));
        }
        let mut simulation = Simulation::on(&options.device, case).map_err(RunError::setup)?;
        let outputs = checkpoint::read_of(&mut simulation, from, &other.hash)?;
        simulation.load().map_err(|error| RunError::setup(SetupError::Device(error)))?;
        let (time, height) = (simulation.flume_time(), simulation.units.as_ref().map(|units| units.shape.height()));
        let moved = simulation.units.iter().flat_map(Units::displacements).fold(0.0, f64::max);
        if height.is_some_and(|height| moved > STILL * height) {
            let moved = 1e3 * moved;
            return Err(refused(format!("a unit has moved {moved:.1} mm by {time:.3} s; begin while all stand still")));
        }
        simulation.statistics.rest = Rest::default();
        let warning =
            format!("until {time:.3} s computed with the friction of another run, while the units stood still");
        simulation.statistics.warnings.push(warning);
        Ok(Self { simulation, outputs, from })
    }

    /// Run it from there into an existing, empty folder. What the other run has written until then is taken over.
    ///
    /// # Errors
    /// As [`super::run::run`].
    pub fn run(self, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
        let Self { simulation, outputs, from } = self;
        let recorder = Recorder::branch(&simulation, from, dir, outputs)?;
        Checkpoint::of(&simulation, recorder.state()).write(dir, Checkpoint::FILE)?;
        drive(FlumeRun::new(simulation, recorder, dir, options.until), dir, &options.control)
    }
}

/// In what two case files differ that may not, in words.
pub fn difference(one: &str, other: &str) -> String {
    let keys = apart(one, other);
    let may = Case::MAY_DIFFER.join(", ");
    if keys.is_empty() {
        return "a file that both cases name has changed".to_owned();
    }
    format!("the cases differ in {}; only {may} may differ", keys.join(", "))
}

/// Keys at the top of two case files in which they differ, but for [`Case::MAY_DIFFER`].
fn apart(one: &str, other: &str) -> Vec<String> {
    let parsed = |text: &str| {
        let mut keys: Map<String, Value> =
            serde_json::from_str(text.trim_start_matches('\u{feff}')).unwrap_or_default();
        if let Some(stop) = keys.get_mut("stop").and_then(Value::as_object_mut) {
            stop.remove("at_rest");
        }
        keys
    };
    let (one, other) = (parsed(one), parsed(other));
    let mut keys: Vec<&String> = one.keys().chain(other.keys()).collect();
    keys.sort_unstable();
    keys.dedup();
    let may = |key: &str| key == "$schema" || Case::MAY_DIFFER.contains(&key);
    keys.retain(|key| !may(key) && one.get(*key) != other.get(*key));
    keys.into_iter().cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_that_differ_in_what_units_at_rest_do_not_feel_are_not_apart() {
        let case = r#"{ "title": "a", "friction": [0.3], "stop": { "duration_s": 1 }, "wave": { "height_m": 0.1 } }"#;
        let other = r#"{ "title": "b", "friction": [0.5], "stop": { "duration_s": 1, "at_rest": {} },
            "wave": { "height_m": 0.1 } }"#;
        assert!(apart(case, other).is_empty());
        let another = r#"{ "stop": { "duration_s": 2 }, "wave": { "height_m": 0.2 }, "gauges": [] }"#;
        assert_eq!(apart(case, another), ["gauges", "stop", "wave"]);
        assert!(difference(case, another).contains("only title, assumptions, friction, stop.at_rest may differ"));
    }
}
