//! The sweep file, and the runs that follow from it.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use thiserror::Error;

use super::key::{get, set, short};
use crate::{
    case::{Case, CaseErrors},
    simulation::flume::branch::difference,
};

/// Most runs of one sweep.
const MOST_RUNS: usize = 10_000;

/// Why a sweep is refused.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// It is no sweep.
    #[error("{}: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what is needed.
        what: String,
    },
    /// A run would be refused.
    #[error("run {number} of the sweep ({label}) is refused:\n{errors}")]
    Member {
        /// Its number, from 1.
        number: usize,
        /// What varies in it.
        label: String,
        /// What is wrong with its case.
        errors: CaseErrors,
    },
}

/// A sweep: one case with keys that vary, every combination of their values a run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SweepFile {
    /// Where the JSON schema lies, for editors (`breakwater schema --sweep` prints it). Not used by the solver.
    #[serde(rename = "$schema", default)]
    _schema: Option<String>,
    /// Title of table and chart.
    title: String,
    /// The case file, from where the sweep file lies; files that it names are looked for beside it.
    case: PathBuf,
    /// Keys that have other values than in the case, the same in all runs: `{"domain.dp_m": 0.014}`.
    #[serde(default)]
    set: Map<String, Value>,
    /// Keys with their values; the last one varies fastest.
    vary: Vec<VaryFile>,
    /// Which of their values meet in a run.
    #[serde(default)]
    combine: Combine,
    /// Simulated time [s] until which the units stand still in every run: up to there one run is made, with the first
    /// values, and the others begin at its checkpoint. Only friction, the rule of rest and titles may vary then.
    #[schemars(extend("exclusiveMinimum" = 0))]
    common_start_s: Option<f64>,
}

/// Which values of the keys that vary meet in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Combine {
    /// Every value of a key with every one of the others.
    #[default]
    All,
    /// The case as it is, then every value alone: how much hangs on each of them.
    OneAtATime,
}

/// A key of the case with its values: either `values`, or `from`, `to` and `count`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct VaryFile {
    /// Path of the key, as in `domain.dp_m` or `friction[1].coefficient`.
    key: String,
    /// Its values: numbers, texts, whatever the key takes.
    #[schemars(length(min = 1))]
    values: Option<Vec<Value>>,
    /// First value.
    from: Option<f64>,
    /// Last value.
    to: Option<f64>,
    /// How many values at equal distances, both ends included.
    #[schemars(range(min = 2, max = 10_000))]
    count: Option<usize>,
}

/// JSON schema of sweep files, indented.
pub fn schema_text() -> String {
    format!("{:#}", schemars::schema_for!(SweepFile).as_value())
}

/// A key of the case and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Path of the key, as in `friction[1].coefficient`.
    pub key: String,
    /// Its values.
    pub values: Vec<Value>,
}

/// One run.
#[derive(Debug, Clone)]
pub struct Member {
    /// Number, from 1; 0 is the common start.
    pub number: usize,
    /// Name of its folder.
    pub name: String,
    /// Values of the varied keys, in their order; null where the case does not have it.
    pub values: Vec<Value>,
    /// The case file's text.
    pub text: String,
    /// Hash of the case, as in summaries.
    pub hash: String,
    /// Hash of what decides where the run stands while its units have not moved, see [`Case::start_hash`].
    start_hash: String,
    /// Simulated time at which the common start ends [s].
    pub until: Option<f64>,
}

/// A sweep.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// Title.
    pub title: String,
    /// The case that is varied; files that it names are looked for beside it.
    pub case: PathBuf,
    /// What varies.
    pub varied: Vec<Varied>,
    /// Which values meet in a run.
    pub combine: Combine,
    /// The runs; the last key varies fastest.
    pub members: Vec<Member>,
    /// The run at whose checkpoint the others begin, if there is one.
    pub start: Option<Member>,
}

impl Sweep {
    /// Whether a text is meant to be a sweep.
    pub fn is_one(text: &str) -> bool {
        serde_json::from_str::<Value>(text).is_ok_and(|value| value.get("vary").is_some())
    }

    /// Read a sweep and check every run of it.
    ///
    /// # Errors
    /// If the file is no sweep, or one of its runs would be refused.
    pub fn load(path: &Path) -> Result<Self, SweepError> {
        let content = |what: String| SweepError::Content { path: path.to_owned(), what };
        let read = |path: &Path| {
            std::fs::read_to_string(path).map_err(|source| SweepError::Read { path: path.to_owned(), source })
        };
        let file: SweepFile = serde_json::from_str(&read(path)?).map_err(|error| content(error.to_string()))?;
        let case = path.parent().unwrap_or(Path::new("")).join(&file.case);
        let mut base: Value = serde_json::from_str(&read(&case)?)
            .map_err(|error| SweepError::Content { path: case.clone(), what: error.to_string() })?;
        if !base.is_object() {
            return Err(SweepError::Content { path: case, what: "must hold an object, { ... }".to_owned() });
        }
        let varied = file.vary.iter().enumerate().map(|(k, vary)| vary.values(k)).collect::<Result<Vec<_>, _>>();
        let varied = varied.map_err(&content)?;
        if varied.is_empty() {
            return Err(content("vary: must hold at least one key".to_owned()));
        }
        let given = base.clone();
        let set_alone = file.set.keys().filter(|key| varied.iter().all(|one| one.key != **key));
        let keys: Vec<&str> = set_alone.chain(varied.iter().map(|one| &one.key)).map(String::as_str).collect();
        for (key, value) in &file.set {
            set(&mut base, key, value.clone()).map_err(|what| content(format!("set: {key}: {what}")))?;
        }
        let runs = file.combine.runs(&varied).filter(|runs| *runs <= MOST_RUNS);
        let runs = runs.ok_or_else(|| content(format!("vary: these are more than {MOST_RUNS} runs; take fewer")))?;
        let mut duration = f64::INFINITY;
        let member = |number: usize| {
            let changes = file.combine.changes(&varied, number);
            let mut text = base.clone();
            for (one, value) in varied.iter().zip(&changes) {
                let Some(value) = value else { continue };
                set(&mut text, &one.key, value.clone())
                    .map_err(|what| content(format!("vary: {}: {what}", one.key)))?;
            }
            say_what_differs(&mut text, &given, &keys);
            let label = label(&varied, &changes);
            let values = varied.iter().map(|one| get(&text, &one.key)).collect();
            // The title of the case that is varied would be wrong for most runs.
            if !varied.iter().any(|one| one.key == "title") {
                text["title"] = format!("{}: {label}", file.title).into();
            }
            let text = format!("{text:#}");
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

    /// The run with a number, 0 for the common start.
    pub fn member(&self, number: usize) -> Option<&Member> {
        match number.checked_sub(1) {
            Some(place) => self.members.get(place),
            None => self.start.as_ref(),
        }
    }
}

/// The first run, ended at a time [s] at which the others can begin; all of them last as long [s].
fn start(members: &[Member], until: f64, duration: f64) -> Result<Member, String> {
    let first = &members[0];
    if let Some(other) = members.iter().find(|other| other.start_hash != first.start_hash) {
        return Err(format!("common_start_s: {}", difference(&first.text, &other.text)));
    }
    if !(until > 0.0 && until < duration) {
        return Err(format!("common_start_s = {until}: must be above 0 and below stop.duration_s, {duration}"));
    }
    Ok(Member { number: 0, name: "000_start".to_owned(), values: Vec::new(), until: Some(until), ..first.clone() })
}

impl VaryFile {
    fn values(&self, number: usize) -> Result<Varied, String> {
        let at = format!("vary[{number}] ({})", self.key);
        let values = match (&self.values, self.from, self.to, self.count) {
            (Some(values), None, None, None) if !values.is_empty() => values.clone(),
            (None, Some(from), Some(to), Some(count)) if (2..=MOST_RUNS).contains(&count) => {
                let step = (to - from) / (count - 1) as f64;
                // Twelve digits: 0.1 + 2 * 0.11 is 0.32 to whoever reads it.
                let value = |k: usize| (1e12 * (from + k as f64 * step)).round() / 1e12;
                (0..count).map(|k| json!(value(k))).collect()
            }
            _ => {
                return Err(format!(
                    "{at}: must have either `values`, a list, or `from`, `to` and `count`, two values or more"
                ));
            }
        };
        Ok(Varied { key: self.key.clone(), values })
    }
}

impl Combine {
    /// How many runs; none if they cannot be counted.
    fn runs(self, varied: &[Varied]) -> Option<usize> {
        let mut values = varied.iter().map(|one| one.values.len());
        match self {
            Self::All => values.try_fold(1, usize::checked_mul),
            Self::OneAtATime => values.try_fold(1, usize::checked_add),
        }
    }

    /// What the run with a number from 0 has in the place of the case's values; none where it keeps them.
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

/// Values of the run with a number from 0.
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

/// Add to the assumptions of a run in which of the keys it differs from the case as given: what is assumed there is said
/// of the values given, and reports would carry it on.
fn say_what_differs(run: &mut Value, given: &Value, keys: &[&str]) {
    let differs = |key: &&str| {
        let (now, before) = (get(run, key), get(given, key));
        let there = if before.is_null() { "not set".to_owned() } else { in_words(&before) };
        (now != before).then(|| format!("{key} = {} (there {there})", in_words(&now)))
    };
    let differences: Vec<String> = keys.iter().filter_map(differs).collect();
    if differences.is_empty() {
        return;
    }
    let sentence = format!("Not as in the case that the sweep varies: {}.", differences.join(", "));
    match &mut run["assumptions"] {
        Value::Array(assumptions) => assumptions.push(sentence.into()),
        none @ Value::Null => *none = json!([sentence]),
        _ => (), // Refused when the case is read.
    }
}

/// What a run changes in words: `coefficient=0.32 height_m=0.045`.
fn label(varied: &[Varied], changes: &[Option<Value>]) -> String {
    let one =
        |(one, value): (&Varied, &Option<Value>)| Some(format!("{}={}", short(&one.key), in_words(value.as_ref()?)));
    let words: Vec<String> = varied.iter().zip(changes).filter_map(one).collect();
    if words.is_empty() { "as_given".to_owned() } else { words.join(" ") }
}

/// A value without quotes; nothing for null.
pub fn in_words(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// A text as the name of a folder.
fn file_name(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-=".contains(c) { c } else { '_' };
    text.chars().map(plain).take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_their_ends_and_no_crooked_digits() {
        let vary = VaryFile { key: "a.b".to_owned(), values: None, from: Some(0.1), to: Some(0.98), count: Some(9) };
        let values: Vec<f64> = vary.values(0).unwrap().values.iter().map(|v| v.as_f64().unwrap()).collect();
        assert_eq!(values, [0.1, 0.21, 0.32, 0.43, 0.54, 0.65, 0.76, 0.87, 0.98]);
        let both = VaryFile { values: Some(vec![json!(1)]), ..vary };
        assert!(both.values(3).unwrap_err().contains("vary[3] (a.b)"));
    }

    #[test]
    fn what_is_assumed_of_the_case_is_corrected_in_a_run() {
        let given = json!({ "assumptions": ["The crest is 0.32 m wide."], "crest_width_m": 0.32, "dp_m": 0.007 });
        let mut run = given.clone();
        say_what_differs(&mut run, &given, &["crest_width_m", "dp_m", "numerics.cfl"]);
        assert_eq!(run, given);
        run["crest_width_m"] = json!(0.28);
        set(&mut run, "numerics.cfl", json!(0.4)).unwrap();
        say_what_differs(&mut run, &given, &["crest_width_m", "dp_m", "numerics.cfl"]);
        let said = "Not as in the case that the sweep varies: crest_width_m = 0.28 (there 0.32), \
                    numerics.cfl = 0.4 (there not set).";
        assert_eq!(run["assumptions"], json!(["The crest is 0.32 m wide.", said]));
        let mut silent = json!({ "dp_m": 0.014 });
        say_what_differs(&mut silent, &given, &["dp_m"]);
        assert_eq!(silent["assumptions"][0], "Not as in the case that the sweep varies: dp_m = 0.014 (there 0.007).");
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
