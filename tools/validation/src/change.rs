//! Differences between the case of a run and the base case: `cases/fudo/H4.5-slice.json` with PVC on the whole bed.

use std::collections::{BTreeMap, BTreeSet};

use breakwater::{
    case::file::{CaseFile, Scheme},
    sweep::values::in_words,
};
use serde_json::{Value, json};

/// Base case: two units between periodic sides. The base cases of the three waves differ only in the wave height.
const BASE: &str = include_str!("../../../cases/fudo/H4.5-slice.json");

/// Key of the friction coefficient between units and mound.
pub const FRICTION: &str = "friction.mortar-pvc.coefficient";

/// Key of the material of the bed beside the mound. In the experiment it is mortar; most runs were made with PVC.
pub const BED: &str = "flume.material";

/// Key of the material of the mound. Its default is the material of the bed.
const MOUND: &str = "flume.mound.material";

/// Key of the set of defaults of the SPH scheme.
pub const SCHEME: &str = "numerics.scheme";

/// Key of the number of units.
pub const COUNT: &str = "units.count";

/// Keys that do not change how the units move.
const WITHOUT_EFFECT: [&str; 8] =
    ["$schema", "title", "assumptions", "reference", "output", "gauges", "breakage", "stop"];

/// Keys that are not listed as changes. Tables have separate columns for particle spacing and wave height. The Courant
/// number is not listed, because doubling the time step changes the forces by less than 2 %.
const SHOWN_ELSEWHERE: [&str; 3] = ["domain.dp_m", "numerics.cfl", "wave.height_m"];

/// Keys that must change with the number of units. If [`COUNT`] is a change, these keys are not listed.
const OF_ROW: [&str; 3] = ["domain.sides", "domain.width_m", "units.pitch_m"];

/// Keys of a run with open ends that are not listed as changes. Such a domain is shorter; the tables have a column for
/// it.
const OF_OPEN_ENDS: [&str; 2] = ["wavemaker.kind", "domain.x_m"];

/// A key whose value differs from the base case.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Path of the key. A list element is identified by its name or pair of names: `friction.mortar-pvc.coefficient`.
    pub key: String,
    /// Value in the base case; null if not set.
    pub base: Value,
    /// Value in the run.
    pub value: Value,
}

impl Change {
    /// Value in the run as text for the page.
    pub fn value_in_words(&self) -> String {
        words(&self.value)
    }

    /// Value in the base case as text for the page.
    pub fn base_in_words(&self) -> String {
        words(&self.base)
    }
}

/// Value as text for the page. Numbers from 1e6 on are written with a power of ten.
fn words(value: &Value) -> String {
    match value.as_f64() {
        Some(number) if number >= 1e6 => format!("{number:e}"),
        _ if value.is_null() => "default".to_owned(),
        _ => in_words(value).replace(',', ", "),
    }
}

/// Friction coefficient between units and mound in the base case [-].
pub fn base_friction() -> f64 {
    leaves(&base())[FRICTION].as_f64().unwrap_or(f64::NAN)
}

fn base() -> Value {
    let mut base: Value = serde_json::from_str(BASE).unwrap_or_default();
    base["flume"]["material"] = json!("pvc");
    base
}

/// Returns the places of the open ends of a domain [m], or None if it has none.
pub fn open_ends(case: &Value) -> Option<[f64; 2]> {
    let ends = serde_json::from_value(case["domain"]["x_m"].clone()).ok();
    ends.filter(|_| case["wavemaker"]["kind"] == "open_ends")
}

/// Changes of a case from the base case, sorted by key. If the case has another scheme, its defaults are not listed.
pub fn changes(case: &Value) -> Vec<Change> {
    let (mut base, mut of_case) = (leaves(&base()), leaves(case));
    if base.get(SCHEME) == of_case.get(SCHEME) {
        [&mut base, &mut of_case].into_iter().for_each(add_defaults);
    }
    let value = |leaves: &BTreeMap<String, Value>, key: &str| leaves.get(key).cloned().unwrap_or_default();
    let keys: BTreeSet<&String> = base.keys().chain(of_case.keys()).collect();
    let mut changes: Vec<Change> = (keys.into_iter())
        .filter(|key| !SHOWN_ELSEWHERE.contains(&key.as_str()) && value(&base, key) != value(&of_case, key))
        .map(|key| Change { key: key.clone(), base: value(&base, key), value: value(&of_case, key) })
        .collect();
    if changes.iter().any(|change| change.key == COUNT) {
        changes.retain(|change| !OF_ROW.contains(&change.key.as_str()));
    }
    if open_ends(case).is_some() {
        changes.retain(|change| !OF_OPEN_ENDS.contains(&change.key.as_str()));
    }
    changes
}

/// Adds the defaults that depend on the scheme.
fn add_defaults(leaves: &mut BTreeMap<String, Value>) {
    let scheme = leaves.get(SCHEME).and_then(|scheme| serde_json::from_value::<Scheme>(scheme.clone()).ok());
    let Some(defaults) = scheme.map(Scheme::defaults) else { return };
    let defaults = [
        ("viscosity_alpha", json!(defaults.viscosity_alpha)),
        ("viscosity_beta", json!(defaults.viscosity_beta)),
        ("shifting_coefficient", json!(defaults.shifting_coefficient)),
        ("wall_slip", json!(defaults.wall_slip)),
    ];
    for (key, default) in defaults {
        let value = leaves.entry(format!("numerics.{key}")).or_insert(Value::Null);
        if value.is_null() {
            *value = default;
        }
    }
}

/// Values of all keys of a case by their paths. Defaults are filled in, except those that depend on the scheme.
/// [`WITHOUT_EFFECT`] keys are left out.
fn leaves(case: &Value) -> BTreeMap<String, Value> {
    let complete = serde_json::from_value::<CaseFile>(case.clone()).and_then(serde_json::to_value);
    let mut leaves = BTreeMap::new();
    if let Value::Object(keys) = complete.as_ref().unwrap_or(case) {
        let with_effect = keys.iter().filter(|(key, _)| !WITHOUT_EFFECT.contains(&key.as_str()));
        with_effect.for_each(|(key, value)| collect(key, value, &mut leaves));
    }
    if let (Some(bed), None) = (leaves.get(BED).cloned(), leaves.get(MOUND)) {
        leaves.insert(MOUND.to_owned(), bed);
    }
    leaves
}

fn collect(path: &str, value: &Value, leaves: &mut BTreeMap<String, Value>) {
    match value {
        Value::Object(keys) => keys.iter().for_each(|(key, inner)| collect(&format!("{path}.{key}"), inner, leaves)),
        Value::Array(items) if items.iter().any(Value::is_object) => {
            for (number, item) in items.iter().enumerate() {
                collect(&format!("{path}.{}", name(item).unwrap_or_else(|| number.to_string())), item, leaves);
            }
        }
        leaf => {
            leaves.insert(path.to_owned(), leaf.clone());
        }
    }
}

/// Identifier of a list element: its `name`, or the names in `between`, joined by hyphens.
fn name(item: &Value) -> Option<String> {
    if let Some(name) = item.get("name").and_then(Value::as_str) {
        return Some(name.to_owned());
    }
    let between = item.get("between")?.as_array()?.iter().map(Value::as_str).collect::<Option<Vec<_>>>()?;
    Some(between.join("-"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_keys_with_an_effect_are_changes() {
        let mut case = base();
        case["title"] = json!("another");
        case["reference"] = json!("elsewhere");
        case["domain"]["dp_m"] = json!(0.012);
        case["output"]["series_interval_s"] = json!(0.02);
        case["numerics"]["cfl"] = json!(0.4);
        case["wave"]["height_m"] = json!(0.026);
        // Neither a default that is written out nor another notation of the same number is a change.
        case["numerics"]["viscosity_alpha"] = json!(0.04);
        case["flume"]["mound"]["lee_run_per_rise"] = json!(2);
        assert_eq!(changes(&case), []);
        case["friction"][1]["coefficient"] = json!(0.1);
        case["materials"][1]["young_modulus_pa"] = json!(1.5e9);
        let [friction, modulus] = &changes(&case)[..] else { panic!("{:?}", changes(&case)) };
        assert_eq!((friction.key.as_str(), friction.value.as_f64()), (FRICTION, Some(0.1)));
        assert_eq!(friction.base.as_f64(), Some(base_friction()));
        assert_eq!((modulus.base_in_words(), modulus.value_in_words()), ("1e8".to_owned(), "1.5e9".to_owned()));
    }

    #[test]
    fn open_ends_are_no_change() {
        let mut case = base();
        case["domain"]["x_m"] = json!([37.9, 40.15]);
        assert_eq!(changes(&case).len(), 1);
        case["wavemaker"] = json!({ "kind": "open_ends" });
        assert_eq!(changes(&case), []);
    }

    #[test]
    fn another_scheme_is_one_change() {
        let mut case = base();
        case["numerics"]["scheme"] = json!("low_dissipation");
        assert_eq!(changes(&case).iter().map(|change| change.key.as_str()).collect::<Vec<_>>(), [SCHEME]);
        case["numerics"]["viscosity_alpha"] = json!(0.01);
        assert_eq!(changes(&case).len(), 2);
    }

    #[test]
    fn mortar_beside_a_mound_of_pvc_is_one_change() {
        let mut case: Value = serde_json::from_str(BASE).unwrap();
        assert_eq!(changes(&case).iter().map(|change| change.key.as_str()).collect::<Vec<_>>(), [BED]);
        case["flume"]["material"] = json!("pvc");
        case["flume"]["mound"].as_object_mut().unwrap().remove("material");
        assert_eq!(changes(&case), []);
    }

    #[test]
    fn row_of_fifteen_is_one_change() {
        let mut case = base();
        case["units"]["count"] = json!(15);
        case["units"]["pitch_m"] = json!(0.078);
        case["domain"]["sides"] = json!("walls");
        case["domain"]["width_m"] = json!(1.2);
        assert_eq!(changes(&case).len(), 1);
    }
}
