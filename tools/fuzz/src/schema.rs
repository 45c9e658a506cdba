//! Samples of the objects and keys in the JSON schemas of input files.

use std::collections::HashSet;

use serde_json::{Map, Value, json};

use crate::random::Random;

/// The definitions of all schemas: objects with their properties.
pub struct Schemas {
    roots: Vec<Value>,
}

impl Schemas {
    pub fn new() -> Self {
        use breakwater::case;
        let texts = [
            case::schema_text(),
            case::dry_schema_text(),
            case::fracture_schema_text(),
            case::sweep_schema_text(),
            case::reference_schema_text(),
        ];
        Self { roots: texts.iter().map(|text| serde_json::from_str(text).unwrap()).collect() }
    }

    /// Returns a key that `object` does not have, with a value of the right type; `None` if no object of the schemas
    /// has all keys of `object`.
    pub fn missing_entry(&self, object: &Map<String, Value>, random: &mut Random) -> Option<(String, Value)> {
        let root = random.pick(&self.roots);
        let mut found = Vec::new();
        collect_properties(root, &mut found);
        let known: HashSet<&String> = object.keys().collect();
        found.retain(|properties| known.iter().all(|key| properties.contains_key(*key)));
        if found.is_empty() {
            return None;
        }
        let properties = *random.pick(&found);
        let missing: Vec<&String> = properties.keys().filter(|key| !known.contains(key)).collect();
        if missing.is_empty() {
            return None;
        }
        let key = *random.pick(&missing);
        Some((key.clone(), sample(root, &properties[key], random, 0)))
    }
}

fn collect_properties<'a>(schema: &'a Value, found: &mut Vec<&'a Map<String, Value>>) {
    match schema {
        Value::Object(object) => {
            found.extend(object.get("properties").and_then(Value::as_object));
            object.values().for_each(|inner| collect_properties(inner, found));
        }
        Value::Array(list) => list.iter().for_each(|inner| collect_properties(inner, found)),
        _ => {}
    }
}

/// Returns a value that fits a schema.
fn sample(root: &Value, schema: &Value, random: &mut Random, depth: u32) -> Value {
    if depth > 12 {
        return Value::Null;
    }
    if let Some(path) = schema["$ref"].as_str() {
        return sample(root, root.pointer(path.trim_start_matches('#')).unwrap_or(&Value::Null), random, depth + 1);
    }
    if let Some(value) = schema.get("const") {
        return value.clone();
    }
    for choice in ["enum", "anyOf", "oneOf", "allOf"] {
        let Some(list) = schema[choice].as_array().filter(|list| !list.is_empty()) else { continue };
        let picked = random.pick(list);
        return if choice == "enum" { picked.clone() } else { sample(root, picked, random, depth + 1) };
    }
    let kind = match &schema["type"] {
        Value::Array(kinds) => kinds[0].as_str(),
        kind => kind.as_str(),
    };
    match kind {
        Some("number") => json!(random.pick(&[0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 10.0])),
        Some("integer") => json!(1 + random.below(4)),
        Some("boolean") => json!(random.below(2) == 0),
        Some("string") => json!(random.pick(&["mortar", "x", "rubble.stl", "block", "watl", "tsec"])),
        Some("array") => {
            let prefix = schema["prefixItems"].as_array();
            let count = schema["minItems"].as_u64().map_or(1 + random.below(3), |count| count as usize);
            let item = |k: usize| prefix.and_then(|items| items.get(k)).unwrap_or(&schema["items"]);
            (0..count).map(|k| sample(root, item(k), random, depth + 1)).collect()
        }
        Some("object") => {
            let required: HashSet<&str> =
                schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
            let properties = schema["properties"].as_object().into_iter().flatten();
            let chosen: Vec<_> =
                properties.filter(|(key, _)| required.contains(key.as_str()) || random.below(3) == 0).collect();
            let entry = |(key, inner): (&String, &Value)| (key.clone(), sample(root, inner, random, depth + 1));
            Value::Object(chosen.into_iter().map(entry).collect())
        }
        _ => Value::Null,
    }
}
