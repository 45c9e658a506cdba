//! The cut plane of a fracture run: a plane through the undeformed bodies that deforms with the bodies.

use glam::DVec3;

use crate::case::Plane;
use crate::femdem::element::{self, Moduli};
use crate::femdem::principal_stresses::principal_stresses;
use crate::femdem::setup::Setup;
use crate::femdem::world::World;
use crate::output::{FieldKind, FieldValues, OutputError, PolyDataSeries};

/// Point fields of the cut plane file.
pub const SECTION_FIELDS: [(&str, FieldKind); 4] = [
    ("velocity", FieldKind::Vector),
    ("sigma_1", FieldKind::Scalar),
    ("sigma_1_minus_sigma_3", FieldKind::Scalar),
    ("body", FieldKind::Integer),
];

/// A point on an edge of a tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
struct EdgePoint {
    /// Vertices at the two ends of the edge, numbered from 0 to 3 in the tetrahedron.
    ends: [u8; 2],
    /// Position between the two vertices: 0 at the first, 1 at the second.
    share: f64,
}

/// Triangles of the intersection of the cut plane with the tetrahedra, each with the index of its tetrahedron.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    triangles: Vec<(u32, [EdgePoint; 3])>,
}

impl Section {
    /// Cuts the undeformed bodies. The corners of a triangle are in anticlockwise order for a viewer towards whom the
    /// normal of the plane points.
    pub fn new(setup: &Setup, plane: &Plane) -> Self {
        let mut triangles = Vec::new();
        for (number, tet) in setup.tets.iter().enumerate() {
            let corners = tet.map(|node| setup.nodes[node as usize]);
            let height = corners.map(|corner| plane.height(corner));
            let (above, below): (Vec<u8>, Vec<u8>) = (0..4).partition(|k| height[usize::from(*k)] >= 0.0);
            let cut = |a: u8, b: u8| {
                let [h_a, h_b] = [a, b].map(|k| height[usize::from(k)]);
                EdgePoint { ends: [a, b], share: h_a / (h_a - h_b) }
            };
            let polygon = match (above.as_slice(), below.as_slice()) {
                ([one], [a, b, c]) | ([a, b, c], [one]) => vec![cut(*one, *a), cut(*one, *b), cut(*one, *c)],
                ([a, b], [c, d]) => vec![cut(*a, *c), cut(*a, *d), cut(*b, *d), cut(*b, *c)],
                _ => continue,
            };
            for k in 2..polygon.len() {
                let mut triangle = [polygon[0], polygon[k - 1], polygon[k]];
                let [a, b, c] = triangle.map(|point| point.value(corners));
                let normal = (b - a).cross(c - a);
                if normal.dot(plane.normal) < 0.0 {
                    triangle.swap(1, 2);
                }
                // If the plane contains an edge of the tetrahedron, triangles can have zero area: omit these.
                if normal.length() > 1e-9 * (corners[1] - corners[0]).length_squared() {
                    triangles.push((number as u32, triangle));
                }
            }
        }
        Self { triangles }
    }

    /// Appends the current state of the cut plane to the file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record(&self, world: &World, series: &mut PolyDataSeries) -> Result<(), OutputError> {
        let single = |v: DVec3| v.as_vec3().to_array();
        let (mut points, mut velocity, mut first, mut difference, mut body) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (tet, triangle) in &self.triangles {
            let nodes = world.tets.nodes[*tet as usize].map(|node| node as usize);
            let (places, velocities) = (nodes.map(|n| world.nodes.position[n]), nodes.map(|n| world.nodes.velocity[n]));
            let number = world.tets.body[*tet as usize];
            let moduli = Moduli::from(&world.setup().bodies[usize::from(number)].elastic);
            let stress = element::stress(&world.tets.shape[*tet as usize], &moduli, &places);
            let [sigma_1, _, sigma_3] = principal_stresses(stress);
            for point in triangle {
                points.push(single(point.value(places)));
                velocity.push(single(point.value(velocities)));
                first.push(sigma_1 as f32);
                difference.push((sigma_1 - sigma_3) as f32);
                body.push(i32::from(number));
            }
        }
        let corners: Vec<[u32; 3]> = (0..points.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let values = [
            FieldValues::Vector(&velocity),
            FieldValues::Scalar(&first),
            FieldValues::Scalar(&difference),
            FieldValues::Integer(&body),
        ];
        series.append(world.time, &points, &corners, &values)
    }
}

impl EdgePoint {
    /// Interpolates a field from its values at the vertices.
    fn value(&self, at_vertices: [DVec3; 4]) -> DVec3 {
        let [a, b] = self.ends.map(|k| at_vertices[usize::from(k)]);
        a.lerp(b, self.share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::femdem::material::Elastic;
    use crate::femdem::mesh::block::{Pattern, block};
    use crate::femdem::mesh::prepare;
    use crate::femdem::setup::Body;

    /// Returns the area of the cut through a box [m2]; checks that all triangles face in the direction of the normal.
    fn area(plane: Plane) -> f64 {
        let mesh = prepare(block(DVec3::new(0.4, 0.3, 0.2), [4, 3, 2], Pattern::Diagonal)).unwrap();
        let elastic = Elastic { density: 2340.0, young_modulus: 26e9, poisson_ratio: 0.2, viscosity: 0.0 };
        let setup = Setup::of_mesh(&mesh, vec![Body::at_rest(0..mesh.mesh.tets.len(), elastic)]);
        let section = Section::new(&setup, &plane);
        let triangle_area = |(tet, triangle): &(u32, [EdgePoint; 3])| {
            let corners = setup.tets[*tet as usize].map(|node| setup.nodes[node as usize]);
            let [a, b, c] = triangle.map(|point| point.value(corners));
            0.5 * (b - a).cross(c - a).dot(plane.normal)
        };
        section.triangles.iter().map(triangle_area).inspect(|area| assert!(*area > 0.0)).sum()
    }

    #[test]
    fn cut_has_the_cross_section_area_of_the_body() {
        let through = |point: [f64; 3], normal: DVec3| {
            area(Plane { point: DVec3::from_array(point), normal: normal.normalize() })
        };
        // The limit 1e-12 allows only rounding errors. The plane y = 0.1 m contains faces of tetrahedra; only the
        // tetrahedra on one side of it are cut.
        assert!((through([0.0, 0.13, 0.0], DVec3::Y) - 0.08).abs() < 1e-12);
        assert!((through([0.0, 0.1, 0.0], DVec3::Y) - 0.08).abs() < 1e-12);
        // This plane contains the diagonal of the box in x and z.
        assert!((through([0.2, 0.0, 0.1], DVec3::new(1.0, 0.0, -2.0)) - 0.3 * 0.2f64.hypot(0.4)).abs() < 1e-12);
        assert_eq!(through([0.0, 0.0, 0.7], DVec3::Z), 0.0);
    }
}
