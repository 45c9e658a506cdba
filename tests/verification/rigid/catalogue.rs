//! For each unit of the catalogue, a heap of ten such units comes to rest and gains no energy.

use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::rigid::{BodyShape, RigidSetup, RigidWorld};
use glam::DVec3;

use super::{heap, kind, run};

/// Asserts that ten units of about the size of the Tetrapod come to rest in a shaft.
fn assert_settles(name: &str, unit: &ArmourUnit) {
    let mass = 2300.0 * unit.solid().volume_properties().volume;
    let setup = RigidSetup { kinds: vec![kind(BodyShape::from_unit(unit, mass))], ..heap(unit) };
    let mut world = RigidWorld::new(setup).unwrap();
    let e = world.energy();
    let start = e.kinetic + e.potential + e.elastic;
    let (mut previous, mut rise) = (start, 0.0f64);
    let (mut e, mut quiet) = (world.energy(), 0);
    // Stops when the units have been at rest for 0.2 s, at the latest after 3 s.
    while quiet < 20 && world.time() < 3.0 {
        run(&mut world, 0.01, 1e-4);
        e = world.energy();
        let now = e.kinetic + e.potential + e.elastic;
        rise = rise.max(now - previous);
        previous = now;
        quiet = if e.kinetic < 1e-6 * start { quiet + 1 } else { 0 };
    }
    println!(
        "{name}: kinetic {:.1e} of {start:.2} J after {:.2} s, largest rise {rise:.1e} J, {} contacts, {} substeps",
        e.kinetic,
        world.time(),
        world.contact_count(),
        world.substeps()
    );
    // Target: rise of the mechanical energy below 1e-6 of the energy at the start.
    assert!(rise < 1e-6 * start, "{name} gains energy");
    assert!(e.kinetic < 1e-6 * start, "{name} does not come to rest");
    assert!(world.states().iter().all(|s| s.position.z > 0.0 && s.position.abs().cmple(DVec3::splat(2.0)).all()));
}

#[test]
fn tetrapods_settle() {
    assert_settles("Tetrapod", &ArmourUnit::tetrapod(0.077, 0.05).unwrap());
}

#[test]
fn dolosse_settle() {
    assert_settles("Dolos", &ArmourUnit::dolos(0.09, 0.34, 0.05).unwrap());
}

#[test]
fn core_locs_settle() {
    assert_settles("Core-Loc", &ArmourUnit::core_loc(0.085, 0.04).unwrap());
}

#[test]
fn grooved_cubes_settle() {
    assert_settles("grooved cube", &ArmourUnit::grooved_cube(0.05, 0.05).unwrap());
}
