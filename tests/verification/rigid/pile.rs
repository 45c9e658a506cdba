//! Tetrapods that fall into a pile on a slope of 1:1.5.

use std::time::Instant;

use breakwater::geometry::profile::Profile;
use breakwater::rigid::{BodyShape, BodyState, Load, RigidSetup, RigidWorld, STEPS_PER_PERIOD, Sides};
use glam::{DQuat, DVec3};

use super::{HEIGHT, MASS, MORTAR, ground, setup, tetrapod};

/// Spacing of the initial lattice [m], so wide that Tetrapods of any orientation do not touch.
const SPACING: f64 = 1.36 * HEIGHT;

/// Returns the setup of `count` Tetrapods in various orientations over a slope between walls. Each layer has `along` x
/// `across` units.
pub(super) fn lattice(count: usize, along: usize, across: usize) -> RigidSetup {
    let (length, width) = (SPACING * along as f64, SPACING * across as f64);
    let slope = |x: f64| x.clamp(0.0, length) / 1.5;
    let body = |k: usize| {
        let (column, row, layer) = (k % along, k / along % across, k / (along * across));
        let (x, y) = ((column as f64 + 0.5) * SPACING, (row as f64 + 0.5) * SPACING);
        let z = slope(x) + (layer as f64 + 0.9) * SPACING;
        let t = k as f64;
        BodyState::at_rest(DVec3::new(x, y, z), DQuat::from_euler(glam::EulerRot::XYZ, t, 2.3 * t, 0.7 * t))
    };
    let bodies = (0..count).map(body).collect();
    let profile = Profile::new(vec![[-1.0, 0.0], [0.0, 0.0], [length, length / 1.5], [length + 1.0, length / 1.5]]);
    RigidSetup {
        ground: Some(ground(profile)),
        sides: Sides::Walls { width },
        end_walls: Some([0.0, length]),
        ..setup(BodyShape::from_unit(&tetrapod(), MASS), bodies, MORTAR, 0.65)
    }
}

/// Properties of a pile at rest.
struct Pile {
    contacts: usize,
    /// Deepest overlap divided by the height of a unit [-].
    overlap: f64,
    /// Wall-clock time of a substep [s].
    substep: f64,
}

/// Runs a pile until it is at rest. Fails if the pile still moves after `longest` [s]. For the time `coarse` [s], the
/// substeps are four times as long, as in `breakwater place`.
fn run_to_rest(count: usize, [along, across]: [usize; 2], longest: f64, coarse: f64) -> Pile {
    let mut world = RigidWorld::new(lattice(count, along, across)).unwrap();
    if coarse > 0.0 {
        world.set_steps_per_period(0.25 * STEPS_PER_PERIOD);
    }
    let loads = vec![Load::default(); count];
    let start = world.energy();
    let mechanical = |world: &RigidWorld| {
        let e = world.energy();
        e.kinetic + e.potential + e.elastic
    };
    let (mut before, mut rise) = (mechanical(&world), 0.0f64);
    let clock = Instant::now();
    let mut quiet = 0;
    while quiet < 20 {
        if world.time() >= coarse {
            world.set_steps_per_period(STEPS_PER_PERIOD);
        }
        world.advance(5e-3, &loads).unwrap();
        let now = mechanical(&world);
        rise = rise.max(now - before);
        before = now;
        let e = world.energy();
        let at_rest = e.kinetic < 1e-6 * (start.potential - e.potential);
        quiet = if at_rest { quiet + 1 } else { 0 };
        assert!(world.time() < longest, "still {:.1e} J after {longest} s", e.kinetic);
    }
    let (all, wall, at_rest) = (world.substeps(), clock.elapsed().as_secs_f64(), world.count_at_rest());
    // Units at rest cost almost nothing; the cost of a contact is that between awake units.
    world.set_rest_bound(0.0);
    let clock = Instant::now();
    world.advance(0.02, &loads).unwrap();
    let substep = clock.elapsed().as_secs_f64() / (world.substeps() - all) as f64;
    let e = world.energy();
    println!(
        "{count} units: kinetic energy small after {:.2} s, {all} substeps, {wall:.0} s, {at_rest} of them at rest; kinetic energy over the loss of \
         potential energy {:.1e}; deepest overlap {:.3} % of H; largest rise of energy over the loss of potential \
         energy {:.1e}; {} contacts, {:.0} us per substep, {:.2} us per contact",
        world.time(),
        e.kinetic / (start.potential - e.potential),
        100.0 * world.deepest_overlap() / HEIGHT,
        rise / (start.potential - e.potential),
        world.contact_count(),
        substep * 1e6,
        substep * 1e6 / world.contact_count() as f64
    );
    // Target: rise of mechanical energy below 1e-6 of the initial potential energy.
    assert!(rise < 1e-6 * start.potential);
    Pile { contacts: world.contact_count(), overlap: world.deepest_overlap() / HEIGHT, substep }
}

#[test]
fn forty_tetrapods_come_to_rest_in_a_pile() {
    // Target: overlap below 1 % of the height.
    assert!(run_to_rest(40, [4, 3], 10.0, 0.0).overlap < 0.01);
}

#[test]
#[ignore = "15 minutes on 2 cores: cargo test --release --test verification -- --ignored --nocapture rigid::pile::five"]
fn five_hundred_tetrapods_cost_as_much_per_contact_as_fifteen() {
    let piles = [(15, 3, 2), (100, 6, 4), (500, 10, 8)]
        .map(|(count, along, across)| run_to_rest(count, [along, across], 20.0, 0.0));
    assert!(piles.iter().all(|pile| pile.overlap < 0.01));
    let per_contact = |pile: &Pile| pile.substep / pile.contacts as f64;
    // Target: the cost per contact hardly depends on the number of units. A factor of two is allowed, because part of a
    // substep takes time for each unit, with or without contacts.
    assert!(per_contact(&piles[2]) < 2.0 * per_contact(&piles[0]));
}

#[test]
#[ignore = "7 minutes on 2 cores: cargo test --release --test verification -- --ignored --nocapture rigid::pile::a_thousand"]
fn a_thousand_tetrapods_come_to_rest() {
    // The pile is five layers deep instead of three, and its deepest contact, between two edges, has an overlap of 1.3
    // %.
    assert!(run_to_rest(1000, [16, 12], 20.0, 1.2).overlap < 0.02);
}

#[test]
fn search_effort_per_unit_does_not_grow_with_the_number_of_units() {
    let [small, large] = [(60, 4, 3), (240, 8, 6)].map(|(count, along, across)| {
        let mut world = RigidWorld::new(lattice(count, along, across)).unwrap();
        world.advance(0.2, &vec![Load::default(); count]).unwrap();
        let effort = world.search_size().map(|number| number as f64 / count as f64);
        println!("{count} units: part pairs and contact points per unit: {effort:.2?}");
        effort
    });
    // Both piles have five layers. The smaller pile has fewer pairs per unit, because more of its units are at a wall.
    // 25 % allows for this; the effort of a search among all units would be four times as large.
    assert!((0..2).all(|k| large[k] < 1.25 * small[k]), "{large:?} {small:?}");
}

#[test]
fn remembered_gaps_change_no_result() {
    let [mut world, mut forgetful] = [(); 2].map(|()| RigidWorld::new(lattice(40, 4, 3)).unwrap());
    let loads = vec![Load::default(); 40];
    for _ in 0..1000 {
        // A restored world searches all gaps again.
        let snapshot = forgetful.snapshot();
        forgetful.restore(&snapshot).unwrap();
        for world in [&mut world, &mut forgetful] {
            world.advance(2e-4, &loads).unwrap();
        }
    }
    assert!(world.contact_count() > 40);
    assert_eq!(world.states(), forgetful.states());
}

#[test]
fn a_pile_has_the_same_bits_for_any_number_of_threads() {
    let states_with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = RigidWorld::new(lattice(120, 6, 5)).unwrap();
            world.advance(0.15, &vec![Load::default(); 120]).unwrap();
            world.states().to_vec()
        })
    };
    assert_eq!(states_with(1), states_with(2));
}
