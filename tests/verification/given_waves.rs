//! The same wave from files of three programs moves the wavemaker identically, and a run keeps the wave that it read.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use breakwater::case::{Case, ROWS_FILE, Wave};
use breakwater::simulation::flume::{Simulation, wave::incoming::run_flume};
use breakwater::waves::external::openfoam::{Frame, Up, probes};
use breakwater::waves::external::swash::{self, Heading};
use breakwater::waves::external::table::{Layers, Place, VelocityTable};
use breakwater::waves::generation::wavemaker::Wavemaker;
use serde_json::{Value, json};

const DEPTH: f64 = 0.4;
const PLACE: Place = Place { bed_z_m: 0.0, still_water_z_m: DEPTH, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };

fn case(wave: &Value) -> Value {
    json!({
        "title": "A wave from files",
        "flume": { "bed_m": [[0.0, 0.0], [12.0, 0.0]], "still_water_level_m": DEPTH },
        "domain": { "x_m": [4.0, 6.0], "width_m": 0.4, "sides": "periodic", "top_z_m": 0.6, "dp_m": 0.04 },
        "wave": wave,
        "stop": { "duration_s": 3.0 }
    })
}

/// Returns a solitary wave of the flume model at x = 4 m. The velocity at all heights is the depth-averaged velocity.
fn table() -> VelocityTable {
    let text = case(&json!({ "kind": "solitary", "height_m": 0.06 })).to_string();
    let record = run_flume(&Case::from_str(&text, "test").unwrap()).unwrap().unwrap();
    let times_s = record.times_s().to_vec();
    let levels = vec![0.05, 0.2, 0.35];
    VelocityTable {
        surface_z_m: Some(times_s.iter().map(|&t| record.surface_level_m(4.0, t)).collect()),
        heights_m: vec![levels.clone(); times_s.len()],
        velocities_m_s: times_s.iter().map(|&t| vec![record.mean_velocity(4.0, t); levels.len()]).collect(),
        times_s,
    }
}

fn create(folder: &Path, name: &str) -> File {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    File::create(path).unwrap()
}

/// Writes the table as files of three programs; returns the `source` of the case for each.
fn write(table: &VelocityTable, folder: &Path) -> [Value; 3] {
    let levels: Vec<f64> = (1..=9).map(|k| 0.05 * f64::from(k)).collect();
    table.velx([4.0, 0.0], &levels).write(create(folder, "piston_velx.csv")).unwrap();
    swash::write_level(table, &PLACE, Heading::None, create(folder, "level.tbl")).unwrap();
    swash::write_velocities(table, &PLACE, &[0.5, 0.3, 0.2], Heading::Names, create(folder, "velocity.tbl")).unwrap();
    let frame = Frame { up: Up::Y, origin_z_m: 0.1 };
    probes::write_velocities(table, &levels, 4.0, frame, create(folder, "probes/0/U")).unwrap();
    probes::write_water(table, &levels, 4.0, frame, create(folder, "probes/0/alpha.water")).unwrap();
    [
        json!({ "format": "dualsphysics", "path": "piston_velx.csv" }),
        json!({
            "format": "swash", "layer_shares": [0.5, 0.3, 0.2], "velocity": { "path": "velocity.tbl" },
            "level": { "path": "level.tbl", "columns": ["tsec", "watl"] }
        }),
        json!({ "format": "openfoam", "folder": "probes", "water": "alpha.water", "up": "y", "origin_z_m": 0.1 }),
    ]
}

/// Writes the case to the folder and creates its simulation.
fn simulation(folder: &Path, wave: &Value) -> Simulation {
    fs::write(folder.join("case.json"), case(wave).to_string()).unwrap();
    let case = Case::load(folder.join("case.json")).unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// Returns displacements [m] and velocities [m/s] of the piston rows every 0.1 s.
fn motion(simulation: &Simulation) -> Vec<[f64; 2]> {
    let Some(Wavemaker::MlPiston(piston)) = simulation.ends.first().map(|end| &end.wavemaker) else {
        panic!("the wavemaker is not a multi-layer piston")
    };
    let rows = |k: i32| {
        let t = simulation.start + 0.1 * f64::from(k);
        (0..piston.row_heights_m().len()).map(move |row| [piston.displacement_m(row, t), piston.velocity_m_s(row, t)])
    };
    (0..=30).flat_map(rows).collect()
}

#[test]
fn files_of_three_programs_move_the_wavemaker_identically() {
    let folder = tempfile::tempdir().unwrap();
    let sources = write(&table(), folder.path());
    let motions =
        sources.map(|source| motion(&simulation(folder.path(), &json!({ "kind": "file", "source": source }))));
    let stroke = motions[0].iter().map(|row| row[0]).fold(0.0, f64::max);
    println!("stroke {stroke:.4} m");
    // The full stroke of the water is the volume of the wave divided by depth and width. The stroke of this piston is a
    // third shorter, because the files give the velocities at a fixed position.
    assert!(stroke > 0.2);
    for motion in &motions[1..] {
        let difference = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        let largest = motion.iter().zip(&motions[0]).map(difference).fold(0.0, f64::max);
        println!("largest difference {largest:.1e} m or m/s");
        // Limit 1e-6: the files contain all digits, so the motions differ only by rounding.
        assert!(largest < 1e-6);
    }
}

#[test]
fn a_wave_from_files_with_celerity_has_the_stroke_of_the_flume_model() {
    let folder = tempfile::tempdir().unwrap();
    let [source, ..] = write(&table(), folder.path());
    let celerity = (9.81 * (DEPTH + 0.06)).sqrt();
    let stroke = |wave: &Value| motion(&simulation(folder.path(), wave)).iter().map(|row| row[0]).fold(0.0, f64::max);
    let fixed = stroke(&json!({ "kind": "file", "source": source }));
    let moving = stroke(&json!({ "kind": "file", "source": source, "celerity_m_s": celerity }));
    let flume = stroke(&json!({ "kind": "solitary", "height_m": 0.06 }));
    println!("stroke without celerity {fixed:.4} m, with celerity {moving:.4} m, in the flume model {flume:.4} m");
    // Limit 6 %: in the flume model, the strokes of the rows of this wave differ by 6 % between bed and surface.
    assert!((moving / flume - 1.0).abs() < 0.06 && fixed < 0.95 * moving);
}

#[test]
fn a_run_keeps_the_wave_that_it_read() {
    let (folder, run) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let [_, swash, _] = write(&table(), folder.path());
    let first = simulation(folder.path(), &json!({ "kind": "file", "source": swash }));
    // These are the files that a run writes at its start.
    fs::write(run.path().join("case.json"), &first.case.text).unwrap();
    let Wave::External(wave) = &first.case.wave else { panic!("the wave does not come from files") };
    fs::write(run.path().join(ROWS_FILE), wave.rows_text()).unwrap();
    drop(folder);
    let kept = Case::load(run.path().join("case.json")).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(kept.hash, first.case.hash);
    assert_eq!(kept.wave, first.case.wave);
}

#[test]
fn a_run_longer_than_its_wave_files_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [source, ..] = write(&table(), folder.path());
    let mut case = case(&json!({ "kind": "file", "source": source }));
    case["stop"]["duration_s"] = 60.0.into();
    fs::write(folder.path().join("case.json"), case.to_string()).unwrap();
    let case = Case::load(folder.path().join("case.json")).unwrap();
    let refusal = Simulation::new(Arc::new(case)).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(refusal.starts_with("stop.duration_s = 60: the files of `wave.source` end at"), "{refusal}");
}
