//! Identity of a case in a checkpoint: decides whether a run can continue with the case in its folder.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::hash::fingerprint;

/// Keys that may change before a run continues. They change neither the motion nor the form of the output files.
const KEYS_FREE_TO_RESUME: [&str; 12] = [
    "title",
    "assumptions",
    "reference",
    "stop",
    "output.fluid_interval_s",
    "output.units_interval_s",
    "output.surface_interval_s",
    "output.series_interval_s",
    "output.checkpoint_interval_s",
    "output.surfaces_interval_s",
    "output.tets_interval_s",
    "output.energy_interval_s",
];

/// A case as a checkpoint stores it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseIdentity {
    /// Fingerprint of the case and the files that it refers to, without the keys that may change.
    hash: String,
    /// Text of the case file, to name the keys that differ.
    text: String,
}

impl CaseIdentity {
    /// Returns the identity of the parsed case `file` with the text `text`; `read` is the content of the files that the
    /// case refers to.
    pub(in crate::case) fn new(file: &impl Serialize, read: &[u8], text: &str) -> Self {
        // The structs have text keys only, so the conversion cannot fail.
        let mut value = serde_json::to_value(file).unwrap_or_default();
        if let Value::Object(keys) = &mut value {
            remove_keys(keys, &KEYS_FREE_TO_RESUME);
        }
        Self { hash: fingerprint(&value, read), text: text.to_owned() }
    }

    /// Checks that a run with this case can continue with the case `now`.
    ///
    /// # Errors
    /// The keys that differ, and the keys that may differ.
    pub fn check(&self, now: &Self) -> Result<(), String> {
        if self.hash == now.hash {
            return Ok(());
        }
        let reason = difference(&self.text, &now.text, &KEYS_FREE_TO_RESUME);
        Err(format!("was written with another case than case.json in its folder: {reason}"))
    }
}

/// Returns a message that lists the keys in which two case files differ, and the keys that may differ.
pub fn difference(one: &str, other: &str, free: &[&str]) -> String {
    let keys = differing_keys(one, other, free);
    let allowed = free.join(", ");
    if keys.is_empty() {
        return "a file that both cases use has changed".to_owned();
    }
    format!("the cases differ in {}; only {allowed} may differ", keys.join(", "))
}

/// Returns the keys in which two case files differ, except the keys `free`; a key inside an object is named with the key
/// of the object.
fn differing_keys(one: &str, other: &str, free: &[&str]) -> Vec<String> {
    let parsed = |text: &str| {
        let mut keys: Map<String, Value> =
            serde_json::from_str(text.trim_start_matches('\u{feff}')).unwrap_or_default();
        remove_keys(&mut keys, free);
        keys
    };
    let mut found = Vec::new();
    compare("", &parsed(one), &parsed(other), &mut found);
    found.sort_unstable();
    found.dedup();
    found
}

fn compare(prefix: &str, one: &Map<String, Value>, other: &Map<String, Value>, found: &mut Vec<String>) {
    for key in one.keys().chain(other.keys()) {
        match (one.get(key), other.get(key)) {
            (Some(Value::Object(a)), Some(Value::Object(b))) => compare(&format!("{prefix}{key}."), a, b, found),
            (a, b) if a != b => found.push(format!("{prefix}{key}")),
            _ => {}
        }
    }
}

/// Removes `$schema` and keys such as `title` or `stop.at_rest` from a case.
fn remove_keys(case: &mut Map<String, Value>, free: &[&str]) {
    case.remove("$schema");
    for path in free {
        match path.split_once('.') {
            None => drop(case.remove(*path)),
            Some((outer, inner)) => {
                if let Some(keys) = case.get_mut(outer).and_then(Value::as_object_mut) {
                    keys.remove(inner);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_free_keys_may_differ() {
        let free = ["title", "friction", "stop.at_rest"];
        let case = r#"{ "title": "a", "friction": [0.3], "stop": { "duration_s": 1 }, "wave": { "height_m": 0.1 } }"#;
        let other = r#"{ "title": "b", "friction": [0.5], "stop": { "duration_s": 1, "at_rest": {} },
            "wave": { "height_m": 0.1 } }"#;
        assert!(differing_keys(case, other, &free).is_empty());
        let another = r#"{ "stop": { "duration_s": 2 }, "wave": { "height_m": 0.2 }, "gauges": [] }"#;
        assert_eq!(differing_keys(case, another, &free), ["gauges", "stop.duration_s", "wave.height_m"]);
        assert!(difference(case, another, &free).ends_with("; only title, friction, stop.at_rest may differ"));
    }

    #[test]
    fn identity_ignores_titles_stop_rules_and_intervals() {
        let identity = |text: &str| CaseIdentity::new(&serde_json::from_str::<Value>(text).unwrap(), b"", text);
        let first = identity(r#"{ "title": "a", "stop": { "duration_s": 1 }, "output": { "series_interval_s": 1 } }"#);
        let longer = identity(r#"{ "title": "b", "stop": { "duration_s": 2 }, "output": { "series_interval_s": 2 } }"#);
        assert_eq!(first.check(&longer), Ok(()));
        let changed = identity(r#"{ "title": "a", "output": { "fluid_fields": ["id"] } }"#);
        let message = first.check(&changed).unwrap_err();
        assert!(message.contains("the cases differ in output.fluid_fields; only title,"), "{message}");
    }
}
