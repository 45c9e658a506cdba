//! Impacts handed over to the fracture of units: what is the same on both sides, and what the scale does.

use std::path::Path;
use std::sync::Arc;

use breakwater::case::{DryCase, FractureCase, HandoverWay};
use breakwater::output::Impacts;
use breakwater::output::driver::Control;
use breakwater::simulation::breakage::model::Model;
use breakwater::simulation::breakage::results::{Breakage, Moved, Outcome};
use breakwater::simulation::breakage::run::{FOLDER, hand_over};
use breakwater::simulation::dry_test::run::run;
use breakwater::simulation::fracture::run::world;
use glam::DVec3;
use serde_json::{Value, json};

/// The committed case, its mesh named so that it is found from anywhere.
fn drop_case() -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("cases/breakage/tetrapod-drop.json")).unwrap();
    let mut case: Value = serde_json::from_str(&text).unwrap();
    case["fracture"]["mesh"] = json!(root.join("cases/fracture/meshes/tetrapod-coarse.msh"));
    case
}

/// Runs a dry case and hands its impacts over.
fn handed_over(case: &Value, dir: &Path) -> Breakage {
    let case = DryCase::from_str(&case.to_string(), "drop.json").unwrap_or_else(|errors| panic!("{errors}"));
    let case = Arc::new(case);
    let summary = run(case.clone(), dir, &Control::quiet()).unwrap();
    let moved: Vec<Moved> =
        summary.units.iter().map(|unit| Moved { displacement: unit.moved_m, damaged: false }).collect();
    hand_over(&Model::of_dry(&case), case.fracture.as_ref().unwrap(), &moved, dir, &Control::quiet()).unwrap()
}

fn of_way(breakage: &Breakage, way: HandoverWay) -> &Outcome {
    breakage.impacts.iter().find(|impact| impact.way == way).unwrap()
}

#[test]
fn a_dropped_tetrapod_keeps_its_momentum_and_its_blow() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = drop_case();
    case["fracture"]["joints"] = json!("unbreakable");
    case["fracture"]["duration_s"] = json!(0.02);
    let breakage = handed_over(&case, folder.path());
    let impacts = Impacts::read(&folder.path().join(Impacts::FILE)).unwrap().impacts;
    // Mass, momentum and energy of the nodes as the solver has them, against the rigid unit's by Froude's law.
    let file = folder.path().join(FOLDER).join(format!("{}.json", of_way(&breakage, HandoverWay::ReEnact).name));
    let mut start = world(&FractureCase::load(&file).unwrap()).unwrap();
    let nodes = start.setup().bodies[0].tets.clone().flat_map(|tet| start.tets.nodes[tet]);
    let own: std::collections::BTreeSet<u32> = nodes.collect();
    let momentum: DVec3 = own.iter().map(|n| start.nodes.velocity[*n as usize] * start.nodes.mass[*n as usize]).sum();
    let before = impacts[0].event.before;
    let expected = before.velocity * (0.3 * 50f64.powi(3) * 50f64.sqrt());
    assert!((momentum - expected).length() < 1e-6 * expected.length(), "{momentum} {expected}");
    let (_, bodies) = start.step_with_books().unwrap();
    let energy = 0.5 * 0.3 * before.velocity.length_squared() * 50f64.powi(4);
    // 1e-6: asked for; the book has the energy half a step later, by which gravity has changed it.
    let fallen = expected.z.abs() * 9.81 * start.dt;
    assert!((bodies[0].kinetic - energy).abs() < 1e-6 * energy + fallen, "{} {energy}", bodies[0].kinetic);

    // The impulse of the collision against the rigid one, three feet together, less what gravity gives meanwhile.
    let rigid: f64 = impacts.iter().map(|impact| impact.event.impulse[2]).sum::<f64>() * 50f64.powf(3.5);
    let weight = 37_500.0 * 9.81 * 0.02;
    let [again, by_loads] =
        [HandoverWay::ReEnact, HandoverWay::LoadHistory].map(|way| of_way(&breakage, way).found[0].impulse_n_s[2]);
    println!(
        "impulse over the rigid one: {:.4} and by loads {:.4}",
        (again + weight) / rigid,
        (by_loads + weight) / rigid
    );
    // 10 %: asked for. The loads have the recorded impulse, to the ramps between their rows.
    assert!(((again + weight) / rigid - 1.0).abs() < 0.1);
    assert!(((by_loads + weight) / rigid - 1.0).abs() < 1e-3);
}

#[test]
fn stress_grows_with_the_scale_as_hertz_has_it() {
    let folder = tempfile::tempdir().unwrap();
    let stress = |scale: f64| {
        let dir = folder.path().join(format!("{scale}"));
        std::fs::create_dir(&dir).unwrap();
        let mut case = drop_case();
        case["fracture"]["scale"] = json!(scale);
        case["fracture"]["joints"] = json!("unbreakable");
        case["fracture"]["way"] = json!("re_enact");
        case["fracture"]["duration_s"] = json!(4e-4 * scale);
        // The same share of a wave's energy at any length.
        case["fracture"]["material"]["viscosity_pa_s"] = json!(4e3 * scale);
        handed_over(&case, &dir).impacts[0].found[0].sigma_1_pa
    };
    let [one, fifty] = [1.0, 50.0].map(stress);
    let exponent = (fifty / one).ln() / 50f64.ln();
    println!("{:.2} MPa at 50, {:.2} at 1: exponent {exponent:.3}", fifty * 1e-6, one * 1e-6);
    // By Hertz the force goes as R^(1/5) m^(3/5) v^(6/5), v with the root of the scale: the stress with the exponent 0.6.
    // 0.05: the contact is an element or two wide; a bar, whose stress is sqrt(E rho) v, would have 0.5.
    assert!((exponent - 0.6).abs() < 0.05);
}

#[test]
fn the_prototype_breaks_and_the_model_does_not() {
    let folder = tempfile::tempdir().unwrap();
    for (scale, breaks) in [(1.0, false), (50.0, true)] {
        let dir = folder.path().join(format!("{scale}"));
        std::fs::create_dir(&dir).unwrap();
        let mut case = drop_case();
        case["dry"]["height_m"] = json!(DROP);
        case["fracture"]["scale"] = json!(scale);
        case["fracture"]["way"] = json!("re_enact");
        case["fracture"]["duration_s"] = json!(1.2e-4 * scale);
        let breakage = handed_over(&case, &dir);
        let unit = &breakage.units[0];
        println!(
            "scale {scale}: sigma_1 {:.2} MPa, {:.2} m2 of cracks",
            unit.sigma_1_pa.unwrap() * 1e-6,
            unit.crack_area_m2.unwrap()
        );
        assert_eq!(unit.crack_area_m2.unwrap() > 0.0, breaks, "{unit:?}");
    }
}

/// Drop of the model [m]: 0.2 m of the prototype, whose foot cracks 4.2 ms after the start.
const DROP: f64 = 0.004;
