//! Reads a sweep file and creates the cases of its runs.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};
use thiserror::Error;

use super::key::{get, set, short};
pub use crate::case::file::Combine;
use crate::case::{
    Case, CaseError, CaseErrors, Document, InputKind, difference,
    file::{SweepFile, VaryFile},
};

/// Largest number of runs in one sweep.
const MOST_RUNS: usize = 10_000;

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

/// A varied key of the case and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Path of the key, as in `friction[1].coefficient`.
    pub key: String,
    /// Values of the key.
    pub values: Vec<Value>,
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
        let varied = file.vary.iter().enumerate().map(|(k, vary)| vary.values(k)).collect::<Result<Vec<_>, _>>();
        let varied = varied.map_err(&content)?;
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
        let runs = file.combine.runs(&varied).filter(|runs| *runs <= MOST_RUNS);
        let runs = runs.ok_or_else(|| content(format!("vary: more than {MOST_RUNS} runs; use fewer values")))?;
        let (mut duration, mut size) = (f64::INFINITY, 0);
        let member = |number: usize| {
            let changes = file.combine.changes(&varied, number);
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
        Ok(Self { title: file.title, case, varied, combine: file.combine, members, start })
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

impl VaryFile {
    fn values(&self, number: usize) -> Result<Varied, String> {
        let path = format!("vary[{number}] ({})", self.key);
        let values = match (&self.values, self.from, self.to, self.count) {
            (Some(values), None, None, None) if !values.is_empty() => values.clone(),
            (None, Some(from), Some(to), Some(count)) if (2..=MOST_RUNS).contains(&count) => {
                let step = (to - from) / (count - 1) as f64;
                // Round to twelve decimals, so that 0.1 + 2 * 0.11 is written as 0.32.
                let value = |k: usize| (1e12 * (from + k as f64 * step)).round() / 1e12;
                (0..count).map(|k| json!(value(k))).collect()
            }
            _ => {
                return Err(format!(
                    "{path}: must have either `values` (a list) or `from`, `to` and `count` (at least 2)"
                ));
            }
        };
        let mut seen = HashSet::new();
        match values.iter().find(|value| !seen.insert(value.to_string())) {
            Some(value) => Err(format!("{path}: {} is listed twice; write each value once", in_words(value))),
            None => Ok(Varied { key: self.key.clone(), values }),
        }
    }
}

impl Combine {
    /// Returns the number of runs; `None` on overflow.
    fn runs(self, varied: &[Varied]) -> Option<usize> {
        let mut values = varied.iter().map(|one| one.values.len());
        match self {
            Self::All => values.try_fold(1, usize::checked_mul),
            Self::OneAtATime => values.try_fold(1, usize::checked_add),
        }
    }

    /// Returns the value of each varied key in run `number` (from 0); `None` for keys that keep the value of the base
    /// case.
    fn changes(self, varied: &[Varied], number: usize) -> Vec<Option<Value>> {
        if self == Self::All {
            return combination(varied, number).into_iter().map(Some).collect();
        }
        let mut changes = vec![None; varied.len()];
        let mut alone =
            varied.iter().enumerate().flat_map(|(key, one)| one.values.iter().map(move |value| (key, value)));
        if let Some((key, value)) = number.checked_sub(1).and_then(|before| alone.nth(before)) {
            changes[key] = Some(value.clone());
        }
        changes
    }
}

/// Returns the combination of values in run `number` (from 0); the last key varies fastest.
fn combination(varied: &[Varied], mut number: usize) -> Vec<Value> {
    let mut values: Vec<Value> = varied
        .iter()
        .rev()
        .map(|one| {
            let value = one.values[number % one.values.len()].clone();
            number /= one.values.len();
            value
        })
        .collect();
    values.reverse();
    values
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

/// Returns the keys that a run changes, with their values, as in `coefficient=0.32 height_m=0.045`.
fn label(varied: &[Varied], changes: &[Option<Value>]) -> String {
    let one =
        |(one, value): (&Varied, &Option<Value>)| Some(format!("{}={}", short(&one.key), in_words(value.as_ref()?)));
    let words: Vec<String> = varied.iter().zip(changes).filter_map(one).collect();
    if words.is_empty() { "as_given".to_owned() } else { words.join(" ") }
}

/// Returns a value as text without quotes; empty for null.
pub fn in_words(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
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
    fn ranges_include_both_ends_and_have_short_decimals() {
        let vary = VaryFile { key: "a.b".to_owned(), values: None, from: Some(0.1), to: Some(0.98), count: Some(9) };
        let values: Vec<f64> = vary.values(0).unwrap().values.iter().map(|v| v.as_f64().unwrap()).collect();
        assert_eq!(values, [0.1, 0.21, 0.32, 0.43, 0.54, 0.65, 0.76, 0.87, 0.98]);
        let both = VaryFile { values: Some(vec![json!(1)]), ..vary.clone() };
        assert!(both.values(3).unwrap_err().contains("vary[3] (a.b)"));
        let list = |values: Value| VaryFile {
            values: values.as_array().cloned(),
            from: None,
            to: None,
            count: None,
            ..vary.clone()
        };
        assert!(list(json!([0.3, 0.4, "x", [1, 2]])).values(0).is_ok());
        for twice in [json!([0.3, 0.4, 0.3]), json!(["a", "a"]), json!([null, 1, null])] {
            assert!(list(twice).values(0).unwrap_err().ends_with(" is listed twice; write each value once"));
        }
    }

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
    fn the_last_key_varies_fastest() {
        let one = |key: &str, values: &[f64]| Varied {
            key: key.to_owned(),
            values: values.iter().map(|v| json!(v)).collect(),
        };
        let varied = [one("x.a", &[1.0, 2.0]), one("b", &[3.0, 4.0, 5.0])];
        assert_eq!(combination(&varied, 0), [json!(1.0), json!(3.0)]);
        assert_eq!(combination(&varied, 2), [json!(1.0), json!(5.0)]);
        assert_eq!(combination(&varied, 3), [json!(2.0), json!(3.0)]);
        assert_eq!((Combine::All.runs(&varied), Combine::OneAtATime.runs(&varied)), (Some(6), Some(6)));
        assert_eq!(label(&varied, &Combine::All.changes(&varied, 5)), "a=2.0 b=5.0");
        let alone: Vec<String> = (0..6).map(|k| label(&varied, &Combine::OneAtATime.changes(&varied, k))).collect();
        assert_eq!(alone, ["as_given", "a=1.0", "a=2.0", "b=3.0", "b=4.0", "b=5.0"]);
        assert_eq!(file_name("a=2.0 b=[1,2]"), "a=2.0_b=_1_2_");
    }
}
