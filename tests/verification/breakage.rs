//! Impacts re-run at prototype scale with breakable units: conserved quantities, and the effect of the scale.

use std::path::Path;
use std::sync::Arc;

use breakwater::case::{DryTestCase, FractureCase, RerunMethod};
use breakwater::output::Impacts;
use breakwater::output::driver::Control;
use breakwater::simulation::breakage::model::Model;
use breakwater::simulation::breakage::results::{Breakage, Moved, Outcome};
use breakwater::simulation::breakage::run::{FOLDER, analyse_breakage};
use breakwater::simulation::dry_test::run::run;
use breakwater::simulation::fracture::run::world;
use glam::DVec3;
use serde_json::{Value, json};

/// Returns the case of the drop test, with the absolute path of its mesh.
fn drop_case() -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("cases/breakage/tetrapod-drop.json")).unwrap();
    let mut case: Value = serde_json::from_str(&text).unwrap();
    case["breakage"]["mesh"] = json!(root.join("cases/fracture/meshes/tetrapod-coarse.msh"));
    case
}

/// Runs a dry test and re-runs its impacts at prototype scale.
fn rerun_impacts(case: &Value, dir: &Path) -> Breakage {
    let case = DryTestCase::from_str(&case.to_string(), "drop.json").unwrap_or_else(|errors| panic!("{errors}"));
    let case = Arc::new(case);
    let summary = run(case.clone(), dir, &Control::quiet()).unwrap();
    let moved: Vec<Moved> =
        summary.units.iter().map(|unit| Moved { displacement: unit.moved_m, damaged: false }).collect();
    analyse_breakage(&Model::of_dry(&case), case.breakage.as_ref().unwrap(), &moved, dir, &Control::quiet()).unwrap()
}

fn impact_by(breakage: &Breakage, way: RerunMethod) -> &Outcome {
    breakage.impacts.iter().find(|impact| impact.way == way).unwrap()
}

#[test]
fn a_rerun_impact_keeps_momentum_energy_and_impulse() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = drop_case();
    case["breakage"]["joints"] = json!("unbreakable");
    case["breakage"]["duration_s"] = json!(0.02);
    let breakage = rerun_impacts(&case, folder.path());
    let impacts = Impacts::read(&folder.path().join(Impacts::FILE)).unwrap().impacts;
    // Momentum and energy of the nodes must equal momentum and energy of the rigid unit, scaled by Froude's law.
    let file = folder.path().join(FOLDER).join(format!("{}.json", impact_by(&breakage, RerunMethod::ReEnact).name));
    let mut start = world(&FractureCase::load(&file).unwrap()).unwrap();
    let nodes = start.setup().bodies[0].tets.clone().flat_map(|tet| start.tets.nodes[tet]);
    let unit_nodes: std::collections::BTreeSet<u32> = nodes.collect();
    let momentum: DVec3 =
        unit_nodes.iter().map(|n| start.nodes.velocity[*n as usize] * start.nodes.mass[*n as usize]).sum();
    let before = impacts[0].event.before;
    let expected = before.velocity * (0.3 * 50f64.powi(3) * 50f64.sqrt());
    assert!((momentum - expected).length() < 1e-6 * expected.length(), "{momentum} {expected}");
    let (_, bodies) = start.step_with_body_energies().unwrap();
    let energy = 0.5 * 0.3 * before.velocity.length_squared() * 50f64.powi(4);
    // Limit for the energy: 1e-6 plus the work of gravity, because the energy refers to a time half a time step after
    // the initial velocities.
    let fallen = expected.z.abs() * 9.81 * start.dt;
    assert!((bodies[0].kinetic - energy).abs() < 1e-6 * energy + fallen, "{} {energy}", bodies[0].kinetic);

    // The impulse of the collision must equal the sum of the impulses on the three feet of the rigid unit. The impulse
    // of gravity is removed.
    let rigid: f64 = impacts.iter().map(|impact| impact.event.impulse[2]).sum::<f64>() * 50f64.powf(3.5);
    let weight = 37_500.0 * 9.81 * 0.02;
    let [reenacted, by_loads] =
        [RerunMethod::ReEnact, RerunMethod::LoadHistory].map(|way| impact_by(&breakage, way).found[0].impulse_n_s[2]);
    println!(
        "impulse divided by the impulse of the rigid unit: re-enacted {:.4}, by load history {:.4}",
        (reenacted + weight) / rigid,
        (by_loads + weight) / rigid
    );
    // Limits for the impulse: 10 % for the re-enacted collision, 0.1 % for the load history. The load history keeps the
    // recorded impulse, except for the ramps between its rows.
    assert!(((reenacted + weight) / rigid - 1.0).abs() < 0.1);
    assert!(((by_loads + weight) / rigid - 1.0).abs() < 1e-3);
}

#[test]
fn stress_grows_with_the_scale_by_the_law_of_hertz() {
    let folder = tempfile::tempdir().unwrap();
    let stress = |scale: f64| {
        let dir = folder.path().join(format!("{scale}"));
        std::fs::create_dir(&dir).unwrap();
        let mut case = drop_case();
        case["breakage"]["scale"] = json!(scale);
        case["breakage"]["joints"] = json!("unbreakable");
        case["breakage"]["way"] = json!("re_enact");
        case["breakage"]["duration_s"] = json!(4e-4 * scale);
        // The viscosity is proportional to the scale, so an elastic wave loses the same share of its energy at any
        // scale.
        case["breakage"]["material"]["viscosity_pa_s"] = json!(4e3 * scale);
        rerun_impacts(&case, &dir).impacts[0].found[0].sigma_1_pa
    };
    let [one, fifty] = [1.0, 50.0].map(stress);
    let exponent = (fifty / one).ln() / 50f64.ln();
    println!("scale 50: {:.2} MPa, scale 1: {:.2} MPa, exponent {exponent:.3}", fifty * 1e-6, one * 1e-6);
    // By Hertz's law, the force is proportional to R^(1/5) m^(3/5) v^(6/5). The radius R is proportional to the scale,
    // the mass m to its cube, the velocity v to its square root. The force then has the exponent 2.6; the stress, which
    // is force per area, has 0.6. Limit 0.05, because the contact is one or two elements wide. The stress in a bar that
    // hits a wall, sqrt(E rho) v, has the exponent 0.5.
    assert!((exponent - 0.6).abs() < 0.05);
}

#[test]
fn the_prototype_cracks_and_the_model_does_not() {
    let folder = tempfile::tempdir().unwrap();
    for (scale, breaks) in [(1.0, false), (50.0, true)] {
        let dir = folder.path().join(format!("{scale}"));
        std::fs::create_dir(&dir).unwrap();
        let mut case = drop_case();
        case["dry_test"]["height_m"] = json!(DROP);
        case["breakage"]["scale"] = json!(scale);
        case["breakage"]["way"] = json!("re_enact");
        case["breakage"]["duration_s"] = json!(3.2e-5 * scale);
        let breakage = rerun_impacts(&case, &dir);
        let unit = &breakage.units[0];
        println!(
            "scale {scale}: sigma_1 {:.2} MPa, {:.2} m2 of cracks",
            unit.sigma_1_pa.unwrap() * 1e-6,
            unit.crack_area_m2.unwrap()
        );
        assert_eq!(unit.crack_area_m2.unwrap() > 0.0, breaks, "{unit:?}");
    }
}

/// Drop height of the model [m]. The prototype falls by 0.8 m, and its foot cracks within 1.6 ms after the start of the
/// fracture run.
const DROP: f64 = 0.016;
