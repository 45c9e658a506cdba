//! Bodies of several kinds: friction of each pair of materials, momentum of unequal bodies, fixed bodies.

use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::rigid::{Body, BodyKind, BodyShape, BodyState, RigidSetup, RigidWorld};
use glam::{DQuat, DVec3};

use super::{G, GROUND, MASS, MORTAR, ball, kind, pair, run, setup, standing, tetrapod, total_energy};

/// Number of a third material.
const ROCK: usize = 2;

fn cube(edge: f64) -> ArmourUnit {
    ArmourUnit::cuboid(DVec3::splat(edge), 0.05).unwrap()
}

/// Returns a setup of Tetrapods of 0.3 kg (kind 0) and cubes of 0.1 kg and another material (kind 1).
fn two_kinds(bodies: Vec<Body>, tetrapod_friction: f64, cube_friction: f64) -> RigidSetup {
    let base = setup(BodyShape::from_unit(&tetrapod(), MASS), vec![], MORTAR, tetrapod_friction);
    let cubes = BodyKind { material: ROCK, ..kind(BodyShape::from_unit(&cube(0.04), 0.1)) };
    let mut pairs = base.pairs.clone();
    let between =
        |a, b, friction: f64| breakwater::rigid::MaterialPair { between: [a, b], resistance: friction.into() };
    pairs.extend([pair(ROCK, 0.4.into()), between(ROCK, ROCK, 0.5), between(GROUND, ROCK, cube_friction)]);
    let kinds = vec![base.kinds[0].clone(), cubes];
    RigidSetup { kinds, bodies, materials: vec![MORTAR; 3], pairs, ..base }
}

#[test]
fn two_kinds_slide_at_the_friction_angles_of_their_materials() {
    let [tetrapod_friction, cube_friction] = [0.5, 0.35];
    let bodies = vec![
        Body { kind: 0, state: standing(&tetrapod(), 0.0, 0.0, 0.0) },
        Body { kind: 1, state: BodyState::at_rest(DVec3::new(0.0, 1.0, 0.02 - 1e-6), DQuat::IDENTITY) },
    ];
    let mut world = RigidWorld::new(two_kinds(bodies, tetrapod_friction, cube_friction)).unwrap();
    run(&mut world, 0.3, 1e-4);
    let mut slides_at = [None; 2];
    for step in 0.. {
        // One degree per second.
        let angle = (1e-3 * f64::from(step)).to_radians();
        world.set_gravity(DVec3::new(G * angle.sin(), 0.0, -G * angle.cos()));
        run(&mut world, 1e-3, 1e-4);
        for (found, state) in slides_at.iter_mut().zip(world.states()) {
            if found.is_none() && state.velocity.x > 0.001 {
                *found = Some(angle.tan());
            }
        }
        if slides_at.iter().all(Option::is_some) {
            break;
        }
    }
    let found = slides_at.map(|tangent| tangent.unwrap());
    println!("Tetrapod slides at tan = {:.4}, cube at {:.4}", found[0], found[1]);
    // Target: 1 % of the coefficients. Until a unit has reached 1 mm/s, the ground tilts further by 0.1 degrees (0.5
    // %).
    assert!((found[0] / tetrapod_friction - 1.0).abs() < 0.01 && (found[1] / cube_friction - 1.0).abs() < 0.01);
}

#[test]
fn unequal_balls_bounce_with_the_restitution_and_keep_their_momentum() {
    let balls = [ball(0.02, 2400.0), ball(0.035, 1700.0)];
    let masses = balls.clone().map(|ball| ball.mass);
    let at = |kind: usize, x: f64, v: f64| Body {
        kind,
        state: BodyState { velocity: DVec3::X * v, ..BodyState::at_rest(DVec3::X * x, DQuat::IDENTITY) },
    };
    let base = setup(balls[0].clone(), vec![], MORTAR, 0.3);
    let mut world = RigidWorld::new(RigidSetup {
        kinds: balls.map(kind).to_vec(),
        bodies: vec![at(0, -0.021, 0.6), at(1, 0.036, -0.3)],
        ground: None,
        gravity: DVec3::ZERO,
        ..base
    })
    .unwrap();
    run(&mut world, 0.02, 1e-4);
    let [a, b] = [0, 1].map(|k| world.states()[k].velocity.x);
    let mean = (0.6 * masses[0] - 0.3 * masses[1]) / (masses[0] + masses[1]);
    // Restitution 0.5: the velocities relative to the common centre of mass halve and change their signs.
    let expected = [mean - 0.5 * (0.6 - mean), mean + 0.5 * (0.3 + mean)];
    println!("unequal balls: {a:.5} and {b:.5} m/s, expected {:.5} and {:.5} m/s", expected[0], expected[1]);
    // Limit 1e-3 of the approach speed, as for equal balls.
    assert!((a - expected[0]).abs() < 9e-4 && (b - expected[1]).abs() < 9e-4);
    // Limit 1e-12: rounding; forces are equal and opposite.
    assert!((masses[0] * a + masses[1] * b - mean * (masses[0] + masses[1])).abs() < 1e-12);
    let event = world.take_events()[0];
    let effective = masses[0] * masses[1] / (masses[0] + masses[1]);
    assert!((event.approach_energy / (0.5 * effective * 0.81) - 1.0).abs() < 1e-9);
}

#[test]
fn a_tetrapod_that_hits_a_cube_or_a_rock_keeps_momentum_and_angular_momentum() {
    keeps_momentum(&cube(0.04));
    keeps_momentum(&ArmourUnit::rock(0.04, 3, 0.05).unwrap());
}

/// A Tetrapod hits a unit of 0.1 kg at rest.
fn keeps_momentum(other: &ArmourUnit) {
    let state =
        |position, velocity| BodyState { velocity, ..BodyState::at_rest(position, DQuat::from_rotation_x(0.4)) };
    let bodies = vec![
        Body { kind: 0, state: state(DVec3::new(-0.09, 0.012, 0.0), DVec3::X) },
        Body { kind: 1, state: state(DVec3::ZERO, DVec3::ZERO) },
    ];
    let mut setup = RigidSetup { ground: None, gravity: DVec3::ZERO, ..two_kinds(bodies, 0.5, 0.5) };
    setup.kinds[1].shape = BodyShape::from_unit(other, 0.1);
    let (masses, inertias) = ([0, 1].map(|k| setup.kinds[k].shape.mass), [0, 1].map(|k| setup.kinds[k].shape.inertia));
    let mut world = RigidWorld::new(setup).unwrap();
    let momenta = |world: &RigidWorld| {
        let of = |k: usize| {
            let s = world.states()[k];
            let spin = s.rotation * (inertias[k] * (s.rotation.inverse() * s.angular_velocity));
            [masses[k] * s.velocity, spin + masses[k] * s.position.cross(s.velocity)]
        };
        let [a, b] = [of(0), of(1)];
        [a[0] + b[0], a[1] + b[1]]
    };
    let (before, energy) = (momenta(&world), total_energy(&world));
    run(&mut world, 0.1, 1e-4);
    let after = momenta(&world);
    println!("the other unit moves with {:.4} m/s", world.states()[1].velocity);
    assert!(world.states()[1].velocity.length() > 0.3 && !world.take_events().is_empty());
    // Limit 1e-12: rounding of a thousand substeps. The force acts on both bodies at the same point, so that the moment
    // is conserved as well.
    assert!((after[0] - before[0]).length() < 1e-12 && (after[1] - before[1]).length() < 1e-12, "{after:?} {before:?}");
    // Limit: 1 % of the kinetic energy at the start, 0.15 J.
    assert!((total_energy(&world) - energy).abs() < 1.5e-3);
}

#[test]
fn a_fixed_body_carries_others_and_does_not_move() {
    let base = two_kinds(vec![], 0.5, 0.5);
    let mut kinds = base.kinds.clone();
    kinds[1].is_fixed = true;
    let [low, high] = [0.02, 0.08].map(|z| BodyState::at_rest(DVec3::Z * z, DQuat::IDENTITY));
    let cubes = BodyShape::from_unit(&cube(0.08), 0.5);
    kinds.push(BodyKind { material: ROCK, ..kind(cubes) });
    let bodies = vec![
        // The second fixed cube overlaps the first one and the ground, which has no effect.
        Body { kind: 1, state: low },
        Body { kind: 1, state: BodyState { position: DVec3::new(0.01, 0.0, 0.01), ..low } },
        Body { kind: 2, state: high },
    ];
    let mut world = RigidWorld::new(RigidSetup { kinds, bodies, ..base }).unwrap();
    let fixed = [world.states()[0], world.states()[1]];
    run(&mut world, 0.5, 1e-4);
    assert_eq!([world.states()[0], world.states()[1]], fixed);
    // The force on the free cube is its weight; 1e-3 allows for residual motion.
    let load = world.contact_loads()[2].force.z;
    assert!((load / (0.5 * G) - 1.0).abs() < 1e-3, "{load}");
    // Limit 0.1 mm for the position: the overlap at rest is some hundredths of a millimetre. Limit 1e-9 J for the
    // kinetic energy: a fall of 0.2 nm.
    assert!((world.states()[2].position.z - 0.08).abs() < 1e-4);
    assert!(world.energy().kinetic < 1e-9, "{:?}", world.energy());
}

#[test]
fn a_driven_cube_pushes_another_one_with_its_friction_and_supplies_the_energy() {
    let (friction, speed) = (0.35, 0.05);
    let at = |x: f64| BodyState::at_rest(DVec3::new(x, 0.0, 0.02 - 1e-6), DQuat::IDENTITY);
    let bodies = vec![Body { kind: 1, state: at(0.0) }, Body { kind: 2, state: at(-0.0405) }];
    let mut setup = two_kinds(bodies, 0.5, friction);
    setup.kinds.push(BodyKind { is_fixed: true, ..setup.kinds[1].clone() });
    let mut world = RigidWorld::new(setup).unwrap();
    assert!(world.drive(0, DVec3::X).is_err());
    run(&mut world, 0.2, 1e-4);
    let before = total_energy(&world);
    world.drive(1, speed * DVec3::X).unwrap();
    let (mut push, mut count) = (0.0, 0.0);
    for step in 0..5000 {
        run(&mut world, 1e-4, 1e-4);
        if step >= 2500 {
            (push, count) = (push - world.contact_loads()[1].force.x, count + 1.0);
        }
    }
    let [free, driven] = [world.states()[0], world.states()[1]];
    let work = world.energy().load_work;
    let weight = friction * 0.1 * G;
    println!(
        "push {:.4} of the friction, speed {:.5} m/s, work {work:.5} J, energy changes by {:.1e} J",
        push / count / weight,
        free.velocity.x,
        total_energy(&world) - before
    );
    assert!((driven.position.x - (speed * 0.5 - 0.0405)).abs() < 1e-9);
    // Limits: 1 % of force and speed, 0.1 % of the work (the contact begins with an impact).
    assert!((push / count / weight - 1.0).abs() < 0.01 && (free.velocity.x / speed - 1.0).abs() < 0.01);
    assert!(work > 0.9 * weight * speed * 0.49 && (total_energy(&world) - before).abs() < 1e-3 * work);
}
