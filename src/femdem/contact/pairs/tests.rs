//! Tests of the start of a contact: energy and force of a pair with an initial overlap.

use super::super::samples::regular_tetrahedron;
use super::*;

const PENALTY: f64 = 26e9;
const STILL: [[DVec3; 4]; 2] = [[DVec3::ZERO; 4]; 2];

fn pair(inherited_energy: f64) -> Pair {
    let law = FrictionLaw { stiffness: 1e8, coefficient: 0.0 };
    let (tets, penalty, initial_overlap, stored, dissipated) = ([0, 1], PENALTY, None, 0.0, 0.0);
    Pair { tets, penalty, law, initial_overlap, inherited_energy, spring: None, forces: None, stored, dissipated }
}

/// Returns two overlapping tetrahedra of about 1 cm. `further` [m] is an additional displacement of the second
/// tetrahedron that increases the overlap.
fn corners(further: f64) -> [[DVec3; 4]; 2] {
    let one = regular_tetrahedron(DVec3::ZERO, 0.01);
    let shift = DVec3::new(6e-3, 1e-3, -2e-3) - further * DVec3::X;
    [one, one.map(|vertex| vertex + shift)]
}

/// Force on the second tetrahedron in the direction that separates the pair [N].
fn force_x(pair: &Pair) -> f64 {
    pair.forces.map_or(0.0, |forces| forces[1].iter().sum::<DVec3>().x)
}

#[test]
fn a_new_pair_stores_the_elastic_energy_of_its_broken_joint() {
    for energy in [0.0, 1e-4, 1e-2] {
        let mut pair = pair(energy);
        pair.evaluate(corners(0.0), || STILL);
        // Tolerance: rounding of the energy of the whole overlap, a few joules.
        assert!((pair.stored - energy).abs() < 1e-12 && (pair.inherited_energy - energy).abs() < 1e-12, "{pair:?}");
        assert_eq!(pair.forces.is_some(), energy > 0.0);
    }
    // Here the joint has more energy than the overlap can store. The excess is dissipated.
    let mut excess = pair(1e3);
    excess.evaluate(corners(0.0), || STILL);
    assert!(excess.stored < 1e3 && (excess.inherited_energy - excess.stored).abs() < 1e-12);
    assert_eq!(excess.initial_overlap, Some(0.0));
}

#[test]
fn half_a_time_step_earlier_the_pair_had_the_energy_of_the_joint() {
    let way = 1e-6;
    let moves = [[DVec3::ZERO; 4], [-way * DVec3::X; 4]];
    let mut pair = pair(1e-2);
    pair.evaluate(corners(0.0), || moves);
    // `work` is the work of the current force over half a time step. Tolerance: rounding of the energy of the whole
    // overlap.
    let work = force_x(&pair) * 0.5 * way;
    assert!((pair.stored - work - 1e-2).abs() < 1e-9 && (pair.inherited_energy - 1e-2).abs() < 1e-9, "{pair:?}");
}

#[test]
fn the_force_rises_from_zero_and_is_the_gradient_of_the_energy() {
    let (mut fresh, mut full) = (pair(0.0), pair(0.0));
    fresh.evaluate(corners(0.0), || STILL);
    assert!(fresh.forces.is_none());
    full.initial_overlap = Some(0.0);
    let mut evaluate_at = |further: f64| {
        fresh.evaluate(corners(further), || STILL);
        full.evaluate(corners(further), || STILL);
        (fresh.stored, force_x(&fresh), force_x(&full))
    };
    let (_, small, whole) = evaluate_at(1e-9);
    // The displacement of 1e-9 m is a millionth of the overlap depth of about 1e-3 m. The force is therefore about a
    // millionth of the force of the whole overlap.
    assert!(small > 0.0 && small < 1e-5 * whole, "{small:.3e} of {whole:.3e} N");
    for further in [1e-6, 1e-5, 1e-4] {
        let step = 1e-3 * further;
        let [before, (_, force, _), after] = [further - step, further, further + step].map(&mut evaluate_at);
        let slope = (after.0 - before.0) / (2.0 * step);
        // Tolerance: error of central differences over a thousandth of the displacement.
        assert!((force / slope - 1.0).abs() < 1e-5, "{further}: {force:.6e} {slope:.6e}");
    }
}

#[test]
fn a_pair_that_separates_and_meets_again_equals_a_new_pair() {
    let (mut pair, mut fresh) = (pair(0.0), pair(0.0));
    pair.evaluate(corners(0.0), || STILL);
    assert!(pair.initial_overlap.unwrap() > 0.0);
    pair.evaluate(corners(-0.1), || STILL);
    fresh.evaluate(corners(-0.1), || STILL);
    for pair in [&mut pair, &mut fresh] {
        pair.evaluate(corners(1e-3), || STILL);
    }
    assert!(pair.stored > 0.0);
    assert_eq!(pair, fresh);
}
