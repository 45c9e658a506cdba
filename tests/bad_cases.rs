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
