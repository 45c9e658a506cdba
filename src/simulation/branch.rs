//! Runs that begin where another one stands: one flume, one wave, and units that have not moved yet.

use std::{fs, path::Path, sync::Arc};

use serde_json::{Map, Value};

use super::{
    Units,
    checkpoint::{self, Checkpoint},
    run::{RunError, RunOptions, drive, reopen},
};
use crate::{
    case::Case,
    output::{Impacts, OutputError, Summary, write_atomically},
};

/// What a run may have otherwise than the one that it begins from: units at rest know nothing of it.
pub const MAY_DIFFER: [&str; 4] = ["title", "assumptions", "friction", "stop"];

/// What belongs to the run as a whole, or to its case.
const NOT_COPIED: [&str; 7] = [
    "case.json",
    Checkpoint::FILE,
    Checkpoint::FAILED_FILE,
    Summary::FILE,
    "report.html",
    "picture.svg",
    Impacts::FILE,
];

/// Units that have moved less than this share of their height stand still: rolling and sliding begin after it.
const STILL: f64 = 0.01;

/// Keys at the top of two case files in which they differ, but for those that may.
pub fn apart(one: &str, other: &str) -> Vec<String> {
    let parsed = |text: &str| serde_json::from_str::<Map<String, Value>>(text).unwrap_or_default();
    let (one, other) = (parsed(one), parsed(other));
    let mut keys: Vec<&String> = one.keys().chain(other.keys()).collect();
    keys.sort_unstable();
    keys.dedup();
    let differs = |key: &&String| !MAY_DIFFER.contains(&key.as_str()) && one.get(*key) != other.get(*key);
    keys.into_iter().filter(differs).cloned().collect()
}

/// Run a case into an existing, empty folder from the checkpoint of another run on, whose case is the same but for
/// [`MAY_DIFFER`] (see [`apart`]). What that run has written until then is taken over.
///
/// # Errors
/// As [`super::run::run`], and if the other run has no checkpoint, or its units have moved.
pub fn branch(case: Arc<Case>, from: &Path, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
    let failed = |error: std::io::Error| OutputError::io(from)(error);
    for entry in fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let (path, name) = (entry.path(), entry.file_name());
        if path.is_file() && !NOT_COPIED.iter().any(|known| name == *known) {
            fs::copy(&path, dir.join(&name)).map_err(OutputError::io(&path))?;
        }
    }
    write_atomically(&dir.join("case.json"), case.text.as_bytes())?;
    checkpoint::adopt(from, dir, &case.hash)?;
    let (mut simulation, recorder) = reopen(case, dir, options)?;
    let time = simulation.flume_time();
    let moved = simulation.units.iter().flat_map(Units::displacements).fold(0.0, f64::max);
    let height = simulation.units.as_ref().map_or(0.0, |units| units.shape.height());
    if moved > STILL * height {
        // Without it nothing goes on from here.
        let checkpoint = dir.join(Checkpoint::FILE);
        fs::remove_file(&checkpoint).map_err(OutputError::io(&checkpoint))?;
        return Err(RunError::NoStart { from: from.display().to_string(), time, moved });
    }
    let warning = format!("until {time:.3} s this is a run of another friction or end, while the units stood still");
    simulation.statistics.warnings.push(warning);
    drive(simulation, recorder, dir, options)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_that_differ_in_what_units_at_rest_do_not_feel_are_not_apart() {
        let case = r#"{ "title": "a", "friction": [{ "coefficient": 0.3 }], "stop": 1, "wave": { "height_m": 0.1 } }"#;
        let other = r#"{ "title": "b", "friction": [{ "coefficient": 0.5 }], "wave": { "height_m": 0.1 } }"#;
        assert!(apart(case, other).is_empty());
        let another = r#"{ "wave": { "height_m": 0.2 }, "gauges": [] }"#;
        assert_eq!(apart(case, another), ["gauges", "wave"]);
    }
}
