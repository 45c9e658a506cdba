//! Convex polyhedra, created from planes or as convex hulls; nearest points, support points, shrinking for rounding.
//!
//! A polyhedron is cut from a large cube, plane by plane. Armour units with plane faces are unions of convex polyhedra
//! ([`super::union`]). For contact, each polyhedron is shrunk and rounded ([`super::convex_part`]).

use glam::DVec3;
use parry3d_f64::transformation::try_convex_hull;
use thiserror::Error;

use super::half_space::{HalfSpace, cube, cut};

/// Reason why points have no usable convex hull.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PolyhedronError {
    /// The points are coplanar, collinear, coincident or not finite.
    #[error("{0} points do not span a convex body: they are fewer than 4, lie in one plane or are not finite")]
    Flat(usize),
    /// The convex hull has too many faces.
    #[error("the convex hull has more than {MAX_FACES} faces: use a coarser surface")]
    TooManyFaces,
}

/// Largest number of faces of a hull. The contact search allows about the same number of corners plus edges. The cost
/// of the search grows with the square of this number.
const MAX_FACES: usize = 1000;

/// Distance below which a corner lies in a plane, relative to the size of the polyhedron [-].
const SAME: f64 = 1e-9;

/// Distance below which two corners are merged, relative to the size of the polyhedron [-]. At a corner of more than
/// three faces, the single-precision coordinates of an STL file give several points.
const SAME_CORNER: f64 = 1e-5;

/// A plane face.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Plane of the face.
    pub plane: HalfSpace,
    /// Indices of the corners, counter-clockwise seen from outside.
    pub ring: Vec<usize>,
}

/// An edge between two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Indices of the two corners.
    pub ends: [usize; 2],
    /// Outward normals of the two faces.
    pub normals: [DVec3; 2],
}

/// A bounded convex polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    corners: Vec<DVec3>,
    faces: Vec<Face>,
    edges: Vec<Edge>,
    centre: DVec3,
    radius: f64,
}

impl Polyhedron {
    /// Intersection of the half-spaces with the cube |x|, |y|, |z| <= `bound` [m]; `None` if it is empty or flat.
    pub fn from_planes(planes: &[HalfSpace], bound: f64) -> Option<Self> {
        let mut faces = cube(bound);
        for plane in planes {
            cut(&mut faces, plane, SAME * bound);
        }
        Self::weld(faces)
    }

    /// Convex hull of points [m].
    ///
    /// # Errors
    /// If the points do not span a body, or the hull has too many faces.
    pub fn hull(points: &[DVec3]) -> Result<Self, PolyhedronError> {
        let flat = || PolyhedronError::Flat(points.len());
        if points.len() < 4 || points.iter().any(|p| !p.is_finite()) {
            return Err(flat());
        }
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let size = points.iter().map(|p| (*p - middle).abs().max_element()).fold(0.0, f64::max);
        if size.is_nan() || size <= 0.0 {
            return Err(flat());
        }
        // The tolerances of the hull need points that are centred and scaled to size 1.
        let scaled: Vec<DVec3> = points.iter().map(|p| (*p - middle) / size).collect();
        let (corners, triangles) = try_convex_hull(&scaled).map_err(|_| flat())?;
        let mut planes: Vec<HalfSpace> = Vec::new();
        for [a, b, c] in triangles.iter().map(|t| t.map(|v| corners[v as usize])) {
            let normal = (b - a).cross(c - a);
            if normal.length() > SAME {
                let normal = normal.normalize();
                // With this offset all points lie behind the plane, despite rounding errors.
                let offset = scaled.iter().map(|p| normal.dot(*p)).fold(f64::MIN, f64::max);
                let plane = HalfSpace { normal, offset };
                if !planes.iter().any(|p| same_plane(p, &plane)) {
                    planes.push(plane);
                }
                if planes.len() > MAX_FACES {
                    return Err(PolyhedronError::TooManyFaces);
                }
            }
        }
        let body = Self::from_planes(&planes, 2.0).ok_or_else(flat)?;
        let corners = body.corners.iter().map(|c| *c * size + middle).collect();
        let planes = body.faces.into_iter().map(|face| Face {
            plane: HalfSpace {
                normal: face.plane.normal,
                offset: face.plane.offset * size + face.plane.normal.dot(middle),
            },
            ring: face.ring,
        });
        Ok(Self::with_edges(corners, planes.collect()))
    }

    /// Convex hull of two polygons in space.
    ///
    /// # Errors
    /// If the polygons do not span a body.
    pub fn hull_of_polygons(lower: &[DVec3], upper: &[DVec3]) -> Result<Self, PolyhedronError> {
        let points: Vec<DVec3> = lower.iter().chain(upper).copied().collect();
        Self::hull(&points)
    }

    /// Merges nearly equal corners of different faces; `None` if fewer than four faces remain.
    fn weld(faces: Vec<(HalfSpace, Vec<DVec3>)>) -> Option<Self> {
        let extent = faces.iter().flat_map(|(_, ring)| ring).map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let mut corners: Vec<DVec3> = Vec::new();
        let mut welded = Vec::new();
        for (plane, ring) in faces {
            let mut indices: Vec<usize> = Vec::new();
            for point in ring {
                let near = |c: &DVec3| c.distance(point) < SAME_CORNER * extent;
                let index = corners.iter().position(near).unwrap_or_else(|| {
                    corners.push(point);
                    corners.len() - 1
                });
                if indices.last() != Some(&index) && indices.first() != Some(&index) {
                    indices.push(index);
                }
            }
            if indices.len() >= 3 {
                welded.push(Face { plane, ring: indices });
            }
        }
        (welded.len() >= 4).then(|| Self::with_edges(corners, welded))
    }

    fn with_edges(corners: Vec<DVec3>, faces: Vec<Face>) -> Self {
        let mut edges: Vec<Edge> = Vec::new();
        for (number, face) in faces.iter().enumerate() {
            for (a, b) in pairs_around(&face.ring) {
                let has_reverse_edge = |f: &&Face| pairs_around(&f.ring).any(|pair| pair == (b, a));
                if let Some(other) = faces[number + 1..].iter().find(has_reverse_edge) {
                    edges.push(Edge { ends: [a, b], normals: [face.plane.normal, other.plane.normal] });
                }
            }
        }
        let [low, high] = corners.iter().fold([DVec3::MAX, DVec3::MIN], |[l, h], c| [l.min(*c), h.max(*c)]);
        let centre = 0.5 * (low + high);
        let radius = corners.iter().map(|c| c.distance(centre)).fold(0.0, f64::max);
        Self { corners, faces, edges, centre, radius }
    }

    /// Corners [m].
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Faces.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Centre and radius of a bounding sphere [m].
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        (self.centre, self.radius)
    }

    /// Support point: the corner furthest in `direction` [m].
    pub fn support(&self, direction: DVec3) -> DVec3 {
        let further = |best: DVec3, c: &DVec3| if c.dot(direction) > best.dot(direction) { *c } else { best };
        self.corners.iter().fold(self.corners[0], further)
    }

    /// Nearest point of the polyhedron to `point` [m]; `point` itself if it lies inside.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        let mut best = (f64::MAX, point);
        for face in self.faces.iter().filter(|face| face.plane.distance(point) > 0.0) {
            let on_face = self.nearest_on(face, point);
            let distance = on_face.distance_squared(point);
            if distance < best.0 {
                best = (distance, on_face);
            }
        }
        best.1
    }

    /// Nearest point of a face to a point in front of the face.
    fn nearest_on(&self, face: &Face, point: DVec3) -> DVec3 {
        let foot = point - face.plane.normal * face.plane.distance(point);
        let mut best = (f64::MAX, foot);
        let mut inside = true;
        for (a, b) in pairs_around(&face.ring) {
            let (a, b) = (self.corners[a], self.corners[b]);
            let along = b - a;
            if face.plane.normal.cross(along).dot(foot - a) >= 0.0 {
                continue;
            }
            inside = false;
            let on_edge = a + along * ((foot - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let distance = on_edge.distance_squared(foot);
            if distance < best.0 {
                best = (distance, on_edge);
            }
        }
        if inside { foot } else { best.1 }
    }

    /// Volume [m3].
    pub fn volume(&self) -> f64 {
        let fan = |face: &Face| {
            let a = self.corners[face.ring[0]] - self.centre;
            let triangle = |pair: &[usize]| {
                a.dot((self.corners[pair[0]] - self.centre).cross(self.corners[pair[1]] - self.centre)) / 6.0
            };
            face.ring[1..].windows(2).map(triangle).sum::<f64>()
        };
        self.faces.iter().map(fan).sum()
    }

    /// Returns the polyhedron with every face moved inwards by `distance` [m]; `None` if nothing is left.
    pub fn shrunk(&self, distance: f64) -> Option<Self> {
        let inwards = |face: &Face| {
            let offset = face.plane.offset - face.plane.normal.dot(self.centre) - distance;
            HalfSpace { normal: face.plane.normal, offset }
        };
        let planes: Vec<HalfSpace> = self.faces.iter().map(inwards).collect();
        Some(Self::from_planes(&planes, 2.0 * self.radius)?.translated(self.centre))
    }

    /// Radius of the largest ball inside [m].
    pub fn inner_radius(&self) -> f64 {
        let (mut low, mut high) = (0.0, self.radius);
        // 20 bisections resolve 1e-6 of the bounding radius.
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            if self.shrunk(middle).is_some() {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Returns the polyhedron moved by `shift` [m].
    pub fn translated(&self, shift: DVec3) -> Self {
        let corners = self.corners.iter().map(|c| *c + shift).collect();
        let moved = |face: &Face| {
            let offset = face.plane.offset + face.plane.normal.dot(shift);
            Face { plane: HalfSpace { offset, ..face.plane }, ring: face.ring.clone() }
        };
        Self::with_edges(corners, self.faces.iter().map(moved).collect())
    }
}

/// Consecutive pairs of indices of a closed ring.
fn pairs_around(ring: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// Returns true if two planes of a body of size 1 differ only by rounding errors.
fn same_plane(a: &HalfSpace, b: &HalfSpace) -> bool {
    // 1e-6 allows for the single-precision coordinates of an STL file.
    a.normal.distance_squared(b.normal) < 1e-12 && (a.offset - b.offset).abs() < 1e-6
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_cube() -> Polyhedron {
        let corner = |n: usize| DVec3::new((n & 1) as f64, (n >> 1 & 1) as f64, (n >> 2 & 1) as f64);
        Polyhedron::hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn hull_of_eight_corners_is_a_cube() {
        let cube = unit_cube();
        assert_eq!((cube.corners().len(), cube.faces().len(), cube.edges().len()), (8, 6, 12));
        // The tolerances in these tests allow only for rounding errors.
        assert!((cube.volume() - 1.0).abs() < 1e-12);
        assert_eq!(cube.support(DVec3::new(1.0, -1.0, 2.0)).round(), DVec3::new(1.0, 0.0, 1.0));
    }

    #[test]
    fn hull_ignores_interior_and_duplicate_points() {
        let mut points = unit_cube().corners().to_vec();
        points.extend([DVec3::splat(0.3), DVec3::new(0.5, 0.5, 1.0), points[3], points[3] + 1e-12]);
        let hull = Polyhedron::hull(&points).unwrap();
        assert_eq!((hull.corners().len(), hull.faces().len(), hull.edges().len()), (8, 6, 12));
    }

    #[test]
    fn flat_point_sets_are_rejected() {
        assert!(Polyhedron::hull(&[DVec3::ZERO; 9]).is_err());
        assert!(Polyhedron::hull(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y]).is_err());
        assert!(Polyhedron::hull(&[DVec3::NAN; 4]).is_err());
    }

    #[test]
    fn hulls_with_too_many_faces_are_rejected() {
        let point = |k: u32| {
            let (a, b) = (2.4 * f64::from(k), (1.0 - 2.0 * (f64::from(k) + 0.5) / 20_000.0).acos());
            DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos())
        };
        let ball: Vec<DVec3> = (0..20_000).map(point).collect();
        assert_eq!(Polyhedron::hull(&ball), Err(PolyhedronError::TooManyFaces));
    }

    #[test]
    fn frustum_has_its_volume_and_shrinks_with_parallel_faces() {
        let square = |half: f64, z: f64| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(half * x, half * y, z))
        };
        let frustum = Polyhedron::hull_of_polygons(&square(2.0, 1.0), &square(1.0, 4.0)).unwrap();
        // The volume of a frustum is h/3 (A + B + sqrt(A B)), with h = 3 and the end areas A = 16 and B = 4.
        assert!((frustum.volume() - (16.0 + 4.0 + 8.0)).abs() < 1e-9, "{}", frustum.volume());
        let smaller = frustum.shrunk(0.1).unwrap();
        assert_eq!(smaller.corners().len(), 8);
        for corner in smaller.corners() {
            // Each corner of the smaller frustum lies 0.1 behind three faces of the frustum.
            let at = frustum.faces().iter().filter(|f| (f.plane.distance(*corner) + 0.1).abs() < 1e-9).count();
            assert_eq!(at, 3);
        }
        assert!(frustum.shrunk(1.6).is_none());
    }

    #[test]
    fn nearest_point_satisfies_the_support_condition() {
        let body = unit_cube().shrunk(0.1).unwrap();
        for i in 0..300 {
            let (a, b) = (0.7 * f64::from(i), 0.37 * f64::from(i));
            let q = DVec3::splat(0.5) + DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos()) * 1.3;
            let p = body.nearest(q);
            let n = (q - p).normalize();
            assert!(body.support(n).dot(n) - p.dot(n) < 1e-12);
        }
        assert_eq!(body.nearest(DVec3::splat(0.5)), DVec3::splat(0.5));
    }

    #[test]
    fn edges_are_normal_to_both_face_normals() {
        for body in [unit_cube(), unit_cube().shrunk(0.2).unwrap().translated(DVec3::X)] {
            for edge in body.edges() {
                let [a, b] = edge.ends.map(|end| body.corners()[end]);
                for normal in edge.normals {
                    assert!(normal.dot(b - a).abs() < 1e-12);
                }
            }
        }
    }
}
