//! Units below the friction angle stay where they are; in the law of the published runs they do not.

use breakwater::rigid::{BodyShape, ContactModel, RigidWorld};
use glam::DVec3;

use super::{G, MASS, MORTAR, run, setup, standing, tetrapod};

/// Way [m] and speed [m/s] of a Tetrapod at 0.9 of the friction angle over a time [s].
fn creep(model: ContactModel, duration: f64) -> [f64; 2] {
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
    let [way, speed] = creep(ContactModel::HertzMindlin, 60.0);
    println!("Hertz-Mindlin: {way:.2e} m in 60 s, {speed:.1e} m/s");
    // 0.01 mm: asked for.
    assert!(way < 1e-5);
}

#[test]
fn without_history_it_creeps() {
    let [way, speed] = creep(ContactModel::Chrono4, 5.0);
    println!("chrono4: {:.3} mm in 5 s, {:.3} mm/s", way * 1e3, speed * 1e3);
    // A unit that rests cannot be held without a speed: at least that below which chrono4 has no friction.
    assert!(way > 5.0 * 1e-4);
}
