//! Run folders with a checkpoint, of a flume run, a dry test and a fracture run: damages files, resumes the run
//! and writes its report.
//!
//! The input is the seed of the damage, so the fuzzer's own mutations are enough.

#![no_main]

use std::fs;
use std::sync::{Arc, LazyLock};

use breakwater::case::InputFile;
use breakwater::output::driver::Control;
use breakwater::report;
use breakwater::simulation::{dry_test, flume, fracture};
use breakwater_fuzz::folder::{Folder, read};
use breakwater_fuzz::{damage::Damage, random::Random};
use libfuzzer_sys::fuzz_target;

/// A finished run that left a checkpoint: name and content of all files in its folder.
type Run = Vec<(String, Vec<u8>)>;

static FOLDER: LazyLock<Folder> = LazyLock::new(Folder::new);
static RUNS: LazyLock<Vec<Run>> = LazyLock::new(|| cases().iter().map(|case| run(case)).collect());
static DAMAGE: LazyLock<Damage> = LazyLock::new(|| Damage::new(&RUNS));

fuzz_target!(|input: &[u8]| {
    let seed = input.iter().fold(0x811C_9DC5_u32, |hash, byte| (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193));
    let mut random = Random::new(seed);
    let run = random.pick(&RUNS);
    let dir = FOLDER.path("run");
    let _ = fs::remove_dir_all(&dir);
    for (name, content) in run {
        FOLDER.write(&format!("run/{name}"), content);
    }
    for number in 0..1 + random.below(2) {
        DAMAGE.apply(&dir, number == 0, &mut random);
    }
    let Ok(case) = InputFile::load(dir.join("case.json")) else { return };
    let before = run.iter().find(|(name, _)| name == "case.json").map_or(0.0, |(_, case)| duration(case));
    // A user may lengthen a run; the damaged file can ask for a run of hours.
    if duration(&fs::read(dir.join("case.json")).unwrap()) > 10.0 * before {
        return;
    }
    // A report takes much longer than the rest.
    let reports = random.below(500) == 0;
    // The result does not matter: the run may fail, but must neither panic nor run forever.
    let control = Control::quiet();
    match case {
        InputFile::Flume(case) => {
            let options = flume::run::RunOptions { control, ..Default::default() };
            let _ = flume::run::resume(Arc::from(case), &dir, &options);
            if reports {
                let _ = report::run::write_report(&dir);
            }
        }
        InputFile::DryTest(case) => {
            let _ = dry_test::run::resume(Arc::from(case), &dir, &control);
        }
        InputFile::Fracture(case) => {
            if let Ok(world) = fracture::run::world(&case) {
                let _ = fracture::run::resume(&case, world, &dir, &control);
                if reports {
                    let _ = report::fracture::write_fracture_report(&dir);
                }
            }
        }
        _ => {}
    }
});

/// Returns the duration of a case [s].
fn duration(case: &[u8]) -> f64 {
    let case: serde_json::Value = serde_json::from_slice(case).unwrap_or_default();
    case["stop"]["duration_s"].as_f64().unwrap_or_default()
}

/// Runs a case to its end; returns the files in the folder of the run.
fn run(case: &str) -> Run {
    FOLDER.write("mesh.msh", &read("tests/data/meshes/block_on_plate.msh"));
    FOLDER.write("case.json", case.as_bytes());
    let dir = FOLDER.path("run");
    let _ = fs::remove_dir_all(&dir);
    fs::create_dir(&dir).unwrap();
    let control = Control::quiet();
    match InputFile::load(FOLDER.path("case.json")).unwrap_or_else(|errors| panic!("{errors}")) {
        InputFile::Flume(case) => {
            let options = flume::run::RunOptions { control, ..Default::default() };
            drop(flume::run::run(Arc::from(case), &dir, &options).unwrap());
        }
        InputFile::DryTest(case) => drop(dry_test::run::run(Arc::from(case), &dir, &control).unwrap()),
        InputFile::Fracture(case) => {
            let world = fracture::run::world(&case).unwrap();
            drop(fracture::run::run(&case, world, &dir, &control).unwrap());
        }
        _ => unreachable!("the cases are runs"),
    }
    let files = fs::read_dir(&dir).unwrap().map(|entry| entry.unwrap());
    let named = |entry: fs::DirEntry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap());
    let mut files: Run = files.map(named).collect();
    files.sort();
    assert!(files.iter().any(|(name, _)| name.starts_with("checkpoint.")), "the run left no checkpoint");
    files
}

fn cases() -> [String; 4] {
    let solids = r#"
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e6, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.65 }]"#;
    let block = r#""units": { "shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3, "material": "mortar",
        "poses": [{ "centre_m": [0.3, 0.15, 0.0501] }] }"#;
    [
        format!(
            r#"{{ "title": "Flume",
            "flume": {{ "bed_m": [[0.0, 0.0], [0.6, 0.0]], "still_water_level_m": 0.15, "material": "mortar" }},
            "domain": {{ "x_m": [0.0, 0.6], "width_m": 0.3, "sides": "walls", "top_z_m": 0.3, "dp_m": 0.05 }},
            {block}, {solids},
            "numerics": {{ "hold_units_s": 0.0 }},
            "gauges": [{{ "kind": "elevation", "name": "g", "x_m": 0.2 }}],
            "output": {{ "fluid_interval_s": 0.01, "units_interval_s": 0.01, "series_interval_s": 0.005,
                "checkpoint_interval_s": 0.02 }},
            "stop": {{ "duration_s": 0.03 }} }}"#
        ),
        r#"{ "title": "Wave",
            "flume": { "bed_m": [[0.0, 0.0], [4.0, 0.0]], "still_water_level_m": 0.3, "cell_m": 0.2 },
            "domain": { "x_m": [2.0, 3.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": 0.05 },
            "wave": { "kind": "solitary", "height_m": 0.05 },
            "output": { "fluid_interval_s": 0.01, "series_interval_s": 0.005, "checkpoint_interval_s": 0.02 },
            "stop": { "duration_s": 0.03 } }"#
            .to_owned(),
        format!(
            r#"{{ "title": "Dry", "dry_test": {{ "kind": "settle" }},
            "flume": {{ "bed_m": [[-1.0, 0.0], [2.0, 0.0]], "material": "mortar" }},
            "domain": {{ "x_m": [0.0, 0.6], "width_m": 0.3, "sides": "walls", "top_z_m": 1.0 }},
            {block}, {solids},
            "output": {{ "units_interval_s": 0.005, "series_interval_s": 0.005, "checkpoint_interval_s": 0.01 }},
            "stop": {{ "duration_s": 0.015 }} }}"#
        ),
        r#"{ "title": "Fracture", "assumptions": [],
            "fracture": { "mesh": "mesh.msh", "joints": "tied", "dt_s": 1e-7 }, "gravity_m_s2": [0, 0, -9.8],
            "bodies": [
                { "name": "block", "material": "concrete", "cracks": true, "velocity_m_s": [0, 0, -100] },
                { "name": "plate", "material": "concrete" }],
            "materials": [{ "name": "concrete", "density_kg_m3": 2340, "young_modulus_pa": 26e9, "poisson_ratio": 0.2,
                "strength": { "tensile_pa": 3.3e4, "cohesion_pa": 16.5e4, "friction_angle_deg": 30,
                              "fracture_energy_j_m2": 0.5, "sliding_energy_j_m2": 0.5 } }],
            "friction": [{ "between": ["block", "plate"], "coefficient": 0.6 },
                { "between": ["block", "block"], "coefficient": 0.6 }],
            "output": { "surfaces_interval_s": 1e-6, "energy_interval_s": 5e-7, "checkpoint_interval_s": 3e-6 },
            "stop": { "duration_s": 4e-6 } }"#
            .to_owned(),
    ]
}
