//! Impacts: Hertz's law, restitution, and elastic collisions without loss.

use breakwater::rigid::{BodyState, Load, Material, RigidSetup, RigidWorld};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

use super::{GROUND, MORTAR, UNIT, ball, heap, pair, run, setup, tetrapod};

#[test]
fn a_sphere_on_a_plane_follows_the_law_of_hertz() {
    let material = Material { young_modulus: 1e9, poisson_ratio: 0.25, restitution: 1.0 };
    let body = BodyState { velocity: DVec3::NEG_Z, ..BodyState::at_rest(DVec3::Z * 0.0201, DQuat::IDENTITY) };
    let mut setup = setup(ball(0.02, 2650.0), vec![body], material, 0.3);
    setup.gravity = DVec3::ZERO;
    let mut world = RigidWorld::new(setup).unwrap();
    let mut deepest: f64 = 0.0;
    for _ in 0..400 {
        world.advance(5e-6, &[Load::default()]).unwrap();
        deepest = deepest.max(0.02 - world.states()[0].position.z);
    }
    let events = world.take_events();
    assert_eq!(events.len(), 1);
    let e = &events[0];
    println!("Hertz: F {:.2} N, d {:.2} um, t {:.1} us", e.peak_force, deepest * 1e6, (e.end - e.start) * 1e6);
    // Limit 1 % for force and overlap: the reference values are from Hertz's law; the contact lasts 150 time steps.
    assert!((e.peak_force / 424.8 - 1.0).abs() < 0.01);
    assert!((deepest / 261.3e-6 - 1.0).abs() < 0.01);
    assert!(((e.end - e.start) / 769e-6 - 1.0).abs() < 0.015, "a time step is 0.7 % of the contact");
    assert!((e.approach_normal - 1.0).abs() < 1e-9);
    // The impulse of an elastic impact is 2 m v, with the mass m and the speed v before the impact.
    assert!((e.impulse[2] / (2.0 * 2650.0 * 4.0 / 3.0 * PI * 8e-6) - 1.0).abs() < 2e-3);
}

#[test]
fn restitution_equals_the_given_coefficient() {
    let mut worst: f64 = 0.0;
    for e in [0.3, 0.5, 0.8, 0.95, 1.0] {
        // The time between two calls, here from 2e-5 to 1e-3 s, must not matter: it is the time step of the water.
        for (speed, dt) in [(0.1, 1e-4), (1.0, 1e-4), (1.0, 2e-5), (1.0, 1e-3)] {
            let material = Material { restitution: e, ..MORTAR };
            let ball_at = |x: f64, v: f64| BodyState {
                velocity: DVec3::X * v,
                ..BodyState::at_rest(DVec3::X * x, DQuat::IDENTITY)
            };
            let bodies = vec![ball_at(-0.0201, speed), ball_at(0.0201, -speed)];
            let mut setup = RigidSetup { ground: None, ..setup(ball(0.02, 2380.0), bodies, material, 0.3) };
            setup.gravity = DVec3::ZERO;
            let mut world = RigidWorld::new(setup).unwrap();
            run(&mut world, 0.02, dt);
            let out = world.states()[1].velocity.x / speed;
            println!("restitution {e}: found {out:.5}, speed {speed}, dt {dt}, substeps {}", world.substeps());
            worst = worst.max((out - e).abs());
            // Limit 1e-12: rounding; forces are equal and opposite.
            assert!((world.states()[0].velocity + world.states()[1].velocity).length() < 1e-12);
        }
    }
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn frictionless_elastic_bodies_keep_their_energy() {
    let elastic = Material { restitution: 1.0, young_modulus: 1e9, ..MORTAR };
    let pairs = [UNIT, GROUND].map(|other| pair(other, 0.0.into())).to_vec();
    let setup = RigidSetup { materials: vec![elastic; 2], pairs, ..heap(&tetrapod()) };
    let mut world = RigidWorld::new(setup).unwrap();
    let mechanical = |w: &RigidWorld| w.energy().kinetic + w.energy().potential + w.energy().elastic;
    let start = mechanical(&world);
    for _ in 0..10 {
        run(&mut world, 0.1, 1e-4);
    }
    println!("elastic collisions: energy change {:.2e} of {start:.3} J after 1 s", mechanical(&world) - start);
    // Limit 0.2 % of the energy: error of second order in the time step over some fifty impacts. A jump in gap or
    // normal of a contact would cause a far larger error.
    assert!((mechanical(&world) - start).abs() < 0.002 * start);
}
