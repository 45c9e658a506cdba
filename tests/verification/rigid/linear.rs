//! Impacts under the linear law.

use breakwater::rigid::{BodyState, ContactModel, Material, Resistance, RigidSetup, RigidWorld};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

use super::{MORTAR, ball, run, setup};

/// Two balls that meet head on at a speed [m/s] each: speed after over before, and time of contact [s].
fn impact(e: f64, stiffness: f64) -> [f64; 2] {
    let ball = ball(0.02, 2380.0);
    let coming = |side: f64| BodyState {
        velocity: DVec3::X * (-side * 0.5),
        ..BodyState::at_rest(DVec3::X * (side * 0.021), DQuat::IDENTITY)
    };
    let material = Material { restitution: e, ..MORTAR };
    let mut setup = setup(ball, vec![coming(-1.0), coming(1.0)], material, 0.3);
    setup.friction.unit_unit = Resistance { stiffness: Some(stiffness), ..0.3.into() };
    setup.friction.unit_wall = setup.friction.unit_unit;
    setup.friction.unit_ground = setup.friction.unit_unit;
    let setup = RigidSetup { ground: None, gravity: DVec3::ZERO, model: ContactModel::Linear, ..setup };
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.02, 1e-4);
    let event = world.take_events()[0];
    [world.states()[1].velocity.x / 0.5, event.end - event.start]
}

#[test]
fn restitution_out_is_restitution_in() {
    for e in [0.3, 0.5, 0.8, 1.0] {
        let [out, _] = impact(e, 1e5);
        println!("in {e}, out {out:.5}");
        // 0.005: the dashpot sets in with a jump, which steps of an eightieth of a period resolve to first order.
        assert!((out - e).abs() < 0.005);
    }
}

#[test]
fn an_elastic_impact_lasts_half_a_period() {
    let mass = ball(0.02, 2380.0).mass;
    for stiffness in [1e4, 1e6] {
        let [_, time] = impact(1.0, stiffness);
        let expected = PI * (0.5 * mass / stiffness).sqrt();
        println!("k = {stiffness:e}: {:.2} us, expected {:.2} us", time * 1e6, expected * 1e6);
        // 3 %: start and end are known to a step, a hundred and sixtieth of the period.
        assert!((time / expected - 1.0).abs() < 0.03);
    }
}
