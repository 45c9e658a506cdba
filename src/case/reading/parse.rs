//! Parses the JSON of an input file and checks its keys and types.

use serde::Serialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde_json::Value;

use super::error::{CaseError, nearest};
use crate::case::file::{
    BlockFile, DropFile, ElevationFile, ExternalWaveFile, FlapFile, IrregularFile, PistonFile, PointFile, RegularFile,
    SolitaryFile, SpongeFile, TiltFile,
};

/// Renamed top-level keys: old name, new name. Flume cases and dry tests may still use the old names.
pub(super) const RENAMED_KEYS: [(&str, &str); 2] = [("fracture", "breakage"), ("dry", "dry_test")];

/// Sections whose value is an object.
const SECTIONS: [&str; 13] = [
    "breakage",
    "contact",
    "domain",
    "dry",
    "dry_test",
    "fluid",
    "flume",
    "fracture",
    "numerics",
    "output",
    "stop",
    "wave",
    "wavemaker",
];

/// Parses valid JSON into a struct of the module `case::file`; `name` is the file name in messages.
pub(super) fn parse<T: DeserializeOwned + Serialize>(text: &str, name: &str) -> Result<T, CaseError> {
    // A number that is too large for `Value` is reported below, with its place.
    let written: Value = serde_json::from_str(text).unwrap_or_default();
    if written.is_array() {
        return Err(list_error(name, "top level"));
    }
    let mut sections = written.as_object().into_iter().flatten();
    if let Some((section, _)) = sections.find(|(key, value)| SECTIONS.contains(&key.as_str()) && value.is_array()) {
        return Err(list_error(name, section));
    }
    let parsed = parse_values(text, name)?;
    // serde also reads an object from a list of its values. This check refuses such lists.
    match list_for_object(&written, &serde_json::to_value(&parsed).unwrap_or_default()) {
        Some(path) => Err(list_error(name, &path)),
        None => Ok(parsed),
    }
}

/// Returns the path of a list in the written JSON that was read as an object; the path of the top level is empty.
fn list_for_object(written: &Value, read: &Value) -> Option<String> {
    match (written, read) {
        (Value::Array(_), Value::Object(_)) => Some(String::new()),
        (Value::Object(written), Value::Object(read)) => {
            written.iter().find_map(|(key, value)| Some(join(key, &list_for_object(value, read.get(key)?)?)))
        }
        (Value::Array(written), Value::Array(read)) => {
            let mut pairs = written.iter().zip(read).enumerate();
            pairs.find_map(|(index, (a, b))| Some(join(&format!("[{index}]"), &list_for_object(a, b)?)))
        }
        _ => None,
    }
}

/// Joins two parts of a JSON path.
fn join(first: &str, rest: &str) -> String {
    if rest.is_empty() || rest.starts_with('[') { format!("{first}{rest}") } else { format!("{first}.{rest}") }
}

fn list_error(name: &str, path: &str) -> CaseError {
    let advice = "write each value with its key; `breakwater schema` explains every key";
    CaseError::Invalid {
        file: name.to_owned(),
        path: path.to_owned(),
        value: "a list [ ... ]".to_owned(),
        allowed: "an object { ... }".to_owned(),
        advice: advice.to_owned(),
    }
}

fn parse_values<T: DeserializeOwned>(text: &str, name: &str) -> Result<T, CaseError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize::<_, T>(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let inner = error.into_inner();
        if !inner.is_data() {
            return value_error(text, path, &inner, name);
        }
        let (path, problem) = locate_inside_kind(text, &path).unwrap_or_else(|| (path, without_position(&inner)));
        key_error(name, path, inner.line(), &problem)
    })
}

/// Returns the error for three faults in valid JSON that the parser reports as syntax errors: a number beyond the
/// largest float, a value without quotes where a name is required, and too many entries in a list of fixed length.
fn value_error(text: &str, path: String, error: &serde_json::Error, name: &str) -> CaseError {
    let (problem, advice) = match without_position(error).as_str() {
        "number out of range" => ("number too large to be represented", "write a finite number"),
        // The text is nested more deeply than the parser allows.
        _ if serde_json::from_str::<IgnoredAny>(text).is_err() => return syntax_error(text, error, name),
        "expected value" => {
            ("not one of the allowed names", "write a name in quotes; `breakwater schema` lists the names")
        }
        _ => ("too many entries", "remove the surplus entries; `breakwater schema` shows the required number"),
    };
    let (problem, advice) = (problem.to_owned(), advice.to_owned());
    CaseError::Key { file: name.to_owned(), path, line: error.line(), problem, advice }
}

/// Returns the error for a text that is not valid JSON.
pub(super) fn syntax_error(text: &str, error: &serde_json::Error, name: &str) -> CaseError {
    let (line, column) = (error.line(), error.column());
    let problem = frequent_mistake(text, line, column).unwrap_or_else(|| without_position(error));
    CaseError::Syntax { file: name.to_owned(), line, column, problem }
}

/// Returns a description of the mistake if it is a frequent one; `line` and `column` are those of the parser's error.
fn frequent_mistake(text: &str, line: usize, column: usize) -> Option<String> {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let at = start + column.saturating_sub(1);
    let (before, rest) = (text.get(..at)?, text.get(at..)?);
    let found = rest.chars().next()?;
    let before = before.trim_end();
    let after_comma = before.strip_suffix(',');
    let word: String = rest.chars().take_while(|c| !c.is_whitespace() && !",]}".contains(*c)).take(20).collect();
    Some(match found {
        '}' | ']' if after_comma.is_some() => format!("found `{found}` after a comma; remove the comma"),
        '0'..='9' if after_comma.is_some_and(|number| number.ends_with(|c: char| c.is_ascii_digit())) => {
            format!("found `{word}` after a comma; write a decimal point instead of a decimal comma")
        }
        '/' | '#' => format!("found `{found}`; comments are not allowed, use `assumptions` for notes"),
        '+' => format!("found `{word}`; write positive numbers without a sign"),
        '\'' => format!("found `{found}`; write texts and keys in double quotes"),
        '.' | 'I' | 'N' | 'i' | 'n' => format!("found `{word}`; write a finite number such as 0.5"),
        _ => return None,
    })
}

/// Returns the parser's message without the position at its end, for example " at line 3 column 5".
fn without_position(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    message.strip_suffix(&position).unwrap_or(&message).to_owned()
}

/// Returns the path of the wrong key inside an object with the key `kind`, and the problem. The parser reads such
/// objects in two steps and reports only the path of the object. Therefore this function parses the object again as the
/// struct of its kind.
fn locate_inside_kind(text: &str, path: &str) -> Option<(String, String)> {
    let root: Value = serde_json::from_str(text).ok()?;
    let pointer = format!("/{}", path.replace(['.', '['], "/").replace(']', ""));
    let mut object = root.pointer(&pointer)?.as_object()?.clone();
    let Some(Value::String(kind)) = object.shift_remove("kind") else { return None };
    let rest = Value::Object(object);
    let section = path.split(['.', '[']).next()?;
    let (inner_path, problem) = match (section, kind.as_str()) {
        ("wave", "solitary") => first_problem::<SolitaryFile>(rest),
        ("wave", "regular") => first_problem::<RegularFile>(rest),
        ("wave", "irregular") => first_problem::<IrregularFile>(rest),
        ("wave", "file") => first_problem::<ExternalWaveFile>(rest),
        ("wavemaker", "ml_piston" | "piston") => first_problem::<PistonFile>(rest),
        ("wavemaker", "flap") => first_problem::<FlapFile>(rest),
        ("flume", "sponge") => first_problem::<SpongeFile>(rest),
        ("domain", "block") => first_problem::<BlockFile>(rest),
        ("dry_test" | "dry", "drop") => first_problem::<DropFile>(rest),
        ("dry_test" | "dry", "tilt") => first_problem::<TiltFile>(rest),
        ("gauges", "elevation") => first_problem::<ElevationFile>(rest),
        ("gauges", "pressure" | "velocity") => first_problem::<PointFile>(rest),
        _ => None,
    }?;
    let path = if inner_path == "." { path.to_owned() } else { format!("{path}.{inner_path}") };
    Some((path, problem))
}

fn first_problem<T: DeserializeOwned>(value: Value) -> Option<(String, String)> {
    let error = serde_path_to_error::deserialize::<_, T>(value).err()?;
    Some((error.path().to_string(), without_position(error.inner())))
}

/// Returns an error whose message uses the terms of case files instead of the terms of the parser.
fn key_error(name: &str, path: String, line: usize, problem: &str) -> CaseError {
    let path = if path == "." { "top level".to_owned() } else { path };
    let (problem, advice) = reword(problem);
    CaseError::Key { file: name.to_owned(), path, line, problem, advice }
}

fn reword(problem: &str) -> (String, String) {
    for (prefix, noun) in [("unknown field `", "key"), ("unknown variant `", "value")] {
        let Some(rest) = problem.strip_prefix(prefix) else { continue };
        let (word, expected) = rest.split_once("`, ").unwrap_or((rest.trim_end_matches('`'), ""));
        let mut allowed: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
        let renamed: Vec<&str> =
            RENAMED_KEYS.iter().filter(|(_, new)| allowed.contains(new)).map(|(old, _)| *old).collect();
        allowed.retain(|key| !renamed.contains(key));
        let guess = nearest(word, allowed.iter().copied());
        let guess = guess.map(|key| format!("did you mean \"{key}\"? ")).unwrap_or_default();
        let allowed = if allowed.is_empty() { "none".to_owned() } else { allowed.join(", ") };
        return (format!("unknown {noun} \"{word}\""), format!("{guess}allowed here: {allowed}"));
    }
    if let Some(key) = problem.strip_prefix("missing field `") {
        let key = key.trim_end_matches('`');
        return (format!("the key \"{key}\" is missing"), "add it; `breakwater schema` explains every key".to_owned());
    }
    if let Some(key) = problem.strip_prefix("duplicate field `") {
        return (
            format!("the key \"{}\" is written twice", key.trim_end_matches('`')),
            "remove one of the two".to_owned(),
        );
    }
    let Some((found, expected)) = problem.split_once(", expected ") else {
        return (problem.to_owned(), "`breakwater schema` explains every key".to_owned());
    };
    let found = found.strip_prefix("invalid type: ").unwrap_or(found);
    (format!("wrong type: {found}"), format!("write {}", expected_words(expected)))
}

fn expected_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" => "a whole number, 0 or more".to_owned(),
        "a map" => "an object { ... }".to_owned(),
        "a sequence" => "a list [ ... ]".to_owned(),
        _ if expected.starts_with("struct ") => "an object { ... }".to_owned(),
        _ if expected.contains("tagged enum") => "an object { \"kind\": ..., ... }".to_owned(),
        _ if expected.starts_with("an array of length ") => {
            format!("a list of exactly {} entries", expected.trim_start_matches("an array of length "))
        }
        _ => expected.to_owned(),
    }
}
