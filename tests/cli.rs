//! The command line: exit codes, messages, output files, and resuming after an interruption.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use breakwater::output::Impacts;
use serde_json::{Value, json};

const FILES: [&str; 14] = [
    "case.json",
    "checkpoint.h5",
    "contacts.csv",
    "diagnostics.csv",
    "energy.csv",
    "fluid.vtkhdf",
    "gauges.csv",
    "impacts.h5",
    "profile.csv",
    "report.html",
    "summary.json",
    "surface.vtkhdf",
    "units.csv",
    "units.vtkhdf",
];

const TABLES: [&str; 6] = ["contacts.csv", "diagnostics.csv", "energy.csv", "gauges.csv", "profile.csv", "units.csv"];

fn breakwater() -> Command {
    Command::new(env!("CARGO_BIN_EXE_breakwater"))
}

fn run(arguments: &[&str]) -> Output {
    breakwater().args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs a command that must succeed; returns its standard output.
fn succeed(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}\n{}", output.status, text(&output.stderr));
    text(&output.stdout)
}

/// Runs a command that must refuse its input with exit code 2 and without a panic; returns the error message.
fn refuse(arguments: &[&str]) -> String {
    let output = run(arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(!message.trim().is_empty() && !message.contains("panicked"), "{arguments:?}: {message}");
    message
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Writes a case that runs for seconds: water around one large Tetrapod, which is released after 0.02 s and moves.
fn tiny_case(folder: &Path) -> PathBuf {
    let case = json!({
        "title": "One unit in a tank",
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.3, "material": "mortar" },
        "domain": { "x_m": [0.0, 1.0], "width_m": 0.25, "sides": "periodic", "top_z_m": 0.5, "dp_m": 0.025,
                    "water": { "kind": "block", "x_m": [0.0, 0.6], "top_z_m": 0.3 } },
        "numerics": { "hold_units_s": 0.02 },
        "units": { "shape": "tetrapod", "height_m": 0.2, "mass_kg": 5.0, "material": "mortar",
                   "count": 1, "pitch_m": 0.25, "x_m": 0.75 },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.3 }],
        "gauges": [
            { "kind": "elevation", "name": "column", "x_m": 0.3 },
            { "kind": "pressure", "name": "bed", "at_m": [0.3, 0.1, 0.0] },
            { "kind": "velocity", "name": "front", "at_m": [0.6, 0.1, 0.05] }
        ],
        "output": { "fluid_interval_s": 0.05, "units_interval_s": 0.05, "surface_interval_s": 0.03, "series_interval_s": 0.005,
                    "checkpoint_interval_s": 0.02 },
        "stop": { "duration_s": 0.3 }
    });
    let file = folder.join("tiny.json");
    std::fs::write(&file, serde_json::to_string_pretty(&case).unwrap()).unwrap();
    file
}

fn read_json(file: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}

/// Returns the summary without the keys in which two runs of one case may differ.
fn lasting_summary(dir: &Path) -> Value {
    let mut summary = read_json(&dir.join("summary.json"));
    for key in ["wall_s", "outputs_s", "steps_per_s", "threads", "processor"] {
        summary.as_object_mut().unwrap().remove(key);
    }
    summary
}

fn assert_same_tables(a: &Path, b: &Path) {
    for table in TABLES {
        let [bytes_a, bytes_b] = [a, b].map(|dir| std::fs::read(dir.join(table)).unwrap());
        assert!(bytes_a == bytes_b, "{table}: {} and {} differ", a.display(), b.display());
    }
    assert_eq!(lasting_summary(a), lasting_summary(b));
    let [impacts_a, impacts_b] = [a, b].map(|dir| Impacts::read(&dir.join(Impacts::FILE)).unwrap());
    assert!(impacts_a == impacts_b, "{}: {} and {} differ", Impacts::FILE, a.display(), b.display());
}

/// Returns the bits of all numbers in a dataset of an HDF5 file.
fn numbers(file: &Path, dataset: &str) -> Vec<u64> {
    let values = hdf5_metno::File::open(file).unwrap().dataset(dataset).unwrap().read_raw::<f64>().unwrap();
    values.into_iter().map(f64::to_bits).collect()
}

fn bad_cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_cases");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files
}

#[test]
fn run_refuses_every_bad_case_and_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for case in bad_cases() {
        let message = refuse(&["run", path(&case), "--out", path(&out)]);
        assert!(message.contains(path(&case)), "{message}");
        assert!(!out.exists(), "{} left a folder", case.display());
    }
}

/// `/dev/full` refuses everything that is written to it, like a full disk.
#[cfg(target_os = "linux")]
#[test]
fn no_command_panics_if_its_output_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (tiny_case(folder.path()), folder.path().join("out"));
    let wave = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/tutorial/wave-alone.json");
    let full = || std::fs::File::options().write(true).open("/dev/full").unwrap();
    let commands: [&[&str]; 7] = [
        &["--help"],
        &["check", path(&case)],
        &["schema"],
        &["unit", "tetrapod", "--height-m", "1"],
        &["devices"],
        &["wave", path(&wave), "--overwrite", "--out", path(&out)],
        &["run", path(&case), "--overwrite", "--out", path(&out)],
    ];
    for arguments in commands {
        let ended = breakwater().args(arguments).stdout(full()).output().unwrap();
        let message = text(&ended.stderr);
        assert_eq!(ended.status.code(), Some(1), "{arguments:?}: {message}");
        assert!(message.contains("cannot write") && !message.contains("panicked"), "{arguments:?}: {message}");
        // Nobody can read the standard error, so only the exit code shows a panic, which has the code 101.
        let ended = breakwater().args(arguments).stdout(full()).stderr(full()).output().unwrap();
        assert_eq!(ended.status.code(), Some(1), "{arguments:?}");
    }
    assert!(out.join("summary.json").exists(), "the results of the run must be complete");
}

#[test]
fn run_refuses_bad_arguments_and_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (tiny_case(folder.path()), folder.path().join("out"));
    for threads in ["0", "100000", "-1", "many"] {
        refuse(&["run", path(&case), "--out", path(&out), &format!("--threads={threads}")]);
        assert!(!out.exists(), "--threads={threads} left a folder");
    }
    let message = refuse(&["run", path(&folder.path().join("no-such-case.json")), "--out", path(&out)]);
    assert!(message.contains("no-such-case.json: cannot be read"), "{message}");
    refuse(&["run"]);
    refuse(&["swim", path(&case)]);
    assert!(!out.exists());
}

#[test]
fn a_file_of_the_wrong_kind_is_refused_with_the_right_command() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let [flume, dry, fracture, sweep] =
        ["fudo/quick-look.json", "contact/drop-dolos.json", "fracture/dolos-drop.json", "fudo/friction-sweep.json"]
            .map(|name| cases.join(name).display().to_string());
    for (command, file, expected) in [
        ("run", &fracture, "is a fracture case; run it with breakwater fracture"),
        ("run", &sweep, "is a sweep; run it with breakwater sweep"),
        ("fracture", &flume, "is a flume case; run it with breakwater run"),
        ("wave", &dry, "is a dry test; run it with breakwater run"),
        ("sweep", &dry, "is a dry test; run it with breakwater run"),
        ("place", &sweep, "is a sweep; run it with breakwater sweep"),
        ("resume", &flume, "is a flume case, but must be the folder of a run; run it with breakwater run"),
        ("report", &fracture, "must be the folder of a run; run it with breakwater fracture"),
        ("run", &cases.display().to_string(), "is a folder, but must be an input file"),
    ] {
        let message = refuse(&[command, file]);
        assert!(message.contains(expected), "{command} {file}: {message}");
    }
}

#[test]
fn errors_in_any_kind_of_file_state_the_line_and_the_likely_key() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [
        ("{ \"vary\": [],\n \"title\": }", "line 2, column 11: not valid JSON"),
        ("{ \"vary\": [], \"titel\": \"\" }", "unknown key \"titel\"; did you mean \"title\"?"),
        ("{ \"poses\": [], \"titel\": \"\" }", "unknown key \"titel\"; did you mean \"title\"?"),
        (
            "{ \"dry_test\": { \"kind\": \"drop\", \"hight_m\": 1 } }",
            "unknown key \"hight_m\"; did you mean \"height_m\"?",
        ),
        ("{ \"fracture\": { \"mesh\": \"\", \"scales\": 1 } }", "did you mean \"scale\"?"),
    ] {
        let file = folder.path().join("file.json");
        std::fs::write(&file, text).unwrap();
        let message = refuse(&["check", path(&file)]);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn init_writes_a_case_that_check_accepts() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("mine.json");
    succeed(&["init", path(&case)]);
    let checked = succeed(&["check", path(&case)]);
    for line in ["particles", "files", "run time"] {
        assert!(checked.contains(line), "{checked}");
    }
    let message = refuse(&["init", path(&case)]);
    assert!(message.contains("exists already"), "{message}");
}

#[test]
fn bench_writes_its_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bench.json");
    succeed(&["bench", "--particles", "1000", "--seconds", "0.1", "--threads", "2", "--json", path(&file)]);
    let measured = read_json(&file);
    for key in ["particles", "neighbours_mean", "threads", "full_evaluations_per_s", "pairs_per_s", "share_of_peak"] {
        assert!(measured[key].as_f64().is_some_and(|value| value > 0.0), "{key}: {measured:#}");
    }
    assert_eq!(measured["threads"], 2);
    // The four measurements are still and moving water, each on one and two threads.
    assert_eq!(measured["measurements"].as_array().unwrap().len(), 4);
    let shares = measured["phases"].as_array().unwrap().iter().map(|phase| phase["share"].as_f64().unwrap());
    assert!((shares.sum::<f64>() - 1.0).abs() < 1e-9);
    refuse(&["bench", "--support", "20"]);
    let case = folder.path().join("case.json");
    succeed(&["init", path(&case)]);
    succeed(&["bench", path(&case), "--seconds", "0.1", "--threads", "1", "--json", path(&file)]);
    let measured = read_json(&file);
    assert!(measured["water_alone_per_s"].as_f64().is_some_and(|rate| rate > 0.0), "{measured:#}");
    refuse(&["bench", path(&case), "--particles", "1000"]);
}

#[test]
fn schema_prints_json() {
    let schema: Value = serde_json::from_str(&succeed(&["schema"])).unwrap();
    assert!(schema["properties"]["domain"].is_object() && schema["properties"]["flume"].is_object());
    let sweep: Value = serde_json::from_str(&succeed(&["schema", "--sweep"])).unwrap();
    assert_eq!(sweep["required"], serde_json::json!(["title", "case", "vary"]));
}

/// Example: `breakwater schema | head`.
#[test]
fn a_reader_that_closes_the_pipe_early_causes_no_error() {
    let mut program = breakwater().arg("schema").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(program.stdout.take());
    assert_eq!(text(&program.wait_with_output().unwrap().stderr), "");
}

#[test]
fn a_run_writes_all_output_files_and_summary_keys() {
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (tiny_case(folder.path()), folder.path().join("out"));
    let printed = succeed(&["run", path(&case), "--out", path(&out), "--quiet"]);
    assert!(printed.contains("0.30 s simulated") && printed.contains("report.html"), "{printed}");
    for file in FILES {
        let size = std::fs::metadata(out.join(file)).map(|data| data.len()).unwrap_or(0);
        assert!(size > 0, "{file} is missing or empty");
    }
    let leftovers = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name());
    let parts: Vec<_> = leftovers.filter(|name| name.to_string_lossy().ends_with(".part")).collect();
    assert!(parts.is_empty(), "{parts:?}");
    assert_eq!(std::fs::read(out.join("case.json")).unwrap(), std::fs::read(&case).unwrap());

    let summary = read_json(&out.join("summary.json"));
    for key in ["particles", "steps", "simulated_s", "wall_s", "damage_ratio", "mean_displacement_m"] {
        assert!(summary[key].is_number(), "the summary has no top-level key {key}");
    }
    assert!(summary["units"][0]["displacement_m"].is_number() && summary["units"][0]["damaged"].is_boolean());
    assert!((summary["simulated_s"].as_f64().unwrap() - 0.3).abs() < 1e-3);
    // The surge has reached the unit and moved it.
    assert!(summary["mean_displacement_m"].as_f64().unwrap() > 1e-3, "{}", summary["mean_displacement_m"]);
    let rows = std::fs::read_to_string(out.join("gauges.csv")).unwrap().lines().count();
    // The file has a heading, a row every 0.005 s from 0 to 0.3 s, and a row at the end.
    assert!((61..=63).contains(&rows), "{rows} rows of gauges");

    // The surge moves at about 2 m/s, and the speed of sound is 15 sqrt(9.81 x 0.3) = 25.7 m/s.
    let mach = summary["largest_mach"].as_f64().unwrap();
    assert!((0.03..0.3).contains(&mach), "{mach}");
    assert_eq!(summary["warnings"].as_array().map(Vec::is_empty), Some(mach <= 0.1));
    impacts_hold_the_water_loads(&out);
    files_are_about_as_large_as_estimated(&case, &out);
    refuse_to_overwrite(&case, &out);
    compare_needs_a_measured_wave(&out);
    report_can_be_rewritten(&out);
}

fn impacts_hold_the_water_loads(out: &Path) {
    let Impacts { places, impacts } = Impacts::read(&out.join(Impacts::FILE)).unwrap();
    assert!(!impacts.is_empty() && impacts.len() <= 16 && !places.is_empty());
    assert!(impacts.is_sorted_by(|a, b| a.event.peak_force >= b.event.peak_force));
    for impact in &impacts {
        let (event, water) = (&impact.event, impact.fluid.as_ref().unwrap());
        // The run lasts 0.3 s, and the water is at most 0.3 m deep.
        assert!(event.start >= 0.0 && event.start <= event.peak_time && event.peak_time <= event.end);
        assert!(event.end < 0.31 && event.before.position.is_finite());
        assert!(water.load.force.is_finite() && water.pressure.len() == places.len());
        assert!(water.pressure.iter().all(|pressure| pressure.is_finite() && pressure.abs() < 1e5));
    }
    assert!(impacts.iter().any(|impact| impact.fluid.as_ref().is_some_and(|f| f.pressure.iter().any(|p| *p > 100.0))));
}

/// Asserts that real and estimated file sizes differ by less than a factor of two. Small files contain large reserved
/// parts that are empty.
fn files_are_about_as_large_as_estimated(case: &Path, out: &Path) {
    let estimate = breakwater::output::OutputSize::estimate(&breakwater::case::Case::load(case).unwrap());
    let size = |file: &str| std::fs::metadata(out.join(file)).unwrap().len() as f64;
    let tables = ["diagnostics.csv", "energy.csv", "gauges.csv", "units.csv"].map(size).iter().sum::<f64>();
    let sizes = [
        ("fluid.vtkhdf", size("fluid.vtkhdf"), estimate.fluid),
        ("surface.vtkhdf", size("surface.vtkhdf"), estimate.surface),
        ("units.vtkhdf", size("units.vtkhdf"), estimate.units),
        ("tables", tables, estimate.tables),
        ("checkpoint.h5", size("checkpoint.h5"), estimate.checkpoint),
    ];
    for (file, size, estimate) in sizes {
        assert!((0.5..2.0).contains(&(size / estimate)), "{file}: {size} bytes, {estimate} estimated");
    }
}

fn refuse_to_overwrite(case: &Path, out: &Path) {
    let before = std::fs::read(out.join("summary.json")).unwrap();
    let message = refuse(&["run", path(case), "--out", path(out)]);
    assert!(message.contains("--overwrite") && message.contains("resume"), "{message}");
    assert_eq!(std::fs::read(out.join("summary.json")).unwrap(), before);
}

fn compare_needs_a_measured_wave(out: &Path) {
    let message = refuse(&["compare", path(out)]);
    assert!(message.contains("give one with --reference DIR"), "{message}");
    let message = refuse(&["compare", path(out), "--reference", "cases/fudo/reference"]);
    assert!(message.contains("no wave") && message.contains("solitary 0.026 m"), "{message}");
    assert!(!out.join("compare.html").exists());
}

#[test]
fn a_run_folder_keeps_the_measurements_and_can_be_moved() {
    let folder = tempfile::tempdir().unwrap();
    let case = tiny_case(folder.path());
    let mut measured = read_json(&case);
    measured["reference"] = path(&std::path::absolute("cases/fudo/reference").unwrap()).into();
    measured["stop"]["duration_s"] = json!(0.025);
    std::fs::write(&case, measured.to_string()).unwrap();
    let [out, moved] = ["out", "moved"].map(|name| folder.path().join(name));
    let said = succeed(&["run", path(&case), "--out", path(&out), "--quiet"]);
    assert!(said.contains("compare with the measurements: breakwater compare"), "{said}");
    std::fs::rename(&out, &moved).unwrap();
    assert_eq!(read_json(&moved.join("case.json"))["reference"], "reference");
    succeed(&["check", path(&moved.join("case.json")), path(&moved.join("reference/reference.json"))]);
    let message = refuse(&["compare", path(&moved)]);
    assert!(message.contains("no wave of known height"), "{message}");
}

fn report_can_be_rewritten(out: &Path) {
    std::fs::remove_file(out.join("report.html")).unwrap();
    succeed(&["report", path(out)]);
    assert!(std::fs::read_to_string(out.join("report.html")).unwrap().contains("One unit in a tank"));
}

#[test]
fn threads_do_not_change_the_tables() {
    let folder = tempfile::tempdir().unwrap();
    let case = tiny_case(folder.path());
    let [one, two] = ["1", "2"].map(|threads| {
        let out = folder.path().join(threads);
        succeed(&["run", path(&case), "--out", path(&out), "--quiet", "--threads", threads]);
        out
    });
    assert_eq!(read_json(&one.join("summary.json"))["threads"], 1);
    assert_same_tables(&one, &two);
}

#[test]
fn a_killed_run_resumes_to_the_same_results() {
    let folder = tempfile::tempdir().unwrap();
    let case = tiny_case(folder.path());
    let [whole, killed] = ["whole", "killed"].map(|name| folder.path().join(name));
    succeed(&["run", path(&case), "--out", path(&whole), "--quiet"]);

    let mut child = breakwater()
        .args(["run", path(&case), "--out", path(&killed), "--quiet"])
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !killed.join("checkpoint.h5").exists() {
        assert!(start.elapsed() < Duration::from_secs(120), "no checkpoint within two minutes");
        std::thread::sleep(Duration::from_millis(2));
    }
    // Meanwhile the run writes rows after the checkpoint. Resuming must remove these rows.
    std::thread::sleep(Duration::from_millis(100));
    child.kill().unwrap();
    assert!(child.wait().unwrap().code().is_none(), "the run ended before it was killed");
    assert!(!killed.join("summary.json").exists());

    succeed(&["resume", path(&killed), "--quiet"]);
    assert_same_tables(&whole, &killed);
    for file in FILES {
        assert!(killed.join(file).exists(), "{file} is missing after resuming");
    }
    let water = ["VTKHDF/Points", "VTKHDF/PointData/velocity", "VTKHDF/Steps/Values"];
    let units = ["VTKHDF/Points", "VTKHDF/Steps/Values"];
    for (file, datasets) in [("fluid.vtkhdf", &water[..]), ("surface.vtkhdf", &water), ("units.vtkhdf", &units)] {
        for dataset in datasets {
            let [a, b] = [&whole, &killed].map(|dir| numbers(&dir.join(file), dataset));
            assert!(!a.is_empty() && a == b, "{file}: {dataset} differs");
        }
    }
}

#[test]
fn the_report_of_a_run_in_progress_shows_it_and_ends_with_the_run() {
    // A part of the script with which the page loads itself again.
    const RELOADS: &str = "isBusy()) location.reload()";
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (tiny_case(folder.path()), folder.path().join("out"));
    let mut longer = read_json(&case);
    longer["stop"]["duration_s"] = json!(30.0);
    std::fs::write(&case, longer.to_string()).unwrap();
    let start =
        |arguments: &[&str]| breakwater().args(arguments).stderr(Stdio::null()).stdout(Stdio::null()).spawn().unwrap();
    let wait_for = |what: &str, is_true: &mut dyn FnMut() -> bool| {
        let begun = Instant::now();
        while !is_true() {
            assert!(begun.elapsed() < Duration::from_secs(120), "{what}: not within two minutes");
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    let report = || std::fs::read_to_string(out.join("report.html")).unwrap_or_default();
    let mut run = start(&["run", path(&case), "--out", path(&out), "--quiet"]);
    wait_for("summary of the run in progress", &mut || out.join("progress.json").exists());
    let mut live = start(&["report", path(&out), "--live"]);
    wait_for("report of the run in progress", &mut || report().contains(RELOADS));
    assert!(!out.join("summary.json").exists(), "the run has ended too early for this test");
    assert!(report().contains("film-head"), "the page has a film");
    wait_for("checkpoint", &mut || out.join("checkpoint.h5").exists());
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(live.try_wait().unwrap().is_none(), "a run that was killed can continue");
    succeed(&["resume", path(&out), "--until", "0.3", "--quiet"]);
    wait_for("end of the command", &mut || live.try_wait().unwrap().is_some());
    assert!(!report().contains(RELOADS), "the report of a finished run does not load itself again");
    assert!(!out.join("progress.json").exists());
}

#[test]
fn resume_refuses_a_folder_without_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let message = refuse(&["resume", path(folder.path())]);
    assert!(message.contains("case.json"), "{message}");
    let message = refuse(&["resume", path(&folder.path().join("nowhere"))]);
    assert!(message.contains("nowhere"), "{message}");
}

#[test]
fn resume_before_the_first_checkpoint_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let case = tiny_case(folder.path());
    std::fs::rename(&case, folder.path().join("case.json")).unwrap();
    let message = refuse(&["resume", path(folder.path())]);
    assert!(
        message.contains("checkpoint.h5: there is no checkpoint") && message.contains("breakwater run"),
        "{message}"
    );
}

#[test]
fn compare_and_report_refuse_a_folder_without_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let message = refuse(&["report", path(folder.path())]);
    assert!(message.contains("case.json"), "{message}");
    let message = refuse(&["compare", path(folder.path()), "--reference", "cases/fudo/reference"]);
    assert!(message.contains("case.json"), "{message}");
}

/// A failed write ends the run with a message that names the file.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_run_with_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (tiny_case(folder.path()), folder.path().join("out"));
    let mut many_snapshots = read_json(&case);
    many_snapshots["output"] = json!({ "fluid_interval_s": 0.002, "units_interval_s": 0.0, "surface_interval_s": 0.0 });
    std::fs::write(&case, many_snapshots.to_string()).unwrap();
    // Files are limited to 2400 blocks of 512 or 1024 bytes, a fifth of the size of fluid.vtkhdf. With the signal
    // ignored, the write fails as on a full disk.
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 2400; exec \"$0\" run \"$1\" --out \"$2\" --quiet"])
        .args([env!("CARGO_BIN_EXE_breakwater"), path(&case), path(&out)])
        .output()
        .unwrap();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("fluid.vtkhdf: HDF5: "), "{message}");
    assert!(!message.contains("panicked") && !out.join("summary.json").exists(), "{message}");
}

/// The invented record of another program is the wave of breakwater, 10 % higher, in the format of OpenFOAM's function
/// object interfaceHeight.
#[test]
fn wave_compares_its_gauges_with_those_of_another_program() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("flume.json");
    let content = json!({
        "title": "A wave along a short flume",
        "flume": { "bed_m": [[0.0, 0.0], [20.0, 0.0]], "still_water_level_m": 0.4 },
        "domain": { "x_m": [8.0, 12.0], "width_m": 0.5, "sides": "periodic", "top_z_m": 0.6, "dp_m": 0.05 },
        "wave": { "kind": "solitary", "height_m": 0.04 },
        "gauges": [{ "kind": "elevation", "name": "middle", "x_m": 6.0 }],
        "stop": { "duration_s": 2.0 }
    });
    std::fs::write(&case, content.to_string()).unwrap();
    let (alone, beside) = (folder.path().join("alone"), folder.path().join("beside"));
    succeed(&["wave", path(&case), "--out", path(&alone)]);
    let piston = std::fs::read_to_string(alone.join("flume_piston.csv")).unwrap();
    assert!(piston.starts_with("time_s,displacement_m,velocity_m_s\n0,0,"), "{}", &piston[..60]);

    let table = std::fs::read_to_string(alone.join("flume_gauges.csv")).unwrap();
    let position = |line: &str| {
        let (time, eta) = line.split_once(',').unwrap();
        format!("{time} (6 0 {})\n", 0.4 + 1.1 * eta.parse::<f64>().unwrap())
    };
    let other = folder.path().join("height");
    std::fs::create_dir_all(other.join("0")).unwrap();
    std::fs::write(other.join("0/position.dat"), table.lines().skip(1).map(position).collect::<String>()).unwrap();
    let printed = succeed(&["wave", path(&case), "--out", path(&beside), "--beside", path(&other)]);
    assert!(printed.contains("(+10.0 %)") && printed.contains("0.00 s)"), "{printed}");
    assert!(std::fs::read_to_string(beside.join("wave.html")).unwrap().contains("dashed"));

    let message = refuse(&["wave", path(&case), "--out", path(&folder.path().join("none")), "--beside", path(&alone)]);
    assert!(message.contains("position.dat"), "{message}");
    assert!(!folder.path().join("none").exists());
}

/// Checks the files that `tools/openfoam` writes. OpenFOAM itself is not run.
#[test]
fn openfoam_tool_writes_the_flume_case() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("vof");
    let case = root.join("cases/fudo/H4.5-slice.json");
    let command = ["--out", path(&out), "--coarsen", "4", "2", "--breakwater", env!("CARGO_BIN_EXE_breakwater")];
    let script = root.join("tools/openfoam/flume");
    let Ok(done) = Command::new("python3").arg(script).arg(&case).args(command).output() else {
        println!("skipped: python3 is not installed");
        return;
    };
    assert!(done.status.success(), "{}", text(&done.stderr));
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    // Cells are 8 cm long on 19 m of level bed. Probes are at the four gauges of the case and at the wavemaker.
    assert!(read("system/blockMeshDict").contains("(238 1 55)"), "{}", read("system/blockMeshDict"));
    assert_eq!(read("system/controlDict").matches("type            probes;").count(), 5);
    assert!(read("constant/piston").starts_with("(\n(0 (0 0 0))\n"));
    let driven: Value = serde_json::from_str(&read("H4.5-slice-openfoam.json")).unwrap();
    assert_eq!(driven["wave"]["source"]["format"], "openfoam");
    assert_eq!(driven["wave"]["source"]["water"], "alpha.water");
}

#[test]
fn a_folder_of_another_kind_is_named_with_the_command_that_fits() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, text).unwrap();
    };
    write("sweep/sweep.csv", "run\n");
    write("wave/wave.html", "<html>\n");
    write("reference/reference.json", "{}");
    write("other/notes.txt", "notes\n");
    let drop = include_str!("../cases/tutorial/drop.json");
    // A run that was stopped before its first checkpoint, and one after it.
    write("begun/case.json", drop);
    write("stopped/case.json", drop);
    write("stopped/checkpoint.json", "{}");
    write("dry/case.json", drop);
    write("dry/summary.json", "{}");
    let expected = [
        ("none", "there is no such folder"),
        ("sweep", "is the folder of a sweep; give one of its subfolders"),
        ("wave", "has the results of breakwater wave, see wave.html"),
        ("reference", "is a folder with measurements; compare a run with it: breakwater compare RUN --reference DIR"),
        ("other", "is not the folder of a run, because case.json is missing"),
        ("begun", "the run has not finished and has no checkpoint; start it again"),
        ("stopped", "the run has not finished; continue it with: breakwater resume"),
    ];
    for (name, reason) in expected {
        for command in ["report", "compare"] {
            let message = refuse(&[command, &at(name)]);
            assert!(message.contains(reason), "{command} {name}: {message}");
        }
    }
    for name in ["none", "sweep", "wave", "reference", "other"] {
        assert!(!refuse(&["resume", &at(name)]).is_empty());
    }
    assert!(refuse(&["report", &at("dry")]).contains("the run is a dry test, which has no report"));
    assert!(refuse(&["compare", &at("dry")]).contains("is a dry test, which has no wave"));
}
