//! Contact between bodies: impact of bars, friction.

use super::*;
use breakwater::femdem::mesh::Mesh;

/// Creates a mesh of two blocks, each shifted to its position [m].
pub fn two(blocks: [(DVec3, [usize; 3], DVec3); 2]) -> PreparedMesh {
    let mut all = Mesh::default();
    for (number, (lengths, cells, shift)) in blocks.into_iter().enumerate() {
        let mut part = block(lengths, cells, Pattern::Centred);
        let (nodes, tets) = (all.nodes.len(), all.tets.len());
        all.nodes.extend(part.nodes.iter().map(|x| *x + shift));
        all.tets.extend(part.tets.iter().map(|tet| tet.map(|node| node + nodes as u32)));
        all.node_tags.extend(part.node_tags.iter().map(|tag| tag + nodes as u64));
        all.tet_tags.extend(part.tet_tags.iter().map(|tag| tag + tets as u64));
        let mut body = part.bodies.remove(0);
        body.name = format!("block_{number}");
        body.tets = body.tets.start + tets..body.tets.end + tets;
        all.bodies.push(body);
    }
    prepare(all).unwrap()
}

/// Creates a setup of two bodies that do not crack.
pub fn both(mesh: &PreparedMesh, elastic: [Elastic; 2], friction: f64) -> Setup {
    let bodies = mesh.mesh.bodies.iter().zip(elastic).map(|(body, elastic)| Body::at_rest(body.tets.clone(), elastic));
    let mut setup = Setup::of_mesh(mesh, bodies.collect());
    setup.friction = vec![vec![friction; 2]; 2];
    setup
}

/// Returns the mean velocity of a body [m/s].
fn mean_velocity(world: &World, body: usize) -> DVec3 {
    let tets = world.setup().bodies[body].tets.clone();
    let (mut momentum, mut mass) = (DVec3::ZERO, 0.0);
    for n in 0..world.nodes.count() {
        if tets.contains(&(world.nodes.copies_of(n)[0] as usize / 4)) {
            momentum += world.nodes.velocity[n] * world.nodes.mass[n];
            mass += world.nodes.mass[n];
        }
    }
    momentum / mass
}

#[test]
fn two_bars_separate_after_the_wave_returns() {
    // The bars are slender: lateral inertia would spread the wave front in thick bars.
    let (length, side) = (0.5, 0.02);
    let gap = 1e-6;
    let size = DVec3::new(length, side, side);
    let mesh = two([(size, [60, 2, 2], DVec3::ZERO), (size, [60, 2, 2], DVec3::new(length + gap, 0.0, 0.0))]);
    let mut setup = both(&mesh, [CONCRETE; 2], 0.0);
    let speed = 1.0;
    setup.bodies[0].velocity = DVec3::X * 0.5 * speed;
    setup.bodies[1].velocity = DVec3::X * -0.5 * speed;
    let mut world = World::new(setup, 0.8);
    let first = world.step_with_energies().unwrap();
    let momentum = |world: &World| -> f64 {
        (0..world.nodes.count()).map(|n| world.nodes.velocity[n].x * world.nodes.mass[n]).sum()
    };
    let start = momentum(&world);
    let (mut contact_times, mut residual) = (Vec::new(), 0.0f64);
    let (mut before, mut force) = (mean_velocity(&world, 0).x, 0.0f64);
    while world.time < 4.5e-4 {
        let energies = world.step_with_energies().unwrap();
        residual = residual.max((energies.total() - first.total()).abs() / first.kinetic);
        if world.contacts.scalars.touching > 0 {
            contact_times.push(world.time);
        }
        let now = mean_velocity(&world, 0).x;
        force = force.max((before - now) * 2340.0 * length * side * side / world.dt);
        before = now;
    }
    let duration = contact_times[contact_times.len() - 1] - contact_times[0];
    let celerity = bar_celerity();
    // The contact lasts until the compression wave has travelled to the far end of a bar and back.
    let expected = 2.0 * length / celerity;
    // The mean contact stress is the change of momentum of a bar, divided by its cross-section and by the duration of
    // the contact. It therefore does not contain the overshoot of the wave front.
    let mean = 2340.0 * length * 0.5 * speed * 2.0 / duration;
    let stress = 2340.0 * celerity * 0.5 * speed;
    println!(
        "contact {:.1} us ({:.1} expected), mean stress {:.3} MPa ({:.3} expected), largest {:.3} MPa, residual {residual:.1e}, \
         change of momentum {:.1e}",
        duration * 1e6,
        expected * 1e6,
        mean / 1e6,
        stress / 1e6,
        force / (side * side) / 1e6,
        momentum(&world) - start
    );
    let separation_speed = mean_velocity(&world, 1).x - mean_velocity(&world, 0).x;
    println!("relative velocity after separation {separation_speed:.4} m/s");
    // Target: duration of the contact within 2 % of theory.
    assert!((duration / expected - 1.0).abs() < 0.02);
    assert!(residual < 1e-2 && (momentum(&world) - start).abs() < 1e-9);
}

#[test]
fn a_sliding_block_stops_after_the_coulomb_distance() {
    let soft = Elastic { young_modulus: 1e8, density: 2340.0, poisson_ratio: 0.2, viscosity: 2e3 };
    let depth = 5e-7;
    let mesh = two([
        (DVec3::new(0.1, 0.1, 0.05), [2, 2, 1], DVec3::new(0.05, 0.1, -depth)),
        (DVec3::new(0.4, 0.3, 0.05), [5, 4, 1], DVec3::new(0.0, 0.0, -0.05)),
    ]);
    let mut setup = both(&mesh, [soft, soft], 0.6);
    let lower = mesh.mesh.bodies[1].tets.clone();
    let fixed: std::collections::BTreeSet<u32> = mesh.mesh.tets[lower].iter().flatten().copied().collect();
    setup.constraints = vec![constant_velocity(fixed.into_iter().collect(), [Some(0.0); 3])];
    setup.gravity = DVec3::NEG_Z * 9.8;
    setup.bodies[0].velocity = DVec3::X;
    let mut world = World::new(setup, 0.8);
    let first = world.step_with_energies().unwrap();
    let (mut distance, mut rest) = (0.0, 0.0);
    while world.time < 0.22 {
        world.step().unwrap();
        let v = mean_velocity(&world, 0).x;
        distance += v * world.dt;
        if v > 0.0 {
            rest = world.time;
        }
    }
    let last = world.step_with_energies().unwrap();
    // Sliding distance with Coulomb friction: v^2 / (2 mu g), for the initial speed v = 1 m/s.
    let expected = 1.0 / (2.0 * 0.6 * 9.8);
    println!(
        "sliding distance {distance:.5} m ({expected:.5} expected), duration {rest:.4} s ({:.4}), friction {:.5} J of {:.5} J, residual {:.1e}",
        1.0 / (0.6 * 9.8),
        last.friction,
        first.kinetic,
        last.total() - first.total()
    );
    // Target: sliding distance within 1 %.
    assert!((distance / expected - 1.0).abs() < 0.01);
    assert!((last.total() - first.total()).abs() < 0.01 * first.kinetic);
}

/// Returns the speeds [m/s] of a block after 0.05 and 0.1 s on a slope of `degrees`.
fn down_a_slope(degrees: f64) -> [f64; 2] {
    // The viscosity damps oscillations that would separate the bodies: after each separation, the friction springs
    // restart from zero.
    let soft = Elastic { young_modulus: 1e8, density: 2340.0, poisson_ratio: 0.2, viscosity: 1e4 };
    let mesh = two([
        // The initial overlap is about the overlap at rest. With more overlap, the block would jump and lose contact.
        (DVec3::new(0.1, 0.1, 0.05), [2, 2, 1], DVec3::new(0.05, 0.05, -4e-8)),
        (DVec3::new(0.3, 0.2, 0.05), [4, 3, 1], DVec3::new(0.0, 0.0, -0.05)),
    ]);
    let mut setup = both(&mesh, [soft, soft], 0.6);
    let lower = mesh.mesh.bodies[1].tets.clone();
    let fixed: std::collections::BTreeSet<u32> = mesh.mesh.tets[lower].iter().flatten().copied().collect();
    setup.constraints = vec![constant_velocity(fixed.into_iter().collect(), [Some(0.0); 3])];
    let angle = degrees.to_radians();
    setup.gravity = DVec3::new(angle.sin(), 0.0, -angle.cos()) * 9.8;
    let mut world = World::new(setup, 0.8);
    [0.05, 0.1].map(|until| {
        while world.time < until {
            world.step().unwrap();
        }
        mean_velocity(&world, 0).x
    })
}

#[test]
fn a_block_slides_only_on_slopes_steeper_than_the_friction_angle() {
    let [early, late] = down_a_slope(35.0);
    let angle = 35f64.to_radians();
    let expected = 9.8 * (angle.sin() - 0.6 * angle.cos());
    let found = (late - early) / 0.05;
    // The friction angle is arctan 0.6 = 30.96 degrees, so friction holds a block on a slope of 30 degrees.
    let [_, held] = down_a_slope(30.0);
    println!("{found:.4} m/s2 ({expected:.4}); at 30 degrees {held:.1e} m/s after 0.1 s");
    // Target: acceleration within 1 % of theory.
    assert!((found / expected - 1.0).abs() < 0.01);
    // Limit 1e-9 m/s for the speed of the held block: rounding.
    assert!(held.abs() < 1e-9);
}
