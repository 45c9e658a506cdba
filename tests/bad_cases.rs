//! Every file in `tests/bad_cases` is refused. The error message for `NAME.json` contains each line of `NAME.expect`.

use std::path::{Path, PathBuf};

use breakwater::case::Case;

fn bad_cases() -> Vec<(PathBuf, Vec<String>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_cases");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    let expected = |path: &Path| -> Vec<String> {
        let expect = path.with_extension("expect");
        let text = std::fs::read_to_string(&expect).unwrap_or_else(|error| panic!("{}: {error}", expect.display()));
        text.lines().filter(|line| !line.is_empty()).map(str::to_owned).collect()
    };
    files
        .into_iter()
        .map(|path| {
            let lines = expected(&path);
            (path, lines)
        })
        .collect()
}

/// Lists the expected lines that the message lacks, and the lines of the message that do not name the file.
fn message_faults(message: &str, path: &Path, expected: &[String]) -> Vec<String> {
    let name = path.file_name().unwrap().to_string_lossy();
    let mut found = Vec::new();
    if expected.is_empty() {
        found.push(format!("{name}: its .expect file is empty"));
    }
    for line in expected.iter().filter(|line| !message.contains(line.as_str())) {
        found.push(format!("{name}:\n  expected: {line}\n  message:  {message}"));
    }
    for line in message.lines().filter(|line| !line.contains(&*name)) {
        found.push(format!("{name}: a line of the message does not name the file: {line}"));
    }
    found
}

#[test]
fn every_bad_case_is_refused_with_its_message() {
    let cases = bad_cases();
    assert!(cases.len() >= 30, "only {} bad cases found", cases.len());
    let mut found = Vec::new();
    for (path, expected) in cases {
        match Case::load(&path) {
            Ok(_) => found.push(format!("{} was accepted", path.display())),
            Err(errors) => found.extend(message_faults(&errors.to_string(), &path, &expected)),
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_missing_file_is_refused_by_name() {
    let errors = Case::load("tests/bad_cases/no-such-file.json").unwrap_err();
    assert!(errors.to_string().starts_with("tests/bad_cases/no-such-file.json: cannot be read: "), "{errors}");
}

#[test]
fn a_folder_is_refused_as_a_case() {
    let errors = Case::load("tests/bad_cases").unwrap_err();
    assert!(errors.to_string().starts_with("tests/bad_cases: cannot be read: "), "{errors}");
}

#[test]
fn truncated_cases_are_refused_at_every_length() {
    let text = breakwater::case::template_text();
    let whole = text.trim_end().len();
    for length in (0..whole).filter(|length| text.is_char_boundary(*length)) {
        assert!(Case::from_str(&text[..length], "cut.json").is_err(), "accepted when cut at {length}");
    }
}

#[test]
fn extreme_values_give_an_error_or_a_valid_case() {
    let extreme = ["0", "-1", "1e308", "-1e308", "5e-324", "4294967295", "0.001", "null", "\"\"", "[]", "{}", "true"];
    let file: breakwater::case::file::CaseFile = serde_json::from_str(&breakwater::case::template_text()).unwrap();
    let valid = serde_json::to_value(&file).unwrap();
    let mut pointers = Vec::new();
    collect_pointers(&valid, String::new(), &mut pointers);
    for pointer in &pointers {
        for value in extreme {
            let mut changed = valid.clone();
            *changed.pointer_mut(pointer).unwrap() = serde_json::from_str(value).unwrap();
            match Case::from_str(&changed.to_string(), "extreme.json") {
                Ok(case) => {
                    let size = case.estimate();
                    let finite = size.dt > 0.0 && size.dt.is_finite() && size.bytes.is_finite();
                    assert!(finite, "{pointer} = {value}: {size:?}");
                }
                Err(errors) => assert!(!errors.errors.is_empty(), "{pointer} = {value}: refused without a reason"),
            }
        }
    }
}

/// Collects the JSON pointers of a value and of everything inside it.
fn collect_pointers(value: &serde_json::Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(object) => {
            object.iter().for_each(|(key, inner)| collect_pointers(inner, format!("{pointer}/{key}"), pointers));
        }
        serde_json::Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, inner)| collect_pointers(inner, format!("{pointer}/{i}"), pointers));
        }
        _ => {}
    }
    pointers.push(pointer);
}

/// Returns the key, and the limits that a message such as "x.json: a.b = 3: must be at least 1 and at most 2 m" allows.
fn allowed_limits(line: &str) -> Option<(String, Vec<f64>)> {
    let (_, rest) = line.split_once(".json: ")?;
    let (key, rest) = rest.split_once(" = ")?;
    let range = rest.split_once(": must be ")?.1.split(';').next()?;
    let is_range =
        ["at least ", "at most ", "> "].iter().any(|start| range.starts_with(start)) && !range.contains("particle");
    let range = range.get(if is_range { 0.. } else { range.len().. })?;
    // A formula can stand before its value, as in "at most 2 / (7 cfl) = 0.571428".
    let limit = |words: &str| range.split_once(words)?.1.rsplit("= ").next()?.split_whitespace().next()?.parse().ok();
    let limits: Vec<f64> = ["at least ", "at most "].into_iter().filter_map(limit).collect();
    (!limits.is_empty()).then(|| (key.to_owned(), limits))
}

/// A user who takes a limit from a message must not get the same message again.
#[test]
fn limits_in_messages_are_accepted() {
    let mut tried = 0;
    for (path, _) in bad_cases() {
        let text = std::fs::read_to_string(&path).unwrap();
        let (Ok(case), Err(errors)) = (serde_json::from_str::<serde_json::Value>(&text), Case::load(&path)) else {
            continue;
        };
        for (key, limits) in errors.errors.iter().filter_map(|error| allowed_limits(&error.to_string())) {
            let pointer = format!("/{}", key.replace(['.', '['], "/").replace(']', ""));
            for limit in &limits {
                let mut changed = case.clone();
                // The value in the message can be one that the program derived, without a key in the file.
                let Some(value) = changed.pointer_mut(&pointer).filter(|value| value.is_number()) else { continue };
                let whole = value.is_u64() && limit.fract() == 0.0;
                *value = if whole { serde_json::json!(*limit as u64) } else { serde_json::json!(*limit) };
                tried += 1;
                let refused = Case::from_str(&changed.to_string(), &path.display().to_string()).err();
                let message = refused.map(|errors| errors.to_string()).unwrap_or_default();
                let again = message
                    .lines()
                    .find(|line| allowed_limits(line).is_some_and(|other| other == (key.clone(), limits.clone())));
                assert_eq!(again, None, "{}: {key} = {limit} is refused although a message names it", path.display());
            }
        }
    }
    assert!(tried > 90, "only {tried} limits found");
}

#[test]
fn program_refuses_every_bad_case_with_exit_code_2() {
    for (path, expected) in bad_cases() {
        let run =
            std::process::Command::new(env!("CARGO_BIN_EXE_breakwater")).arg("check").arg(&path).output().unwrap();
        let message = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{}: {message}", path.display());
        let missing: Vec<&String> = expected.iter().filter(|line| !message.contains(line.as_str())).collect();
        assert!(missing.is_empty(), "{}:\nexpected: {missing:?}\nmessage:\n{message}", path.display());
    }
}
