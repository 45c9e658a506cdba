//! Parses a case file: syntax, keys and types.

use serde::de::{DeserializeOwned, IgnoredAny};
use serde_json::Value;

use super::error::{CaseError, nearest};
use super::file::{BlockFile, DropFile, ElevationFile, FlapFile, PointFile, RegularFile, SolitaryFile, TiltFile};

/// Parses the text of a case file; `name` is the file's name in messages.
pub(super) fn parse<T: DeserializeOwned>(text: &str, name: &str) -> Result<T, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = serde_json::Deserializer::from_str(text);
    let parsed = serde_path_to_error::deserialize::<_, T>(&mut reader);
    match parsed {
        Ok(file) => match reader.end() {
            Ok(()) => Ok(file),
            Err(error) => Err(syntax_error(&error, name)),
        },
        Err(error) => {
            let path = error.path().to_string();
            let inner = error.into_inner();
            if !inner.is_data() {
                return Err(syntax_or_key_error(text, path, &inner, name));
            }
            let (path, problem) = locate_inside_kind(text, &path).unwrap_or_else(|| (path, without_position(&inner)));
            Err(key_error(name, path, inner.line(), &problem))
        }
    }
}

/// Returns a key error for three faults that the parser reports as syntax errors: a number beyond the largest float,
/// another value where a name in quotes is required, and too many entries in a list of fixed length. In the last two
/// cases the text itself is valid JSON.
fn syntax_or_key_error(text: &str, path: String, error: &serde_json::Error, name: &str) -> CaseError {
    let key = |problem: &str, advice: &str| CaseError::Key {
        file: name.to_owned(),
        path,
        line: error.line(),
        problem: problem.to_owned(),
        advice: advice.to_owned(),
    };
    if without_position(error) == "number out of range" {
        key("number too large to be represented", "write a finite number")
    } else if serde_json::from_str::<IgnoredAny>(text).is_err() {
        syntax_error(error, name)
    } else if without_position(error) == "expected value" {
        key("not one of the allowed names", "write a name in quotes; `breakwater schema` lists the names")
    } else {
        key("too many entries", "remove the surplus entries; `breakwater schema` shows how many are needed")
    }
}

fn syntax_error(error: &serde_json::Error, name: &str) -> CaseError {
    CaseError::Syntax {
        file: name.to_owned(),
        line: error.line(),
        column: error.column(),
        problem: without_position(error),
    }
}

/// Returns the parser's message without its ending " at line 3 column 5".
fn without_position(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    message.strip_suffix(&position).unwrap_or(&message).to_owned()
}

/// Returns the path of the wrong key inside an object with `kind`, and the problem. The parser reads such objects in
/// two steps and knows only the object's path, so the object is parsed again as its kind.
fn locate_inside_kind(text: &str, path: &str) -> Option<(String, String)> {
    let root: Value = serde_json::from_str(text).ok()?;
    let pointer = format!("/{}", path.replace(['.', '['], "/").replace(']', ""));
    let mut object = root.pointer(&pointer)?.as_object()?.clone();
    let Some(Value::String(kind)) = object.shift_remove("kind") else { return None };
    let rest = Value::Object(object);
    let (inner_path, problem) = match kind.as_str() {
        "solitary" => first_problem::<SolitaryFile>(rest),
        "regular" => first_problem::<RegularFile>(rest),
        "drop" => first_problem::<DropFile>(rest),
        "tilt" => first_problem::<TiltFile>(rest),
        "flap" => first_problem::<FlapFile>(rest),
        "block" => first_problem::<BlockFile>(rest),
        "elevation" => first_problem::<ElevationFile>(rest),
        "pressure" | "velocity" => first_problem::<PointFile>(rest),
        _ => None,
    }?;
    let path = if inner_path == "." { path.to_owned() } else { format!("{path}.{inner_path}") };
    Some((path, problem))
}

fn first_problem<T: DeserializeOwned>(value: Value) -> Option<(String, String)> {
    let error = serde_path_to_error::deserialize::<_, T>(value).err()?;
    Some((error.path().to_string(), without_position(error.inner())))
}

/// Returns an error whose message uses the terms of case files instead of the parser's.
fn key_error(name: &str, path: String, line: usize, problem: &str) -> CaseError {
    let path = if path == "." { "top level".to_owned() } else { path };
    let (problem, advice) = reword(problem);
    CaseError::Key { file: name.to_owned(), path, line, problem, advice }
}

fn reword(problem: &str) -> (String, String) {
    for (prefix, noun) in [("unknown field `", "key"), ("unknown variant `", "value")] {
        let Some(rest) = problem.strip_prefix(prefix) else { continue };
        let (word, expected) = rest.split_once("`, ").unwrap_or((rest.trim_end_matches('`'), ""));
        let allowed: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
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
        "a sequence" => "a list [ ... ]".to_owned(),
        _ if expected.starts_with("struct ") => "an object { ... }".to_owned(),
        _ if expected.contains("tagged enum") => "an object { \"kind\": ..., ... }".to_owned(),
        _ if expected.starts_with("an array of length ") => {
            format!("a list of exactly {} entries", expected.trim_start_matches("an array of length "))
        }
        _ => expected.to_owned(),
    }
}
