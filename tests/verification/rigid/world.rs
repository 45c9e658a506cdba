//! The rigid-body world: many contacts, restoring a snapshot, refused input.

use breakwater::rigid::{BodyShape, Load, Material, RigidError, RigidSnapshot, RigidWorld};
use glam::DVec3;
use std::time::Instant;

use super::{MASS, MORTAR, heap, run, setup, standing, tetrapod, total_energy};

#[test]
fn a_heap_comes_to_rest_without_gaining_energy() {
    let mut world = RigidWorld::new(heap(&tetrapod())).unwrap();
    let start = total_energy(&world);
    let mut highest = f64::MIN;
    let mut mechanical: f64 = start;
    let clock = Instant::now();
    for _ in 0..300 {
        run(&mut world, 0.01, 1e-4);
        let e = world.energy();
        let now = e.kinetic + e.potential + e.elastic;
        highest = highest.max(now - mechanical);
        mechanical = now;
    }
    let e = world.energy();
    println!(
        "heap: {e:?}, largest rise {highest:.1e} J, residual {:.2e} J, {} contacts, {} substeps, {:.1} us each, {} events",
        total_energy(&world) - start,
        world.contact_count(),
        world.substeps(),
        clock.elapsed().as_secs_f64() / world.substeps() as f64 * 1e6,
        world.take_events().len()
    );
    // Limit 1e-3 J for a rise of the mechanical energy: 0.01 % of the potential energy lost in the fall.
    assert!(highest < 1e-3);
    assert!(e.kinetic < 1e-4);
    // Limit: 1 % of the energy of the fall, which is about 10 J.
    assert!((total_energy(&world) - start).abs() < 0.1);
    assert!(world.states().iter().all(|s| s.position.z > 0.02 && s.position.is_finite()));
}

#[test]
fn a_restored_world_continues_with_the_same_bits() {
    let unit = tetrapod();
    let mut world = RigidWorld::new(heap(&unit)).unwrap();
    run(&mut world, 0.5, 1e-4);
    let text = serde_json::to_string(&world.snapshot()).unwrap();
    run(&mut world, 0.3, 1e-4);
    let snapshot: RigidSnapshot = serde_json::from_str(&text).unwrap();
    let mut restored = RigidWorld::new(heap(&unit)).unwrap();
    restored.restore(&snapshot).unwrap();
    run(&mut restored, 0.3, 1e-4);
    assert_eq!(world.states(), restored.states());
    assert_eq!(world.contact_loads(), restored.contact_loads());
    assert_eq!(serde_json::to_string(&world.snapshot()).unwrap(), serde_json::to_string(&restored.snapshot()).unwrap());
}

#[test]
fn a_too_deep_overlap_is_an_error_that_names_the_units() {
    let unit = tetrapod();
    let bodies = vec![standing(&unit, 0.0, 0.0, 0.0), standing(&unit, 0.0, 0.04, 0.0)];
    let error = RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), bodies, MORTAR, 0.3)).unwrap_err();
    assert!(matches!(error, RigidError::TooDeep { .. }));
    assert!(error.to_string().contains("unit 1") && error.to_string().contains("unit 2"), "{error}");
}

#[test]
fn invalid_loads_and_materials_are_errors() {
    let unit = tetrapod();
    let mut world =
        RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), vec![standing(&unit, 0.0, 0.0, 0.0)], MORTAR, 0.3))
            .unwrap();
    assert!(matches!(world.advance(1e-4, &[]), Err(RigidError::Loads { loads: 0, bodies: 1 })));
    let broken = Load { force: DVec3::NAN, torque: DVec3::ZERO };
    assert!(matches!(world.advance(1e-4, &[broken]), Err(RigidError::NotFinite { body: 0, .. })));
    let bad = Material { young_modulus: -1.0, ..MORTAR };
    assert!(RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), vec![], bad, 0.3)).is_err());
}
