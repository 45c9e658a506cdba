//! Rows of Tetrapods: neighbours, images across periodic sides, sliding over a mound.

use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::geometry::profile::Profile;
use breakwater::rigid::{BodyShape, BodyState, Load, RigidSetup, RigidWorld, Sides};
use glam::DVec3;
use std::f64::consts::PI;
use std::time::Instant;

use super::{MASS, MORTAR, ground, run, setup, standing, tetrapod, total_energy};

/// Returns the smallest pitch of a row without overlap [m] by bisection.
fn least_pitch(unit: &ArmourUnit, second_azimuth: f64) -> f64 {
    let touches = |pitch: f64| {
        let bodies = vec![standing(unit, 0.0, 0.0, 0.0), standing(unit, 0.0, pitch, second_azimuth)];
        let world = RigidWorld::new(RigidSetup {
            ground: None,
            ..setup(BodyShape::from_unit(unit, MASS), bodies, MORTAR, 0.3)
        });
        world.map_or(true, |w| w.contact_count() > 0)
    };
    let (mut low, mut high) = (0.03, 0.2);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if touches(middle) { low = middle } else { high = middle }
    }
    high
}

#[test]
fn alternating_neighbours_do_not_overlap_at_the_pitch_of_the_experiment() {
    let unit = tetrapod();
    let [alternating, equal] = [PI, 0.0].map(|azimuth| least_pitch(&unit, azimuth));
    println!("least pitch: alternating {:.2} mm, equal orientation {:.2} mm", alternating * 1e3, equal * 1e3);
    assert!(alternating < 0.08);
    // The gap is between the sharp surfaces of both units: sharp surfaces, not the rounded surfaces, bound the water.
    let second = unit.standing_rotation(PI);
    let gap = unit
        .solid()
        .vertices()
        .iter()
        .map(|v| unit.solid().signed_distance(second.inverse() * (*v - DVec3::Y * 0.08)))
        .fold(f64::MAX, f64::min);
    println!(
        "gap of the sharp surfaces at 80 mm: {:.2} mm; extent in y {:.2} mm",
        gap * 1e3,
        unit.solid().bounds()[1].y * 1e3
    );
    assert!(gap > 0.0);
}

#[test]
fn images_across_periodic_sides_touch_like_neighbours() {
    let unit = tetrapod();
    let run_row = |sides: Sides, shift: f64| {
        let mut bodies = vec![standing(&unit, 0.0, 0.02 + shift, 0.0), standing(&unit, 0.0, 0.14, PI)];
        bodies[0].velocity = DVec3::NEG_Y * 0.3;
        bodies[1].velocity = DVec3::Y * 0.3;
        let mut world =
            RigidWorld::new(RigidSetup { sides, ..setup(BodyShape::from_unit(&unit, MASS), bodies, MORTAR, 0.32) })
                .unwrap();
        run(&mut world, 0.3, 1e-4);
        world.states().to_vec()
    };
    let width = 0.24;
    let (images, plain) = (run_row(Sides::Periodic { width }, 0.0), run_row(Sides::Open, width));
    assert!(images[0].position.y > -0.06, "the units did not meet across the side");
    // Limit 1e-6 m for positions: the shift changes the last bits of y, and the impacts amplify this change.
    assert!((images[0].position + DVec3::Y * width - plain[0].position).length() < 1e-6);
    assert!((images[1].position - plain[1].position).length() < 1e-6);
}

#[test]
fn a_substep_of_a_row_takes_less_than_half_a_millisecond() {
    let unit = tetrapod();
    for count in [2, 15] {
        let row =
            (0..count).map(|i| standing(&unit, 0.0, 0.0495 + 0.0787 * f64::from(i), PI * f64::from(i % 2))).collect();
        let mut world = RigidWorld::new(setup(BodyShape::from_unit(&unit, MASS), row, MORTAR, 0.32)).unwrap();
        let loads = vec![Load { force: DVec3::X * 2.0, torque: DVec3::ZERO }; count as usize];
        let clock = Instant::now();
        for _ in 0..2000 {
            world.advance(1e-4, &loads).unwrap();
        }
        let each = clock.elapsed().as_secs_f64() / world.substeps() as f64;
        println!("{count} units: {:.1} us per substep, {} substeps", each * 1e6, world.substeps());
        // Limit 0.5 ms per substep: half of the target.
        assert!(each < 5e-4);
    }
}

#[test]
fn a_unit_slides_over_the_lee_edge_and_comes_to_rest_below() {
    let unit = tetrapod();
    let profile = Profile::new(vec![[-2.0, 0.0], [-0.4, 0.0], [-0.16, 0.12], [0.16, 0.12], [0.4, 0.0], [2.0, 0.0]]);
    let mut body = standing(&unit, 0.0, 0.0, 0.0);
    body.position.z += 0.12;
    body.velocity = DVec3::X * 1.2;
    let mut s = setup(BodyShape::from_unit(&unit, MASS), vec![body], MORTAR, 0.32);
    s.ground = Some(ground(profile.clone()));
    let mut world = RigidWorld::new(s).unwrap();
    let before = total_energy(&world);
    run(&mut world, 3.0, 1e-4);
    let end = world.states()[0];
    println!(
        "over the edge: {:.4?}, energy residual {:.2e} J, {:?}",
        end.position,
        total_energy(&world) - before,
        world.energy()
    );
    assert!(end.position.x > 0.16 && end.position.z > profile.z(end.position.x));
    assert!(end.velocity.length() < 1e-3);
    // Limit: 1 % of the energy of the fall and the initial velocity, which is 0.6 J.
    assert!((total_energy(&world) - before).abs() < 6e-3);
}

#[test]
fn a_row_slides_over_the_mound_and_its_energy_balance_closes() {
    let unit = tetrapod();
    let profile = Profile::new(vec![[-2.0, 0.0], [-0.4, 0.0], [-0.16, 0.12], [0.16, 0.12], [0.4, 0.0], [2.0, 0.0]]);
    let row: Vec<BodyState> = (0..15)
        .map(|i| {
            let mut body = standing(&unit, 0.0, 0.0495 + 0.0786 * f64::from(i), PI * f64::from(i % 2));
            body.position.z += 0.12;
            body
        })
        .collect();
    let mut s = setup(BodyShape::from_unit(&unit, MASS), row, MORTAR, 0.32);
    s.ground = Some(ground(profile.clone()));
    s.sides = Sides::Walls { width: 1.2 };
    let mut world = RigidWorld::new(s).unwrap();
    let start = total_energy(&world);
    let clock = Instant::now();
    let mut most_contacts = 0;
    for step in 0..20_000 {
        let time = 1e-4 * f64::from(step);
        let force = if time < 0.4 { 3.0 } else { 0.0 };
        let loads: Vec<Load> = (0..15)
            .map(|i| Load { force: DVec3::new(force * (1.0 + 0.02 * f64::from(i)), 0.0, 0.0), torque: DVec3::ZERO })
            .collect();
        world.advance(1e-4, &loads).unwrap();
        most_contacts = most_contacts.max(world.contact_count());
    }
    let fastest = world.states().iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
    println!(
        "row: energy residual {:.1e} J of {:?}, fastest {fastest:.1e} m/s, at most {most_contacts} contacts, {:.1} us per substep, {} substeps",
        total_energy(&world) - start,
        world.energy(),
        clock.elapsed().as_secs_f64() / world.substeps() as f64 * 1e6,
        world.substeps()
    );
    for state in world.states() {
        assert!(state.position.x > 0.16 && state.position.z > profile.z(state.position.x));
        assert!(state.position.y > 0.0 && state.position.y < 1.2);
    }
    // Limit: 1 % of the work of the load.
    assert!((total_energy(&world) - start).abs() < 0.01 * world.energy().load_work);
}
