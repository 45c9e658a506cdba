//! Creep below the friction angle: none with Hertz-Mindlin, some with the contact law of the published runs.

use breakwater::rigid::{BodyShape, ContactModel, RigidWorld};
use glam::DVec3;

use super::{G, MASS, MORTAR, run, setup, standing, tetrapod};

/// Returns displacement [m] and final speed [m/s] of a Tetrapod after a time [s] at 0.9 of the friction angle.
fn creep_of(model: ContactModel, duration: f64) -> [f64; 2] {
    let unit = tetrapod();
    let body = standing(&unit, 0.0, 0.0, 0.0);
    let setup = setup(BodyShape::from_unit(&unit, MASS), vec![body], MORTAR, 0.32);
    let mut world = RigidWorld::new(breakwater::rigid::RigidSetup { model, ..setup }).unwrap();
    run(&mut world, 0.3, 1e-4);
    let angle = 0.9 * 0.32f64.atan();
    world.set_gravity(DVec3::new(G * angle.sin(), 0.0, -G * angle.cos()));
    run(&mut world, 0.5, 1e-4);
    let before = world.states()[0];
    run(&mut world, duration, 1e-4);
    let after = world.states()[0];
    [(after.position - before.position).length(), after.velocity.length()]
}

#[test]
fn a_tetrapod_below_the_friction_angle_does_not_creep_in_a_minute() {
    let [displacement, speed] = creep_of(ContactModel::HertzMindlin, 60.0);
    println!("Hertz-Mindlin: {displacement:.2e} m in 60 s, {speed:.1e} m/s");
    // Target: displacement below 0.01 mm in 60 s.
    assert!(displacement < 1e-5);
}

#[test]
fn a_tetrapod_creeps_with_chrono4() {
    let [displacement, speed] = creep_of(ContactModel::Chrono4, 5.0);
    println!("chrono4: {:.3} mm in 5 s, {:.3} mm/s", displacement * 1e3, speed * 1e3);
    // With chrono4, friction acts only above a speed of 0.1 mm/s, so the unit creeps at least at this speed.
    assert!(displacement > 5.0 * 1e-4);
}
