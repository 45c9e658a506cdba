//! Structured tetrahedral meshes of a box, for verification.

use std::collections::HashMap;

use glam::DVec3;

use super::quality::triple_product;
use super::{Body, Mesh, TriangleSet};

/// Division of a cell of the box into tetrahedra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// 6 tetrahedra around a diagonal of the cell (Kuhn 1960). The mesh then has a preferred direction, the diagonal.
    Diagonal,
    /// 24 tetrahedra around the centre of the cell, four at each of its six sides. The mesh has no preferred axis.
    Centred,
}

/// The six sides of a box: name, number of the normal axis, and true for the side that is away from the origin.
const SIDES: [(&str, usize, bool); 6] = [
    ("xmin", 0, false),
    ("xmax", 0, true),
    ("ymin", 1, false),
    ("ymax", 1, true),
    ("zmin", 2, false),
    ("zmax", 2, true),
];

/// Creates the mesh of a box from the origin to `lengths` [m], with `cells` along each axis. It has one body `block`
/// and the sets `xmin`, `xmax`, `ymin`, `ymax`, `zmin`, `zmax`. The tags of nodes and tetrahedra count from one.
///
/// # Panics
/// If a length is not positive or a number of cells is zero.
pub fn block(lengths: DVec3, cells: [usize; 3], pattern: Pattern) -> Mesh {
    assert!(lengths.min_element() > 0.0 && cells.iter().all(|n| *n > 0), "box of {lengths} m with {cells:?} cells");
    let mut lattice = Lattice { lengths, cells, known: HashMap::new(), mesh: Mesh::default() };
    for k in 0..cells[2] {
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                match pattern {
                    Pattern::Diagonal => lattice.cut_along_diagonal([2 * i, 2 * j, 2 * k]),
                    Pattern::Centred => lattice.cut_around_centre([2 * i, 2 * j, 2 * k]),
                }
            }
        }
    }
    let mut mesh = lattice.mesh;
    mesh.node_tags = (1..=mesh.nodes.len() as u64).collect();
    mesh.tet_tags = (1..=mesh.tets.len() as u64).collect();
    mesh.bodies = vec![Body { name: "block".to_owned(), tets: 0..mesh.tets.len() }];
    mesh.sets = SIDES
        .map(|(name, axis, far)| {
            let end = if far { lengths[axis] } else { 0.0 };
            // Exact comparison, because nodes on the sides have exact coordinates.
            TriangleSet { name: name.to_owned(), triangles: mesh.faces_within(|node| node[axis] == end) }
        })
        .to_vec();
    mesh
}

/// Nodes at the corners, side centres and centres of the cells. `known` contains their numbers. Its key is the position
/// of the node, counted in half cells along each axis.
struct Lattice {
    lengths: DVec3,
    cells: [usize; 3],
    known: HashMap<[usize; 3], u32>,
    mesh: Mesh,
}

impl Lattice {
    fn node(&mut self, index: [usize; 3]) -> u32 {
        *self.known.entry(index).or_insert_with(|| {
            let part = |axis: usize| index[axis] as f64 / (2 * self.cells[axis]) as f64;
            self.mesh.nodes.push(self.lengths * DVec3::new(part(0), part(1), part(2)));
            (self.mesh.nodes.len() - 1) as u32
        })
    }

    /// Adds a tetrahedron with nodes at four positions. Exchanges two nodes if its volume would be negative.
    fn add(&mut self, indices: [[usize; 3]; 4]) {
        let mut nodes = indices.map(|index| self.node(index));
        if triple_product(nodes.map(|node| self.mesh.nodes[node as usize])) < 0.0 {
            nodes.swap(2, 3);
        }
        self.mesh.tets.push(nodes);
    }

    /// Adds one tetrahedron for each path along three edges of the cell from `origin`, its first corner, to the
    /// opposite corner.
    fn cut_along_diagonal(&mut self, origin: [usize; 3]) {
        for [first, second] in [[0, 1], [1, 0], [1, 2], [2, 1], [2, 0], [0, 2]] {
            let (mut b, mut c) = (origin, origin);
            b[first] += 2;
            c[first] += 2;
            c[second] += 2;
            self.add([origin, b, c, origin.map(|index| index + 2)]);
        }
    }

    /// Adds one tetrahedron for each edge of each side of the cell. Its corners are the two ends of the edge, the
    /// centre of the side and the centre of the cell.
    fn cut_around_centre(&mut self, origin: [usize; 3]) {
        let centre = origin.map(|index| index + 1);
        for axis in 0..3 {
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            for end in [0, 2] {
                let mut side = centre;
                side[axis] = origin[axis] + end;
                let corner = |[p, q]: [usize; 2]| {
                    let mut corner = side;
                    corner[u] = origin[u] + p;
                    corner[v] = origin[v] + q;
                    corner
                };
                let ring = [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]].map(corner);
                for edge in ring.windows(2) {
                    self.add([edge[0], edge[1], side, centre]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::prepare;
    use super::*;

    #[test]
    fn tetrahedra_fill_the_box_and_its_sides_are_named_sets() {
        let lengths = DVec3::new(0.3, 0.2, 0.5);
        for (pattern, tets, side) in [(Pattern::Diagonal, 6, 2), (Pattern::Centred, 24, 4)] {
            let mesh = block(lengths, [3, 2, 4], pattern);
            assert_eq!(mesh.tets.len(), 24 * tets);
            let prepared = prepare(mesh).unwrap();
            // Tolerance: rounding of the sum.
            assert!((prepared.quality[0].volume / lengths.element_product() - 1.0).abs() < 1e-13);
            let counts: Vec<_> = prepared.faces.boundaries.iter().map(|set| set.faces.len()).collect();
            assert_eq!(counts, [8, 8, 12, 12, 6, 6].map(|cells| cells * side));
            assert_eq!(prepared.faces.exteriors.len(), 52 * side);
        }
    }

    #[test]
    fn the_smallest_angle_between_faces_is_45_degrees() {
        for pattern in [Pattern::Diagonal, Pattern::Centred] {
            let quality = &prepare(block(DVec3::ONE, [1; 3], pattern)).unwrap().quality[0];
            // 45 degrees is the angle between a side of the cell and a plane through two opposite edges. Tolerance:
            // rounding of the arc cosine.
            assert!((quality.angle_min_deg - 45.0).abs() < 1e-12, "{pattern:?}: {}", quality.angle_min_deg);
        }
    }
}
