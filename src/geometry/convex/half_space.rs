//! Half-spaces, and the cutting of polygons and polyhedra by their boundary planes.

use glam::DVec3;

/// A half-space: the points x with normal . x <= offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Outward unit normal.
    pub normal: DVec3,
    /// Distance of the plane from the origin along the normal [m].
    pub offset: f64,
}

impl HalfSpace {
    /// Signed distance of a point [m], positive outside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// Faces of the cube |x|, |y|, |z| <= `half` [m]: plane and corners of each face.
pub(super) fn cube(half: f64) -> Vec<(HalfSpace, Vec<DVec3>)> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let (mut normal, mut u, mut v) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
            normal[axis] = side;
            u[(axis + 1) % 3] = half;
            v[(axis + 2) % 3] = half * side;
            let middle = normal * half;
            faces.push((
                HalfSpace { normal, offset: half },
                vec![middle - u - v, middle + u - v, middle + u + v, middle - u + v],
            ));
        }
    }
    faces
}

/// Keeps the part of a polyhedron behind a plane and closes the cut with a face.
pub(super) fn cut(faces: &mut Vec<(HalfSpace, Vec<DVec3>)>, plane: &HalfSpace, tolerance: f64) {
    let mut rim: Vec<DVec3> = Vec::new();
    for (_, ring) in faces.iter_mut() {
        let [behind, _] = split(ring, plane, tolerance);
        rim.extend(behind.iter().filter(|p| plane.distance(**p).abs() <= tolerance));
        *ring = behind;
    }
    faces.retain(|(_, ring)| ring.len() >= 3);
    // No new face is needed if a face already lies in the plane.
    let closed = |(_, ring): &(HalfSpace, Vec<DVec3>)| ring.iter().all(|p| plane.distance(*p).abs() <= tolerance);
    if faces.iter().any(closed) {
        return;
    }
    let middle = rim.iter().sum::<DVec3>() / rim.len().max(1) as f64;
    let u = plane.normal.any_orthonormal_vector();
    let v = plane.normal.cross(u);
    let angle = |p: &DVec3| (*p - middle).dot(v).atan2((*p - middle).dot(u));
    rim.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    rim.dedup_by(|a, b| a.distance(*b) <= 2.0 * tolerance);
    if rim.len() >= 3 {
        faces.push((*plane, rim));
    }
}

/// Parts of a convex polygon behind and in front of a plane; points within the tolerance [m] belong to both parts.
pub(in crate::geometry) fn split(ring: &[DVec3], plane: &HalfSpace, tolerance: f64) -> [Vec<DVec3>; 2] {
    let (mut behind, mut in_front) = (Vec::new(), Vec::new());
    for (index, &a) in ring.iter().enumerate() {
        let b = ring[(index + 1) % ring.len()];
        let (d_a, d_b) = (plane.distance(a), plane.distance(b));
        if d_a <= tolerance {
            behind.push(a);
        }
        if d_a >= -tolerance {
            in_front.push(a);
        }
        if (d_a > tolerance && d_b < -tolerance) || (d_a < -tolerance && d_b > tolerance) {
            let crossing = a.lerp(b, d_a / (d_a - d_b));
            behind.push(crossing);
            in_front.push(crossing);
        }
    }
    let drop_degenerate = |part: Vec<DVec3>, side: f64| {
        let counts = part.iter().any(|p| plane.distance(*p) * side > tolerance);
        if counts || side < 0.0 && part.len() == ring.len() { part } else { Vec::new() }
    };
    [drop_degenerate(behind, -1.0), drop_degenerate(in_front, 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygon_is_split_and_coplanar_polygon_counts_as_behind() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        let plane = HalfSpace { normal: DVec3::X, offset: 0.25 };
        let [behind, in_front] = split(&square, &plane, 1e-9);
        assert_eq!((behind.len(), in_front.len()), (4, 4));
        assert!(behind.iter().all(|p| p.x <= 0.25) && in_front.iter().all(|p| p.x >= 0.25));
        let [behind, in_front] = split(&square, &HalfSpace { normal: DVec3::Z, offset: 0.0 }, 1e-9);
        assert_eq!((behind.len(), in_front.len()), (4, 0));
    }
}
