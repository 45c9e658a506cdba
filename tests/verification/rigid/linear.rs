//! Impacts with the linear contact law.

use breakwater::rigid::{BodyState, ContactModel, Material, Resistance, RigidSetup, RigidWorld};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

use super::{GROUND, MORTAR, UNIT, ball, pair, run, setup};

/// Returns the speed ratio after a head-on impact of two balls, and the duration of contact [s].
fn impact(e: f64, stiffness: f64) -> [f64; 2] {
    let ball = ball(0.02, 2380.0);
    let coming = |side: f64| BodyState {
        velocity: DVec3::X * (-side * 0.5),
        ..BodyState::at_rest(DVec3::X * (side * 0.021), DQuat::IDENTITY)
    };
    let material = Material { restitution: e, ..MORTAR };
    let mut setup = setup(ball, vec![coming(-1.0), coming(1.0)], material, 0.3);
    let resistance = Resistance { stiffness: Some(stiffness), ..0.3.into() };
    setup.pairs = [UNIT, GROUND].map(|other| pair(other, resistance)).to_vec();
    let setup = RigidSetup { ground: None, gravity: DVec3::ZERO, model: ContactModel::Linear, ..setup };
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.02, 1e-4);
    let event = world.take_events()[0];
    [world.states()[1].velocity.x / 0.5, event.end - event.start]
}

#[test]
fn restitution_equals_the_given_coefficient() {
    for e in [0.3, 0.5, 0.8, 1.0] {
        let [out, _] = impact(e, 1e5);
        println!("restitution {e}: found {out:.5}");
        // Limit 0.005 for the speed ratio: the dashpot force starts with a jump. This jump causes an error of first
        // order in the time step, which is at most an eightieth of a period.
        assert!((out - e).abs() < 0.005);
    }
}

#[test]
fn an_elastic_impact_lasts_half_a_period() {
    let mass = ball(0.02, 2380.0).mass;
    for stiffness in [1e4, 1e6] {
        let [_, time] = impact(1.0, stiffness);
        let expected = PI * (0.5 * mass / stiffness).sqrt();
        println!("k = {stiffness:e}: duration {:.2} us, expected {:.2} us", time * 1e6, expected * 1e6);
        // Limit 3 %: start and end of the contact are known to one substep, which is less than 1/160 of the period.
        assert!((time / expected - 1.0).abs() < 0.03);
    }
}
