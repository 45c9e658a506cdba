//! A run that starts from the checkpoint of another run gives the same bits as an uninterrupted run, or is refused with
//! a reason.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::{Value, json};

/// A dam break that reaches one large Tetrapod after 0.1 s; the unit is at rest until then.
fn surge(friction: f64, duration: f64) -> Value {
    json!({
        "title": format!("Surge, friction {friction}"),
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.3, "material": "mortar" },
        "domain": { "x_m": [0.0, 1.0], "width_m": 0.25, "sides": "periodic", "top_z_m": 0.5, "dp_m": 0.025,
                    "water": { "kind": "block", "x_m": [0.0, 0.6], "top_z_m": 0.3 } },
        "numerics": { "hold_units_s": 0.02 },
        "units": { "shape": "tetrapod", "height_m": 0.2, "mass_kg": 5.0, "material": "mortar",
                   "count": 1, "pitch_m": 0.25, "x_m": 0.75 },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": friction }],
        "gauges": [{ "kind": "elevation", "name": "column", "x_m": 0.3 }],
        "output": { "units_interval_s": 0.02, "series_interval_s": 0.005, "checkpoint_interval_s": 0.02 },
        "stop": { "duration_s": duration }
    })
}

fn write(folder: &Path, name: &str, value: &Value) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, value.to_string()).unwrap();
    path
}

fn breakwater(arguments: &[&Path]) -> Output {
    let program = env!("CARGO_BIN_EXE_breakwater");
    Command::new(program).args(arguments).args(["--device", "cpu"]).output().unwrap()
}

fn run(case: &Path, out: &Path, from: Option<&Path>) -> Output {
    let mut arguments = vec![Path::new("run"), case, Path::new("--quiet"), Path::new("--out"), out];
    if let Some(from) = from {
        arguments.extend([Path::new("--from"), from]);
    }
    breakwater(&arguments)
}

fn assert_succeeded(ended: &Output) {
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
}

fn assert_refused(ended: &Output, reason: &str) {
    let message = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(2), "{message}");
    assert!(message.contains(reason), "{message}");
}

fn summary(dir: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(dir.join("summary.json")).unwrap()).unwrap()
}

/// Writes the case and a sweep that varies the given keys.
fn sweep_of(folder: &Path, vary: &Value, start: f64) -> PathBuf {
    write(folder, "surge.json", &surge(0.5, 0.25));
    let sweep = json!({ "title": "Friction", "case": "surge.json", "vary": vary, "common_start_s": start });
    write(folder, "sweep.json", &sweep)
}

fn displacement(dir: &Path) -> f64 {
    summary(dir)["mean_displacement_m"].as_f64().unwrap()
}

#[test]
fn runs_from_a_common_start_equal_uninterrupted_runs() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let friction = json!([{ "key": "friction[0].coefficient", "values": [0.5, 0.1] }]);
    let sweep = sweep_of(folder.path(), &friction, 0.06);
    let out = at("out");
    assert_succeeded(&breakwater(&[Path::new("sweep"), &sweep, Path::new("--out"), &out]));
    let start_time = summary(&out.join("000_start"))["simulated_s"].as_f64().unwrap();
    assert!((0.06..0.065).contains(&start_time), "{start_time}");
    let table = fs::read_to_string(out.join("sweep.csv")).unwrap();
    assert!(table.lines().count() == 3 && !table.contains("000_start"), "{table}");

    // This run has the same friction coefficient as the run that wrote the checkpoint.
    let branched = out.join("001_coefficient=0.5");
    assert_succeeded(&run(&at("surge.json"), &at("whole"), None));
    let (unbroken, summary) = (summary(&at("whole")), summary(&branched));
    for key in ["steps", "simulated_s", "mean_displacement_m", "damage_ratio", "units", "contacts", "largest_mach"] {
        assert!(!unbroken[key].is_null() && unbroken[key] == summary[key], "{key}: {unbroken:#} {summary:#}");
    }
    for file in ["gauges.csv", "units.csv", "contacts.csv", "energy.csv", "diagnostics.csv"] {
        let text = |dir: &Path| fs::read_to_string(dir.join(file)).unwrap();
        assert!(text(&at("whole")) == text(&branched), "{file}");
    }
    assert!(summary["warnings"].to_string().contains("with the friction of another run"));
    let slippery = out.join("002_coefficient=0.1");
    assert!(displacement(&slippery) > 1.1 * displacement(&branched));

    // The same run is started with `--from` on the command line.
    let case = write(folder.path(), "slippery.json", &surge(0.1, 0.25));
    assert_succeeded(&run(&case, &at("slippery"), Some(&out.join("000_start"))));
    assert_eq!(displacement(&at("slippery")), displacement(&slippery));
}

#[test]
fn starting_at_an_unsuitable_checkpoint_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let case = write(folder.path(), "case.json", &surge(0.1, 0.3));
    assert_refused(&run(&case, &at("out"), Some(&at("none"))), "the run cannot begin there: there is no checkpoint.h5");
    assert!(!at("out").exists());

    // At the last checkpoint of this run, the surge has moved the unit.
    assert_succeeded(&run(&case, &at("moved"), None));
    assert_refused(&run(&case, &at("moved"), Some(&at("moved"))), "is the folder of the results");
    assert!(at("moved").join("summary.json").exists());
    let rough = write(folder.path(), "rough.json", &surge(0.4, 0.3));
    assert_refused(&run(&rough, &at("rough"), Some(&at("moved"))), "begin while all units are still");

    let mut deeper = surge(0.1, 0.4);
    deeper["flume"]["still_water_level_m"] = json!(0.31);
    let deeper = write(folder.path(), "deeper.json", &deeper);
    assert_refused(
        &run(&deeper, &at("deeper"), Some(&at("moved"))),
        "the cases differ in flume.still_water_level_m, stop.duration_s; only title,",
    );
    let dry = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/contact/tilt-tetrapod.json");
    assert_refused(&run(&dry, &at("dry"), Some(&at("moved"))), "only flume cases can begin at the checkpoint");
    assert!(!at("rough").exists() && !at("deeper").exists() && !at("dry").exists());
}

#[test]
fn a_common_start_is_refused_if_runs_differ_before_it() {
    let folder = tempfile::tempdir().unwrap();
    let friction = json!([{ "key": "friction[0].coefficient", "values": [0.1, 0.5] }]);
    let size = json!([{ "key": "domain.dp_m", "values": [0.025, 0.024] }]);
    let refused_sweeps = [
        (&size, 0.06, "common_start_s: the cases differ in domain.dp_m;"),
        (&friction, 0.25, "common_start_s = 0.25: must be above 0 and below stop.duration_s, 0.25"),
        (&friction, 0.0, "common_start_s = 0: must be"),
    ];
    for (vary, start, reason) in refused_sweeps {
        let (sweep, out) = (sweep_of(folder.path(), vary, start), folder.path().join("out"));
        assert_refused(&breakwater(&[Path::new("sweep"), &sweep, Path::new("--out"), &out]), reason);
        assert!(!out.exists());
    }
}
