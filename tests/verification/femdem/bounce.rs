//! Conservation of energy when a tetrahedron bounces off another tetrahedron, for any contact penalty.

use super::*;
use breakwater::femdem::mesh::{Body as MeshBody, Mesh};

/// Runs the impact of a tetrahedron on a larger tetrahedron, which is fixed if `held` is true. Returns the energy
/// residual, the number of time steps in contact, and the energy lost by friction. Both energies are divided by the
/// initial kinetic energy.
fn bounce(penalty: f64, held: bool, friction: f64) -> (f64, usize, f64) {
    let size = 0.1;
    let mesh = Mesh {
        nodes: [
            // The tip of the upper tetrahedron is above the middle of the top face of the lower tetrahedron.
            [0.03, 0.02, 0.0],
            [0.1, 0.03, 0.08],
            [0.0, 0.1, 0.09],
            [-0.05, -0.03, 0.1],
            [-0.2, -0.2, 0.0],
            [0.3, -0.2, 0.0],
            [0.0, 0.3, 0.0],
            [0.0, 0.0, -0.3],
        ]
        .map(|[x, y, z]: [f64; 3]| {
            DVec3::new(x, y, if z >= 0.0 && x.abs() < 0.11 && y < 0.11 && y > -0.1 { z + 1e-5 } else { z })
        })
        .to_vec(),
        node_tags: (1..=8).collect(),
        tets: vec![[0, 1, 2, 3], [4, 6, 5, 7]],
        tet_tags: vec![1, 2],
        bodies: vec![MeshBody { name: "one".to_owned(), tets: 0..1 }, MeshBody { name: "base".to_owned(), tets: 1..2 }],
        ..Mesh::default()
    };
    let mesh = prepare(mesh).unwrap();
    let mut bodies: Vec<Body> =
        mesh.mesh.bodies.iter().map(|body| Body::at_rest(body.tets.clone(), CONCRETE)).collect();
    bodies.iter_mut().for_each(|body| body.contact_penalty = penalty * CONCRETE.young_modulus);
    bodies[0].velocity = DVec3::new(0.1, 0.0, -1.0);
    bodies[0].angular_velocity = DVec3::new(1.0, -2.0, 3.0);
    let mut setup = Setup::of_mesh(&mesh, bodies);
    setup.friction = vec![vec![friction; 2]; 2];
    if held {
        setup.constraints = vec![constant_velocity(mesh.mesh.tets[1].to_vec(), [Some(0.0); 3])];
    }
    // The time step dt is a hundredth of the longest stable time step, because the time integration conserves the
    // energy of an oscillation of angular frequency omega only up to the share (omega dt)^2 / 8.
    let mut world = World::new(setup, 1e-2);
    let first = world.step_with_energies().unwrap();
    let (mut touched, mut separated) = (0, 0.0);
    let wave_time = size / bar_celerity();
    while separated == 0.0 || world.time < separated + wave_time {
        assert!(world.time < 300.0 * wave_time, "the tetrahedra do not separate");
        world.step().unwrap();
        if world.contacts.scalars.touching > 0 {
            (touched, separated) = (touched + 1, 0.0);
        } else if touched > 0 && separated == 0.0 {
            separated = world.time;
        }
    }
    let last = world.step_with_energies().unwrap();
    let residual = (last.total() - first.total()) / first.kinetic;
    println!(
        "p = {penalty} E, base {}: dt {:.2e} s, {touched} time steps in contact, residual {residual:.1e}, remaining strain energy {:.1e}",
        if held { "held" } else { "free" },
        world.dt,
        last.strain / first.kinetic
    );
    (residual, touched, last.friction / first.kinetic)
}

#[test]
fn a_tetrahedron_bounces_without_loss_for_any_penalty() {
    for penalty in [0.1, 1.0, 10.0] {
        for held in [false, true] {
            let (residual, touched, _) = bounce(penalty, held, 0.0);
            // Target: residual of the energy balance below 1e-6 of the initial kinetic energy.
            assert!(residual.abs() < 1e-6 && touched > 100, "p = {penalty} E: {residual:.1e}");
        }
    }
}
