//! Runs continue from their last checkpoint.

mod finished;
mod interrupted;

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use hdf5_metno::{File, Group};
use serde_json::{Value, json};

/// A dam break in a two-dimensional tank with a block that the water reaches. The block starts on one edge, inclined by
/// 10 degrees, and rocks.
fn tank() -> Value {
    json!({
        "title": "tank",
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.3, "material": "stone" },
        "domain": { "x_m": [0.0, 1.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": 0.025,
                    "water": { "kind": "block", "x_m": [0.0, 0.5], "top_z_m": 0.3 } },
        "numerics": { "hold_units_s": 0.02 },
        "units": { "shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3, "material": "stone",
                   "rocking_limit_deg": 0.1,
                   "poses": [{ "centre_m": [0.8, 0.0, 0.058],
                               "quaternion_xyzw": [0.0, 0.08715574, 0.0, 0.9961947] }] },
        "materials": [{ "name": "stone", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["stone", "stone"], "coefficient": 0.5 }],
        // Checkpoints are between rows, so that a mean over the time since the last row continues too.
        "gauges": [{ "kind": "elevation", "name": "wall", "x_m": 0.95 },
                   { "kind": "pressure", "name": "bed", "at_m": [0.1, 0.0, 0.0] },
                   { "kind": "force", "name": "block", "on": "units" }],
        "output": { "units_interval_s": 0.02, "series_interval_s": 0.005, "checkpoint_interval_s": 0.042 },
        "stop": { "duration_s": 0.2 }
    })
}

fn breakwater(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_breakwater"));
    command.args(arguments).arg("--quiet").stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn message(ended: &Output) -> String {
    String::from_utf8_lossy(&ended.stderr).into_owned()
}

/// Returns the values in a group of an HDF5 file as text, with names, types and shapes.
///
/// The bytes of the file may differ: a resumed run leaves gaps between its datasets.
fn values(group: &Group) -> String {
    let mut text = String::new();
    for name in group.attr_names().unwrap() {
        let attribute = group.attr(&name).unwrap();
        text += &format!("{} {name}: {:?}\n", group.name(), attribute.read_raw::<i64>().unwrap_or_default());
    }
    for dataset in group.datasets().unwrap() {
        let (kind, shape) = (dataset.dtype().unwrap().to_descriptor().unwrap(), dataset.shape());
        // Conversion to f64 is exact: the files have f32, f64, and integers below 2^53.
        let bits: Vec<u64> = dataset.read_raw::<f64>().unwrap().into_iter().map(f64::to_bits).collect();
        text += &format!("{}: {kind} {shape:?} {bits:x?}\n", dataset.name());
    }
    group.groups().unwrap().iter().fold(text, |text, inner| text + &values(inner))
}

/// Returns the paths of all files in a run folder, relative to the folder.
fn files(out: &Path) -> BTreeSet<PathBuf> {
    let (mut files, mut folders) = (BTreeSet::new(), vec![out.to_owned()]);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else {
                files.insert(path.strip_prefix(out).unwrap().to_owned());
            }
        }
    }
    files
}

/// Returns the results in a file. `summary.json` is without the keys that tell the wall time, and without the hash of
/// the case.
fn content(path: &Path) -> Vec<u8> {
    if path.ends_with("summary.json") {
        let mut summary: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
        for key in ["execution", "wall_s", "outputs_s", "steps_per_s", "tet_steps_per_s", "case_hash"] {
            summary.as_object_mut().unwrap().remove(key);
        }
        summary.to_string().into_bytes()
    } else if path.extension().is_some_and(|kind| kind == "vtkhdf") {
        values(&File::open(path).unwrap()).into_bytes()
    } else {
        fs::read(path).unwrap()
    }
}

/// Asserts that two run folders have the same files with the same results, except for checkpoints and reports, which
/// contain wall times, and for the files `other_files`.
fn assert_same_results(one: &Path, other: &Path, other_files: &[&str]) {
    let names = files(one);
    assert_eq!(names, files(other));
    for path in names {
        let name = path.file_name().unwrap().to_str().unwrap();
        if !name.starts_with("checkpoint.") && name != "report.html" && !other_files.contains(&name) {
            assert!(content(&one.join(&path)) == content(&other.join(&path)), "{} differs", path.display());
        }
    }
}
