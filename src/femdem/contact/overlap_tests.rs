//! Tests of the overlap energy and its gradient.

use glam::{DVec3, DVec4};

use super::overlap::{Overlap, overlap};
use super::samples::{random_point, random_tetrahedron, regular_tetrahedron};
use super::tetrahedron::Tetrahedron;
use crate::random::SplitMix64;

type Pair = [[DVec3; 4]; 2];

/// Returns random overlapping pairs, from a very small overlap to one tetrahedron inside the other. The size of T is
/// 1 m, the size of C is 0.1 to 2.1 m.
fn random_pairs(seed: u64, count: usize) -> Vec<(Pair, Overlap)> {
    let mut random = SplitMix64::new(seed);
    let mut pairs = Vec::new();
    while pairs.len() < count {
        let size = 0.1 + 2.0 * random.next_share();
        let about = random_point(&mut random);
        let t = random_tetrahedron(&mut random, DVec3::ZERO, 1.0);
        let c = random_tetrahedron(&mut random, about, size);
        if let Some(found) = overlap(&t, &c) {
            pairs.push(([t, c], found));
        }
    }
    pairs
}

fn energy([t, c]: Pair) -> f64 {
    overlap(&t, &c).map_or(0.0, |found| found.energy)
}

fn largest_force(found: &Overlap) -> f64 {
    found.forces.iter().flatten().map(|force| force.length()).fold(0.0, f64::max)
}

/// Positions and forces of all vertices.
fn loads(pair: &Pair, found: &Overlap) -> Vec<(DVec3, DVec3)> {
    pair.iter().flatten().copied().zip(found.forces.iter().flatten().copied()).collect()
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy() {
    for (pair, found) in random_pairs(11, 4000) {
        for (body, vertex, axis) in (0..24).map(|n| (n / 12, n / 3 % 4, n % 3)) {
            let error = |step: f64| {
                let energy_at = |shift: f64| {
                    let mut moved = pair;
                    moved[body][vertex][axis] += shift;
                    energy(moved)
                };
                ((energy_at(step) - energy_at(-step)) / (2.0 * step) + found.forces[body][vertex][axis]).abs()
            };
            // Tolerance 5e-17: rounding of the energy (1e-24 for an overlap 1e-4 m deep), divided by twice the smallest
            // increment of a coordinate. The best increment depends on the overlap depth and on jumps of the second
            // derivative of the energy, so one of six increments must give the force.
            let allowed = 1e-6 * largest_force(&found) + 5e-17;
            assert!([1e-4, 1e-5, 1e-6, 1e-7, 1e-3, 1e-8].into_iter().any(|step| error(step) < allowed), "{pair:?}");
        }
    }
}

#[test]
fn forces_have_no_resultant_and_no_moment() {
    for (pair, found) in random_pairs(12, 4000) {
        let loads = loads(&pair, &found);
        // Tolerance: rounding of the forces and of the areas from which they are computed. Positions are up to 3 m
        // away.
        let allowed = 1e-13 * largest_force(&found) + 1e-17;
        assert!(loads.iter().map(|(_, f)| f).sum::<DVec3>().length() < allowed);
        assert!(loads.iter().map(|(x, f)| x.cross(*f)).sum::<DVec3>().length() < 20.0 * allowed);
    }
}

#[test]
fn the_contact_point_is_inside_both_tetrahedra() {
    for ([t, c], found) in random_pairs(13, 4000) {
        for tetrahedron in [t, c] {
            let shares = Tetrahedron::new(&tetrahedron).unwrap().shape_functions(found.centre);
            assert!(shares.min_element() > -1e-12, "{shares}");
        }
    }
}

#[test]
fn energy_is_invariant_under_rigid_motion_exchange_and_renumbering() {
    let mut random = SplitMix64::new(14);
    for (pair, found) in random_pairs(14, 2000) {
        let (turn, shift) = (random.next_rotation(), random_point(&mut random));
        let [t, c] = pair.map(|vertices| vertices.map(|vertex| turn * vertex + shift));
        // Tolerance 1e-15: rounding of volumes of order 0.1.
        let same = |other: f64| (other - found.energy).abs() < 1e-12 * found.energy + 1e-15;
        assert!(same(energy([t, c])) && same(energy([c, t])));
        let turned = overlap(&t, &c).unwrap();
        for ((_, now), (_, before)) in loads(&pair, &turned).iter().zip(loads(&pair, &found)) {
            assert!((*now - turn * before).length() < 1e-11 * largest_force(&found) + 1e-15);
        }
        for order in [[1, 0, 2, 3], [2, 3, 0, 1], [3, 0, 1, 2]] {
            assert!(same(energy([order.map(|i| t[i]), c])) && same(energy([t, order.map(|i| c[i])])));
        }
    }
}

#[test]
fn overlap_energy_of_identical_tetrahedra_is_half_their_volume() {
    let mut random = SplitMix64::new(15);
    for _ in 0..100 {
        let t = random_tetrahedron(&mut random, DVec3::ZERO, 1.0);
        let volume = Tetrahedron::new(&t).unwrap().volume;
        let found = overlap(&t, &t).unwrap();
        // The mean of each potential is 1/4, and there are two potentials. Tolerance: only rounding.
        assert!((found.energy - 0.5 * volume).abs() < 1e-15);
        assert!((found.centre - t.iter().sum::<DVec3>() / 4.0).length() < 1e-15);
    }
}

#[test]
fn overlap_energy_of_a_small_tetrahedron_inside_another_follows_the_potential_at_its_centroid() {
    let mut random = SplitMix64::new(16);
    for _ in 0..1000 {
        let t = random_tetrahedron(&mut random, DVec3::ZERO, 1.0);
        let outer = Tetrahedron::new(&t).unwrap();
        // At the point `about`, barycentric coordinate j of the large tetrahedron is 0.1 and the others are 0.3. The
        // part where coordinate j is least is wide enough for the small tetrahedron there.
        let j = (4.0 * random.next_share()) as usize;
        let about = outer.weighted(DVec4::splat(0.3) - 0.2 * DVec4::AXES[j]);
        let c = random_tetrahedron(&mut random, about, 0.01);
        let inner = Tetrahedron::new(&c).unwrap();
        let potential = 4.0 * outer.shape_functions(inner.centroid).min_element();
        assert!((energy([t, c]) / (inner.volume * (potential + 0.25)) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn separate_or_touching_tetrahedra_have_no_overlap() {
    let t = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let below = [DVec3::ZERO, DVec3::X, DVec3::Y, -DVec3::Z];
    assert_eq!(overlap(&t, &below), None);
    // First, the two tetrahedra touch: a corner on a face, an edge on an edge, a corner on a corner. Then they are
    // apart, first with and then without intersecting boxes. Last, one tetrahedron has no volume.
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    assert_eq!(overlap(&t, &[corner(0.2, 0.2, 0.0), corner(0.0, 0.2, -1.0), corner(0.5, 0.2, -1.0), -DVec3::Z]), None);
    assert_eq!(overlap(&t, &[DVec3::ZERO, DVec3::X, -DVec3::Y, -DVec3::Z]), None);
    assert_eq!(overlap(&t, &t.map(|vertex| -vertex)), None);
    assert_eq!(overlap(&t, &t.map(|vertex| 1.1 - vertex)), None);
    assert_eq!(overlap(&t, &t.map(|vertex| 9.0 + vertex)), None);
    assert_eq!(overlap(&t, &[DVec3::ZERO; 4]), None);
}

#[test]
fn faces_that_coincide_to_rounding_give_no_spurious_overlap() {
    let mut random = SplitMix64::new(17);
    for _ in 0..2000 {
        let t = random_tetrahedron(&mut random, DVec3::ZERO, 1.0);
        let [a, b, c, d] = t;
        // `neighbour` lies on the other side of the face (a, b, c) of T, `upper` on the side of T. Both have this face.
        let mirrored = d - 2.0 * (d - a).project_onto((b - a).cross(c - a));
        let noise = |v: DVec3, random: &mut SplitMix64| v + 2e-16 * random_point(random);
        let neighbour = [a, b, c, mirrored].map(|v| noise(v, &mut random));
        if let Some(found) = overlap(&t, &neighbour) {
            assert!(found.energy < 1e-30 && largest_force(&found) < 1e-14);
        }
        let upper = [a, b, c, d.lerp(mirrored, -0.3)];
        let (exact, noisy) = (energy([t, upper]), energy([t, upper.map(|v| noise(v, &mut random))]));
        assert!((exact - noisy).abs() < 1e-14, "{exact} {noisy}");
    }
}

#[test]
fn energy_of_a_tip_in_a_face_grows_with_the_fourth_power_of_the_depth() {
    let base = [[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, -9.0]].map(DVec3::from_array);
    let tip = |depth: f64| {
        let c = [[0.0, 0.0, 0.0], [0.5, 0.1, 0.8], [-0.3, 0.4, 0.9], [-0.1, -0.5, 0.7]].map(DVec3::from_array);
        overlap(&base, &c.map(|vertex| vertex + DVec3::new(0.2, -1.0, -depth))).unwrap()
    };
    let (energy, force) = (tip(1e-2).energy / 1e-8, tip(1e-2).resultant() / 1e-6);
    for depth in [1e-3, 1e-4, 1e-5, 1e-6] {
        let found = tip(depth);
        // The depth is a difference of positions of up to 18 m, rounded to about 1e-15 m. This limits the accuracy of
        // the force. The energy is a difference of terms that are larger than the energy by a further factor 1 / depth.
        let allowed = 1e-14 / depth;
        assert!((found.energy / depth.powi(4) / energy - 1.0).abs() < allowed / depth, "{depth} {}", found.energy);
        assert!((found.resultant() / depth.powi(3) - force).length() < allowed * force.length());
    }
}

#[test]
fn contact_of_two_meshed_cubes_does_not_depend_on_the_numbering() {
    // A cube consists of six tetrahedra around its diagonal (Kuhn 1960), one for each order of the three axes.
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let cube = |shift: DVec3| {
        orders.map(|order| {
            let mut corner = shift;
            let path = order.map(|axis| {
                corner[axis] += 1.0;
                corner
            });
            [shift, path[0], path[1], path[2]]
        })
    };
    let total = |lower: &[[DVec3; 4]], upper: &[[DVec3; 4]]| {
        let all = lower.iter().flat_map(|t| upper.iter().filter_map(|c| overlap(t, c)));
        all.fold((0.0, DVec3::ZERO), |(energy, force), o| (energy + o.energy, force + o.resultant()))
    };
    let depth = 1e-3;
    let (lower, upper) = (cube(DVec3::ZERO), cube((1.0 - depth) * DVec3::Z));
    let (energy, force) = total(&lower, &upper);
    let mut renumbered = upper.map(|[a, b, c, d]| [d, b, a, c]);
    renumbered.reverse();
    let (energy_again, force_again) = total(&lower, &renumbered);
    let (energy_back, force_back) = total(&renumbered, &lower);
    // Tolerance: rounding, of the order of 1e-15 / depth^2 = 1e-9 for the energies.
    assert!((energy_again / energy - 1.0).abs() < 1e-9 && (energy_back / energy - 1.0).abs() < 1e-9);
    assert!((force_again - force).length() < 1e-14 && (force_back + force).length() < 1e-14);
    // Two of the six tetrahedra of each cube have a face in the contact plane. Their potential rises from 0 at this
    // face to 1 over a quarter of their height of 1 m, so its mean over the overlap is 4 depth / 2. The volume of the
    // overlap is `depth` times 1 m2, so both cubes together have the energy 4 depth^2. The tolerance is proportional to
    // the depth: where another face is nearer than the contact plane, the potential is lower.
    assert!((energy / (4.0 * depth * depth) - 1.0).abs() < 5.0 * depth, "{energy}");
    // The force on the upper cube points upwards. The sides of the cubes are aligned, so there is almost no lateral
    // force.
    assert!(force.z > 0.0 && force.truncate().length() < 5.0 * depth * force.z, "{force}");
}

#[test]
fn a_bouncing_tetrahedron_conserves_energy_for_any_penalty() {
    // A tetrahedron moves at 1 m/s, without gravity, onto a fixed tetrahedron with edges of about 10 m. The edges of
    // the moving tetrahedron are springs of 1 m length, with a mass of 1 kg at each vertex.
    let base = [[-5.0, -3.0, 0.0], [5.0, -3.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, -8.0]].map(DVec3::from_array);
    let edges = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let (stiffness, step) = (5e3, 5e-6);
    let turn = SplitMix64::new(18).next_rotation();
    for penalty in [1e3, 1e4, 1e5] {
        let mut x = regular_tetrahedron(DVec3::ZERO, 1.0).map(|vertex| turn * vertex + 0.65 * DVec3::Z);
        let mut v = [-DVec3::Z; 4];
        let (mut touched, mut worst, mut contact_most) = (false, 0.0f64, 0.0f64);
        loop {
            let found = overlap(&base, &x);
            let mut force = found.map_or([DVec3::ZERO; 4], |found| found.forces[1].map(|f| penalty * f));
            let mut stored = found.map_or(0.0, |found| penalty * found.energy);
            contact_most = contact_most.max(stored);
            for [i, j] in edges {
                let along = x[j] - x[i];
                let extension = along.length() - 1.0;
                let pull = stiffness * extension * along.normalize();
                force[i] += pull;
                force[j] -= pull;
                stored += 0.5 * stiffness * extension * extension;
            }
            // The energy needs the velocity at the time of the positions `x`, half a time step after `v`.
            let kinetic: f64 = (0..4).map(|i| 0.5 * (v[i] + 0.5 * step * force[i]).length_squared()).sum();
            worst = worst.max((kinetic + stored - 2.0).abs() / 2.0);
            if touched && found.is_none() && x.iter().all(|vertex| vertex.z > 0.05) {
                break;
            }
            touched |= found.is_some();
            for i in 0..4 {
                v[i] += step * force[i];
                x[i] += step * v[i];
            }
        }
        assert!(contact_most > 0.1 && worst < 1e-6, "{penalty}: {worst:e}");
    }
}

#[test]
fn the_stiffness_of_a_flush_pair_equals_the_formula() {
    let t = regular_tetrahedron(DVec3::ZERO, 1.0);
    let height = (2.0f64 / 3.0).sqrt();
    let normal = -t[3].normalize();
    let mirrored = t[3] + 2.0 * height * normal;
    // In the eigenvector of the largest stiffness, the three vertices of each of the two faces move along the normal,
    // each by 1 / sqrt(6).
    let resultant = |depth: f64| {
        let c = [t[0], t[1], t[2], mirrored].map(|vertex| vertex - depth * normal);
        let found = overlap(&t, &c).unwrap();
        found.forces[1][..3].iter().map(|force| force.dot(normal)).sum::<f64>()
    };
    let (depth, change) = (1e-4, 1e-6);
    let stiffness = (resultant(depth + change) - resultant(depth - change)) / (2.0 * change) * 2.0 / 3.0;
    let area = 0.75f64.sqrt() / 2.0;
    // The tolerance is proportional to the depth: near the edges of the face, the stiffness is lower.
    assert!((stiffness * height / (16.0 / 3.0 * area) - 1.0).abs() < 30.0 * depth, "{stiffness}");
}
