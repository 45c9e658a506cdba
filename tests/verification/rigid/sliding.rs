//! Static and kinetic friction.

use breakwater::geometry::profile::Profile;
use breakwater::rigid::{BodyShape, Cover, Ground, Resistance, RigidWorld};
use glam::DVec3;

use super::{G, GROUND, MASS, MORTAR, ground, pair, run, setup, standing, tetrapod};

/// Creates a Tetrapod that settled on level ground, and tilts the ground to a slope [rad]. The azimuth turns a leg
/// forward or backward; the unit slides along x.
fn tilted_world(azimuth: f64, resistance: Resistance, angle: f64) -> RigidWorld {
    let unit = tetrapod();
    let body = standing(&unit, 0.0, 0.0, azimuth);
    let mut setup = setup(BodyShape::from_unit(&unit, MASS), vec![body], MORTAR, 0.0);
    setup.pairs[GROUND] = pair(GROUND, resistance);
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.3, 1e-4);
    // The tilt is slow: after a sudden tilt, the unit would oscillate on its tangential spring up to twice the load.
    for step in 1..=500 {
        let now = angle * f64::from(step) / 500.0;
        world.set_gravity(DVec3::new(G * now.sin(), 0.0, -G * now.cos()));
        run(&mut world, 1e-3, 1e-4);
    }
    world
}

#[test]
fn a_sliding_tetrapod_has_the_acceleration_of_kinetic_friction() {
    for azimuth in [0.0, std::f64::consts::PI] {
        let resistance = Resistance { kinetic_friction: 0.32, ..0.65.into() };
        let angle = 0.72f64.atan();
        let mut world = tilted_world(azimuth, resistance, angle);
        // Within 0.1 s, the unit starts to slide, and kinetic friction replaces static friction.
        run(&mut world, 0.1, 1e-4);
        let before = world.states()[0].velocity.x;
        run(&mut world, 0.3, 1e-4);
        let acceleration = (world.states()[0].velocity.x - before) / 0.3;
        let expected = G * (angle.sin() - 0.32 * angle.cos());
        println!("azimuth {azimuth:.2}: {acceleration:.4} m/s2, expected {expected:.4}");
        // Target: acceleration within 1 % of theory.
        assert!((acceleration / expected - 1.0).abs() < 0.01);
    }
}

#[test]
fn a_unit_between_both_friction_angles_slides_only_after_an_external_force() {
    let resistance = Resistance { kinetic_friction: 0.32, ..0.65.into() };
    let angle = 0.5f64.atan();
    let mut world = tilted_world(0.0, resistance, angle);
    run(&mut world, 0.5, 1e-4);
    let rest = world.states()[0];
    run(&mut world, 1.0, 1e-4);
    let now = world.states()[0];
    // Limit 0.01 mm for the displacement, as for a Tetrapod below the friction angle.
    assert!((now.position - rest.position).length() < 1e-5 && now.velocity.length() < 1e-5);
    // A force for 0.1 s starts the motion. Then kinetic friction replaces static friction, and the unit keeps sliding.
    let load = breakwater::rigid::Load { force: DVec3::X * (MASS * 2.0 + 2.0), torque: DVec3::ZERO };
    for _ in 0..1000 {
        world.advance(1e-4, &[load]).unwrap();
    }
    let speed = world.states()[0].velocity.x;
    run(&mut world, 0.2, 1e-4);
    let acceleration = (world.states()[0].velocity.x - speed) / 0.2;
    let expected = G * (angle.sin() - 0.32 * angle.cos());
    println!("{speed:.3} m/s after the load, then {acceleration:.4} m/s2, expected {expected:.4}");
    assert!(speed > 0.05 && (acceleration / expected - 1.0).abs() < 0.01);
}

#[test]
fn a_unit_that_slides_from_the_mound_to_the_bed_is_slowed_by_the_friction_of_each() {
    let unit = tetrapod();
    let mut body = standing(&unit, -0.3, 0.0, 0.0);
    body.velocity = DVec3::X * 1.5;
    let mut setup = setup(BodyShape::from_unit(&unit, MASS), vec![body], MORTAR, 0.5);
    let profile = Profile::new(vec![[-5.0, 0.0], [0.0, 0.0], [5.0, 0.0]]);
    let mound = setup.materials.len();
    setup.materials.push(MORTAR);
    setup.pairs.push(pair(mound, 0.2.into()));
    setup.ground = Some(Ground { covers: vec![Cover { x: [-5.0, 0.0], material: mound }], ..ground(profile) });
    let mut world = RigidWorld::new(setup).unwrap();
    // Until 0.1 s, all feet are at x < 0; from 0.32 s to 0.4 s, they are at x > 0. At the start, the unit rocks.
    let mut deceleration = |start: f64, end: f64| {
        let wait = start - world.time();
        run(&mut world, wait, 1e-4);
        let before = world.states()[0].velocity.x;
        run(&mut world, end - start, 1e-4);
        (before - world.states()[0].velocity.x) / (end - start)
    };
    let found = [deceleration(0.04, 0.1), deceleration(0.32, 0.4)];
    println!("deceleration on the mound {:.3} m/s2, on the bed {:.3} m/s2", found[0], found[1]);
    // Target: within 1 % of theory, as for a unit on a slope.
    assert!((found[0] / (0.2 * G) - 1.0).abs() < 0.01 && (found[1] / (0.5 * G) - 1.0).abs() < 0.01);
}

#[test]
fn an_oblique_impact_gains_no_energy_at_any_instant() {
    let mut body = standing(&tetrapod(), 0.0, 0.0, 0.3);
    body.position.z += 0.01;
    body.velocity = DVec3::new(1.1, 0.2, -1.2);
    let mut world = RigidWorld::new(setup(BodyShape::from_unit(&tetrapod(), MASS), vec![body], MORTAR, 0.65)).unwrap();
    let mechanical = |world: &RigidWorld| {
        let e = world.energy();
        e.kinetic + e.potential + e.elastic
    };
    let start = mechanical(&world);
    let (mut before, mut rise) = (start, 0.0f64);
    for _ in 0..20_000 {
        world.advance(2e-6, &[breakwater::rigid::Load::default()]).unwrap();
        rise = rise.max(mechanical(&world) - before);
        before = mechanical(&world);
    }
    println!("largest rise {rise:.1e} J of {start:.3} J, final energy {:.3} J", before);
    // Target: rise of the mechanical energy below 1e-6 of the energy at the start.
    assert!(rise < 1e-6 * start && before < 0.9 * start);
}
