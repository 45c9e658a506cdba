//! Sample tetrahedra for the tests.

use glam::DVec3;

use super::tetrahedron::Tetrahedron;
use crate::random::SplitMix64;

/// Returns a random point in the cube -1..1.
pub fn random_point(random: &mut SplitMix64) -> DVec3 {
    let [x, y, z] = [0; 3].map(|_| 2.0 * random.next_share() - 1.0);
    DVec3::new(x, y, z)
}

/// Returns a regular tetrahedron with a given centroid [m] and edge length [m].
pub fn regular_tetrahedron(centroid: DVec3, edge: f64) -> [DVec3; 4] {
    let corner = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    corner.map(|c| centroid + edge / 8f64.sqrt() * DVec3::from_array(c))
}

/// Returns a random tetrahedron of about the given size [m] around a point [m]. Its smallest height is more than a
/// fifth of this size, so the tetrahedron is not flatter than the tetrahedra of a good mesh.
pub fn random_tetrahedron(random: &mut SplitMix64, about: DVec3, size: f64) -> [DVec3; 4] {
    loop {
        let vertices = [0; 4].map(|_| about + size * random_point(random));
        if Tetrahedron::new(&vertices).is_some_and(|t| least_height(&t) > 0.2 * size) {
            return vertices;
        }
    }
}

/// Returns the smallest height of a tetrahedron [m].
pub fn least_height(tetrahedron: &Tetrahedron) -> f64 {
    tetrahedron.gradients.map(|gradient| 1.0 / gradient.length()).into_iter().fold(f64::INFINITY, f64::min)
}
