//! In which keys of the case runs differ.

use std::collections::BTreeMap;

use serde_json::Value;

use super::entry::Entry;

/// Keys that do not change how the units move.
const OF_NO_MATTER: [&str; 6] = ["$schema", "title", "assumptions", "output", "gauges", "fracture"];

/// A key in which runs differ, with the value in each of them; none where a case does not have it.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Path of the key; an element of a list goes by its names if it has any: `friction.mortar-pvc.coefficient`.
    pub key: String,
    /// Values, one for each run.
    pub values: Vec<Option<Value>>,
}

impl Varied {
    /// The value of a run in words.
    pub fn in_words(&self, run: usize) -> String {
        match &self.values[run] {
            None => "\u{2013}".to_owned(),
            Some(Value::String(text)) => text.clone(),
            Some(other) => other.to_string(),
        }
    }

    /// The value of a run as a number.
    pub fn number(&self, run: usize) -> Option<f64> {
        self.values[run].as_ref().and_then(Value::as_f64)
    }

    /// How many different numbers there are.
    pub fn numbers(&self) -> usize {
        let mut numbers: Vec<f64> = (0..self.values.len()).filter_map(|run| self.number(run)).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        numbers.len()
    }
}

/// Keys in which the cases of runs differ, in the order of their paths.
pub fn between(entries: &[&Entry]) -> Vec<Varied> {
    let mut found: BTreeMap<String, Vec<Option<Value>>> = BTreeMap::new();
    for (number, entry) in entries.iter().enumerate() {
        let Value::Object(keys) = &entry.case else { continue };
        for (key, value) in keys.iter().filter(|(key, _)| !OF_NO_MATTER.contains(&key.as_str())) {
            collect(key, value, &mut |path, value| {
                found.entry(path).or_insert_with(|| vec![None; entries.len()])[number] = Some(value.clone());
            });
        }
    }
    let differ = |values: &Vec<Option<Value>>| values.iter().any(|value| *value != values[0]);
    found.into_iter().filter(|(_, values)| differ(values)).map(|(key, values)| Varied { key, values }).collect()
}

/// Calls `visit` with the path and the value of every leaf.
fn collect(path: &str, value: &Value, visit: &mut impl FnMut(String, &Value)) {
    match value {
        Value::Object(keys) => keys.iter().for_each(|(key, inner)| collect(&format!("{path}.{key}"), inner, visit)),
        Value::Array(items) if items.iter().any(Value::is_object) => {
            for (number, item) in items.iter().enumerate() {
                collect(&format!("{path}.{}", name_of(item).unwrap_or_else(|| number.to_string())), item, visit);
            }
        }
        leaf => visit(path.to_owned(), leaf),
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
    use crate::output::{Summary, Table};
    use serde_json::json;
    use std::path::Path;

    fn entry(case: Value) -> Entry {
        let series = Table::of_columns(Path::new("series.csv"), std::iter::empty());
        Entry::for_tests("run", case, Summary::default(), series)
    }

    #[test]
    fn only_what_differs_and_matters_is_told() {
        let case = |title: &str, friction: f64, dp: f64| {
            json!({
                "title": title, "domain": { "dp_m": dp, "x_m": [36.5, 41.0] }, "output": { "surfaces_interval_s": dp },
                "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.65 },
                             { "between": ["mortar", "pvc"], "coefficient": friction }]
            })
        };
        let mut third = case("c", 0.32, 0.007);
        third["numerics"] = json!({ "wall_slip": "original" });
        let entries = [entry(case("a", 0.32, 0.009)), entry(case("b", 0.1, 0.009)), entry(third)];
        let varied = between(&entries.iter().collect::<Vec<_>>());
        let keys: Vec<&str> = varied.iter().map(|one| one.key.as_str()).collect();
        assert_eq!(keys, ["domain.dp_m", "friction.mortar-pvc.coefficient", "numerics.wall_slip"]);
        assert_eq!((varied[0].numbers(), varied[1].number(1)), (2, Some(0.1)));
        assert_eq!([0, 2].map(|run| varied[2].in_words(run)), ["\u{2013}", "original"]);
        assert_eq!(between(&[&entries[0]]), []);
    }
}
