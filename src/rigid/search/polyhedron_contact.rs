//! Contact points of two rounded polyhedra.
//!
//! Two polyhedra with parallel faces touch over a contact patch, where a single pair of nearest points is arbitrary.
//! The patch is a polygon. Each corner of the patch is a contact point: it is a corner of one body in front of a face
//! of the other body, or a crossing of two edges. The distance of a corner from the other body is exact and changes
//! smoothly. An edge is assumed to bend inwards near its ends, with the rounding radius as radius of curvature.
//! Therefore the overlap of a crossing decreases smoothly near the end of an edge.

use glam::DVec3;

use super::nearest_points::Placement;
use crate::geometry::convex::polyhedron::{Edge, Face, Polyhedron};
use crate::rigid::contact::WHOLE_PART;

/// Squared sine of the angle below which two edges count as parallel [-] (0.6 degrees). Corners then carry the load.
const PARALLEL: f64 = 1e-4;
/// Tolerance (sine of an angle) of the check that the other edge lies outside both faces of an edge [-].
const OUTSIDE_TOLERANCE: f64 = 0.2;

/// A point where two bodies are near each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearPoint {
    /// Feature number (corner, edge or [`WHOLE_PART`]) on the first and on the second body.
    pub features: [u16; 2],
    /// Nearest points of the first and the second core, world axes [m].
    pub points: [DVec3; 2],
    /// Reduction of the overlap near the ends of crossing edges [m]; 0 at a corner.
    pub overlap_reduction: f64,
}

/// Returns the points where the cores of two polyhedra are nearer than `reach` [m]; `rounding` is the rounding radius
/// [m]. If the two points of an entry are equal, the cores overlap.
pub fn near_points(
    (a, (q_a, x_a)): (&Polyhedron, Placement),
    (b, (q_b, x_b)): (&Polyhedron, Placement),
    rounding: f64,
    reach: f64,
) -> Vec<NearPoint> {
    // Corners of each body in the body axes of the other body.
    let (back_a, back_b) = (q_a.inverse(), q_b.inverse());
    let a_at_b: Vec<DVec3> = a.corners().iter().map(|c| back_b * (q_a * *c + x_a - x_b)).collect();
    let b_at_a: Vec<DVec3> = b.corners().iter().map(|c| back_a * (q_b * *c + x_b - x_a)).collect();
    if are_apart(a, &b_at_a, reach) || are_apart(b, &a_at_b, reach) {
        return Vec::new();
    }
    let (from_a, from_b) = (|p: DVec3| q_a * p + x_a, |p: DVec3| q_b * p + x_b);
    let mut found = Vec::new();
    let mut keep = |near: NearPoint| {
        if near.points[0].distance_squared(near.points[1]) < reach * reach {
            found.push(near);
        }
    };
    let (beyond_b, beyond_a) = (beyond_faces(b, &a_at_b, reach), beyond_faces(a, &b_at_a, reach));
    for (number, corner) in a_at_b.iter().enumerate().filter(|(number, _)| beyond_b[*number] == 0) {
        let points = [from_b(*corner), from_b(b.nearest(*corner))];
        keep(NearPoint { features: [number as u16, WHOLE_PART], points, overlap_reduction: 0.0 });
    }
    for (number, corner) in b_at_a.iter().enumerate().filter(|(number, _)| beyond_a[*number] == 0) {
        let points = [from_a(a.nearest(*corner)), from_a(*corner)];
        keep(NearPoint { features: [WHOLE_PART, number as u16], points, overlap_reduction: 0.0 });
    }
    let relative = back_a * q_b;
    // An edge with both ends beyond the same face is out of reach.
    let can_touch = |edge: &Edge, beyond: &[u64]| edge.ends.iter().fold(u64::MAX, |all, end| all & beyond[*end]) == 0;
    let edges_of_b: Vec<(usize, EdgeAt)> = b
        .edges()
        .iter()
        .enumerate()
        .filter(|(_, edge)| can_touch(edge, &beyond_a))
        .map(|(number, edge)| {
            let at = EdgeAt { ends: edge.ends.map(|c| b_at_a[c]), normals: edge.normals.map(|n| relative * n) };
            (number, at)
        })
        .collect();
    for (i, edge) in a.edges().iter().enumerate().filter(|(_, edge)| can_touch(edge, &beyond_b)) {
        let edge = EdgeAt { ends: edge.ends.map(|c| a.corners()[c]), normals: edge.normals };
        for (j, other) in &edges_of_b {
            if let Some((points, overlap_reduction)) = crossing(&edge, other, rounding, reach) {
                let features = [(a.corners().len() + i) as u16, (b.corners().len() + j) as u16];
                keep(NearPoint { features, points: points.map(from_a), overlap_reduction });
            }
        }
    }
    found
}

/// Returns true if all `corners` of the other body lie more than `reach` [m] in front of one face of `body`.
fn are_apart(body: &Polyhedron, corners: &[DVec3], reach: f64) -> bool {
    body.faces().iter().any(|face| corners.iter().all(|corner| face.plane.distance(*corner) > reach))
}

/// Returns for each of the `corners` of the other body a bit for each of the first 64 faces of `body`: 1 if the corner lies
/// more than `reach` [m] in front of the face.
fn beyond_faces(body: &Polyhedron, corners: &[DVec3], reach: f64) -> Vec<u64> {
    let bit = |corner: &DVec3, face: &Face| u64::from(face.plane.distance(*corner) >= reach);
    let bits = |corner| body.faces().iter().take(64).fold(0, |bits, face| bits << 1 | bit(corner, face));
    corners.iter().map(bits).collect()
}

/// An edge in the axes of the first body: ends [m] and outward normals of its two faces.
struct EdgeAt {
    ends: [DVec3; 2],
    normals: [DVec3; 2],
}

impl EdgeAt {
    /// Returns true if `direction` points out of the body at this edge.
    fn points_out(&self, direction: DVec3) -> bool {
        self.normals.iter().all(|face| face.dot(direction) > -OUTSIDE_TOLERANCE)
    }
}

/// Returns the nearest points of two edges [m], and the reduction of the overlap near their ends [m]. `None` if the
/// edges are parallel, further apart than `reach` [m], do not cross, or if one edge lies inside the other body.
fn crossing(a: &EdgeAt, b: &EdgeAt, rounding: f64, reach: f64) -> Option<([DVec3; 2], f64)> {
    let ([a_0, a_1], [b_0, b_1]) = (a.ends, b.ends);
    let (length_a, length_b) = (a_0.distance(a_1), b_0.distance(b_1));
    let (u, v) = ((a_1 - a_0) / length_a, (b_1 - b_0) / length_b);
    let (between, cosine) = (a_0 - b_0, u.dot(v));
    let sine_squared = 1.0 - cosine * cosine;
    // The triple product is the distance of the two lines times the sine of their angle.
    if sine_squared < PARALLEL || between.dot(u.cross(v)).powi(2) > reach * reach * sine_squared {
        return None;
    }
    let s = (cosine * v.dot(between) - u.dot(between)) / sine_squared;
    let t = (v.dot(between) - cosine * u.dot(between)) / sine_squared;
    let from_ends = [s, length_a - s, t, length_b - t];
    if from_ends.iter().any(|distance| *distance <= 0.0) {
        return None;
    }
    let (on_a, on_b) = (a_0 + s * u, b_0 + t * v);
    let out = (on_b - on_a).normalize_or_zero();
    if !(a.points_out(out) && b.points_out(-out)) {
        return None;
    }
    let reduction = |distance: &f64| (rounding - distance).max(0.0).powi(2) / (2.0 * rounding);
    Some(([on_a, on_b], from_ends.iter().map(reduction).sum()))
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    const ROUNDING: f64 = 0.05;
    /// Feature number of the first edge, after eight corners.
    const FIRST_EDGE: u16 = 8;

    fn cube() -> Polyhedron {
        let side = |number: usize, axis: usize| if number >> axis & 1 == 1 { 0.45 } else { -0.45 };
        let corner = |number: usize| DVec3::new(side(number, 0), side(number, 1), side(number, 2));
        Polyhedron::hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    fn above(x: f64, z: f64, turn: f64) -> Vec<NearPoint> {
        let upper = (DQuat::from_rotation_z(turn), DVec3::new(x, 0.0, z));
        near_points((&cube(), (DQuat::IDENTITY, DVec3::ZERO)), (&cube(), upper), ROUNDING, 0.2)
    }

    #[test]
    fn aligned_boxes_touch_at_the_corners_of_the_contact_patch() {
        let points = above(0.3, 1.0, 0.0);
        // Two corners of each box face the other box; the other corners are 0.3 m away from it. Only edge crossings can
        // have an overlap reduction.
        let bearing = points.iter().filter(|near| near.overlap_reduction == 0.0);
        assert_eq!(bearing.clone().count(), 4);
        for near in bearing {
            assert!((near.points[1] - near.points[0] - DVec3::Z * 0.1).length() < 1e-12);
        }
    }

    #[test]
    fn rotated_boxes_touch_where_their_edges_cross() {
        let points = above(0.0, 1.0, 0.25 * std::f64::consts::PI);
        // The common area of two squares at 45 degrees is an octagon; no corner of one square lies in the other.
        let crossings = points.iter().filter(|near| near.features[0] >= FIRST_EDGE && near.features[0] != WHOLE_PART);
        assert_eq!((crossings.count(), points.len()), (8, 8));
        for near in points {
            assert!(
                (near.points[1] - near.points[0] - DVec3::Z * 0.1).length() < 1e-12 && near.overlap_reduction == 0.0
            );
        }
    }

    #[test]
    fn overlap_of_an_edge_crossing_decreases_near_the_end_of_an_edge() {
        let edge_up = DQuat::from_rotation_x(0.25 * std::f64::consts::PI);
        for shift in [0.0, 0.3, 0.41, 0.4499] {
            let lower = (edge_up, DVec3::ZERO);
            let across = DQuat::from_rotation_z(0.5 * std::f64::consts::PI);
            let upper = (across * edge_up, DVec3::new(shift, 0.0, 0.9 * 2f64.sqrt() + 0.1));
            let points = near_points((&cube(), lower), (&cube(), upper), ROUNDING, 0.15);
            let near =
                points.iter().find(|near| near.features[0] >= FIRST_EDGE && near.features[0] != WHOLE_PART).unwrap();
            let past = (shift - 0.4f64).max(0.0);
            assert!((near.overlap_reduction - past * past / 0.1).abs() < 1e-9, "{shift}: {}", near.overlap_reduction);
        }
    }
}
