//! Closed surface of the union of convex polyhedra that overlap or share faces.
//!
//! The part of each face outside all other blocks is kept: the planes of each block split the face, and the piece
//! inside the block is dropped. Where faces of two blocks coincide, only the face of the first block is kept. A corner
//! that lies on the edge of another piece is inserted into this edge, so every edge has exactly two triangles.

use glam::DVec3;

use super::half_space::split;
use super::polyhedron::Polyhedron;

/// Distance below which points coincide with each other or with a plane, relative to the size of the union [-].
const TOLERANCE: f64 = 1e-9;

/// Vertices [m] and triangles, counter-clockwise seen from outside, of the union of `blocks`.
pub fn surface(blocks: &[Polyhedron]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let size = blocks.iter().flat_map(Polyhedron::corners).map(|c| c.abs().max_element()).fold(0.0, f64::max);
    let tolerance = TOLERANCE * size;
    let mut pieces: Vec<Vec<DVec3>> = Vec::new();
    for (number, block) in blocks.iter().enumerate() {
        for face in block.faces() {
            let mut left = vec![face.ring.iter().map(|&c| block.corners()[c]).collect::<Vec<_>>()];
            for (other, cutter) in blocks.iter().enumerate().filter(|(other, _)| *other != number) {
                let keeps_common = number < other;
                left = left
                    .iter()
                    .flat_map(|ring| outside(ring, face.plane.normal, cutter, keeps_common, tolerance))
                    .collect();
            }
            pieces.extend(left);
        }
    }
    triangulate(&pieces, 10.0 * tolerance)
}

/// Parts of a polygon with the given normal that lie outside a block. A part that coincides with a face of the block
/// with the same orientation is kept only if `keeps_common`.
fn outside(ring: &[DVec3], normal: DVec3, block: &Polyhedron, keeps_common: bool, tolerance: f64) -> Vec<Vec<DVec3>> {
    let (mut parts, mut rest, mut common) = (Vec::new(), ring.to_vec(), false);
    for face in block.faces() {
        if ring.iter().all(|p| face.plane.distance(*p).abs() <= tolerance) {
            common = face.plane.normal.dot(normal) > 0.0;
            continue;
        }
        let [behind, before] = split(&rest, &face.plane, tolerance);
        if !before.is_empty() {
            parts.push(before);
        }
        rest = behind;
        if rest.len() < 3 {
            // No part of the polygon lies inside the block, so the whole polygon is kept.
            return vec![ring.to_vec()];
        }
    }
    if common && keeps_common {
        return vec![ring.to_vec()];
    }
    parts
}

/// Merges the corners of polygons and splits the polygons into triangles.
fn triangulate(pieces: &[Vec<DVec3>], tolerance: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut weld = |point: DVec3| {
        vertices.iter().position(|v| v.distance(point) <= tolerance).unwrap_or_else(|| {
            vertices.push(point);
            vertices.len() - 1
        })
    };
    let rings: Vec<Vec<usize>> = pieces.iter().map(|piece| piece.iter().map(|p| weld(*p)).collect()).collect();
    let corners = vertices.clone();
    let mut triangles = Vec::new();
    for ring in rings {
        let whole = with_points_on_edges(&ring, &corners, tolerance);
        if whole.len() < 3 {
            continue;
        }
        if whole.len() == ring.len() {
            triangles.extend(whole[1..].windows(2).map(|pair| [whole[0] as u32, pair[0] as u32, pair[1] as u32]));
        } else {
            // With points on the edges, a triangle fan from a corner would have triangles without area. Therefore the
            // fan starts from the middle.
            vertices.push(ring.iter().map(|&v| corners[v]).sum::<DVec3>() / ring.len() as f64);
            let middle = (vertices.len() - 1) as u32;
            let next = whole.iter().cycle().skip(1);
            triangles.extend(whole.iter().zip(next).map(|(&a, &b)| [middle, a as u32, b as u32]));
        }
    }
    (vertices, triangles)
}

/// Returns the ring with all vertices that lie on its edges inserted.
fn with_points_on_edges(ring: &[usize], vertices: &[DVec3], tolerance: f64) -> Vec<usize> {
    let mut whole: Vec<usize> = Vec::new();
    for (index, &a) in ring.iter().enumerate() {
        let b = ring[(index + 1) % ring.len()];
        if a == b {
            continue;
        }
        whole.push(a);
        let (start, along) = (vertices[a], vertices[b] - vertices[a]);
        let length = along.length();
        let mut between: Vec<(f64, usize)> = Vec::new();
        for (number, point) in vertices.iter().enumerate().filter(|(number, _)| *number != a && *number != b) {
            let s = (*point - start).dot(along) / length;
            if s > tolerance && s < length - tolerance && point.distance(start + along * (s / length)) <= tolerance {
                between.push((s, number));
            }
        }
        between.sort_by(|a, b| a.0.total_cmp(&b.0));
        whole.extend(between.into_iter().map(|(_, number)| number));
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solid::Solid;

    fn block(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
        let corner =
            |n: usize| DVec3::from_array(std::array::from_fn(|k| if n >> k & 1 == 1 { high[k] } else { low[k] }));
        Polyhedron::hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    fn volume(blocks: &[Polyhedron]) -> f64 {
        let (vertices, triangles) = surface(blocks);
        Solid::new(vertices, triangles).unwrap().volume_properties().volume
    }

    #[test]
    fn overlapping_volume_counts_once() {
        // 1e-12 allows for rounding errors, here and below.
        let blocks = [block([0.0; 3], [2.0, 1.0, 1.0]), block([0.5, 0.5, -1.0], [1.5, 3.0, 0.5])];
        assert!((volume(&blocks) - (2.0 + 3.75 - 0.25)).abs() < 1e-12);
        // Three bars cross, so every long face is split.
        let cross = [
            block([-3.0, -1.0, -1.0], [3.0, 1.0, 1.0]),
            block([-1.0, -3.0, -1.0], [1.0, 3.0, 1.0]),
            block([-1.0, -1.0, -3.0], [1.0, 1.0, 3.0]),
        ];
        assert!((volume(&cross) - (3.0 * 24.0 - 2.0 * 8.0)).abs() < 1e-12);
    }

    #[test]
    fn common_faces_are_removed() {
        // The three cases are: two blocks with an equal common face, a smaller block on top, coplanar outer faces.
        let side_by_side = [block([0.0; 3], [1.0; 3]), block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])];
        assert!((volume(&side_by_side) - 2.0).abs() < 1e-12);
        let on_top = [block([0.0; 3], [1.0; 3]), block([0.25, 0.25, 1.0], [0.5, 0.5, 2.0])];
        assert!((volume(&on_top) - 1.0625).abs() < 1e-12);
        let flush = [block([0.0; 3], [2.0, 2.0, 1.0]), block([1.0, 0.5, 0.0], [3.0, 1.5, 1.0])];
        assert!((volume(&flush) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn union_of_rotated_blocks_is_closed() {
        let tilted = |angle: f64| {
            let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, angle, 0.7 * angle, 0.3);
            let points: Vec<DVec3> =
                block([-2.0, -0.5, -0.5], [2.0, 0.5, 0.5]).corners().iter().map(|c| turn * *c).collect();
            Polyhedron::hull(&points).unwrap()
        };
        for angle in [0.0, 0.4, 0.9, 1.3, 2.1] {
            let two = [tilted(angle), tilted(angle + 1.0)];
            let whole = volume(&two);
            // The overlap is the intersection of all half-spaces.
            let planes: Vec<_> = two.iter().flat_map(|b| b.faces().iter().map(|f| f.plane)).collect();
            let overlap = Polyhedron::from_planes(&planes, 10.0).unwrap().volume();
            assert!((whole - (8.0 - overlap)).abs() < 1e-9, "{angle}: {whole} {overlap}");
        }
    }
}
