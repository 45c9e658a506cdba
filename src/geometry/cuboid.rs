//! Cuboid: a block with three pairs of plane faces.

use glam::DVec3;

use super::polyhedron::{Polyhedron, PolyhedronError};
use super::section::Section;

/// Corner `number` of a box of half-edges `half` [m] about its centre.
fn corner(half: DVec3, number: usize) -> DVec3 {
    let side = |axis: usize| if number >> axis & 1 == 1 { 1.0 } else { -1.0 };
    half * DVec3::new(side(0), side(1), side(2))
}

/// Surface of a cuboid with the given edges [m], centred at the origin: vertices [m] and triangles.
pub fn surface(edges: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let vertices = (0..8).map(|number| corner(0.5 * edges, number)).collect();
    // Corners of each face, counter-clockwise seen from outside: -x, +x, -y, +y, -z, +z.
    let faces: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    (vertices, triangles)
}

/// Convex polyhedron of a cuboid with the given edges [m], centred at the origin.
///
/// # Errors
/// If an edge is negligible compared with the others.
pub fn block(edges: DVec3) -> Result<Polyhedron, PolyhedronError> {
    Polyhedron::hull(&surface(edges).0)
}

/// Sections through the middle of a cuboid with the given edges [m], normal to each axis, towards both ends.
pub fn sections(edges: DVec3) -> Vec<Section> {
    let across = |axis: usize| [edges[(axis + 1) % 3], edges[(axis + 2) % 3]];
    let sections = |axis: usize| {
        [1.0, -1.0].map(|side| Section::chamfered(DVec3::ZERO, DVec3::AXES[axis] * side, across(axis), 0.0))
    };
    (0..3).flat_map(sections).collect()
}
