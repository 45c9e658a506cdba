//! Cuboid: a block with three pairs of plane faces.

use glam::DVec3;

use super::convex_part::ConvexPart;

/// Largest rounding radius over the shortest edge: beyond half of it nothing is left of the core [-].
pub const LARGEST_ROUNDING: f64 = 0.45;

/// Edges of a box as pairs of its corners; bit k of a corner's number tells the side along axis k.
pub const EDGES: [[usize; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Corner `number` of a box of half-edges `half` [m] about its centre.
pub fn corner(half: DVec3, number: usize) -> DVec3 {
    let side = |axis: usize| if number >> axis & 1 == 1 { 1.0 } else { -1.0 };
    half * DVec3::new(side(0), side(1), side(2))
}

/// Surface of a cuboid with the given edges [m] about its centre: vertices [m] and triangles.
pub fn surface(edges: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let vertices = (0..8).map(|number| corner(0.5 * edges, number)).collect();
    // Corners of each face, counter-clockwise seen from outside: -x, +x, -y, +y, -z, +z.
    let faces: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    (vertices, triangles)
}

/// The convex part of a cuboid: a box smaller by the rounding [m] on every side, and a ball.
pub fn part(edges: DVec3, rounding: f64) -> ConvexPart {
    ConvexPart::block(0.5 * edges - rounding, rounding)
}
