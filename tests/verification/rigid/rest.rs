//! Bodies at rest hold their place, cost almost nothing, and move on as if they had never rested.

use std::time::Instant;

use breakwater::rigid::{BodyShape, Load, REST_BOUND, RigidWorld};
use glam::DVec3;

use super::pile::lattice;
use super::{G, MASS, MORTAR, run, setup, standing, tetrapod};

/// Returns a pile of Tetrapods, all of them at rest.
fn pile(count: usize, [along, across]: [usize; 2]) -> RigidWorld {
    let mut world = RigidWorld::new(lattice(count, along, across)).unwrap();
    while world.count_at_rest() < count {
        run(&mut world, 0.05, 5e-3);
        // After 0.9 s, the kinetic energy is less than 1e-7 of that of the fall.
        assert!(world.time() < 5.0, "only {} of {count} units are at rest", world.count_at_rest());
    }
    world
}

/// Returns the wall-clock time of 5 ms [s].
fn cost(world: &mut RigidWorld) -> f64 {
    let clock = Instant::now();
    run(world, 0.05, 5e-3);
    clock.elapsed().as_secs_f64() / 10.0
}

/// Returns the upward impulse of the present contacts with ground and walls [N s].
fn upward_impulse(world: &RigidWorld) -> f64 {
    world.running_events().filter(|event| event.partner_unit().is_none()).map(|event| event.impulse[2]).sum()
}

#[test]
fn units_that_slept_move_as_units_that_did_not() {
    let mut world = pile(40, [4, 3]);
    let mut slept = world.clone();
    let at_rest = world.states().to_vec();
    let time = cost(&mut slept);
    assert_eq!(slept.states(), at_rest);
    let carried = (upward_impulse(&slept) - upward_impulse(&world)) / (40.0 * MASS * G * (slept.time() - world.time()));
    println!("ground and walls carried {carried:.6} of the weight");
    // The forces of each unit balance to 1e-4 of its weight.
    assert!((carried - 1.0).abs() < 1e-4);
    let text = serde_json::to_string(&slept.snapshot()).unwrap();
    let mut restored = RigidWorld::new(lattice(40, 4, 3)).unwrap();
    restored.restore(&serde_json::from_str(&text).unwrap()).unwrap();
    let mut awake = world.clone();
    awake.set_rest_bound(0.0);
    let full = cost(&mut awake);
    println!("5 ms take {:.1} us at rest, {:.1} us awake", 1e6 * time, 1e6 * full);
    // It takes some microseconds instead of some milliseconds.
    assert!(time < 0.1 * full);
    // All worlds get the same push on one unit.
    let mut loads = vec![Load::default(); 40];
    loads[35].force = DVec3::new(-2.0, 0.5, 1.0) * MASS * G;
    for pushed in [&mut world, &mut slept, &mut restored, &mut awake] {
        for _ in 0..20 {
            pushed.advance(1e-3, &loads).unwrap();
        }
    }
    let moved = world.states()[35].position.distance(at_rest[35].position);
    let apart = world.states().iter().zip(awake.states()).map(|(a, b)| a.position.distance(b.position));
    let apart = apart.fold(0.0, f64::max);
    println!("pushed by {moved:.3e} m; difference from a pile that never rested {apart:.1e} m");
    assert_eq!(world.states(), slept.states());
    assert_eq!(world.states(), restored.states());
    // The push is twice the weight of the unit, and forces at rest balance to 1e-4 of the weight.
    assert!(moved > 1e-3 && apart < 1e-4 * moved);
}

#[test]
fn a_unit_leaves_its_rest_when_a_load_exceeds_the_bound() {
    let unit = tetrapod();
    let mut world =
        RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), vec![standing(&unit, 0.0, 0.0, 0.0)], MORTAR, 0.5))
            .unwrap();
    run(&mut world, 0.5, 1e-3);
    assert_eq!(world.count_at_rest(), 1);
    let at_rest = world.states()[0];
    // Its forces at rest balance up to the bound: twice the bound is always too much.
    for (share, rests) in [(0.0, 1), (2.0 * REST_BOUND, 0)] {
        world.advance(1e-5, &[Load { force: DVec3::X * share * MASS * G, ..Load::default() }]).unwrap();
        assert_eq!(world.count_at_rest(), rests);
        assert_eq!(world.states()[0] == at_rest, rests == 1);
    }
}
