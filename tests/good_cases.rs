//! Every case file in `cases` loads, and the schema lists every key.

use std::path::{Path, PathBuf};

use breakwater::case::file::{CaseFile, DryFile, FractureFile};
use breakwater::case::{
    BreakageSettings, Case, Document, DryTestCase, FractureCase, InputFile, InputKind, Reference, Wave, schema_text,
    template_text,
};
use breakwater::sweep::plan::Sweep;

fn json_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(json_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "json") {
            files.push(path);
        }
    }
    files.sort();
    files
}

fn all_files() -> Vec<PathBuf> {
    json_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"))
}

/// Lists the files of a kind.
fn files(kind: InputKind) -> Vec<PathBuf> {
    let is_of_kind = |path: &PathBuf| Document::read(path).unwrap().kind() == kind;
    all_files().into_iter().filter(is_of_kind).collect()
}

fn case(name: &str) -> Case {
    Case::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name))
        .unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn every_case_file_loads() {
    let files = files(InputKind::Flume);
    assert!(files.len() >= 9, "only {} case files found", files.len());
    for path in files {
        let case = Case::load(&path).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(!case.assumptions.is_empty(), "{}: no assumption listed", path.display());
        let size = case.estimate();
        println!(
            "{}: {:.2e} particles, {:.1} GB, dt {:.1e} s, {} steps",
            path.display(),
            size.particles(),
            size.bytes / 1e9,
            size.dt,
            size.steps
        );
        for warning in &case.warnings {
            println!("    {warning}");
        }
    }
}

#[test]
fn every_dry_test_loads_and_survives_a_round_trip() {
    let files = files(InputKind::DryTest);
    assert!(files.len() >= 5, "only {} dry tests found", files.len());
    for path in files {
        let case = DryTestCase::load(&path).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(!case.assumptions.is_empty(), "{}: no assumption listed", path.display());
        let file: DryFile = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let written = serde_json::to_string_pretty(&file).unwrap();
        assert_eq!(file, serde_json::from_str(&written).unwrap(), "{}", path.display());
        // The copy of the case in a run folder needs only files that the run writes, and is the same case.
        let folder = tempfile::tempdir().unwrap();
        if let Some(terrain) = &case.site.terrain {
            std::fs::write(folder.path().join("terrain.stl"), terrain.content.as_slice()).unwrap();
        }
        if let Some(breakage) = &case.breakage {
            std::fs::write(folder.path().join(BreakageSettings::MESH), &breakage.mesh_file).unwrap();
        }
        let name = folder.path().join("case.json").display().to_string();
        let kept = DryTestCase::from_str(&case.text, &name).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(kept.hash, case.hash, "{}", path.display());
        assert_eq!(kept.units.placements, case.units.placements, "{}", path.display());
    }
}

#[test]
fn every_fracture_case_loads_and_survives_a_round_trip() {
    let files = files(InputKind::Fracture);
    assert!(!files.is_empty());
    for path in files {
        let case = FractureCase::load(&path).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(!case.assumptions.is_empty(), "{}: no assumption listed", path.display());
        let file: FractureFile = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let written = serde_json::to_string_pretty(&file).unwrap();
        assert_eq!(file, serde_json::from_str(&written).unwrap(), "{}", path.display());
        // The copy of the case in a run folder is the same case.
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FractureCase::MESH), &case.mesh_file).unwrap();
        let name = folder.path().join("case.json").display().to_string();
        let kept = FractureCase::from_str(&case.text, &name).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!((kept.hash, kept.setup), (case.hash, case.setup), "{}", path.display());
    }
}

#[test]
fn every_sweep_loads_and_its_runs_differ() {
    let files = files(InputKind::Sweep);
    assert!(!files.is_empty());
    for path in files {
        let sweep = Sweep::load(&path).unwrap_or_else(|reason| panic!("{reason}"));
        let mut hashes: Vec<&str> = sweep.members.iter().map(|member| member.hash.as_str()).collect();
        hashes.sort_unstable();
        hashes.dedup();
        assert_eq!(hashes.len(), sweep.members.len(), "{}: two runs are the same case", path.display());
    }
}

#[test]
fn template_loads_without_a_warning() {
    let case = Case::from_str(&template_text(), "template").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(case.warnings, Vec::<String>::new());
}

#[test]
fn flume_cases_survive_a_round_trip() {
    for path in files(InputKind::Flume) {
        let file: CaseFile = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let written = serde_json::to_string_pretty(&file).unwrap();
        let reread: CaseFile = serde_json::from_str(&written).unwrap();
        assert_eq!(file, reread, "{}", path.display());
        let case = Case::load(&path).unwrap();
        let reread = path.with_file_name("again.json").display().to_string();
        assert_eq!(Case::from_str(&written, &reread).unwrap().hash, case.hash, "{}", path.display());
        // The copy of the case in a run folder needs only the mesh and the measurements that the run writes, and is the
        // same case.
        let Some(breakage) = &case.breakage else { continue };
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(BreakageSettings::MESH), &breakage.mesh_file).unwrap();
        if let Some(reference) = &case.reference {
            let folder = folder.path().join(Reference::FOLDER);
            std::fs::create_dir(&folder).unwrap();
            reference.files.iter().for_each(|(name, content)| std::fs::write(folder.join(name), content).unwrap());
        }
        let name = folder.path().join("case.json").display().to_string();
        assert_eq!(Case::from_str(&case.text, &name).unwrap().hash, case.hash, "{}", path.display());
    }
}

#[test]
fn old_key_names_give_the_same_case_and_a_warning() {
    for name in ["breakage/tetrapod-drop.json", "fudo/quick-look-1to50.json"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let old = text.replace("\"breakage\":", "\"fracture\":").replace("\"dry_test\":", "\"dry\":");
        let [(hash, none), (old_hash, warnings)] = [text, old].map(|text| {
            let document = Document::new(text, path.to_str().unwrap()).unwrap();
            match InputFile::from_document(&document).unwrap_or_else(|errors| panic!("{errors}")) {
                InputFile::Flume(case) => (case.hash, case.warnings),
                InputFile::DryTest(case) => (case.hash, case.warnings),
                other => panic!("{:?}", other.kind()),
            }
        });
        assert_eq!(old_hash, hash, "{name}");
        let is_of_old_key = |warning: &&String| warning.ends_with("the old name still works");
        assert!(!none.iter().any(|warning| is_of_old_key(&warning)));
        assert!(warnings.contains(&"fracture: is now called breakage; the old name still works".to_owned()), "{name}");
    }
}

#[test]
fn hash_depends_on_values_and_not_on_layout() {
    let text = template_text();
    let hash = Case::from_str(&text, "a").unwrap().hash;
    assert_eq!(hash.len(), 32);
    let layout = text.replace("\n", "\n\n").replace("\"$schema\": \"case.schema.json\",", "");
    assert_eq!(Case::from_str(&layout, "b").unwrap().hash, hash);
    let value = text.replace("\"height_m\": 0.06", "\"height_m\": 0.061");
    assert_ne!(Case::from_str(&value, "c").unwrap().hash, hash);
}

#[test]
fn naming_the_default_wavemaker_gives_the_same_case() {
    let text = template_text();
    let explicit = text.replacen("\"wave\":", "\"wavemaker\": { \"kind\": \"ml_piston\" }, \"wave\":", 1);
    assert_ne!(explicit, text);
    let hash = |text: &str| Case::from_str(text, "template").unwrap().hash;
    assert_eq!(hash(&explicit), hash(&text));
}

#[test]
fn derived_numbers_equal_those_of_the_published_run() {
    let case = case("fudo/H6.4-full.json");
    // Mitsui et al. 2023, section 4.1: h = 1.2 sqrt(3) dp = 0.0104 m at dp = 0.005 m.
    assert!((case.numerics.h - 0.010_392).abs() < 1e-6);
    // Still water depth at the wavemaker, x = 33 m: 0.8 - 14/30 m.
    assert!((case.domain.depth - (0.8 - 14.0 / 30.0)).abs() < 1e-12);
    assert!((case.fluid.sound_speed - 15.0 * (9.81 * case.domain.depth).sqrt()).abs() < 1e-12);
    assert!((case.flume.profile.z(39.0) - 0.717).abs() < 1e-12);
    let Wave::Solitary(wave) = case.wave else { panic!("no wave") };
    assert!((wave.depth_m - 0.8).abs() < 1e-12);
    // Stroke of Rayleigh's solitary wave: sqrt(16 H (H + d) / 3).
    assert!((wave.stroke_m() - (16.0 * 0.064 * 0.864 / 3.0_f64).sqrt()).abs() < 1e-12);
    let units = case.units.unwrap();
    assert_eq!(units.placements.len(), 15);
    assert_eq!(units.placements[0].rotation, glam::DQuat::IDENTITY);
    assert_eq!(units.placements[1].rotation, glam::DQuat::from_rotation_z(std::f64::consts::PI));
    // The row of units is centred across the flume.
    assert!((units.placements[7].centre.y - 0.6).abs() < 1e-12);
    // Units and bed are of mortar, which is the first material; the mound is of PVC.
    let pairs: Vec<_> = units.pairs.iter().map(|pair| (pair.between, pair.resistance)).collect();
    assert_eq!(pairs, [([0, 0], 0.65.into()), ([0, 1], 0.32.into())]);
    assert!(!case.gauges[0].in_domain && case.gauges[1].in_domain);
}

#[test]
fn estimate_counts_the_water_particles_of_the_dam_break() {
    let case = case("verification/dam-break.json");
    // The column is 1 m x 2 m; each particle represents (0.01 m)^2.
    assert_eq!(case.estimate().fluid, 20_000.0);
    assert_eq!((case.domain.nx, case.domain.ny, case.domain.nz), (400, 1, 300));
}

#[test]
fn schema_lists_every_key() {
    let text = schema_text();
    let schema: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(schema.is_object());
    let mut keys = Vec::new();
    for text in
        files(InputKind::Flume).iter().map(|path| std::fs::read_to_string(path).unwrap()).chain([template_text()])
    {
        let file: CaseFile = serde_json::from_str(&text).unwrap();
        collect_keys(&serde_json::to_value(&file).unwrap(), &mut keys);
    }
    assert!(keys.len() > 60, "only {} keys", keys.len());
    for key in keys {
        assert!(text.contains(&format!("\"{key}\"")), "the schema does not mention {key}");
    }
}

fn collect_keys(value: &serde_json::Value, keys: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(object) => {
            for (key, inner) in object {
                if !keys.contains(key) {
                    keys.push(key.clone());
                }
                collect_keys(inner, keys);
            }
        }
        serde_json::Value::Array(list) => list.iter().for_each(|inner| collect_keys(inner, keys)),
        _ => {}
    }
}

/// Validates a case whose wave comes from `source`, a file in `tests/data/waves`.
fn case_with_wave(source: &serde_json::Value) -> Case {
    let case = serde_json::json!({
        "title": "A wave from files",
        "flume": { "bed_m": [[0.0, 0.0], [6.0, 0.0]], "still_water_level_m": 0.5 },
        "domain": { "x_m": [2.0, 5.0], "sides": "two_dimensional", "top_z_m": 0.8, "dp_m": 0.05, "start_s": 1.0 },
        "wave": { "kind": "file", "source": source },
        "stop": { "duration_s": 3.0 }
    });
    let name = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/waves/case.json");
    Case::from_str(&case.to_string(), &name.display().to_string()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Returns the largest velocity of the lowest and of the highest row of the wavemaker [m/s].
fn largest_velocities(case: &Case) -> [f64; 2] {
    let Wave::External(wave) = &case.wave else { panic!("the wave does not come from files") };
    let largest = |row: usize| wave.rows.velocities_m_s.iter().map(|rows| rows[row]).fold(f64::MIN, f64::max);
    [largest(0), largest(wave.rows.velocities_m_s[0].len() - 1)]
}

#[test]
fn levels_from_the_surface_are_read_with_a_warning() {
    let case = case_with_wave(&serde_json::json!({ "format": "dualsphysics", "path": "pydsphtools_velx.csv" }));
    let warned = case.warnings.iter().find(|warning| warning.contains("wave.source.origin_z_m is missing")).unwrap();
    assert!(warned.contains("count from the surface, which is at the still water, z = 0.5 m, at rest"), "{warned}");
    // The file has the velocity c H / (d + H) = sqrt(9.81 0.7) 0.2 / 0.7 under the crest, with 6 decimals.
    assert!(largest_velocities(&case).iter().all(|u| (u - 0.748_713).abs() < 1e-6));
}

#[test]
fn depth_averaged_velocity_is_read_if_allowed() {
    let table = serde_json::json!({ "path": "swash.tbl" });
    let source = serde_json::json!({ "format": "swash", "level": table, "velocity": table, "depth_averaged": true });
    // c H / (d + H) = sqrt(9.81 0.55) 0.05 / 0.55 at all levels, with 6 decimals.
    assert!(largest_velocities(&case_with_wave(&source)).iter().all(|u| (u - 0.211_166).abs() < 1e-6));
}

#[test]
fn a_flume_case_without_units_may_keep_the_material_of_the_ground() {
    let wave = include_str!("../cases/tutorial/wave-alone.json");
    let mut keys: serde_json::Value = serde_json::from_str(wave).unwrap();
    keys.as_object_mut().unwrap().remove("reference");
    keys["flume"]["material"] = "bed".into();
    let case = Case::from_str(&keys.to_string(), "wave.json").unwrap_or_else(|errors| panic!("{errors}"));
    assert!(case.warnings.iter().any(|w| w == "flume.material = \"bed\": has no effect without units"));
}

#[test]
fn quaternions_of_three_digits_are_normalised() {
    let text = include_str!("../cases/tutorial/drop.json");
    let mut keys: serde_json::Value = serde_json::from_str(text).unwrap();
    let units = keys["units"].as_object_mut().unwrap();
    ["count", "pitch_m", "x_m"].iter().for_each(|key| drop(units.remove(*key)));
    let read = |quaternion: [f64; 4]| {
        let mut keys = keys.clone();
        keys["units"]["poses"] = serde_json::json!([{ "centre_m": [0.0, 0.2, 0.2], "quaternion_xyzw": quaternion }]);
        DryTestCase::from_str(&keys.to_string(), "drop.json")
    };
    for quaternion in [[0.5, 0.5, 0.5, 0.5], [0.707, 0.0, 0.0, 0.707], [0.183, 0.365, 0.548, 0.73]] {
        let rotation = read(quaternion).unwrap_or_else(|errors| panic!("{errors}")).units.placements[0].rotation;
        assert!((rotation.length() - 1.0).abs() < 1e-15, "{rotation}");
    }
    let message = read([0.7, 0.0, 0.0, 0.7]).unwrap_err().to_string();
    assert!(message.contains("quaternion_xyzw = of length 0.989949"), "{message}");
}
