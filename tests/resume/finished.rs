//! A finished run continues with another duration, with other output intervals, or not at all.

use std::{fs, path::Path};

use serde_json::{Value, json};

use super::{assert_same_results, breakwater, message, tank};

/// A Tetrapod that falls onto the bed.
fn falling_unit() -> Value {
    let text = include_str!("../../cases/tutorial/drop.json");
    serde_json::from_str(text).unwrap()
}

/// A coarse cantilever under gravity.
fn beam() -> Value {
    json!({
        "title": "beam",
        "fracture": { "mesh": "beam.msh", "joints": "unbreakable" },
        "gravity_m_s2": [0.0, 0.0, -9.81],
        "bodies": [{ "name": "beam", "material": "mortar" }],
        "materials": [{ "name": "mortar", "density_kg_m3": 2100.0, "young_modulus_pa": 1e9, "poisson_ratio": 0.2 }],
        "output": { "surfaces_interval_s": 2e-4, "energy_interval_s": 1e-4 },
        "stop": { "duration_s": 1e-3 }
    })
}

fn succeed(arguments: &[&str]) {
    let ended = breakwater(arguments).output().unwrap();
    assert!(ended.status.success(), "{arguments:?}: {}", message(&ended));
}

/// Runs a case into the folder `out` below `folder`; returns the path of the results.
fn run(folder: &Path, command: &str, case: &Value, out: &str) -> String {
    let path = folder.join("case.json");
    fs::write(&path, case.to_string()).unwrap();
    let out = folder.join(out).display().to_string();
    succeed(&[command, path.to_str().unwrap(), "--out", &out]);
    out
}

/// Changes the case in a run folder.
fn edit(dir: &str, change: impl FnOnce(&mut Value)) {
    let path = Path::new(dir).join("case.json");
    let mut case: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    change(&mut case);
    fs::write(&path, case.to_string()).unwrap();
}

/// Asserts that a finished run that continues to a longer duration has the results of an unbroken run.
fn assert_continues(command: &str, case: &Value, until: f64) {
    let folder = tempfile::tempdir().unwrap();
    let mut longer = case.clone();
    longer["stop"]["duration_s"] = json!(until);
    let unbroken = run(folder.path(), command, &longer, "unbroken");
    let continued = run(folder.path(), command, case, "continued");
    succeed(&["resume", &continued, "--until", &until.to_string()]);
    assert_same_results(Path::new(&unbroken), Path::new(&continued), &["case.json"]);
}

#[test]
fn a_finished_flume_run_continues_to_a_longer_duration() {
    assert_continues("run", &tank(), 0.3);
}

#[test]
fn a_finished_dry_test_continues_to_a_longer_duration() {
    let mut case = falling_unit();
    case["stop"] = json!({ "duration_s": 0.1 });
    assert_continues("run", &case, 0.2);
}

#[test]
fn a_finished_fracture_run_continues_to_a_longer_duration() {
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/fracture/meshes/beam-coarse.msh");
    let mut case = beam();
    case["fracture"]["mesh"] = json!(mesh);
    assert_continues("fracture", &case, 2e-3);
}

#[test]
fn title_stop_rules_and_intervals_may_change() {
    let folder = tempfile::tempdir().unwrap();
    let dir = run(folder.path(), "run", &tank(), "out");
    edit(&dir, |case| {
        case["title"] = json!("another title");
        case["stop"]["duration_s"] = json!(0.3);
        case["output"]["series_interval_s"] = json!(0.02);
        case["output"]["fluid_interval_s"] = json!(0.05);
    });
    succeed(&["resume", &dir]);
    let gauges = fs::read_to_string(Path::new(&dir).join("gauges.csv")).unwrap();
    let times: Vec<f64> = gauges.lines().skip(1).map(|row| row.split(',').next().unwrap().parse().unwrap()).collect();
    // Every 5 ms up to 0.2 s, then every 20 ms up to 0.3 s, and the last row: 0.22, 0.24, 0.26, 0.28 and 0.3 s.
    let late: Vec<f64> = times.iter().copied().filter(|time| *time > 0.2005).collect();
    // Limit 2 ms: a row is written at the first time step after its time.
    assert_eq!(times.iter().filter(|time| **time < 0.1995).count(), 40);
    assert!((5..=6).contains(&late.len()) && (late[0] - 0.22).abs() < 2e-3, "{late:?}");
    assert!(Path::new(&dir).join("fluid.vtkhdf").exists());
}

#[test]
fn other_changes_are_refused_by_key() {
    let folder = tempfile::tempdir().unwrap();
    let dir = run(folder.path(), "run", &tank(), "out");
    let before = fs::read(Path::new(&dir).join("checkpoint.h5")).unwrap();
    edit(&dir, |case| {
        case["stop"]["duration_s"] = json!(0.3);
        case["units"]["mass_kg"] = json!(2.0);
        case["friction"][0]["coefficient"] = json!(0.4);
    });
    let refused = breakwater(&["resume", &dir]).output().unwrap();
    let text = message(&refused);
    assert!(text.contains("the cases differ in friction, units.mass_kg; only title, assumptions,"), "{text}");
    assert!(!refused.status.success());
    assert_eq!(fs::read(Path::new(&dir).join("checkpoint.h5")).unwrap(), before);
    for (until, reason) in [("0", "stop.duration_s = 0"), ("-1", "stop.duration_s = -1"), ("1e9", "stop.duration_s")] {
        let refused = breakwater(&["resume", &dir, &format!("--until={until}")]).output().unwrap();
        let text = message(&refused);
        assert_eq!(refused.status.code(), Some(2), "{text}");
        assert!(text.contains(reason), "{text}");
    }
}
