//! Quarried rock: a random convex polyhedron.
//!
//! A rock is a cube whose 6 faces and 8 corner cuts have random directions and distances, stretched along its axes. All
//! random numbers are equally likely within their limits. The limits give the length-to-thickness ratios of heavy
//! armour stone: EN 13383-1 allows a ratio above 3 for at most 5 % of these stones.

use glam::DVec3;

use crate::geometry::convex::half_space::HalfSpace;
use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};
use crate::random::SplitMix64;

/// Largest deviation of the direction of a face, as a vector added to the unit vector [-].
const TILT: f64 = 0.25;
/// Distances of the faces of the cube from its centre [-].
const FACES: [f64; 2] = [0.85, 1.1];
/// Distances of the corner cuts from the centre of the cube [-]; the corners of the cube are at sqrt(3).
const CUTS: [f64; 2] = [1.15, 1.5];
/// Ratios of the middle to the longest axis, and of the shortest to the middle axis [-].
const STRETCH: [f64; 2] = [0.7, 1.0];

/// Returns a rock of the given volume [m3] about the origin.
///
/// # Errors
/// If the volume is so small or so large that the shape cannot be computed.
pub fn block(volume: f64, random: &mut SplitMix64) -> Result<Polyhedron, PolyhedronError> {
    let mut between = |[low, high]: [f64; 2]| low + (high - low) * random.next_share();
    let middle = between(STRETCH);
    let axes = DVec3::new(1.0, middle, middle * between(STRETCH));
    let signs = [-1.0, 1.0];
    let faces = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| signs.map(|sign| (sign * axis, FACES)));
    let corner = |x: f64| signs.into_iter().flat_map(move |y| signs.map(|z| DVec3::new(x, y, z).normalize()));
    let cuts = signs.into_iter().flat_map(corner).map(|direction| (direction, CUTS));
    let planes: Vec<HalfSpace> = faces
        .chain(cuts)
        .map(|(direction, distances)| {
            let tilt = DVec3::new(between([-TILT, TILT]), between([-TILT, TILT]), between([-TILT, TILT]));
            // A plane n . x = d of the cube becomes the plane (n / axes) . x = d of the stretched cube.
            let normal = (direction + tilt).normalize() / axes;
            HalfSpace { normal: normal.normalize(), offset: between(distances) / normal.length() }
        })
        .collect();
    let rock = Polyhedron::from_planes(&planes, BOUND).ok_or(PolyhedronError::Flat(0))?;
    let scale = (volume / rock.volume()).cbrt();
    Polyhedron::hull(&rock.corners().iter().map(|corner| *corner * scale).collect::<Vec<_>>())
}

/// Half the edge of a cube that contains every rock before it is scaled [-].
const BOUND: f64 = 10.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rocks_have_their_volume_and_the_proportions_of_armour_stone() {
        let mut ratios = Vec::new();
        let mut blockiness = 0.0;
        for seed in 0..200 {
            let rock = block(0.125, &mut SplitMix64::new(seed)).unwrap();
            // Rounding errors of the hull, which merges corners within 1e-5 of its size.
            assert!((rock.volume() / 0.125 - 1.0).abs() < 1e-6, "{}", rock.volume());
            assert!(rock.corners().len() >= 16 && rock.faces().len() >= 9, "{seed}");
            let width =
                |direction: DVec3| rock.support(direction).dot(direction) - rock.support(-direction).dot(direction);
            let widths: Vec<f64> = (0..400)
                .map(|k| {
                    let (z, turn) = (f64::from(k) / 400.0, 2.4 * f64::from(k));
                    width(DVec3::new((1.0 - z * z).sqrt() * turn.cos(), (1.0 - z * z).sqrt() * turn.sin(), z))
                })
                .collect();
            let (thin, long) = widths.iter().fold((f64::MAX, 0.0_f64), |(a, b), w| (a.min(*w), b.max(*w)));
            ratios.push(long / thin);
            blockiness += 0.125 / (width(DVec3::X) * width(DVec3::Y) * width(DVec3::Z)) / 200.0;
        }
        ratios.sort_by(f64::total_cmp);
        println!(
            "length / thickness: median {:.2}, largest {:.2}; blockiness {blockiness:.2}",
            ratios[100], ratios[199]
        );
        // EN 13383-1: at most 5 % of the stones with a ratio above 3.
        assert!(ratios[190] < 3.0);
        // Volume / volume of the box around a rock: a sphere has 0.52, a cube 1.
        assert!((0.4..0.8).contains(&blockiness), "{blockiness}");
    }

    #[test]
    fn the_same_seed_gives_the_same_rock() {
        let rock = |seed| block(1.0, &mut SplitMix64::new(seed)).unwrap();
        assert_eq!(rock(3), rock(3));
        assert_ne!(rock(3), rock(4));
    }
}
