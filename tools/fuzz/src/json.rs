//! Mutates JSON files: replaces, adds, removes and moves values.

use serde_json::{Map, Value, json};

use crate::random::Random;
use crate::schema::Schemas;
use crate::text::change;

/// JSON texts of extreme numbers. Some are not valid JSON.
const NUMBERS: [&str; 30] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "1e-308",
    "5e-324",
    "1e154",
    "1e-154",
    "1e9",
    "-1e9",
    "1e6",
    "1e-6",
    "1e18",
    "1e-12",
    "0.001",
    "100",
    "1000",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "9007199254740993",
    "1e400",
    "NaN",
    "Infinity",
    "-1e18",
];

/// JSON texts of unusual names, texts and paths.
const TEXTS: [&str; 8] =
    ["\"\"", "\"a\\nb\"", "\"\\u0000\"", "\"é漢字\"", "\"..\"", "\"/\"", "\"case.json\"", "\"no-such-file\""];

/// JSON texts of values that rarely have the right type.
const OTHERS: [&str; 9] = ["null", "true", "false", "[]", "{}", "[[]]", "[{}]", "[null]", "[1e308,-1e308]"];

/// Marks a text in a JSON value that is written without quotes.
const RAW: &str = "\u{1}raw:";

/// Mutates JSON files with the keys and values of valid files and of the schemas.
pub struct Mutator {
    schemas: Schemas,
    /// Key and value of all entries in the valid files.
    entries: Vec<(String, Value)>,
}

impl Mutator {
    pub fn new<'a>(valid: impl IntoIterator<Item = &'a Vec<u8>>) -> Self {
        let mut entries = Vec::new();
        for text in valid {
            collect_entries(&serde_json::from_slice(text).unwrap(), &mut entries);
        }
        Self { schemas: Schemas::new(), entries }
    }

    /// Returns a mutated copy of a JSON text. A text that is not JSON is mutated as words.
    pub fn mutate(&self, text: &[u8], random: &mut Random) -> Vec<u8> {
        let parsed = serde_json::from_slice::<Value>(text);
        let Some(mut value) = parsed.ok().filter(|_| random.below(25) > 0) else {
            return crate::text::mutate(text, random);
        };
        for _ in 0..1 + random.below(2) {
            self.change(&mut value, random);
        }
        let text = if random.below(4) == 0 { format!("{value:#}") } else { value.to_string() };
        without_marks(&text).into_bytes()
    }

    fn change(&self, value: &mut Value, random: &mut Random) {
        let mut pointers = Vec::new();
        collect_pointers(value, String::new(), &mut pointers);
        let pointer = random.pick(&pointers).clone();
        let other = value.pointer(random.pick(&pointers)).cloned().unwrap_or_default();
        let key = pointer.rsplit('/').next().unwrap_or_default().to_owned();
        let Some(place) = value.pointer_mut(&pointer) else { return };
        match random.below(16) {
            0..=3 if !place.is_array() && !place.is_object() => *place = extreme(place, random),
            0..=6 => {
                if let Some(number) = place.as_f64() {
                    *place = json!(change(number, random));
                } else {
                    self.change_inside(place, random);
                }
            }
            7..=9 => self.change_inside(place, random),
            10 => *place = other,
            11 | 12 => {
                let same: Vec<&Value> = self.entries.iter().filter(|(name, _)| *name == key).map(|(_, v)| v).collect();
                if !same.is_empty() {
                    *place = (*random.pick(&same)).clone();
                }
            }
            13 if random.below(4) == 0 => *place = json!([place.take()]),
            14 => {
                let (parent, _) = pointer.rsplit_once('/').unwrap_or_default();
                value.pointer_mut(parent).and_then(Value::as_object_mut).map(|object| object.shift_remove(&key));
            }
            _ => {
                if let Some(number) = place.as_f64() {
                    *place = json!(number.round() as i64);
                }
            }
        }
    }

    /// Adds, removes or repeats an entry of an object or list.
    fn change_inside(&self, place: &mut Value, random: &mut Random) {
        match place {
            Value::Object(object) => self.change_object(object, random),
            Value::Array(list) if list.is_empty() => list.push(extreme(&Value::Null, random)),
            Value::Array(list) => {
                let index = random.below(list.len());
                match random.below(6) {
                    0 => drop(list.remove(index)),
                    1 => list.swap(index, 0),
                    2 => list.reverse(),
                    3 => {
                        let times = [1, 10, 100, 1000][random.below(4)].min(20_000 / list.len());
                        *list = list.iter().cycle().take(list.len() * (1 + times)).cloned().collect();
                    }
                    _ => list.insert(index, list[index].clone()),
                }
            }
            other => *other = extreme(other, random),
        }
    }

    fn change_object(&self, object: &mut Map<String, Value>, random: &mut Random) {
        let entry = match random.below(4) {
            0 if !self.entries.is_empty() => Some(random.pick(&self.entries).clone()),
            1 if !object.is_empty() => {
                let key = object.keys().nth(random.below(object.len())).cloned().unwrap_or_default();
                object.shift_remove(&key);
                None
            }
            _ => self.schemas.missing_entry(object, random),
        };
        if let Some((key, value)) = entry {
            object.insert(key, value);
        }
    }
}

/// Returns an extreme value, in most cases of the type of `old`.
fn extreme(old: &Value, random: &mut Random) -> Value {
    json!(match random.below(400) {
        0 => format!("{RAW}[{}0]", "0,".repeat(30_000)),
        1 => format!("{RAW}{}{}", "[".repeat(200), "]".repeat(200)),
        2 => format!("{RAW}\"{}\"", "x".repeat(10_000)),
        3..40 => format!("{RAW}{}", random.pick(&OTHERS)),
        _ if old.is_string() => format!("{RAW}{}", random.pick(&TEXTS)),
        _ => format!("{RAW}{}", random.pick(&NUMBERS)),
    })
}

/// Removes the mark [`RAW`] and the quotes around marked texts.
fn without_marks(text: &str) -> String {
    let mark = format!("\"{}", &serde_json::to_string(RAW).unwrap().trim_matches('"'));
    let mut parts = text.split(mark.as_str());
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // The marked text ends at the first quote that is not escaped.
        let mut end = part.len();
        let mut escaped = false;
        for (at, letter) in part.char_indices() {
            match letter {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => {
                    end = at;
                    break;
                }
                _ => {}
            }
        }
        let raw: String = serde_json::from_str(&format!("\"{}\"", &part[..end])).unwrap_or_default();
        out.push_str(&raw);
        out.push_str(part.get(end + 1..).unwrap_or_default());
    }
    out
}

fn collect_entries(value: &Value, entries: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(object) => {
            for (key, inner) in object {
                entries.push((key.clone(), inner.clone()));
                collect_entries(inner, entries);
            }
        }
        Value::Array(list) => list.iter().for_each(|inner| collect_entries(inner, entries)),
        _ => {}
    }
}

/// Collects the JSON pointers of a value and of everything inside it.
fn collect_pointers(value: &Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        Value::Object(object) => {
            object.iter().for_each(|(key, inner)| collect_pointers(inner, format!("{pointer}/{key}"), pointers));
        }
        // Long lists have entries of one kind.
        Value::Array(list) => list
            .iter()
            .take(50)
            .enumerate()
            .for_each(|(i, inner)| collect_pointers(inner, format!("{pointer}/{i}"), pointers)),
        _ => {}
    }
    pointers.push(pointer);
}
