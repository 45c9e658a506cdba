//! In what the case of a run differs from the one of `cases/fudo` that it comes from.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::{
    case::file::CaseFile,
    sweep::{
        key::{brief, short},
        plan::in_words,
    },
};

/// The cases as they are given, for one of the waves: the slice, the row of fifteen behind a near wavemaker and behind
/// the published one.
const GIVEN: [&str; 3] = [
    include_str!("../../cases/fudo/H4.5-slice.json"),
    include_str!("../../cases/fudo/H4.5-row.json"),
    include_str!("../../cases/fudo/H4.5-full.json"),
];

/// Keys that do not change how the units move until the run ends.
const OF_NO_MATTER: [&str; 7] = ["$schema", "title", "assumptions", "output", "gauges", "fracture", "stop"];

/// The distance between particles and the Courant number have columns of their own, a wave has a section. Twice the step
/// changes the force along the flume on units that stand by less than 2 % (`docs/validation.md`, the time step).
const TOLD_ELSEWHERE: [&str; 3] = ["domain.dp_m", "numerics.cfl", "wave.height_m"];

/// Either way of turning the units is a simulation of the experiment: SPH1 and SPH2 of the paper.
const EITHER_WAY: [&str; 2] = ["alternating", "alternating_reversed"];

/// A key that a run has otherwise than the case as it is given; no value where one of them does not have it.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Path of the key; an element of a list goes by its names if it has any: `friction.mortar-pvc.coefficient`.
    pub key: String,
    /// Value in the run.
    pub value: Option<Value>,
    /// Value as given.
    pub given: Option<Value>,
}

impl Change {
    /// Whether it is one of friction.
    pub fn is_of_friction(&self) -> bool {
        self.key.starts_with("friction.")
    }

    /// The change in words: `flume.mound.crest_width_m 0.36 for 0.32`.
    pub fn in_words(&self) -> String {
        let value = words(self.value.as_ref());
        match &self.given {
            Some(given) => format!("`{}` {value} for {}", self.key, words(Some(given))),
            None => format!("`{}` {value}, not set as given", self.key),
        }
    }

    /// The last part of the key and the value, for the legend of a chart: `crest_width_m 0.36`.
    pub fn in_brief(&self) -> String {
        format!("{} {}", short(&self.key), words(self.value.as_ref()))
    }

    /// The last two parts of the key and the value as given, for a chart of what hangs on it: `mound.crest_width_m 0.32`.
    pub fn given_in_brief(&self) -> String {
        match &self.given {
            Some(given) => format!("{} {}", brief(&self.key), words(Some(given))),
            None => brief(&self.key).to_owned(),
        }
    }

    /// The value in the run, in words.
    pub fn value_in_words(&self) -> String {
        words(self.value.as_ref())
    }
}

/// A value as people write it: large numbers with a power of ten.
fn words(value: Option<&Value>) -> String {
    match value.map(|value| (value, value.as_f64())) {
        None => "not set".to_owned(),
        Some((_, Some(number))) if number.abs() >= 1e6 => format!("{number:e}"),
        Some((value, _)) => in_words(value),
    }
}

/// Changes of a case from that of the given ones which is nearest to it, by the paths of the keys; what is told elsewhere
/// is left out.
pub fn changes(case: &Value) -> Vec<Change> {
    let leaves = leaves_of(case);
    let from = |given: &str| {
        let given = leaves_of(&serde_json::from_str(given).unwrap_or_default());
        let keys: BTreeMap<&String, ()> = leaves.keys().chain(given.keys()).map(|key| (key, ())).collect();
        let differs = |key: &&String| {
            let (value, given) = (leaves.get(*key), given.get(*key));
            let is_either_way = |value: Option<&Value>| {
                value.and_then(Value::as_str).is_some_and(|turned| EITHER_WAY.contains(&turned))
            };
            value != given && !(*key == "units.orientation" && is_either_way(value) && is_either_way(given))
        };
        let changed = keys.into_keys().filter(differs).filter(|key| !TOLD_ELSEWHERE.contains(&key.as_str()));
        let change =
            |key: &String| Change { key: key.clone(), value: leaves.get(key).cloned(), given: given.get(key).cloned() };
        changed.map(change).collect::<Vec<Change>>()
    };
    GIVEN.into_iter().map(from).min_by_key(Vec::len).unwrap_or_default()
}

/// Values at the ends of all paths of a case, with the defaults that it does not write.
fn leaves_of(case: &Value) -> BTreeMap<String, Value> {
    let written_out =
        serde_json::from_value::<CaseFile>(case.clone()).ok().and_then(|file| serde_json::to_value(file).ok());
    let mut leaves = BTreeMap::new();
    if let Value::Object(keys) = written_out.as_ref().unwrap_or(case) {
        for (key, value) in keys.iter().filter(|(key, _)| !OF_NO_MATTER.contains(&key.as_str())) {
            collect(key, value, &mut leaves);
        }
    }
    leaves
}

fn collect(path: &str, value: &Value, leaves: &mut BTreeMap<String, Value>) {
    match value {
        Value::Object(keys) => keys.iter().for_each(|(key, inner)| collect(&format!("{path}.{key}"), inner, leaves)),
        Value::Array(items) if items.iter().any(Value::is_object) => {
            for (number, item) in items.iter().enumerate() {
                collect(&format!("{path}.{}", name_of(item).unwrap_or_else(|| number.to_string())), item, leaves);
            }
        }
        leaf => {
            leaves.insert(path.to_owned(), leaf.clone());
        }
    }
}

/// The names that an element of a list goes by.
fn name_of(item: &Value) -> Option<String> {
    if let Some(name) = item.get("name").and_then(Value::as_str) {
        return Some(name.to_owned());
    }
    let between = item.get("between")?.as_array()?.iter().map(Value::as_str).collect::<Option<Vec<_>>>()?;
    Some(between.join("-"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_what_differs_and_matters_is_told() {
        let mut case: Value = serde_json::from_str(GIVEN[2]).unwrap();
        assert_eq!(changes(&case), []);
        case["title"] = json!("another");
        case["domain"]["dp_m"] = json!(0.012);
        case["output"]["series_interval_s"] = json!(0.02);
        case["numerics"]["cfl"] = json!(0.4);
        case["wave"]["height_m"] = json!(0.026);
        case["units"]["orientation"] = json!("alternating_reversed");
        // A default that is written, and numbers written otherwise.
        case["numerics"]["viscosity_alpha"] = json!(0.04);
        case["flume"]["mound"]["lee_run_per_rise"] = json!(2);
        assert_eq!(changes(&case), []);
        case["units"]["orientation"] = json!("seaward");
        assert_eq!(changes(&case)[0].in_words(), "`units.orientation` seaward for alternating");
        case["units"]["orientation"] = json!("alternating");
        case["friction"][1]["coefficient"] = json!(0.1);
        case["numerics"]["gap_pressure"] = json!(false);
        let words: Vec<String> = changes(&case).iter().map(Change::in_words).collect();
        let friction = "`friction.mortar-pvc.coefficient` 0.1 for 0.32";
        assert_eq!(words, [friction, "`numerics.gap_pressure` false, not set as given"]);
        assert_eq!(changes(&case)[1].in_brief(), "gap_pressure false");
        assert_eq!(changes(&case)[0].given_in_brief(), "mortar-pvc.coefficient 0.32");
        assert_eq!(changes(&case)[1].given_in_brief(), "numerics.gap_pressure");
        assert_eq!(changes(&case)[1].value_in_words(), "false");
        case["materials"][1]["young_modulus_pa"] = json!(1.5e9);
        assert_eq!(changes(&case)[1].in_words(), "`materials.pvc.young_modulus_pa` 1.5e9 for 1e8");
        assert_eq!(changes(&case).iter().filter(|change| change.is_of_friction()).count(), 1);
    }
}
