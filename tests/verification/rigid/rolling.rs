//! Rolling balls with and without rolling resistance.

use breakwater::rigid::{BodyState, Resistance, RigidWorld};
use glam::{DQuat, DVec3};

use super::{G, GROUND, MORTAR, ball, pair, run, setup};

const RADIUS: f64 = 0.02;

/// Creates a ball at rest on level ground with the rolling resistance coefficient `rolling` [-].
fn at_rest(rolling: f64) -> RigidWorld {
    let body = BodyState::at_rest(DVec3::Z * (RADIUS - 1e-6), DQuat::IDENTITY);
    let mut setup = setup(ball(RADIUS, 2380.0), vec![body], MORTAR, 0.5);
    setup.pairs[GROUND] = pair(GROUND, Resistance { rolling, ..0.5.into() });
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.2, 1e-4);
    world
}

#[test]
fn a_ball_rolls_down_an_incline_with_the_acceleration_of_theory() {
    for (rolling, angle) in [(0.0, 0.3f64), (0.05, 0.3)] {
        let mut world = at_rest(rolling);
        world.set_gravity(DVec3::new(G * angle.sin(), 0.0, -G * angle.cos()));
        run(&mut world, 0.1, 1e-4);
        let before = world.states()[0];
        run(&mut world, 0.4, 1e-4);
        let state = world.states()[0];
        let acceleration = (state.velocity.x - before.velocity.x) / 0.4;
        // The moment mu_r R N (coefficient mu_r, radius R, normal force N) reduces the force along the slope by mu_r N.
        // Two sevenths of the remaining force rotate the ball.
        let expected = 5.0 / 7.0 * G * (angle.sin() - rolling * angle.cos());
        println!("mu_r = {rolling}: {acceleration:.5} m/s2, expected {expected:.5}");
        // Limit 0.1 % for the acceleration: the tangential spring oscillates for a short time after the tilt.
        assert!((acceleration / expected - 1.0).abs() < 1e-3);
        assert!((state.angular_velocity.y * RADIUS / state.velocity.x - 1.0).abs() < 1e-3);
    }
}

#[test]
fn a_ball_stays_below_the_angle_of_rolling_resistance() {
    let mut world = at_rest(0.05);
    let angle = 0.9 * 0.05f64.atan();
    world.set_gravity(DVec3::new(G * angle.sin(), 0.0, -G * angle.cos()));
    run(&mut world, 1.0, 1e-4);
    let before = world.states()[0];
    run(&mut world, 10.0, 1e-4);
    let moved = (world.states()[0].position - before.position).length();
    println!("moved {moved:.1e} m in 10 s");
    // Limit 0.01 mm for the displacement, as for a Tetrapod below the friction angle.
    assert!(moved < 1e-5);
    // The energy balance counts the dissipation by rolling resistance.
    let mut world = at_rest(0.05);
    world.set_gravity(DVec3::new(G * 0.3f64.sin(), 0.0, -G * 0.3f64.cos()));
    let start = super::total_energy(&world);
    let friction = world.energy().friction;
    run(&mut world, 0.5, 1e-4);
    let loss = world.energy().friction - friction;
    let angle_rolled = world.states()[0].angular_velocity.y * 0.5 * 0.5;
    let expected = 0.05 * RADIUS * ball(RADIUS, 2380.0).mass * G * 0.3f64.cos() * angle_rolled;
    println!("loss {loss:.3e} J, expected {expected:.3e} J, residual {:.1e} J", super::total_energy(&world) - start);
    // Limit 1 % for the energy loss: the expected rotation angle assumes a constant acceleration.
    assert!((loss / expected - 1.0).abs() < 0.01);
}
