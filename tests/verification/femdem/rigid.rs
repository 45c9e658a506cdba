//! Rigid bodies in a fracture run: free motion, constraints, contact.

use super::contact::{both, two};
use super::*;
use std::f64::consts::TAU;

fn rigid_block(lengths: DVec3, cells: [usize; 3]) -> (PreparedMesh, Setup) {
    let mesh = mesh(lengths, cells);
    let mut setup = setup(&mesh, None);
    setup.bodies[0].rigid = true;
    (mesh, setup)
}

#[test]
fn a_free_rigid_body_tumbles_and_falls_without_loss() {
    let (_, mut setup) = rigid_block(DVec3::new(0.3, 0.2, 0.1), [2, 2, 1]);
    setup.bodies[0].velocity = DVec3::new(1.0, -2.0, 0.5);
    // The rotation is nearly about the intermediate axis.
    setup.bodies[0].angular_velocity = DVec3::new(0.3, 20.0, 0.5);
    setup.gravity = DVec3::NEG_Z * 9.8;
    let mut world = World::new(setup, 1.0);
    world.dt = 1e-4;
    let (first, body_energies) = world.step_with_body_energies().unwrap();
    let start = world.rigid_bodies[0].motion;
    // Mass and moments of inertia of a cuboid.
    let mass = 2340.0 * 0.006;
    let moment = |a: f64, b: f64| mass * (a * a + b * b) / 12.0;
    let l = DVec3::new(0.3 * moment(0.2, 0.1), 20.0 * moment(0.3, 0.1), 0.5 * moment(0.3, 0.2));
    assert!((start.angular_momentum - l).length() < 1e-12 * l.length());
    assert!((body_energies[0].kinetic / first.kinetic - 1.0).abs() < 1e-14);
    let (mut residual, mut longest) = (0.0f64, 0.0f64);
    let edge = world.initial_position(0).distance(world.initial_position(1));
    for _ in 0..20_000 {
        let energies = world.step_with_energies().unwrap();
        residual = residual.max((energies.total() - first.total()).abs() / first.kinetic);
        longest = longest.max((world.nodes.position[0].distance(world.nodes.position[1]) / edge - 1.0).abs());
    }
    let now = world.rigid_bodies[0].motion;
    println!("residual {residual:.1e}, relative change of edge lengths {longest:.1e}");
    // Without torque, the angular momentum changes only by rounding in the sum of forces.
    assert!((now.angular_momentum - start.angular_momentum).length() < 1e-12 * l.length());
    assert!(now.centre.distance(start.centre) > 10.0 && longest < 1e-12);
    // Limit 1e-5 for the energy residual: it is of second order in the time step dt, (omega dt)^2 = 4e-6.
    assert!(residual < 1e-5);
}

#[test]
fn a_rigid_pendulum_swings_about_its_held_edge() {
    let (length, side) = (0.3, 0.04);
    let (mesh, mut setup) = rigid_block(DVec3::new(side, side, length), [1, 1, 4]);
    // The body is held at its upper edge along y at x = 0.
    let edge: Vec<u32> = (0..mesh.mesh.nodes.len() as u32)
        .filter(|n| mesh.mesh.nodes[*n as usize].z == length && mesh.mesh.nodes[*n as usize].x == 0.0)
        .collect();
    setup.constraints = vec![constant_velocity(edge, [Some(0.0); 3])];
    // The body starts below the edge with an angular velocity.
    let (dx, dz) = (0.5 * side, 0.5 * length);
    let down = DVec3::new(dx, 0.0, -dz);
    setup.gravity = down.normalize() * 9.8;
    setup.bodies[0].pivot = DVec3::new(0.0, 0.0, length);
    setup.bodies[0].angular_velocity = DVec3::Y * 0.1;
    let mut world = World::new(setup, 1.0);
    world.dt = 1e-4;
    let first = world.step_with_energies().unwrap();
    let centre = world.rigid_bodies[0].motion.centre;
    let (mut signal, mut residual) = (Vec::new(), 0.0f64);
    while world.time < 2.5 {
        let energies = world.step_with_energies().unwrap();
        residual = residual.max((energies.total() - first.total()).abs() / first.kinetic);
        signal.push((world.time, (world.rigid_bodies[0].motion.centre - centre).dot(DVec3::X)));
    }
    let times = crossings(&signal);
    let period = 2.0 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    // The period is T = 2 pi sqrt(I / (m g d)), with the moment of inertia I about the edge, the mass m, and the
    // distance d of the centre of mass from the edge. An amplitude of 0.02 lengthens T by the share 0.02^2 / 16.
    let inertia = (side * side + length * length) / 12.0 + down.length_squared();
    let expected = TAU * (inertia / (9.8 * down.length())).sqrt();
    println!("period {period:.5} s ({expected:.5} expected), residual {residual:.1e}");
    // Limit 0.1 % for the period. Half of it allows for zero crossings with positions that are half a time step off.
    assert!((period / expected - 1.0).abs() < 1e-3);
    // Limit 1e-3 for the energy residual: the constraint does no work except for the error of the time step.
    assert!(residual < 1e-3);
}

#[test]
fn a_rigid_block_bounces_off_a_deformable_block() {
    let gap = 1e-5;
    let mesh = two([
        (DVec3::new(0.06, 0.06, 0.06), [2, 2, 2], DVec3::new(0.02, 0.03, 0.1 + gap)),
        (DVec3::new(0.1, 0.1, 0.1), [3, 3, 3], DVec3::ZERO),
    ]);
    let mut setup = both(&mesh, [CONCRETE; 2], 0.3);
    setup.bodies[0].rigid = true;
    setup.bodies[0].velocity = DVec3::new(0.2, 0.0, -1.0);
    setup.bodies[0].angular_velocity = DVec3::new(0.0, 2.0, 0.0);
    setup.bodies[0].pivot = DVec3::new(0.05, 0.06, 0.13);
    let mut world = World::new(setup, 0.2);
    let momentum = |world: &World| -> [DVec3; 2] {
        let motion = world.rigid_bodies[0].motion;
        let p = motion.velocity * (2340.0 * 0.06f64.powi(3));
        let mut sum = [p, motion.centre.cross(p) + motion.angular_momentum];
        for n in (0..world.nodes.count()).filter(|n| world.nodes.copies_of(*n)[0] as usize / 4 >= 24 * 8) {
            let (x, p) = (world.nodes.position[n], world.nodes.velocity[n] * world.nodes.mass[n]);
            sum = [sum[0] + p, sum[1] + x.cross(p)];
        }
        sum
    };
    let (first, start) = (world.step_with_energies().unwrap(), momentum(&world));
    let mut touched = 0;
    while world.time < 5e-4 {
        world.step().unwrap();
        touched += usize::from(world.contacts.scalars.touching > 0);
    }
    let (last, end) = (world.step_with_energies().unwrap(), momentum(&world));
    println!(
        "{touched} time steps in contact, residual {:.1e}, velocity {}, friction {:.1e} J, change of momenta {:.1e}, {:.1e}",
        (last.total() - first.total()) / first.kinetic,
        world.rigid_bodies[0].motion.velocity,
        last.friction,
        (end[0] - start[0]).length(),
        (end[1] - start[1]).length()
    );
    assert!(touched > 10 && world.rigid_bodies[0].motion.velocity.z > -0.5 && last.friction > 0.0);
    // Limit 1e-12: rounding.
    assert!((end[0] - start[0]).length() < 1e-12 && (end[1] - start[1]).length() < 1e-12);
    // Limit 1e-2 for the energy residual, an error of second order: dt is a fifth of the longest stable time step.
    assert!((last.total() - first.total()).abs() < 1e-2 * first.kinetic);
}

#[test]
fn a_moving_rigid_platen_compresses_a_block_and_its_work_is_balanced() {
    let mesh = two([
        (DVec3::new(0.12, 0.12, 0.03), [2, 2, 1], DVec3::new(-0.01, -0.01, 0.1)),
        (DVec3::new(0.1, 0.1, 0.1), [3, 3, 3], DVec3::ZERO),
    ]);
    let mut setup = both(&mesh, [CONCRETE; 2], 0.0);
    setup.bodies[0].rigid = true;
    setup.bodies[1].elastic.viscosity = 1e5;
    let nodes_at = |body: usize, z: f64| -> Vec<u32> {
        let tets = &mesh.mesh.tets[mesh.mesh.bodies[body].tets.clone()];
        let mut nodes: Vec<u32> = tets.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.retain(|n| (mesh.mesh.nodes[*n as usize].z - z).abs() < 1e-9);
        nodes
    };
    // The velocity rises to 0.02 m/s within 0.4 ms and returns to zero.
    let velocity = History::new([(0.0, [0.0]), (4e-4, [-0.02]), (8e-4, [0.0])]).unwrap();
    let top = nodes_at(0, 0.13);
    setup.constraints = vec![
        Constraint { nodes: top, velocity: [Some(0.0.into()), Some(0.0.into()), Some(velocity)] },
        constant_velocity(nodes_at(1, 0.0), [None, None, Some(0.0)]),
    ];
    let mut world = World::new(setup, 0.5);
    let first = world.step_with_energies().unwrap();
    let start = world.rigid_bodies[0].motion;
    let mut residual = 0.0f64;
    while world.time < 1e-3 {
        let energies = world.step_with_energies().unwrap();
        residual = residual.max((energies.total() - first.total()).abs());
    }
    let last = world.step_with_energies().unwrap();
    let motion = world.rigid_bodies[0].motion;
    let displacement = start.centre.z - motion.centre.z;
    // Between smooth platens, the stiffness of a body of cross-section A, length L and modulus E is E A / L. The
    // contact at one end is a spring in series with this stiffness.
    let without_contact = 0.5 * CONCRETE.young_modulus * 0.1 * displacement * displacement;
    println!(
        "displacement {:.3} um, work {:.4} J of {without_contact:.4} J without contact compliance, residual {:.1e}",
        displacement * 1e6,
        last.work,
        residual / last.work
    );
    // The velocities in the middle of the time steps, multiplied by dt, sum to the displacement of the history, 8 um.
    assert!((displacement / 8e-6 - 1.0).abs() < 1e-3 && motion.orientation.angle_between(start.orientation) < 1e-9);
    assert!(last.work > 0.5 * without_contact && last.work < without_contact * 1.01);
    assert!(residual < 1e-3 * last.work);
}
