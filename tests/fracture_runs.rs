//! Fracture runs from the command line: files, exit codes, resuming after an interruption, and failure messages.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use breakwater::case::FractureCase;
use breakwater::femdem::world::World;
use breakwater::femdem::world::limits::StepError;
use breakwater::femdem::world::snapshot::Snapshot;
use breakwater::simulation::fracture::failure::Failure;
use breakwater::simulation::fracture::run::world;
use glam::DVec3;
use serde_json::{Value, json};

const FILES: [&str; 13] = [
    "bodies.csv",
    "case.json",
    "checkpoint.h5",
    "cracks.csv",
    "cracks.vtkhdf",
    "energy.csv",
    "fragments.csv",
    "mesh.msh",
    "report.html",
    "section.vtkhdf",
    "summary.json",
    "surfaces.vtkhdf",
    "tets.vtkhdf",
];

/// Returns the case of a block with a crack, 12 x 8 x 8 cm, thrown at a plate: 108 tetrahedra, some of which break off
/// within 1 ms.
fn thrown() -> Value {
    json!({
        "title": "A block thrown at a plate",
        "fracture": { "mesh": concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/meshes/block_on_plate.msh") },
        "gravity_m_s2": [0.0, 0.0, -9.8],
        "bodies": [
            { "name": "block", "material": "concrete", "cracks": true, "velocity_m_s": [2.0, 1.0, -8.0],
              "angular_velocity_rad_s": [5.0, 20.0, 0.0], "pivot_m": [0.06, 0.04, 0.04] },
            { "name": "plate", "material": "concrete" }
        ],
        "constraints": [{ "set": "plate_bottom", "velocity_m_s": [0.0, 0.0, 0.0] }],
        "materials": [{
            "name": "concrete", "density_kg_m3": 2340.0, "young_modulus_pa": 26e9, "poisson_ratio": 0.2,
            "viscosity_pa_s": 2e4,
            "strength": { "tensile_pa": 3.3e6, "cohesion_pa": 16.5e6, "friction_angle_deg": 30.0,
                          "fracture_energy_j_m2": 50.0 }
        }],
        "friction": [
            { "between": ["block", "plate"], "coefficient": 0.6 },
            { "between": ["block", "block"], "coefficient": 0.6 }
        ],
        "output": { "surfaces_interval_s": 1e-4, "energy_interval_s": 2e-5, "checkpoint_interval_s": 5e-5,
                    "tets_interval_s": 2e-4 },
        "stop": { "duration_s": 1e-3 }
    })
}

fn written(case: &Value, folder: &Path) -> PathBuf {
    let file = folder.join("thrown.json");
    std::fs::write(&file, serde_json::to_string_pretty(case).unwrap()).unwrap();
    file
}

fn loaded(case: &Value) -> FractureCase {
    FractureCase::from_str(&case.to_string(), "thrown.json").unwrap_or_else(|errors| panic!("{errors}"))
}

fn breakwater(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_breakwater")).args(arguments).output().unwrap()
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn succeed(arguments: &[&str]) {
    let output = breakwater(arguments);
    assert!(output.status.success(), "{arguments:?}: {}\n{}", output.status, message(&output));
}

/// Runs a command that must end with this exit code and without a panic; returns its error message.
fn end_with(code: i32, arguments: &[&str]) -> String {
    let output = breakwater(arguments);
    let message = message(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn read_json(file: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}

/// Returns the names and the bytes of all datasets of an HDF5 file.
fn datasets(file: &Path) -> Vec<(String, Vec<u8>)> {
    fn collect(group: &hdf5_metno::Group, found: &mut Vec<(String, Vec<u8>)>) {
        for dataset in group.datasets().unwrap() {
            let size = dataset.dtype().unwrap().size();
            let bits = match (size, dataset.dtype().unwrap().is::<f64>()) {
                (8, true) => bytes::<f64, 8>(&dataset, f64::to_le_bytes),
                (8, false) => bytes::<i64, 8>(&dataset, i64::to_le_bytes),
                (4, _) if dataset.dtype().unwrap().is::<f32>() => bytes::<f32, 4>(&dataset, f32::to_le_bytes),
                (4, _) => bytes::<i32, 4>(&dataset, i32::to_le_bytes),
                _ => bytes::<u8, 1>(&dataset, u8::to_le_bytes),
            };
            found.push((dataset.name(), bits));
        }
        group.groups().unwrap().iter().for_each(|inner| collect(inner, found));
    }
    fn bytes<T: hdf5_metno::H5Type, const N: usize>(
        dataset: &hdf5_metno::Dataset,
        to: impl Fn(T) -> [u8; N],
    ) -> Vec<u8> {
        dataset.read_raw::<T>().unwrap().into_iter().flat_map(to).collect()
    }
    let mut found = Vec::new();
    collect(&hdf5_metno::File::open(file).unwrap(), &mut found);
    found.sort();
    found
}

/// Returns the summary without the keys that depend on clock and machine.
fn lasting_summary(dir: &Path) -> Value {
    let mut summary = read_json(&dir.join("summary.json"));
    summary["tet_steps_per_s"].take();
    summary["execution"].take();
    summary
}

fn assert_same_results(a: &Path, b: &Path) {
    for file in ["energy.csv", "bodies.csv"] {
        let [one, other] = [a, b].map(|dir| std::fs::read(dir.join(file)).unwrap());
        assert!(one == other, "{file}: {} and {} differ", a.display(), b.display());
    }
    for file in ["surfaces.vtkhdf", "cracks.vtkhdf"] {
        let [one, other] = [a, b].map(|dir| datasets(&dir.join(file)));
        assert!(one.len() > 10, "{file}");
        for (one, other) in one.iter().zip(&other) {
            assert!(one == other, "{file}: {} differs between {} and {}", one.0, a.display(), b.display());
        }
    }
    assert_eq!(lasting_summary(a), lasting_summary(b));
}

#[test]
fn a_run_writes_all_output_files_and_summary_keys() {
    let folder = tempfile::tempdir().unwrap();
    let (case, out) = (written(&thrown(), folder.path()), folder.path().join("out"));
    succeed(&["fracture", path(&case), "--out", path(&out), "--quiet"]);
    for file in FILES {
        let size = std::fs::metadata(out.join(file)).map_or(0, |data| data.len());
        assert!(size > 0, "{file} is missing or empty");
    }
    let parts = std::fs::read_dir(&out).unwrap().filter(|e| path(&e.as_ref().unwrap().path()).ends_with(".part"));
    assert_eq!(parts.count(), 0);
    let summary = read_json(&out.join("summary.json"));
    assert_eq!(summary["tets"], 108);
    for key in ["steps", "tet_steps_per_s", "energy_residual_ratio", "crack_area_m2"] {
        assert!(summary[key].as_f64().is_some_and(|value| value > 0.0), "{key}: {}", summary[key]);
    }
    let fragments = summary["fragments"].as_array().unwrap();
    assert!(!fragments.is_empty() && fragments.iter().all(|piece| piece["mass_kg"].as_f64().unwrap() > 0.0));
    let first = &summary["initiation"][0];
    assert!(first["t_s"].as_f64().unwrap() > 0.0 && ["opening", "sliding"].contains(&first["mode"].as_str().unwrap()));
    assert_eq!(first["place"].as_array().unwrap().len(), 3);
    // The file has a heading, and a row every 2e-5 s from 0 to 1e-3 s.
    let rows = std::fs::read_to_string(out.join("energy.csv")).unwrap().lines().count();
    assert!((51..=53).contains(&rows), "{rows} rows");
    let message = end_with(2, &["fracture", path(&case), "--out", path(&out)]);
    assert!(message.contains("--overwrite"), "{message}");
}

#[test]
fn a_refused_case_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut case = thrown();
    case["materials"][0]["density_kg_m3"] = json!(-1.0);
    let message = end_with(2, &["fracture", path(&written(&case, folder.path())), "--out", path(&out)]);
    assert!(message.contains("materials[0].density_kg_m3 = -1: must be at least 1"), "{message}");
    // The longest stable time step is known only after the model is assembled.
    let mut case = thrown();
    case["fracture"]["dt_s"] = json!(1e-4);
    let file = written(&case, folder.path());
    for command in [&["check", path(&file)][..], &["fracture", path(&file), "--out", path(&out)]] {
        let message = end_with(2, command);
        assert!(message.contains("thrown.json: fracture.dt_s = 1.000e-4: must be at most"), "{message}");
    }
    let message = end_with(2, &["fracture", path(&folder.path().join("none.json")), "--out", path(&out)]);
    assert!(message.contains("none.json: cannot be read"), "{message}");
    assert!(!out.exists());
}

/// Restores snapshots of several moments into new worlds and continues with one or two threads.
#[test]
fn a_world_restored_at_any_moment_ends_with_the_same_bits() {
    for joints in ["tied", "intrinsic"] {
        let mut case = thrown();
        case["fracture"]["joints"] = json!(joints);
        let case = loaded(&case);
        let mut whole = world(&case).unwrap();
        let nodes_at_start = whole.nodes.count();
        let mut moments: Vec<(&str, Snapshot)> = Vec::new();
        let mut keep_first = |name, happened: bool, world: &World| {
            if happened && moments.iter().all(|(known, _)| *known != name) {
                moments.push((name, world.snapshot()));
            }
        };
        while whole.time < case.duration {
            whole.step().unwrap();
            keep_first("first time step", true, &whole);
            keep_first("contact", whole.contacts.scalars.touching > 0, &whole);
            keep_first("split nodes", whole.nodes.count() > nodes_at_start, &whole);
            keep_first("first failure", !whole.failures.is_empty(), &whole);
            keep_first("friction on cracks", whole.failures.len() > 5 && whole.contacts.scalars.friction > 0.0, &whole);
            keep_first("half way", whole.time > 0.5 * case.duration, &whole);
        }
        let names: Vec<&str> = moments.iter().map(|(name, _)| *name).collect();
        assert_eq!(moments.len(), if joints == "tied" { 6 } else { 5 }, "{names:?}");
        let (end, energies) = (whole.snapshot(), whole.step_with_energies().unwrap());
        for (number, (name, moment)) in moments.into_iter().enumerate() {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1 + number % 2).build().unwrap();
            pool.install(|| {
                let mut resumed = world(&case).unwrap();
                resumed.restore(moment.clone()).unwrap();
                assert!(resumed.snapshot() == moment, "{joints}, {name}: the restored state differs from the snapshot");
                while resumed.time < case.duration {
                    resumed.step().unwrap();
                }
                assert!(resumed.snapshot() == end, "{joints}, {name}: the final state differs");
                assert_eq!(resumed.step_with_energies().unwrap(), energies, "{joints}, {name}");
            });
        }
    }
}

/// A part of the expected error message, and the function that corrupts the state.
type Corruption = (&'static str, fn(&mut Snapshot));

#[test]
fn a_state_that_does_not_fit_the_mesh_is_refused() {
    let case = loaded(&thrown());
    let mut reference = world(&case).unwrap();
    while reference.failures.len() < 3 {
        reference.step().unwrap();
    }
    let valid = reference.snapshot();
    let corrupt: [Corruption; 9] = [
        ("nodes", |s| s.position.truncate(3)),
        ("nodes", |s| s.vertices[7][2] = u32::MAX),
        ("nodes", |s| s.vertices.truncate(5)),
        ("separate in the mesh", |s| s.vertices[7][2] = s.vertices[7][1]),
        ("joints", |s| s.bonds.truncate(1)),
        ("unknown bond", |s| s.bonds[0] = 9),
        ("joints", |s| s.failed[0] = u32::MAX),
        ("pairs", |s| s.contacts.tets[0] = [u32::MAX; 2]),
        ("friction", |s| s.contacts.pairs_with_spring.push(u32::MAX)),
    ];
    for (expected, corrupt) in corrupt {
        let mut corrupted = valid.clone();
        corrupt(&mut corrupted);
        let error = world(&case).unwrap().restore(corrupted).unwrap_err();
        assert!(error.contains(expected), "expected: {expected}\nmessage:  {error}");
    }
}

#[test]
fn a_killed_run_resumes_to_the_same_results() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = thrown();
    // The run lasts long enough to be killed.
    case["stop"]["duration_s"] = json!(5e-3);
    case["output"]["surfaces_interval_s"] = json!(2e-4);
    case["output"]["checkpoint_interval_s"] = json!(2e-4);
    let case = written(&case, folder.path());
    let [whole, killed] = ["whole", "killed"].map(|name| folder.path().join(name));
    succeed(&["fracture", path(&case), "--out", path(&whole), "--quiet", "--threads", "1"]);

    let mut child = Command::new(env!("CARGO_BIN_EXE_breakwater"))
        .args(["fracture", path(&case), "--out", path(&killed), "--quiet", "--threads", "2"])
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !killed.join("checkpoint.h5").exists() {
        assert!(start.elapsed() < Duration::from_secs(120), "no checkpoint within two minutes");
        std::thread::sleep(Duration::from_millis(1));
    }
    // Meanwhile the run writes rows after the checkpoint. Resuming must remove these rows.
    std::thread::sleep(Duration::from_millis(10));
    child.kill().unwrap();
    assert!(child.wait().unwrap().code().is_none(), "the run ended before it was killed");
    assert!(!killed.join("summary.json").exists());

    succeed(&["resume", path(&killed), "--quiet", "--threads", "2"]);
    assert_same_results(&whole, &killed);
    // A finished run resumes from its last checkpoint to the same results.
    succeed(&["resume", path(&killed), "--quiet", "--threads", "1"]);
    assert_same_results(&whole, &killed);
}

#[test]
fn resume_reports_what_is_wrong_with_a_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let mut no_checkpoint = thrown();
    no_checkpoint["output"]["checkpoint_interval_s"] = json!(0.0);
    no_checkpoint["stop"]["duration_s"] = json!(1e-4);
    no_checkpoint["bodies"][0]["velocity_m_s"] = json!([0.0, 0.0, -3.9]);
    let (case, out) = (written(&no_checkpoint, folder.path()), folder.path().join("out"));
    succeed(&["fracture", path(&case), "--out", path(&out), "--quiet"]);
    std::fs::remove_file(out.join("checkpoint.h5")).unwrap();
    let message = end_with(2, &["resume", path(&out)]);
    assert!(message.contains("finished without a checkpoint") && message.contains("summary.json"), "{message}");
    std::fs::write(out.join("checkpoint.h5"), b"not an HDF5 file").unwrap();
    let message = end_with(1, &["resume", path(&out)]);
    assert!(message.contains("checkpoint.h5: is damaged or incomplete"), "{message}");

    let other = folder.path().join("other");
    succeed(&["fracture", path(&written(&thrown(), folder.path())), "--out", path(&other), "--quiet"]);
    std::fs::copy(other.join("checkpoint.h5"), out.join("checkpoint.h5")).unwrap();
    let message = end_with(1, &["resume", path(&out)]);
    assert!(message.contains("the cases differ in bodies; only title, assumptions,"), "{message}");
    let mut damaged = std::fs::read(other.join("checkpoint.h5")).unwrap();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    std::fs::write(out.join("checkpoint.h5"), damaged).unwrap();
    let message = end_with(1, &["resume", path(&out)]);
    assert!(message.contains("checkpoint.h5: is damaged or incomplete"), "{message}");
    std::fs::write(other.join("energy.csv"), "time_s\n").unwrap();
    let message = end_with(1, &["resume", path(&other)]);
    assert!(message.contains("energy.csv: has 7 bytes, fewer than"), "{message}");
}

#[test]
fn an_unstable_run_keeps_its_state_and_its_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = thrown();
    // At 5 km/s the block is destroyed.
    case["bodies"][0]["velocity_m_s"] = json!([0.0, 0.0, -4.0]);
    case["bodies"][0]["angular_velocity_rad_s"] = json!([0.0, 0.0, 0.0]);
    case["bodies"][1]["velocity_m_s"] = json!([0.0, 0.0, 5000.0]);
    case["constraints"] = json!([]);
    case["output"]["checkpoint_interval_s"] = json!(1e-7);
    case["fracture"]["dt_s"] = json!(1e-8);
    let (case, out) = (written(&case, folder.path()), folder.path().join("out"));
    let message = end_with(1, &["fracture", path(&case), "--out", path(&out), "--quiet"]);
    for part in ["after 0.0", "(step ", " of body \"", "m, ", "failed.h5; the last regular checkpoint is unchanged"] {
        assert!(message.contains(part), "\"{part}\" is missing:\n{message}");
    }
    let state = |file: &str| -> Value {
        let file = hdf5_metno::File::open(out.join(file)).unwrap();
        let text = file.attr("state").unwrap().read_scalar::<hdf5_metno::types::VarLenUnicode>().unwrap();
        serde_json::from_str(&text).unwrap()
    };
    let time = |file: &str| state(file)["world"]["time"].as_f64().unwrap();
    assert!(time("checkpoint.h5") <= time("failed.h5"));
    assert!(!out.join("summary.json").exists());
}

/// Corrupts a world after three time steps and advances it until it fails; returns the error and the run's message.
fn run_corrupted(case: &Value, corrupt: impl Fn(&mut World), steps: usize) -> (StepError, String) {
    let case = loaded(case);
    let mut world = world(&case).unwrap();
    (0..3).for_each(|_| world.step().unwrap());
    corrupt(&mut world);
    for step in 3..3 + steps {
        if let Err(error) = world.step().and_then(|()| world.check_limits()) {
            return (error, Failure::of(&case, &world, step as u64, error).to_string());
        }
    }
    panic!("the corrupted world did not fail");
}

#[test]
fn an_unstable_world_names_the_node_or_element() {
    let mut thrown = thrown();
    // Breakable joints would move the neighbours of the node in the same time step.
    thrown["fracture"]["joints"] = json!("tied");
    let move_node_to = |to: DVec3| move |world: &mut World| world.nodes.position[5] = to;
    let (error, message) = run_corrupted(&thrown, |world| world.nodes.velocity[5].y = f64::NAN, 2);
    // Viscosity spreads the NaN to neighbouring nodes, so the message may name any of these nodes.
    assert!(matches!(error, StepError::NotFinite { .. }), "{message}");
    assert!(message.contains(" of body \"block\", in the mesh at (0.") && message.contains("step_share"), "{message}");
    let (error, message) = run_corrupted(&thrown, move_node_to(DVec3::new(f64::INFINITY, 0.0, 0.0)), 2);
    assert!(matches!(error, StepError::NotFinite { node: 5, .. }), "{message}");

    // The node is moved 1 m down, through its tetrahedra.
    let (error, message) = run_corrupted(&thrown, move_node_to(DVec3::NEG_Z), 2);
    assert!(matches!(error, StepError::Inverted { .. }) && message.contains("is inverted"), "{message}");
    assert!(message.contains("tetrahedron ") && message.contains("(step 3)"), "{message}");

    // The wave speed of the concrete is 3514 m/s.
    let (error, message) = run_corrupted(&thrown, |world| world.nodes.velocity[5].x = 1e5, 2);
    assert!(matches!(error, StepError::TooFast { node: 5, .. }), "{message}");
    assert!(message.contains("more than the limit of 7.0") && message.contains("node "), "{message}");

    // All nodes move, so no element is distorted; the limit is 50 diagonals of 0.3 m, 15 m.
    let move_all = |world: &mut World| world.nodes.position.iter_mut().for_each(|place| place.x += 30.0);
    let (error, message) = run_corrupted(&thrown, move_all, 2);
    assert!(matches!(error, StepError::Escaped { .. }), "{message}");
    assert!(message.contains("m from the middle of the mesh") && message.contains("stop.duration_s"), "{message}");
}

#[test]
fn a_contact_that_is_too_soft_is_reported_with_advice() {
    let mut case = thrown();
    case["fracture"]["contact_penalty"] = json!(1e-3);
    case["fracture"]["joints"] = json!("unbreakable");
    case["bodies"][0]["velocity_m_s"] = json!([0.0, 0.0, -200.0]);
    let (error, message) = run_corrupted(&case, |_| {}, 2000);
    assert!(matches!(error, StepError::TooDeep { .. }), "{message}");
    assert!(message.contains("overlap by 2") && message.contains("raise fracture.contact_penalty"), "{message}");
}
