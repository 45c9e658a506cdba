//! Loads (traction, pressure, force and moment about a point) and the work of these loads.

use super::*;
use breakwater::femdem::loads::patch::{Axes, Patch, faces_near};
use breakwater::femdem::loads::{CornerForce, Load, Surface};
use breakwater::femdem::mesh::faces::Exterior;
use glam::{DMat3, DQuat, EulerRot};

fn side(mesh: &PreparedMesh, name: &str) -> Vec<Exterior> {
    let set = mesh.faces.boundaries.iter().find(|set| set.name == name).unwrap();
    set.faces.iter().map(|face| mesh.faces.exteriors[*face as usize]).collect()
}

fn ramp(until: f64) -> History<1> {
    History::new([(0.0, [0.0]), (until, [1.0])]).unwrap()
}

/// Returns the sums of forces [N] and of their moments about a point [N m].
fn resultant(world: &World, forces: &[CornerForce], about: DVec3) -> [DVec3; 2] {
    let mut sum = [DVec3::ZERO; 2];
    for CornerForce { tet, corner, force } in forces {
        let node = world.tets.nodes[*tet as usize][usize::from(*corner)] as usize;
        sum = [sum[0] + *force, sum[1] + (world.nodes.position[node] - about).cross(*force)];
    }
    sum
}

#[test]
fn a_bar_under_traction_stretches_by_hooke_and_its_energy_balance_closes() {
    let (length, stress) = (0.5, 1e6);
    let mesh = mesh(DVec3::new(length, 0.05, 0.05), [10, 1, 1]);
    let nodes_at = |axis: usize| -> Vec<u32> {
        (0..mesh.mesh.nodes.len() as u32).filter(|n| mesh.mesh.nodes[*n as usize][axis] == 0.0).collect()
    };
    let end: Vec<usize> = (0..mesh.mesh.nodes.len()).filter(|n| mesh.mesh.nodes[*n].x == length).collect();
    let mut setup = setup(&mesh, None);
    setup.bodies[0].elastic.viscosity = 1e5;
    setup.constraints = vec![constant_velocity(nodes_at(0), [Some(0.0), None, None])];
    // The load rises during ten periods; in one period, a wave travels along the bar and back.
    let time = 20.0 * length / bar_celerity();
    setup.loads = vec![Load::Traction { faces: side(&mesh, "xmax"), stress: DVec3::X * stress, factor: ramp(time) }];
    let mut world = World::new(setup, 0.5);
    let first = world.step_with_energies().unwrap();
    while world.time < 1.5 * time {
        world.step().unwrap();
    }
    let last = world.step_with_energies().unwrap();
    let stretch = end.iter().map(|n| world.nodes.position[*n].x - length).sum::<f64>() / end.len() as f64
        * CONCRETE.young_modulus
        / (stress * length);
    // A load that rises slowly stores an energy of half the force times the displacement.
    let expected = 0.5 * stress * stress / CONCRETE.young_modulus * length * 0.0025;
    println!(
        "stretch {stretch:.6} of Hooke's law; work without losses {:.6} of the stored energy, residual {:.1e}",
        (last.work - last.viscous) / expected,
        (last.total() - first.total()) / last.work
    );
    // Limit 2e-3 for stretch and work: the load rises in a finite time, so a small oscillation remains.
    assert!((stretch - 1.0).abs() < 2e-3 && ((last.work - last.viscous) / expected - 1.0).abs() < 2e-3);
    // Target: residual of the energy balance below 1 % of the work. The limit is only 1e-6, because the error of the
    // oscillating part is of second order in the time step, here half of the longest stable time step.
    assert!((last.total() - first.total()).abs() < 1e-6 * last.work);
}

#[test]
fn pressure_on_all_sides_compresses_by_the_bulk_modulus() {
    let mesh = mesh(DVec3::new(0.1, 0.08, 0.06), [3, 2, 2]);
    let mut setup = setup(&mesh, None);
    setup.bodies[0].elastic.viscosity = 1e5;
    let pressure = 1e7;
    let time = 1e-3;
    setup.loads = vec![Load::Pressure {
        faces: mesh.faces.exteriors.clone(),
        pressure,
        on: Surface::Deformed,
        factor: ramp(time),
    }];
    setup.bodies[0].angular_velocity = DVec3::new(30.0, 50.0, -20.0);
    let mut world = World::new(setup, 0.5);
    let first = world.step_with_energies().unwrap();
    while world.time < 1.2 * time {
        world.step().unwrap();
    }
    let last = world.step_with_energies().unwrap();
    let volume: f64 = (0..mesh.mesh.tets.len())
        .map(|t| {
            let [a, b, c, d] = world.tets.nodes[t].map(|n| world.nodes.position[n as usize]);
            (b - a).cross(c - a).dot(d - a) / 6.0
        })
        .sum();
    let bulk = CONCRETE.young_modulus / (3.0 * (1.0 - 2.0 * CONCRETE.poisson_ratio));
    let strain = 1.0 - volume / (0.1 * 0.08 * 0.06);
    println!(
        "strain {:.6} of p / K, residual {:.1e} of the work",
        strain * bulk / pressure,
        (last.total() - first.total()) / last.work
    );
    // Limit 2e-3: the strain p / K (pressure over bulk modulus) is 7e-4, so it is not infinitely small.
    assert!((strain * bulk / pressure - 1.0).abs() < 2e-3);
    assert!((last.total() - first.total()).abs() < 1e-4 * last.work);
    // Limit 1e-12: rounding; a pressure on a closed surface has no resultant in any deformation.
    let mut forces = Vec::new();
    world.setup().loads[0].forces(&world.configuration(), world.time, &mut forces);
    let [force, moment] = resultant(&world, &forces, DVec3::ZERO);
    let scale = pressure * 0.01;
    assert!(force.length() < 1e-12 * scale && moment.length() < 1e-12 * scale);
}

/// Creates a block of concrete with a load about a point.
fn loaded_block(place: DVec3, radius: f64, axes: Axes, rows: History<6>) -> World {
    let mesh = mesh(DVec3::new(0.3, 0.2, 0.1), [6, 4, 2]);
    let patch_faces = faces_near(&mesh, 0, place, radius);
    let mut setup = setup(&mesh, None);
    setup.loads = vec![Load::Patch(Patch::new(&mesh, &patch_faces.faces, place, axes, rows))];
    World::new(setup, 0.5)
}

#[test]
fn a_load_about_a_point_has_the_given_force_and_moment() {
    let given = [3e3, -2e3, 5e3, 40.0, -10.0, 25.0];
    let rotation = DQuat::from_euler(EulerRot::XYZ, 0.7, -1.4, 2.1);
    let strain = DMat3::from_cols_array(&[2e-3, 1e-3, -4e-4, 7e-4, -1e-3, 3e-4, 5e-4, -2e-4, 1.5e-3]);
    let places = [
        (DVec3::new(0.121, 0.083, 0.1), 0.0),
        (DVec3::new(0.121, 0.083, 0.1), 0.06),
        // A point outside the body, as recorded contact points may be; a point at an edge; a point inside the body.
        (DVec3::new(0.301, 0.1, 0.05), 0.03),
        (DVec3::new(0.0, 0.0, 0.05), 0.05),
        (DVec3::new(0.15, 0.1, 0.05), 1.0),
    ];
    for (place, radius) in places {
        for axes in [Axes::Space, Axes::Body] {
            for moment in [0.0, 1.0] {
                let [x, y, z, p, q, r] = given;
                let rows = History::constant([x, y, z, moment * p, moment * q, moment * r]);
                let mut world = loaded_block(place, radius, axes, rows);
                let map = |x: DVec3| rotation * (x + strain * x) + DVec3::new(1.0, -2.0, 0.5);
                displace(&mut world, |x| map(x) - x);
                let Load::Patch(patch) = &world.setup().loads[0] else { panic!() };
                // The point moves with the body. Limit 1e-13 m: rounding of some hundred terms.
                assert!((patch.position(&world.configuration()) - map(place)).length() < 1e-13);
                let mut forces = Vec::new();
                world.setup().loads[0].forces(&world.configuration(), 0.0, &mut forces);
                let [force, about] = resultant(&world, &forces, map(place));
                let expected = [0, 3].map(|k| DVec3::from_slice(&given[k..k + 3]) * if k == 3 { moment } else { 1.0 });
                let expected = match axes {
                    Axes::Space => expected,
                    // The rotation of the body axes comes from a polar decomposition, and the strain changes it
                    // slightly.
                    Axes::Body => patch.prescribed(&world.configuration(), 0.0),
                };
                // Limit 1e-12: rounding.
                assert!((force - expected[0]).length() < 1e-12 * expected[0].length(), "{place} {radius}");
                assert!((about - expected[1]).length() < 1e-12 * expected[0].length(), "{place} {radius}");
                if axes == Axes::Body {
                    let [along, _] = patch.prescribed(&world.configuration(), 0.0);
                    assert!((along - rotation * DVec3::new(x, y, z)).length() < 2e-3 * along.length());
                }
            }
        }
    }
}

#[test]
fn a_recorded_load_gives_its_momentum_and_its_work() {
    let place = DVec3::new(0.25, 0.15, 0.1);
    let rows = [(0.0, 0.0), (2e-4, 1.0), (3e-4, -0.5), (6e-4, 0.0)];
    let direction = [2e4, 1e4, -4e4, 0.0, 300.0, 0.0];
    let history = || History::new(rows.map(|(t, factor)| (t, direction.map(|f| f * factor)))).unwrap();
    for rigid in [false, true] {
        let mesh = mesh(DVec3::new(0.3, 0.2, 0.1), [6, 4, 2]);
        let patch_faces = faces_near(&mesh, 0, place, 0.04);
        let mut setup = setup(&mesh, None);
        setup.bodies[0].rigid = rigid;
        setup.loads = vec![Load::Patch(Patch::new(&mesh, &patch_faces.faces, place, Axes::Space, history()))];
        let mut world = World::new(setup, 0.5);
        if rigid {
            world.dt = 1e-6;
        }
        let first = world.step_with_energies().unwrap();
        let momentum = |world: &World| -> [DVec3; 2] {
            if let Some(body) = world.rigid_bodies.first() {
                let p = body.motion.velocity * (2340.0 * 0.006);
                return [p, body.motion.centre.cross(p) + body.motion.angular_momentum];
            }
            let mut sum = [DVec3::ZERO; 2];
            for n in 0..world.nodes.count() {
                let (x, p) = (world.nodes.position[n], world.nodes.velocity[n] * world.nodes.mass[n]);
                sum = [sum[0] + p, sum[1] + x.cross(p)];
            }
            sum
        };
        let (mut impulse, mut expected_angular) = (history().at(0.0), DVec3::ZERO);
        impulse = impulse.map(|f| f * world.dt);
        while world.time < 7e-4 {
            let Load::Patch(patch) = &world.setup().loads[0] else { panic!() };
            let [force, moment] = patch.prescribed(&world.configuration(), world.time);
            expected_angular += (patch.position(&world.configuration()).cross(force) + moment) * world.dt;
            impulse.iter_mut().zip(history().at(world.time)).for_each(|(sum, f)| *sum += f * world.dt);
            world.step().unwrap();
        }
        let last = world.step_with_energies().unwrap();
        let [linear, angular] = momentum(&world);
        println!(
            "rigid {rigid}: momentum {linear}, angular {angular} ({expected_angular} expected); work {:.6} J, residual {:.1e}",
            last.work,
            (last.total() - first.total()) / last.work
        );
        // Limit 1e-10: rounding.
        let expected = DVec3::from_slice(&impulse[..3]);
        assert!((linear - expected).length() < 1e-10 * expected.length());
        assert!((angular - expected_angular).length() < 1e-10 * expected_angular.length());
        // Limit 1e-3 for the energy residual: the error of the oscillating part is of second order in the time step.
        assert!((last.total() - first.total()).abs() < 1e-3 * last.work);
    }
}
