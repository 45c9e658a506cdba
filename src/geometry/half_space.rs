//! Half-spaces, and cutting polygons and bodies with their planes.

use glam::DVec3;

/// A half-space: normal . x <= offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Outward unit normal.
    pub normal: DVec3,
    /// Distance of the plane from the origin along the normal [m].
    pub offset: f64,
}

impl HalfSpace {
    /// Through a point [m], with an outward normal of any length.
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        let normal = normal.normalize();
        Self { normal, offset: normal.dot(point) }
    }

    /// Signed distance of a point [m], positive outside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// Faces of the cube of half-edge `half` about the origin.
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

/// Keep what lies behind a plane, and close the cut with a face.
pub(super) fn cut(faces: &mut Vec<(HalfSpace, Vec<DVec3>)>, plane: &HalfSpace, tolerance: f64) {
    let mut rim: Vec<DVec3> = Vec::new();
    for (_, ring) in faces.iter_mut() {
        let [behind, _] = split(ring, plane, tolerance);
        rim.extend(behind.iter().filter(|p| plane.distance(**p).abs() <= tolerance));
        *ring = behind;
    }
    faces.retain(|(_, ring)| ring.len() >= 3);
    // A face that already lies in the plane closes the body.
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

/// The parts of a convex polygon behind and before a plane; points within the tolerance [m] belong to both.
pub(super) fn split(ring: &[DVec3], plane: &HalfSpace, tolerance: f64) -> [Vec<DVec3>; 2] {
    let (mut behind, mut before) = (Vec::new(), Vec::new());
    for (index, &a) in ring.iter().enumerate() {
        let b = ring[(index + 1) % ring.len()];
        let (d_a, d_b) = (plane.distance(a), plane.distance(b));
        if d_a <= tolerance {
            behind.push(a);
        }
        if d_a >= -tolerance {
            before.push(a);
        }
        if (d_a > tolerance && d_b < -tolerance) || (d_a < -tolerance && d_b > tolerance) {
            let crossing = a.lerp(b, d_a / (d_a - d_b));
            behind.push(crossing);
            before.push(crossing);
        }
    }
    let solid = |part: Vec<DVec3>, side: f64| {
        let counts = part.iter().any(|p| plane.distance(*p) * side > tolerance);
        if counts || side < 0.0 && part.len() == ring.len() { part } else { Vec::new() }
    };
    [solid(behind, -1.0), solid(before, 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_is_split_and_what_lies_in_the_plane_counts_behind() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        let plane = HalfSpace::through(DVec3::X * 0.25, DVec3::X * 7.0);
        let [behind, before] = split(&square, &plane, 1e-9);
        assert_eq!((behind.len(), before.len()), (4, 4));
        assert!(behind.iter().all(|p| p.x <= 0.25) && before.iter().all(|p| p.x >= 0.25));
        let [behind, before] = split(&square, &HalfSpace::through(DVec3::ZERO, DVec3::Z), 1e-9);
        assert_eq!((behind.len(), before.len()), (4, 0));
    }
}
