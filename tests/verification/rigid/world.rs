//! The world as a whole: many contacts, going on from a snapshot, what it refuses.

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
        // What is left may not rise: 1e-3 J is 0.01 % of the energy of the fall.
        highest = highest.max(now - mechanical);
        mechanical = now;
    }
    let e = world.energy();
    println!(
        "heap: {e:?}, rise {highest:.1e} J, balance {:.2e} J, {} contacts, {} substeps, {:.1} us each, {} events",
        total_energy(&world) - start,
        world.contact_count(),
        world.substeps(),
        clock.elapsed().as_secs_f64() / world.substeps() as f64 * 1e6,
        world.take_events().len()
    );
    assert!(highest < 1e-3);
    assert!(e.kinetic < 1e-4);
    // The book closes to 1 % of the energy of the fall, about 10 J.
    assert!((total_energy(&world) - start).abs() < 0.1);
    assert!(world.states().iter().all(|s| s.position.z > 0.02 && s.position.is_finite()));
}

#[test]
fn a_restored_world_goes_on_with_the_same_bits() {
    let unit = tetrapod();
    let mut world = RigidWorld::new(heap(&unit)).unwrap();
    run(&mut world, 0.5, 1e-4);
    let text = serde_json::to_string(&world.snapshot()).unwrap();
    run(&mut world, 0.3, 1e-4);
    let snapshot: RigidSnapshot = serde_json::from_str(&text).unwrap();
    let mut again = RigidWorld::new(heap(&unit)).unwrap();
    again.restore(&snapshot).unwrap();
    run(&mut again, 0.3, 1e-4);
    assert_eq!(world.states(), again.states());
    assert_eq!(world.contact_loads(), again.contact_loads());
    assert_eq!(serde_json::to_string(&world.snapshot()).unwrap(), serde_json::to_string(&again.snapshot()).unwrap());
}

#[test]
fn too_deep_is_an_error_that_names_the_bodies() {
    let unit = tetrapod();
    let bodies = vec![standing(&unit, 0.0, 0.0, 0.0), standing(&unit, 0.0, 0.04, 0.0)];
    let error = RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), bodies, MORTAR, 0.3)).unwrap_err();
    assert!(matches!(error, RigidError::TooDeep { .. }));
    assert!(error.to_string().contains("unit 1") && error.to_string().contains("unit 2"), "{error}");
}

#[test]
fn loads_that_are_no_numbers_or_do_not_fit_are_errors() {
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
