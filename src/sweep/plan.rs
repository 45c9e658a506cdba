//! Reads a sweep file and creates the cases of its runs.

use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};
use thiserror::Error;

use super::key::{get, set};
use super::random::RandomValues;
use super::values::{MOST_RUNS, Varied, in_words, label, repetitions};
pub use crate::case::file::Combine;
use crate::case::{Case, CaseError, CaseErrors, Document, InputKind, difference, file::SweepFile};

/// Largest size of the case files of all runs together [bytes]. A sweep keeps them in memory.
const MOST_TEXT: usize = 128 << 20;

/// Reasons why a sweep is refused.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The sweep file or its case cannot be read, or has wrong keys.
    #[error(transparent)]
    File(#[from] CaseError),
    /// The file is not a valid sweep.
    #[error("{}: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong and what is allowed.
        what: String,
    },
    /// The case of a run is refused.
    #[error("run {number} of the sweep ({label}) is refused:\n{errors}")]
    Member {
        /// Number of the run, from 1.
        number: usize,
        /// Varied keys and their values.
        label: String,
        /// Errors in the case of the run.
        errors: CaseErrors,
    },
}

/// One run of a sweep.
#[derive(Debug, Clone)]
pub struct Member {
    /// Number of the run, from 1; 0 is the common start of all runs.
    pub number: usize,
    /// Name of the folder of the run.
    pub name: String,
    /// Values of the varied keys, in the order of the keys; null for keys that the case does not have.
    pub values: Vec<Value>,
    /// Text of the case file of the run.
    pub text: String,
    /// Fingerprint of the case, as in `summary.json`.
    pub hash: String,
    /// Fingerprint of all inputs that affect the run before its units move; see [`Case::start_hash`].
    start_hash: String,
    /// Simulated time at which the common start ends [s]; `None` for all other runs.
    pub until: Option<f64>,
}

/// A validated sweep.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// Title.
    pub title: String,
    /// File of the base case. Relative paths in the case start from the folder of this file.
    pub case: PathBuf,
    /// The varied keys.
    pub varied: Vec<Varied>,
    /// How the values are combined.
    pub combine: Combine,
    /// Number of runs of each combination; they follow one after the other.
    pub repetitions: usize,
    /// The runs. With [`Combine::All`], the last key varies fastest.
    pub members: Vec<Member>,
    /// The common start, if any: a run whose checkpoint is the start of all other runs.
    pub start: Option<Member>,
}

impl Sweep {
    /// Reads a sweep and validates all of its runs.
    ///
    /// # Errors
    /// If the file is not a valid sweep, or the case of a run is refused.
    pub fn load(path: &Path) -> Result<Self, SweepError> {
        Self::new(Document::read(path)?.parse()?, path)
    }

    /// Validates all runs of the sweep in the file `path`.
    ///
    /// # Errors
    /// If the file is not a valid sweep, or the case of a run is refused.
    pub fn new(file: SweepFile, path: &Path) -> Result<Self, SweepError> {
        let content = |what: String| SweepError::Content { path: path.to_owned(), what };
        let case = path.parent().unwrap_or(Path::new("")).join(&file.case);
        let document = Document::read(&case)?;
        if document.kind() != InputKind::Flume {
            return Err(content(format!("case: {} is not a flume case; a sweep needs a flume case", case.display())));
        }
        let mut base = Value::Object(document.parse::<Map<String, Value>>()?);
        let repetitions = repetitions(&file).map_err(&content)?;
        let mut random = RandomValues::new(file.seed);
        let varied = file.vary.iter().enumerate().map(|(k, vary)| match &vary.random {
            None => vary.values(k),
            Some(distribution) => vary.draws(k, *distribution, &mut random, repetitions),
        });
        let varied = varied.collect::<Result<Vec<_>, _>>().map_err(&content)?;
        if varied.is_empty() {
            return Err(content("vary: must contain at least one key".to_owned()));
        }
        let repeated = varied.iter().enumerate().find(|(k, one)| varied[..*k].iter().any(|other| other.key == one.key));
        if let Some((k, one)) = repeated {
            let what = "is varied twice; write all of its values in one entry";
            return Err(content(format!("vary[{k}]: {} {what}", one.key)));
        }
        let given = base.clone();
        let set_alone = file.set.keys().filter(|key| varied.iter().all(|one| one.key != **key));
        let keys: Vec<&str> = set_alone.chain(varied.iter().map(|one| &one.key)).map(String::as_str).collect();
        for (key, value) in &file.set {
            set(&mut base, key, value.clone()).map_err(|what| content(format!("set: {key}: {what}")))?;
        }
        let runs = file
            .combine
            .combinations(&varied)
            .and_then(|count| count.checked_mul(repetitions))
            .filter(|runs| *runs <= MOST_RUNS);
        let runs = runs.ok_or_else(|| content(format!("vary: more than {MOST_RUNS} runs; use fewer values")))?;
        let (mut duration, mut size) = (f64::INFINITY, 0);
        let member = |number: usize| {
            let changes = file.combine.changes(&varied, number / repetitions, number % repetitions);
            let mut text = base.clone();
            for (one, value) in varied.iter().zip(&changes) {
                let Some(value) = value else { continue };
                set(&mut text, &one.key, value.clone())
                    .map_err(|what| content(format!("vary: {}: {what}", one.key)))?;
            }
            note_differences(&mut text, &given, &keys);
            let label = label(&varied, &changes);
            let values = varied.iter().map(|one| get(&text, &one.key)).collect();
            // The title of the base case would be wrong for most runs.
            if !varied.iter().any(|one| one.key == "title") {
                text["title"] = format!("{}: {label}", file.title).into();
            }
            let text = format!("{text:#}");
            size += text.len();
            if size > MOST_TEXT {
                let most = MOST_TEXT >> 20;
                let what = format!("vary: the case files of all {runs} runs need more than {most} MiB; use fewer runs");
                return Err(content(what));
            }
            let case = Case::from_str(&text, &case.display().to_string()).map_err(|errors| SweepError::Member {
                number: number + 1,
                label: label.clone(),
                errors,
            })?;
            let name = format!("{:03}_{}", number + 1, file_name(&label));
            let Case { hash, start_hash, stop, .. } = case;
            duration = stop.duration;
            Ok(Member { number: number + 1, name, values, text, hash, start_hash, until: None })
        };
        let members = (0..runs).map(member).collect::<Result<Vec<_>, SweepError>>()?;
        let start = file.common_start_s.map(|until| start(&members, until, duration)).transpose().map_err(content)?;
        Ok(Self { title: file.title, case, varied, combine: file.combine, repetitions, members, start })
    }

    /// Returns the run with the number `number`, from 1; 0 gives the common start.
    pub fn member(&self, number: usize) -> Option<&Member> {
        match number.checked_sub(1) {
            Some(index) => self.members.get(index),
            None => self.start.as_ref(),
        }
    }
}

/// Returns the common start: it computes the case of the first run, but only until the time `until` [s]. `duration` [s]
/// is the duration of all other runs.
fn start(members: &[Member], until: f64, duration: f64) -> Result<Member, String> {
    let first = &members[0];
    if let Some(other) = members.iter().find(|other| other.start_hash != first.start_hash) {
        return Err(format!("common_start_s: {}", difference(&first.text, &other.text, &Case::KEYS_FREE_AT_START)));
    }
    if !(until > 0.0 && until < duration) {
        return Err(format!("common_start_s = {until}: must be above 0 and below stop.duration_s, {duration}"));
    }
    Ok(Member { number: 0, name: "000_start".to_owned(), values: Vec::new(), until: Some(until), ..first.clone() })
}

/// Adds the changed keys to the assumptions of a run. Reports print these assumptions; the assumptions of the base case
/// are true only for the values of the base case.
fn note_differences(run: &mut Value, given: &Value, keys: &[&str]) {
    let differs = |key: &&str| {
        let (now, before) = (get(run, key), get(given, key));
        let base = if before.is_null() { "not set".to_owned() } else { in_words(&before) };
        (now != before).then(|| format!("{key} = {} (base case: {base})", in_words(&now)))
    };
    let differences: Vec<String> = keys.iter().filter_map(differs).collect();
    if differences.is_empty() {
        return;
    }
    let sentence = format!("Changed from the base case of the sweep: {}.", differences.join(", "));
    match &mut run["assumptions"] {
        Value::Array(assumptions) => assumptions.push(sentence.into()),
        none @ Value::Null => *none = json!([sentence]),
        _ => (), // The validation of the case refuses other types.
    }
}

/// Converts a text to a folder name: special characters become `_`, and at most 80 characters are kept.
fn file_name(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-=".contains(c) { c } else { '_' };
    text.chars().map(plain).take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_whose_cases_fill_the_memory_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut case: Value = serde_json::from_str(&crate::case::template_text()).unwrap();
        // Ten runs of 15 MiB exceed the limit of 128 MiB.
        case["assumptions"] = json!(["x".repeat(15 << 20)]);
        std::fs::write(folder.path().join("case.json"), case.to_string()).unwrap();
        let path = folder.path().join("sweep.json");
        let sweep = r#"{ "title": "Large", "case": "case.json",
            "vary": [{ "key": "stop.duration_s", "from": 11, "to": 20, "count": 10 }] }"#;
        std::fs::write(&path, sweep).unwrap();
        let message = Sweep::load(&path).unwrap_err().to_string();
        let expected = "sweep.json: vary: the case files of all 10 runs need more than 128 MiB; use fewer runs";
        assert!(message.ends_with(expected), "{message}");
    }

    #[test]
    fn assumptions_of_a_run_list_changed_keys() {
        let given = json!({ "assumptions": ["The crest is 0.32 m wide."], "crest_width_m": 0.32, "dp_m": 0.007 });
        let mut run = given.clone();
        note_differences(&mut run, &given, &["crest_width_m", "dp_m", "numerics.cfl"]);
        assert_eq!(run, given);
        run["crest_width_m"] = json!(0.28);
        set(&mut run, "numerics.cfl", json!(0.4)).unwrap();
        note_differences(&mut run, &given, &["crest_width_m", "dp_m", "numerics.cfl"]);
        let added = "Changed from the base case of the sweep: crest_width_m = 0.28 (base case: 0.32), \
                     numerics.cfl = 0.4 (base case: not set).";
        assert_eq!(run["assumptions"], json!(["The crest is 0.32 m wide.", added]));
        let mut bare = json!({ "dp_m": 0.014 });
        note_differences(&mut bare, &given, &["dp_m"]);
        assert_eq!(bare["assumptions"][0], "Changed from the base case of the sweep: dp_m = 0.014 (base case: 0.007).");
    }

    #[test]
    fn folder_names_are_plain() {
        assert_eq!(file_name("a=2.0 b=[1,2]"), "a=2.0_b=_1_2_");
    }
}
