//! Parses the JSON of an input file and checks its keys and types.

use serde::de::{DeserializeOwned, IgnoredAny};
use serde_json::Value;

use super::error::{CaseError, nearest};
use crate::case::file::{
    BlockFile, DropFile, ElevationFile, ExternalWaveFile, FlapFile, IrregularFile, PistonFile, PointFile, RegularFile,
    SolitaryFile, SpongeFile, TiltFile,
};

/// Renamed top-level keys: old name, new name. Flume cases and dry tests may still use the old names.
pub(super) const RENAMED_KEYS: [(&str, &str); 2] = [("fracture", "breakage"), ("dry", "dry_test")];

/// Parses valid JSON into a struct of the module `case::file`; `name` is the file name in messages.
pub(super) fn parse<T: DeserializeOwned>(text: &str, name: &str) -> Result<T, CaseError> {
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
        _ if serde_json::from_str::<IgnoredAny>(text).is_err() => return syntax_error(error, name),
        "expected value" => {
            ("not one of the allowed names", "write a name in quotes; `breakwater schema` lists the names")
        }
        _ => ("too many entries", "remove the surplus entries; `breakwater schema` shows the required number"),
    };
    let (problem, advice) = (problem.to_owned(), advice.to_owned());
    CaseError::Key { file: name.to_owned(), path, line: error.line(), problem, advice }
}

/// Returns the error for a text that is not valid JSON.
pub(super) fn syntax_error(error: &serde_json::Error, name: &str) -> CaseError {
    CaseError::Syntax {
        file: name.to_owned(),
        line: error.line(),
        column: error.column(),
        problem: without_position(error),
    }
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
