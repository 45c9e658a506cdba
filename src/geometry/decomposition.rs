//! Convex parts of a body by approximate decomposition (VHACD, Mamou 2016, from the library parry), and their volume
//! error.

use glam::DVec3;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

use super::convex::polyhedron::Polyhedron;
use super::solid::Solid;

/// Number of sample points along the longest edge of the bounding box, for the comparison of parts and body.
const SAMPLES: f64 = 48.0;
/// For each attempt: number of voxels along the longest edge of the bounding box, and largest number of parts.
const ATTEMPTS: [(u32, u32); 3] = [(48, 16), (96, 32), (128, 60)];
/// Volume error below which no further attempt is made [-].
const ACCEPTABLE_ERROR: f64 = 0.02;

/// Convex parts of a body and their volume error.
#[derive(Debug, Clone)]
pub struct Decomposition {
    /// Convex parts [m].
    pub parts: Vec<Polyhedron>,
    /// Volume of the symmetric difference of body and parts, divided by the volume of the body [-].
    pub volume_error: f64,
}

/// Decomposes a body into convex parts; returns the first attempt with a volume error below 2 %, or the best attempt.
pub fn decompose(solid: &Solid) -> Decomposition {
    if let Ok(hull) = Polyhedron::hull(solid.vertices()) {
        let whole = measure(solid, vec![hull]);
        if whole.volume_error < 1e-6 {
            return whole;
        }
    }
    let mut best = Decomposition { parts: Vec::new(), volume_error: f64::INFINITY };
    for (resolution, max_convex_hulls) in ATTEMPTS {
        let parameters = VHACDParameters { concavity: 1e-4, resolution, max_convex_hulls, ..Default::default() };
        let pieces = VHACD::decompose(&parameters, solid.vertices(), solid.triangles(), true);
        let hulls = pieces.compute_exact_convex_hulls(solid.vertices(), solid.triangles());
        let parts = hulls.iter().filter_map(|(points, _)| Polyhedron::hull(points).ok()).collect();
        let found = measure(solid, parts);
        if found.volume_error < best.volume_error {
            best = found;
        }
        if best.volume_error < ACCEPTABLE_ERROR {
            break;
        }
    }
    best
}

/// Computes the volume error of the parts from sample points on a lattice.
pub fn measure(solid: &Solid, parts: Vec<Polyhedron>) -> Decomposition {
    let [low, high] = solid.bounds();
    let step = (high - low).max_element() / SAMPLES;
    let count = ((high - low) / step).ceil().as_uvec3() + 2;
    let (mut inside, mut different) = (0u32, 0u32);
    for i in 0..count.x {
        for j in 0..count.y {
            for k in 0..count.z {
                // Faces often lie at coordinates with few digits. The offset keeps the sample points off the faces.
                let point = low + step * (DVec3::new(i.into(), j.into(), k.into()) - DVec3::new(0.47, 0.53, 0.49));
                let in_body = solid.signed_distance(point) < 0.0;
                let in_parts = parts.iter().any(|part| part.least_distance(point) < 0.0);
                inside += u32::from(in_body);
                different += u32::from(in_body != in_parts);
            }
        }
    }
    Decomposition { parts, volume_error: f64::from(different) / f64::from(inside.max(1)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::armour_unit::ArmourUnit;
    use crate::geometry::armour_unit::{cuboid, dolos};

    #[test]
    fn convex_body_is_a_single_part() {
        let (vertices, triangles) = cuboid::surface(DVec3::new(1.0, 2.0, 3.0));
        let found = decompose(&Solid::new(vertices, triangles).unwrap());
        assert_eq!((found.parts.len(), found.volume_error), (1, 0.0));
    }

    #[test]
    fn exact_parts_have_no_volume_error() {
        let unit = ArmourUnit::dolos(1.0, 0.36, 0.03).unwrap();
        let found = measure(unit.solid(), dolos::blocks(1.0, 0.36).unwrap());
        // The surface is the union of these parts, so only sample points on the surface can count as errors.
        assert!(found.volume_error < 1e-3, "{}", found.volume_error);
        let found = measure(unit.solid(), dolos::blocks(1.0, 0.36).unwrap()[1..].to_vec());
        assert!(found.volume_error > 0.1, "{}", found.volume_error);
    }

    #[test]
    fn dolos_is_decomposed_with_a_bounded_volume_error() {
        let unit = ArmourUnit::dolos(1.0, 0.34, 0.03).unwrap();
        let found = decompose(unit.solid());
        println!("{} parts, volume error {:.2} %", found.parts.len(), 100.0 * found.volume_error);
        assert!(found.parts.len() > 3 && found.volume_error < 0.2);
    }
}
