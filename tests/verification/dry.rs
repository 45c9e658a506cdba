//! Dry runs and placed layers from end to end.

use std::{path::Path, sync::Arc};

use breakwater::{
    case::{DryCase, PlacementJob},
    output::{Impacts, driver::Control},
    simulation::{
        armour_layer::place,
        dry_test::{DryRun, run::run},
    },
};
use serde_json::{Value, json};

fn case_file(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/contact").join(name);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn dry_case(case: &Value) -> Arc<DryCase> {
    let case = DryCase::from_str(&case.to_string(), "cases/contact/test.json");
    Arc::new(case.unwrap_or_else(|errors| panic!("{errors}")))
}

#[test]
fn the_slope_test_gives_the_friction_that_was_put_in() {
    let folder = tempfile::tempdir().unwrap();
    for (name, friction) in [("tilt-tetrapod.json", 0.32), ("tilt-tetrapod-on-mortar.json", 0.65)] {
        let dir = folder.path().join(name);
        std::fs::create_dir(&dir).unwrap();
        let summary = run(dry_case(&case_file(name)), &dir, &Control::quiet()).unwrap();
        for unit in &summary.units {
            let found = unit.friction.unwrap();
            println!("{name}: unit {}: {found:.4} ({:+.2} %)", unit.unit, 100.0 * (found / friction - 1.0));
            // 0.5 %: asked for; the published runs have 1.8 and 1.9 %.
            assert!((found / friction - 1.0).abs() < 0.005);
        }
    }
}

#[test]
fn a_broken_dry_run_goes_on_with_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = case_file("drop-dolos.json");
    case["output"] = json!({ "checkpoint_interval_s": 0.2, "series_interval_s": 0.05, "units_interval_s": 0.05 });
    case["stop"] = json!({ "duration_s": 0.7 });
    let dirs = ["whole", "broken"].map(|name| folder.path().join(name));
    for dir in &dirs {
        std::fs::create_dir(dir).unwrap();
        run(dry_case(&case), dir, &Control::quiet()).unwrap();
    }
    // The last checkpoint is of 0.6 s: going on from there writes the end once more.
    breakwater::simulation::dry_test::run::resume(dry_case(&case), &dirs[1], &Control::quiet()).unwrap();
    for file in ["units.csv", "energy.csv", "contacts.csv"] {
        let [whole, broken] = dirs.each_ref().map(|dir| std::fs::read(dir.join(file)).unwrap());
        assert_eq!(whole, broken, "{file}");
    }
    let [whole, broken] = dirs.map(|dir| Impacts::read(&dir.join(Impacts::FILE)).unwrap());
    // Up to 16 of the one unit; it is dropped, so some approach fast.
    assert!((4..=16).contains(&whole.impacts.len()) && whole.places.is_empty());
    assert!(whole.impacts.iter().any(|impact| impact.event.approach_normal > 0.1 && impact.history.len() > 10));
    assert_eq!(whole, broken);
}

/// A layer of Tetrapods on a slope, a handful.
fn small_layer() -> Value {
    let mut case = case_file("armour-layer.json");
    case["domain"]["width_m"] = json!(0.25);
    case["units"]["armour"]["x_m"] = json!([0.06, 0.3]);
    case["units"].as_object_mut().unwrap().remove("placement_file");
    case
}

#[test]
fn a_placed_layer_rests_and_can_be_run() {
    let job =
        PlacementJob::from_str(&small_layer().to_string(), "test.json").unwrap_or_else(|errors| panic!("{errors}"));
    let placed = place(&job, |_, _| ()).unwrap();
    println!(
        "{} units, packing density {:.3}, {} rolled off, overlap {:.2e} H, kinetic energy {:.1e} of what was let go, {} contacts",
        placed.units.len(),
        placed.packing_density,
        placed.rolled_off,
        placed.deepest_overlap,
        placed.unrest,
        placed.contacts
    );
    assert_eq!(placed.units.len(), job.count());
    // 1 % of the height and 1e-6 of the potential energy: asked for.
    assert!(placed.deepest_overlap < 0.01 && placed.unrest < 1e-6);
    // From the file it goes on resting. The tangential springs have to form again, which takes a way of about the
    // overlap of the contacts, of which the deepest is some thousandths of the height: half of what may overlap.
    let mut case = small_layer();
    let file = placed.file("layer");
    case["units"]["poses"] = serde_json::to_value(&file.poses).unwrap();
    let mut run = DryRun::new(dry_case(&case)).unwrap();
    for _ in 0..200 {
        run.advance(1.0).unwrap();
    }
    let moved = run.world.states().iter().zip(&run.start).map(|(now, start)| now.position.distance(start.position));
    let most = moved.fold(0.0, f64::max);
    println!("moved by {:.1e} H within 0.2 s", most / 0.077);
    assert!(most < 5e-3 * 0.077, "{most}");
}

#[test]
fn the_number_of_threads_does_not_change_a_layer() {
    let job =
        PlacementJob::from_str(&small_layer().to_string(), "test.json").unwrap_or_else(|errors| panic!("{errors}"));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| place(&job, |_, _| ()).unwrap().units)
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn a_run_that_fails_keeps_its_last_checkpoint_and_the_state_it_failed_in() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = case_file("drop-dolos.json");
    // Concrete as soft as rubber, from five metres: the floor cannot stop it within the rounding.
    case["dry"]["height_m"] = json!(5.0);
    case["materials"][0]["young_modulus_pa"] = json!(1e6);
    case["output"] = json!({ "checkpoint_interval_s": 0.4 });
    let error = run(dry_case(&case), folder.path(), &Control::quiet()).unwrap_err().to_string();
    assert!(error.contains("unit 1") && error.contains("failed.json"), "{error}");
    let time = |file: &str| {
        let text = std::fs::read_to_string(folder.path().join(file)).unwrap();
        serde_json::from_str::<Value>(&text).unwrap()["world"]["time_s"].as_f64().unwrap()
    };
    let (kept, failed) = (time("checkpoint.json"), time("failed.json"));
    // It falls for a second; the checkpoints are at 0.4 and 0.8 s.
    assert!((kept - 0.8).abs() < 2e-3 && failed > kept, "{kept} {failed}");
}
