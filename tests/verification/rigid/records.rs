//! Recorded impacts: states before the impact, force histories, impulses.

use std::collections::BTreeMap;

use breakwater::rigid::{BodyShape, BodyState, Load, RecordedContact, RigidWorld, Sides};
use glam::{DQuat, DVec3};

use super::{G, MASS, MORTAR, ball, heap, run, setup, standing, tetrapod};

fn impulse_of(contact: &RecordedContact) -> DVec3 {
    contact.history.samples().iter().map(|sample| sample.impulse).sum()
}

#[test]
fn the_impact_of_a_dropped_ball_records_its_fall_and_its_impulse() {
    let (radius, height, density) = (0.02, 0.01, 2400.0);
    let shape = ball(radius, density);
    let (mass, rotation) = (shape.mass, DQuat::from_rotation_x(1.0));
    let body = BodyState::at_rest(DVec3::new(0.3, 0.0, radius + height), rotation);
    let mut world = RigidWorld::new(setup(shape, vec![body], MORTAR, 0.3)).unwrap();
    // Time steps of different lengths give substeps of different lengths within the impact.
    let steps = [1e-4, 3.3e-4, 7.1e-5];
    let mut events = Vec::new();
    for step in steps.iter().cycle() {
        world.advance(*step, &[Load::default()]).unwrap();
        events = world.take_events();
        if !events.is_empty() {
            break;
        }
    }
    let event = events[0];
    let impacts = world.impacts();
    let [contact] = &impacts[..] else { panic!("{} impacts", impacts.len()) };
    assert_eq!(contact.event, event);
    // Limit 1e-12: rounding; the scheme is exact in free fall, until the impact starts.
    let t = event.start;
    assert!((event.before.velocity - DVec3::NEG_Z * G * t).length() < 1e-12);
    assert!((event.before.position - body.position - DVec3::NEG_Z * (0.5 * G * t * t)).length() < 1e-12);
    assert_eq!(event.before.rotation, rotation.normalize());
    assert!(event.partner_before.is_none() && (event.approach_normal - G * t).abs() < 1e-12);
    assert!((event.approach_energy / (0.5 * mass * (G * t).powi(2)) - 1.0).abs() < 1e-12);
    assert!((DVec3::from_array(event.normal) - DVec3::Z).length() < 1e-12);
    // In body axes, the contact point is below the centre, half the overlap above the lowest point.
    let below = rotation * DVec3::from_array(event.point_in_body);
    assert!((below - DVec3::NEG_Z * radius).length() < 1e-4, "{below}");
    // The impulse is m (v + v'), with the mass m and the speeds v before and v' after the impact, plus the impulse of
    // the weight during the history. Target: relative error below 1e-9.
    let samples = contact.history.samples();
    let [first, last] = [samples.first(), samples.last()].map(Option::unwrap);
    let (begin, ended) = (first.start, last.start + last.duration);
    let after = world.states()[0].velocity.z + G * (world.time() - ended);
    let expected = mass * (after + G * begin + G * (ended - begin));
    assert!((event.impulse[2] / expected - 1.0).abs() < 1e-9, "{} {expected}", event.impulse[2]);
    let sum = impulse_of(contact);
    assert!((sum - DVec3::from_array(event.impulse)).length() < 1e-9 * sum.length());
    // The rebound is the final speed, except for the force in the last substep.
    println!("approach {:.4}, rebound {:.4}, {} samples", event.approach_normal, event.rebound, samples.len());
    assert!((event.rebound - world.states()[0].velocity.z - G * (world.time() - event.end)).abs() < 1e-3 * G * t);
    assert!((DVec3::from_array(event.peak).length() - event.peak_force).abs() < 1e-12);
    let strongest = samples.iter().map(|s| s.force().length()).fold(0.0, f64::max);
    assert!((0.97..=1.0).contains(&(strongest / event.peak_force)));
    assert!(event.start < event.peak_time && event.peak_time < event.end);
}

#[test]
fn impact_partners_are_adjacent_across_a_periodic_side() {
    let width = 1.0;
    let ball_at = |y: f64, v: f64| BodyState {
        velocity: DVec3::Y * v,
        angular_velocity: DVec3::X * v,
        ..BodyState::at_rest(DVec3::Y * y, DQuat::IDENTITY)
    };
    // The balls meet at the periodic side: y = 0 and y = 1 are the same place.
    let bodies = vec![ball_at(0.03, -1.0), ball_at(0.97, 1.0)];
    let mut setup = setup(ball(0.02, 2400.0), bodies, MORTAR, 0.3);
    (setup.ground, setup.sides, setup.gravity) = (None, Sides::Periodic { width }, DVec3::ZERO);
    let mut world = RigidWorld::new(setup).unwrap();
    run(&mut world, 0.03, 1e-4);
    let contact = &world.impacts()[0];
    let event = &contact.event;
    let partner = event.partner_before.unwrap();
    let apart = event.before.position - partner.position;
    // Limit 1e-4 m: at the start of the impact the balls just touch, except for the overlap of the first substep.
    assert!((apart.length() - 0.04).abs() < 1e-4, "{apart}");
    assert!(DVec3::from_array(event.normal).dot(apart.normalize()) > 1.0 - 1e-9);
    assert!((event.before.velocity + partner.velocity).length() < 1e-12 && event.before.velocity.length() == 1.0);
    assert!((event.before.angular_velocity - event.before.velocity.y * DVec3::X).length() < 1e-12);
    assert!((event.approach_normal - 2.0).abs() < 1e-9);
    let change = (world.states()[event.body as usize].velocity - event.before.velocity) * ball(0.02, 2400.0).mass;
    assert!((impulse_of(contact) - change).length() < 1e-9 * change.length());
}

#[test]
fn impulses_of_all_contacts_equal_the_change_of_momentum_of_a_heap() {
    let mut world = RigidWorld::new(heap(&tetrapod())).unwrap();
    let start: Vec<DVec3> = world.states().iter().map(|state| state.velocity).collect();
    let mut impulses = vec![DVec3::ZERO; start.len()];
    let mut strongest: BTreeMap<u32, f64> = BTreeMap::new();
    let (duration, dt) = (0.6, 1e-3);
    run(&mut world, duration, dt);
    let ended = world.take_events();
    for event in ended.iter().chain(world.running_events()) {
        let impulse = DVec3::from_array(event.impulse);
        impulses[event.body as usize] += impulse;
        if let Some(partner) = event.partner_unit() {
            impulses[partner as usize] -= impulse;
        }
        for unit in [Some(event.body), event.partner_unit()].into_iter().flatten() {
            let peak = strongest.entry(unit).or_default();
            *peak = peak.max(event.peak_force);
        }
    }
    for ((now, start), impulse) in world.states().iter().zip(&start).zip(&impulses) {
        let change = MASS * (now.velocity - *start + DVec3::Z * (G * duration));
        // Limit 1e-9: rounding of thousands of substeps.
        assert!((change - *impulse).length() < 1e-9, "{change} {impulse}");
    }
    // The record contains the strongest contact of each unit, with its whole impulse in the history.
    let impacts = world.impacts();
    for (unit, force) in strongest {
        let found = impacts.iter().find(|c| c.event.body == unit || c.event.partner_unit() == Some(unit)).unwrap();
        assert_eq!(found.event.peak_force, force);
    }
    for contact in &impacts {
        assert!(contact.history.samples().len() <= 64);
        assert!((impulse_of(contact) - DVec3::from_array(contact.event.impulse)).length() < 1e-9);
    }
    println!("{} contacts, {} recorded", ended.len(), impacts.len());
}

#[test]
fn a_restored_world_records_the_same_impacts() {
    let mut uninterrupted = RigidWorld::new(heap(&tetrapod())).unwrap();
    run(&mut uninterrupted, 0.3, 1e-3);
    let text = serde_json::to_string(&uninterrupted.snapshot()).unwrap();
    let mut restored = RigidWorld::new(heap(&tetrapod())).unwrap();
    restored.restore(&serde_json::from_str(&text).unwrap()).unwrap();
    for world in [&mut uninterrupted, &mut restored] {
        run(world, 0.3, 1e-3);
    }
    assert!(!uninterrupted.impacts().is_empty());
    assert_eq!(uninterrupted.impacts(), restored.impacts());
}

#[test]
fn a_unit_at_rest_does_not_fill_its_histories() {
    let unit = tetrapod();
    let shape = BodyShape::from_unit(&unit, MASS);
    let at_rest = setup(shape, vec![standing(&unit, 0.0, 0.0, 0.3)], MORTAR, 0.65);
    let mut world = RigidWorld::new(at_rest).unwrap();
    run(&mut world, 2.0, 1e-3);
    let impacts = world.impacts();
    assert_eq!(impacts.len(), 3);
    for contact in impacts {
        let samples = contact.history.samples();
        let last = samples.last().unwrap();
        println!("{} samples, the last one lasts {:.3} s", samples.len(), last.duration);
        assert!(last.duration > 1.0);
    }
}
