//! Paths of keys in a case file, as in `friction[1].coefficient`.

use serde_json::{Map, Value};

/// Returns the last part of a key's path, for example `coefficient`.
pub fn short(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// Returns the last two parts of a key's path, for example `mound.crest_width_m`.
pub fn brief(key: &str) -> &str {
    key.rmatch_indices('.').nth(1).map_or(key, |(dot, _)| &key[dot + 1..])
}

/// Returns the value at a path such as `friction[1].coefficient`; null if the path has no value.
pub fn get(root: &Value, path: &str) -> Value {
    let pointer = path.replace(['.', '['], "/").replace(']', "");
    root.pointer(&format!("/{pointer}")).cloned().unwrap_or_default()
}

/// Sets the value at a path such as `friction[1].coefficient`; creates missing objects along the path.
///
/// # Errors
/// If a part of the path is not an object, or a list has no entry with the given index.
pub fn set(root: &mut Value, path: &str, value: Value) -> Result<(), String> {
    let mut target = root;
    for part in path.split('.') {
        let (key, indices) = part.split_once('[').map_or((part, ""), |(key, rest)| (key, rest));
        if key.is_empty() {
            return Err("a part of the path is empty; write a path like friction[1].coefficient".to_owned());
        }
        if target.is_null() {
            *target = Value::Object(Map::new());
        }
        let object = target.as_object_mut().ok_or_else(|| format!("the part before {key} is not an object"))?;
        target = object.entry(key).or_insert(Value::Null);
        for index in indices.split('[').filter(|index| !index.is_empty()) {
            let number: Option<usize> = index.strip_suffix(']').and_then(|number| number.parse().ok());
            let number = number.ok_or_else(|| format!("[{index} is not an index"))?;
            let length = target.as_array().map_or(0, Vec::len);
            target = target.get_mut(number).ok_or_else(|| format!("{key} has {length} entries; the first is [0]"))?;
        }
    }
    *target = value;
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn paths_reach_lists_and_create_missing_objects() {
        let mut case =
            json!({ "friction": [{ "coefficient": 0.5 }, { "coefficient": 0.3 }], "wave": { "height_m": 0.1 } });
        set(&mut case, "friction[1].coefficient", json!(0.4)).unwrap();
        set(&mut case, "wave.height_m", json!(0.2)).unwrap();
        set(&mut case, "numerics.cfl", json!(0.1)).unwrap();
        assert_eq!(case["friction"][1]["coefficient"], 0.4);
        assert_eq!((&case["wave"]["height_m"], &case["numerics"]["cfl"]), (&json!(0.2), &json!(0.1)));
        assert_eq!((get(&case, "friction[1].coefficient"), get(&case, "numerics.h")), (json!(0.4), Value::Null));
        for wrong in ["", "friction[2].coefficient", "friction[x]", "wave.height_m.deep", "wave..height_m"] {
            assert!(set(&mut case, wrong, json!(1)).is_err(), "{wrong}");
        }
    }
}
