//! Friction at rest and in motion.

use breakwater::rigid::{BodyShape, Resistance, RigidWorld};
use glam::DVec3;

use super::{G, MASS, MORTAR, run, setup, standing, tetrapod};

/// A Tetrapod with a leg forward or backward on a plane at the given slope [rad], settled on the level first; it slides
/// along x.
fn on_slope(azimuth: f64, resistance: Resistance, angle: f64) -> RigidWorld {
    let unit = tetrapod();
    let body = standing(&unit, 0.0, 0.0, azimuth);
    let mut setup = setup(BodyShape::from_unit(&unit, MASS), vec![body], MORTAR, 0.0);
    setup.friction.unit_ground = resistance;
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.3, 1e-4);
    // Slowly: tilted at once, the unit would swing on its tangential spring to twice the load.
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
        let mut world = on_slope(azimuth, resistance, angle);
        // It starts and takes up the speed at which friction is that of motion.
        run(&mut world, 0.1, 1e-4);
        let before = world.states()[0].velocity.x;
        run(&mut world, 0.3, 1e-4);
        let acceleration = (world.states()[0].velocity.x - before) / 0.3;
        let expected = G * (angle.sin() - 0.32 * angle.cos());
        println!("azimuth {azimuth:.2}: {acceleration:.4} m/s2, expected {expected:.4}");
        // 1 %: asked for.
        assert!((acceleration / expected - 1.0).abs() < 0.01);
    }
}

#[test]
fn between_the_angles_of_motion_and_rest_a_unit_stays_until_it_is_pushed() {
    let resistance = Resistance { kinetic_friction: 0.32, ..0.65.into() };
    let angle = 0.5f64.atan();
    let mut world = on_slope(0.0, resistance, angle);
    run(&mut world, 0.5, 1e-4);
    let rest = world.states()[0];
    run(&mut world, 1.0, 1e-4);
    let now = world.states()[0];
    // 0.01 mm: what is allowed below the friction angle.
    assert!((now.position - rest.position).length() < 1e-5 && now.velocity.length() < 1e-5);
    // A push of 0.2 m/s lasting 0.1 s: friction drops to that of motion and it goes on sliding.
    let push = breakwater::rigid::Load { force: DVec3::X * (MASS * 2.0 + 2.0), torque: DVec3::ZERO };
    for _ in 0..1000 {
        world.advance(1e-4, &[push]).unwrap();
    }
    let pushed = world.states()[0].velocity.x;
    run(&mut world, 0.2, 1e-4);
    let acceleration = (world.states()[0].velocity.x - pushed) / 0.2;
    let expected = G * (angle.sin() - 0.32 * angle.cos());
    println!("pushed to {pushed:.3} m/s, then {acceleration:.4} m/s2, expected {expected:.4}");
    assert!(pushed > 0.05 && (acceleration / expected - 1.0).abs() < 0.01);
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
    println!("largest rise {rise:.1e} of {start:.3} J, {:.3} J left", before);
    // 1e-6 of the energy at the start: asked for.
    assert!(rise < 1e-6 * start && before < 0.9 * start);
}
