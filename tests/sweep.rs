//! Sweeps from the command line: all combinations run, finished runs are kept, and failed runs are listed.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::{Value, json};

/// Returns the case of a tank with a few hundred particles for a few time steps.
fn tank() -> Value {
    json!({
        "title": "Tank",
        "flume": { "bed_m": [[0.0, 0.0], [0.5, 0.0]], "still_water_level_m": 0.2, "material": "mortar" },
        "domain": { "x_m": [0.0, 0.5], "width_m": 0.5, "sides": "periodic", "top_z_m": 0.4, "dp_m": 0.05 },
        "numerics": { "hold_units_s": 0.0 },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
        "output": { "checkpoint_interval_s": 0.01 },
        "stop": { "duration_s": 0.02 }
    })
}

/// Creates a folder with the tank case and a sweep of it.
fn sweep_of(vary: &Value) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, value: &Value| {
        let path = folder.path().join(name);
        fs::write(&path, value.to_string()).unwrap();
        path
    };
    write("tank.json", &tank());
    let sweep = write("sweep.json", &json!({ "title": "Tanks", "case": "tank.json", "vary": vary }));
    (folder, sweep)
}

fn breakwater(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_breakwater")).args(arguments).output().unwrap()
}

fn run(sweep: &Path, out: &Path) -> Output {
    breakwater(&["sweep", sweep.to_str().unwrap(), "--out", out.to_str().unwrap(), "--jobs", "2", "--device", "cpu"])
}

#[test]
fn every_combination_runs_and_finished_runs_are_kept() {
    let vary = json!([
        { "key": "numerics.viscosity_alpha", "values": [0.02, 0.04] },
        { "key": "domain.dp_m", "from": 0.04, "to": 0.05, "count": 2 }
    ]);
    let (folder, sweep) = sweep_of(&vary);
    let out = folder.path().join("out");
    let first = run(&sweep, &out);
    assert!(first.status.success(), "{}", String::from_utf8_lossy(&first.stderr));
    let table = fs::read_to_string(out.join("sweep.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 5, "{table}");
    assert!(rows[0].starts_with("run,numerics.viscosity_alpha,domain.dp_m,"));
    assert!(rows[2].starts_with("002_viscosity_alpha=0.02_dp_m=0.05,0.02,0.05,") && rows[2].ends_with(",finished"));

    let case = fs::read_to_string(out.join("002_viscosity_alpha=0.02_dp_m=0.05/case.json")).unwrap();
    let case: Value = serde_json::from_str(&case).unwrap();
    assert_eq!(case["title"], "Tanks: viscosity_alpha=0.02 dp_m=0.05");

    // One run is deleted and one run has no summary. The sweep completes both and does not touch the other runs.
    let summary = |name: &str| out.join(name).join("summary.json");
    let changed = |name: &str| fs::metadata(summary(name)).unwrap().modified().unwrap();
    let kept = changed("003_viscosity_alpha=0.04_dp_m=0.04");
    fs::remove_dir_all(out.join("001_viscosity_alpha=0.02_dp_m=0.04")).unwrap();
    let interrupted = "004_viscosity_alpha=0.04_dp_m=0.05";
    fs::remove_file(summary(interrupted)).unwrap();
    let again = run(&sweep, &out);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    assert_eq!(changed("003_viscosity_alpha=0.04_dp_m=0.04"), kept);
    assert!(summary(interrupted).exists());
    // The wall-clock time (column index 11) differs between the two sweeps.
    let without_wall_time = |table: &str| {
        let cells =
            |row: &str| row.split(',').enumerate().filter(|(k, _)| *k != 11).map(|(_, c)| c.to_owned()).collect();
        table.lines().map(cells).collect::<Vec<Vec<String>>>()
    };
    assert_eq!(without_wall_time(&fs::read_to_string(out.join("sweep.csv")).unwrap()), without_wall_time(&table));
}

#[test]
fn one_at_a_time_varies_each_key_against_the_base_case() {
    let (folder, sweep) = sweep_of(&json!([
        { "key": "numerics.viscosity_alpha", "values": [0.02] },
        { "key": "domain.x_m", "values": [[0.0, 0.4]] }
    ]));
    let mut file: Value = serde_json::from_str(&fs::read_to_string(&sweep).unwrap()).unwrap();
    file["combine"] = json!("one_at_a_time");
    file["set"] = json!({ "numerics.cfl": 0.1, "domain.dp_m": 0.04 });
    fs::write(&sweep, file.to_string()).unwrap();
    let out = folder.path().join("out");
    let done = run(&sweep, &out);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let table = fs::read_to_string(out.join("sweep.csv")).unwrap();
    let starts = [
        "001_as_given,,\"[0.0,0.5]\",",
        "002_viscosity_alpha=0.02,0.02,\"[0.0,0.5]\",",
        "003_x_m=_0.0_0.4_,,\"[0.0,0.4]\",",
    ];
    assert!(table.lines().skip(1).zip(starts).all(|(row, start)| row.starts_with(start)), "{table}");
    assert_eq!(table.lines().count(), 4);
    let case = fs::read_to_string(out.join("003_x_m=_0.0_0.4_/case.json")).unwrap();
    let case: Value = serde_json::from_str(&case).unwrap();
    assert_eq!((&case["numerics"]["cfl"], &case["numerics"]["viscosity_alpha"]), (&json!(0.1), &Value::Null));
    let assumption = "Changed from the base case of the sweep: numerics.cfl = 0.1 (base case: not set), \
                 domain.dp_m = 0.04 (base case: 0.05), domain.x_m = [0.0,0.4] (base case: [0.0,0.5]).";
    assert_eq!(case["assumptions"], json!([assumption]));
}

#[test]
fn random_values_give_statistics() {
    let (folder, sweep) = sweep_of(&json!([
        { "key": "friction[0].coefficient", "random": { "normal": { "mean": 0.5, "deviation": 0.1, "least": 0.2 } } },
        { "key": "numerics.cfl", "values": [0.2, 0.3] },
        { "key": "units.scatter.seed", "random": "seed" }
    ]));
    let mut case = tank();
    case["units"] = json!({
        "shape": "tetrapod", "height_m": 0.15, "mass_kg": 2.2, "material": "mortar", "count": 2, "pitch_m": 0.25,
        "x_m": 0.25, "scatter": { "position_m": 0.01, "angle_deg": 3.0 }
    });
    fs::write(folder.path().join("tank.json"), case.to_string()).unwrap();
    let mut file: Value = serde_json::from_str(&fs::read_to_string(&sweep).unwrap()).unwrap();
    file["repetitions"] = json!(2);
    fs::write(&sweep, file.to_string()).unwrap();
    let out = folder.path().join("out");
    let done = run(&sweep, &out);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let printed = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(printed.contains("cfl=0.2: 2 runs, 4 units: mean displacement 0.000 m"), "{printed}");
    let ensemble = fs::read_to_string(out.join("ensemble.csv")).unwrap();
    let rows: Vec<&str> = ensemble.lines().collect();
    assert!(
        rows.len() == 3 && rows[1].starts_with("cfl=0.2,2,4,") && rows[2].starts_with("cfl=0.3,2,4,"),
        "{ensemble}"
    );
    assert!(out.join("sweep.svg").exists());
    // Both combinations have the same random values. The units stand at random places.
    let read = |name: &str| -> Value {
        let text = fs::read_to_string(out.join(name).join("case.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    let runs: Vec<String> = fs::read_to_string(out.join("sweep.csv"))
        .unwrap()
        .lines()
        .skip(1)
        .map(|row| row.split(',').next().unwrap().to_owned())
        .collect();
    let cases: Vec<Value> = runs.iter().map(|run| read(run)).collect();
    let random = |case: &Value| [case["friction"][0]["coefficient"].clone(), case["units"]["scatter"]["seed"].clone()];
    assert!(random(&cases[0]) == random(&cases[2]) && random(&cases[1]) == random(&cases[3]), "{cases:?}");
    assert!(random(&cases[0])[0] != random(&cases[1])[0] && random(&cases[0])[1] != random(&cases[1])[1]);
    let summary = fs::read_to_string(out.join(&runs[0]).join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let start = &summary["units"][0]["start_m"];
    let deviation = [start[0].as_f64().unwrap() - 0.25, start[1].as_f64().unwrap() - 0.125];
    assert!(deviation.iter().all(|along| along.abs() <= 0.01 && along.abs() > 1e-6), "{deviation:?}");
}

#[test]
fn a_failed_run_is_listed() {
    let (folder, sweep) = sweep_of(&json!([{ "key": "numerics.cfl", "values": [0.2, 0.3] }]));
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    // A file blocks the path of the second run's folder.
    fs::write(out.join("002_cfl=0.3"), "").unwrap();
    let ended = run(&sweep, &out);
    assert_eq!(ended.status.code(), Some(1));
    let message = String::from_utf8_lossy(&ended.stderr);
    assert!(message.contains("1 of 2 runs are not finished: 002_cfl=0.3"), "{message}");
    let table = fs::read_to_string(out.join("sweep.csv")).unwrap();
    assert!(
        table.lines().nth(1).unwrap().ends_with(",finished") && table.contains("failed: attempt 1 of 2"),
        "{table}"
    );
}

#[test]
fn setting_an_unknown_key_is_refused() {
    let (_folder, sweep) = sweep_of(&json!([{ "key": "domain.dp_m", "values": [0.05] }]));
    let base: Value = serde_json::from_str(&fs::read_to_string(&sweep).unwrap()).unwrap();
    for (key, expected) in [
        ("friction[4].coefficient", "set: friction[4].coefficient: friction has 1 entries"),
        ("numerics.cfll", "unknown key \"cfll\"; did you mean \"cfl\"?"),
    ] {
        let mut file = base.clone();
        file["set"] = json!({ key: 0.4 });
        fs::write(&sweep, file.to_string()).unwrap();
        let ended = breakwater(&["check", sweep.to_str().unwrap()]);
        let message = String::from_utf8_lossy(&ended.stderr);
        assert_eq!(ended.status.code(), Some(2), "{key}: {message}");
        assert!(message.contains(expected), "{key}: {message}");
    }
}

#[test]
fn a_base_case_that_is_not_a_json_object_is_refused() {
    let (folder, sweep) = sweep_of(&json!([{ "key": "domain.dp_m", "values": [0.05] }]));
    let mut file: Value = serde_json::from_str(&fs::read_to_string(&sweep).unwrap()).unwrap();
    file["combine"] = json!("one_at_a_time");
    fs::write(&sweep, file.to_string()).unwrap();
    fs::write(folder.path().join("tank.json"), "[]").unwrap();
    let ended = breakwater(&["check", sweep.to_str().unwrap()]);
    let message = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(2), "{message}");
    assert!(message.contains("tank.json: top level = a list [ ... ]: must be an object"), "{message}");
}

#[test]
fn invalid_sweeps_are_refused_before_any_run_starts() {
    let cases = [
        (json!([]), "vary: must contain at least one key"),
        (json!([{ "key": "domain.dp_m" }]), "vary[0] (domain.dp_m): must have either `values`"),
        (json!([{ "key": "friction[4].coefficient", "values": [0.1] }]), "friction has 1 entries"),
        (
            json!([{ "key": "domain.dp_m", "random": { "uniform": [0.04, 0.05] } }]),
            "repetitions: (missing): must be 2 to 10000 with `random` values",
        ),
        (json!([{ "key": "domain.dp_mm", "values": [0.1] }]), "run 1 of the sweep (dp_mm=0.1) is refused"),
        (json!([{ "key": "domain.dp_m", "values": [0.05, -1] }]), "run 2 of the sweep (dp_m=-1) is refused"),
        (json!([{ "key": "stop.duration_s", "from": 1, "to": 2, "count": 20000 }]), "must have either"),
        (json!("dp_m"), "vary (line 1): wrong type"),
    ];
    for (vary, expected) in cases {
        let (folder, sweep) = sweep_of(&vary);
        let out = folder.path().join("out");
        for command in ["sweep", "check"] {
            let mut arguments = vec![command, sweep.to_str().unwrap()];
            if command == "sweep" {
                arguments.extend(["--out", out.to_str().unwrap()]);
            }
            let ended = breakwater(&arguments);
            let message = String::from_utf8_lossy(&ended.stderr);
            assert_eq!(ended.status.code(), Some(2), "{vary}: {message}");
            assert!(message.contains(expected), "{vary}: {message}");
            assert!(!out.exists());
        }
    }
}

#[test]
fn a_key_that_is_varied_twice_is_refused() {
    let vary = json!([
        { "key": "numerics.cfl", "values": [0.1, 0.2] },
        { "key": "domain.dp_m", "values": [0.05] },
        { "key": "numerics.cfl", "values": [0.3] }
    ]);
    let (folder, sweep) = sweep_of(&vary);
    let refused = run(&sweep, &folder.path().join("out"));
    let message = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2));
    assert!(message.contains("vary[2]: numerics.cfl is varied twice"), "{message}");
}
