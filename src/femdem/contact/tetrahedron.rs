//! Shape functions of a linear tetrahedron: the barycentric coordinates of a point.

use glam::{DVec3, DVec4};

/// A tetrahedron in its current position. The order of its vertices (its handedness) does not matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tetrahedron {
    /// Vertices [m].
    pub vertices: [DVec3; 4],
    /// Mean of the vertices [m].
    pub centroid: DVec3,
    /// Volume [m3].
    pub volume: f64,
    /// Gradients of the shape functions, grad N_i [1/m]: normal to the face opposite to vertex i, towards the vertex.
    pub gradients: [DVec3; 4],
}

impl Tetrahedron {
    /// Creates a tetrahedron from four vertices [m]; `None` if it has no volume.
    pub fn new(vertices: &[DVec3; 4]) -> Option<Self> {
        let [a, b, c] = [1, 2, 3].map(|i| vertices[i] - vertices[0]);
        let normals = [b.cross(c), c.cross(a), a.cross(b)];
        let six_volumes = a.dot(normals[0]);
        // The volume is NaN if a coordinate of a vertex is NaN.
        if six_volumes.is_nan() || six_volumes == 0.0 {
            return None;
        }
        let [g_1, g_2, g_3] = normals.map(|normal| normal / six_volumes);
        Some(Self {
            vertices: *vertices,
            centroid: 0.25 * (vertices[0] + vertices[1] + vertices[2] + vertices[3]),
            volume: six_volumes.abs() / 6.0,
            gradients: [-(g_1 + g_2 + g_3), g_1, g_2, g_3],
        })
    }

    /// Returns the shape functions N_i at a point [-]. All of them are positive inside the tetrahedron.
    pub fn shape_functions(&self, point: DVec3) -> DVec4 {
        let from_centroid = point - self.centroid;
        let [n_0, n_1, n_2, n_3] = self.gradients.map(|gradient| 0.25 + gradient.dot(from_centroid));
        DVec4::new(n_0, n_1, n_2, n_3)
    }

    /// Returns the weighted sum of the vertices [m].
    pub fn weighted(&self, weights: DVec4) -> DVec3 {
        let [a, b, c, d] = self.vertices;
        weights.x * a + weights.y * b + weights.z * c + weights.w * d
    }

    /// Returns the outward area vector of the face opposite to vertex i, S_i = -3 V grad N_i [m2].
    pub fn area_vector(&self, i: usize) -> DVec3 {
        -3.0 * self.volume * self.gradients[i]
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::random_tetrahedron;
    use super::*;
    use crate::random::SplitMix64;

    #[test]
    fn shape_functions_are_one_at_their_vertex_and_reproduce_points() {
        let mut random = SplitMix64::new(3);
        for _ in 0..1000 {
            let vertices = random_tetrahedron(&mut random, DVec3::ZERO, 1.0);
            let tetrahedron = Tetrahedron::new(&vertices).unwrap();
            for (i, vertex) in vertices.iter().enumerate() {
                // Tolerance: rounding, amplified by the flattest tetrahedra of the samples.
                assert!((tetrahedron.shape_functions(*vertex) - DVec4::AXES[i]).abs().max_element() < 1e-12);
            }
            let point = DVec3::new(random.next_share(), random.next_share(), random.next_share());
            assert!((tetrahedron.weighted(tetrahedron.shape_functions(point)) - point).length() < 1e-12);
            let closed: DVec3 = (0..4).map(|i| tetrahedron.area_vector(i)).sum();
            assert!(closed.length() < 1e-12);
        }
    }

    #[test]
    fn area_vectors_point_outwards_for_both_orders_of_the_vertices() {
        let corner = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        for order in [[0, 1, 2, 3], [0, 2, 1, 3]] {
            let tetrahedron = Tetrahedron::new(&order.map(|i| corner[i])).unwrap();
            assert!((tetrahedron.area_vector(3) + 0.5 * DVec3::Z).length() < 1e-15);
            assert!((tetrahedron.volume - 1.0 / 6.0).abs() < 1e-15);
        }
        assert!(Tetrahedron::new(&[DVec3::ZERO; 4]).is_none());
    }
}
