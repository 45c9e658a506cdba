//! The stable time step compared with the limit from the largest eigenvalue.

use super::*;

/// Returns the square of the largest angular frequency of a world at rest [1/s2] by power iteration on the forces.
fn largest_frequency_squared(setup: &Setup) -> f64 {
    let mut world = World::new(setup.clone(), 1e-6);
    let start = world.nodes.position.clone();
    let scale = 1e-9;
    let mut u: Vec<DVec3> = (0..start.len())
        .map(|n| DVec3::new((n as f64).sin(), (1.7 * n as f64).cos(), (2.9 * n as f64).sin()))
        .collect();
    let mut largest = 0.0;
    for _ in 0..400 {
        let length = u.iter().map(|v| v.length_squared()).sum::<f64>().sqrt();
        for (n, u) in u.iter().enumerate() {
            world.nodes.position[n] = start[n] + *u * (scale / length);
            world.nodes.velocity[n] = DVec3::ZERO;
        }
        world.step().unwrap();
        u = world.nodes.velocity.iter().map(|v| *v * (-1.0 / (world.dt * scale))).collect();
        largest = u.iter().map(|v| v.length_squared()).sum::<f64>().sqrt();
    }
    largest
}

#[test]
fn stable_time_step_is_below_but_near_the_limit_from_the_largest_eigenvalue() {
    let mesh = mesh(DVec3::new(0.3, 0.2, 0.2), [3, 2, 2]);
    for (name, cohesion) in
        [("plain", None), ("p0 = 10 E", cohesion(10.0, false)), ("p0 = 50 E", cohesion(50.0, false))]
    {
        let mut setup = setup(&mesh, cohesion);
        // Contact forces are switched off.
        setup.bodies[0].contact_penalty = 0.0;
        let exact = 2.0 / largest_frequency_squared(&setup).sqrt();
        let used = World::new(setup, 1.0).dt;
        println!("{name}: time step {used:.3e} s, limit by the eigenvalue {exact:.3e} s, ratio {:.2}", used / exact);
        // The time step never exceeds the limit from the eigenvalue; 0.6 is the reached ratio of time step and limit,
        // rounded down.
        assert!(used <= exact * 1.001 && used > 0.6 * exact);
    }
}
