//! Every file in `tests/bad_cases` is refused with the message that lies beside it: each line of `NAME.expect` must
//! appear in what the user sees.

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

fn assert_tells(message: &str, path: &Path, expected: &[String]) {
    assert!(!expected.is_empty(), "{}: nothing is expected", path.display());
    for line in expected {
        assert!(message.contains(line), "{}:\nexpected: {line}\nmessage:\n{message}", path.display());
    }
    let name = path.file_name().unwrap().to_string_lossy();
    for line in message.lines() {
        assert!(line.contains(&*name), "a line of the message does not name the file {name}: {line}");
    }
}

#[test]
fn every_bad_case_is_refused_with_its_message() {
    let cases = bad_cases();
    assert!(cases.len() >= 30, "only {} bad cases found", cases.len());
    for (path, expected) in cases {
        let Err(errors) = Case::load(&path) else { panic!("{} was accepted", path.display()) };
        assert!(!errors.errors.is_empty());
        assert_tells(&errors.to_string(), &path, &expected);
    }
}

#[test]
fn a_missing_file_is_named() {
    let errors = Case::load("tests/bad_cases/no-such-file.json").unwrap_err();
    assert!(errors.to_string().starts_with("tests/bad_cases/no-such-file.json: cannot be read: "), "{errors}");
}

#[test]
fn a_folder_is_no_case() {
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
#[ignore = "until the check command exists"]
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
