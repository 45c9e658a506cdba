//! Every command in the `sh` blocks of the tutorial succeeds, in order, in a copy of the cases.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Lists the commands in the `sh` blocks of a page.
fn commands(page: &str) -> Vec<&str> {
    let blocks = page.split("\n```sh\n").skip(1).map(|rest| rest.split("\n```").next().unwrap_or(rest));
    blocks.flat_map(str::lines).filter(|line| !line.trim().is_empty()).collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy(&path, &target) } else { fs::copy(&path, &target).map(drop).unwrap() }
    }
}

#[test]
fn every_tutorial_command_succeeds() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(repository.join("docs/tutorial.md")).unwrap();
    let commands = commands(&page);
    // If the page marked its blocks differently, the test would find no commands.
    assert!(commands.len() >= 10, "found only {commands:?}");
    let folder = tempfile::tempdir().unwrap();
    copy(&repository.join("cases"), &folder.path().join("cases"));
    let program = Path::new(env!("CARGO_BIN_EXE_breakwater"));
    let mut search_path: Vec<PathBuf> = vec![program.parent().unwrap().to_owned()];
    search_path.extend(env::split_paths(&env::var_os("PATH").unwrap_or_default()));
    let search_path = env::join_paths(search_path).unwrap();
    for command in commands {
        let output =
            Command::new("sh").args(["-c", command]).current_dir(folder.path()).env("PATH", &search_path).output();
        let output = output.unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command}: {}\n{message}", output.status);
    }
}
