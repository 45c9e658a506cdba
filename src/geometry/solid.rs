//! A body bounded by a closed triangle surface: signed distance, volume, inertia tensor.
//!
//! Distances come from the oriented triangle mesh of the library parry. Its pseudo-normals give the correct sign at
//! edges and vertices (Baerentzen & Aanaes 2005). Each triangle forms a tetrahedron with a reference point. Volume and
//! inertia are exact sums over these tetrahedra (Tonon 2004).

use std::collections::HashMap;

use glam::{DMat3, DVec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{PointQuery, Ray, RayCast, intersection_test};
use parry3d_f64::shape::{TriMesh, TriMeshFlags};
use thiserror::Error;

use super::convex::half_space::{HalfSpace, split};

/// Reason why a triangle surface does not bound a body.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SolidError {
    /// Fewer than four triangles.
    #[error("the surface has {0} triangles; a closed surface needs at least 4")]
    TooFewTriangles(usize),
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {vertex}, but the surface has only {count} vertices")]
    NoSuchVertex { triangle: usize, vertex: u32, count: usize },
    /// A coordinate is not a finite number.
    #[error("vertex {0} has a coordinate that is not a finite number")]
    NotFinite(usize),
    /// A triangle uses a vertex twice.
    #[error("triangle {0} uses the same vertex twice")]
    Degenerate(usize),
    /// An edge belongs to one triangle only: the surface has a hole.
    #[error(
        "the surface is not closed: the edge from ({:.6}, {:.6}, {:.6}) to ({:.6}, {:.6}, {:.6}) belongs to one \
         triangle only ({open} such edges in total)", a.x, a.y, a.z, b.x, b.y, b.z
    )]
    Open { a: DVec3, b: DVec3, open: usize },
    /// Two triangles traverse an edge in the same direction, or more than two share it.
    #[error(
        "the triangles at the edge from ({:.6}, {:.6}, {:.6}) to ({:.6}, {:.6}, {:.6}) have opposite orientations, or \
         more than two share the edge", a.x, a.y, a.z, b.x, b.y, b.z
    )]
    NotOriented { a: DVec3, b: DVec3 },
    /// The surface encloses no volume, or its triangles are clockwise seen from outside.
    #[error(
        "the surface encloses {0:.3e} m3, but the volume must be positive: its triangles must be counter-clockwise \
         seen from outside"
    )]
    VolumeNotPositive(f64),
    /// parry rejected the mesh.
    #[error("the mesh library parry rejected the surface: {0}")]
    Mesh(String),
}

/// Volume, centroid and inertia tensor of a body with unit density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeProperties {
    /// Volume [m3].
    pub volume: f64,
    /// Centroid [m].
    pub centre: DVec3,
    /// Inertia tensor about the centroid for a density of 1 kg/m3 [kg m2].
    pub inertia: DMat3,
}

/// A body bounded by a closed triangle surface.
#[derive(Clone)]
pub struct Solid {
    mesh: TriMesh,
    properties: VolumeProperties,
}

impl std::fmt::Debug for Solid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solid")
            .field("triangles", &self.triangles().len())
            .field("properties", &self.properties)
            .finish()
    }
}

impl Solid {
    /// Creates the body inside the given surface [m]. The triangles must be counter-clockwise seen from outside.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, SolidError> {
        check_closed(&vertices, &triangles)?;
        let properties = volume_properties(&vertices, &triangles);
        if properties.volume.is_nan() || properties.volume <= 0.0 {
            return Err(SolidError::VolumeNotPositive(properties.volume));
        }
        let flags = TriMeshFlags::ORIENTED | TriMeshFlags::CONNECTED_COMPONENTS;
        let mesh =
            TriMesh::with_flags(vertices, triangles, flags).map_err(|error| SolidError::Mesh(error.to_string()))?;
        Ok(Self { mesh, properties })
    }

    /// Vertices of the surface [m].
    pub fn vertices(&self) -> &[DVec3] {
        self.mesh.vertices()
    }

    /// Triangles of the surface, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.mesh.indices()
    }

    /// Number of separate bodies that the surface bounds. The surface of a cavity does not count.
    pub fn body_count(&self) -> usize {
        let Some(parts) = self.mesh.connected_components() else { return 1 };
        let volume = |range: &[usize]| {
            let faces = parts.grouped_faces[range[0]..range[1]].iter();
            let triangles: Vec<[u32; 3]> = faces.map(|face| self.triangles()[*face as usize]).collect();
            volume_properties(self.vertices(), &triangles).volume
        };
        parts.ranges.windows(2).filter(|range| volume(range) > 0.0).count()
    }

    /// Centre [m] of a triangle that intersects or touches another triangle without a common vertex; `None` if no
    /// triangles do.
    pub fn self_intersection(&self) -> Option<DVec3> {
        let triangle = |index: usize| self.mesh.triangle(index as u32);
        let boxes: Vec<Aabb> = (0..self.triangles().len()).map(|index| triangle(index).local_aabb()).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        let intersects = |a: usize, b: usize| {
            let [one, other] = [a, b].map(|index| self.triangles()[index]);
            if one.iter().any(|corner| other.contains(corner)) {
                return false;
            }
            // Both triangles are in the same axes. parry supports triangles, so the test cannot fail.
            let here = Pose::IDENTITY;
            intersection_test(&here, &triangle(a), &here, &triangle(b)).is_ok_and(|found| found.intersecting)
        };
        (0..boxes.len()).find_map(|a| {
            let near = tree.intersect_aabb(&boxes[a]).map(|b| b as usize);
            near.filter(|b| *b > a).find(|b| intersects(a, *b)).map(|_| triangle(a).center())
        })
    }

    /// Volume, centroid and inertia tensor for unit density.
    pub fn volume_properties(&self) -> VolumeProperties {
        self.properties
    }

    /// Lower and upper corner of the axis-aligned bounding box [m].
    pub fn bounds(&self) -> [DVec3; 2] {
        let bounds = self.mesh.local_aabb();
        [bounds.mins, bounds.maxs]
    }

    /// Nearest point of the surface [m] and signed distance to it [m], negative inside.
    pub fn project(&self, point: DVec3) -> (DVec3, f64) {
        let projection = self.mesh.project_local_point(point, false);
        let distance = (projection.point - point).length();
        (projection.point, if projection.is_inside { -distance } else { distance })
    }

    /// Signed distance to the surface [m], negative inside.
    pub fn signed_distance(&self, point: DVec3) -> f64 {
        self.project(point).1
    }

    /// Distance [m] from a point along the unit vector `direction` to the first triangle within `reach` [m], and the
    /// absolute cosine of the angle between this direction and the normal of the triangle [-].
    pub fn ray(&self, from: DVec3, direction: DVec3, reach: f64) -> Option<(f64, f64)> {
        let hit = self.mesh.cast_local_ray_and_get_normal(&Ray::new(from, direction), reach, false)?;
        Some((hit.time_of_impact, hit.normal.dot(direction).abs()))
    }

    /// Returns volume [m3] and centroid [m] of the part of the body below the `level` [m] along the unit vector `up`.
    /// The centroid of nothing is the origin.
    pub fn below(&self, up: DVec3, level: f64) -> (f64, DVec3) {
        let plane = HalfSpace { normal: up, offset: level };
        // Tetrahedra between the surface and a point of the plane. The cut in the plane adds none.
        let tip = level * up;
        let (mut volume, mut moment) = (0.0, DVec3::ZERO);
        for triangle in self.triangles() {
            let corners = triangle.map(|corner| self.vertices()[corner as usize]);
            let [ring, _] = split(&corners, &plane, 0.0);
            for k in 2..ring.len() {
                let [a, b, c] = [ring[0], ring[k - 1], ring[k]].map(|corner| corner - tip);
                let of_one = a.dot(b.cross(c)) / 6.0;
                volume += of_one;
                moment += of_one * (tip + 0.25 * (a + b + c));
            }
        }
        if volume > 0.0 { (volume, moment / volume) } else { (0.0, DVec3::ZERO) }
    }

    /// Returns the body moved by `shift` [m].
    pub fn translated(&self, shift: DVec3) -> Result<Self, SolidError> {
        Self::new(self.vertices().iter().map(|v| *v + shift).collect(), self.triangles().to_vec())
    }
}

/// Returns an error unless the triangles traverse every edge once in each direction.
fn check_closed(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), SolidError> {
    if triangles.len() < 4 {
        return Err(SolidError::TooFewTriangles(triangles.len()));
    }
    if let Some(bad) = vertices.iter().position(|v| !v.is_finite()) {
        return Err(SolidError::NotFinite(bad));
    }
    let mut edges: HashMap<[u32; 2], u32> = HashMap::with_capacity(3 * triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        if let Some(&vertex) = triangle.iter().find(|v| **v as usize >= vertices.len()) {
            return Err(SolidError::NoSuchVertex { triangle: index, vertex, count: vertices.len() });
        }
        let [a, b, c] = *triangle;
        if a == b || b == c || c == a {
            return Err(SolidError::Degenerate(index));
        }
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    let ends = |edge: &[u32; 2]| (vertices[edge[0] as usize], vertices[edge[1] as usize]);
    // The edge with the lowest vertex indices is reported, so that the message is always the same.
    if let Some((edge, _)) = edges.iter().filter(|(_, count)| **count > 1).min() {
        let (a, b) = ends(edge);
        return Err(SolidError::NotOriented { a, b });
    }
    let mut open: Vec<[u32; 2]> = edges.keys().copied().filter(|[a, b]| !edges.contains_key(&[*b, *a])).collect();
    open.sort_unstable();
    match open.first() {
        None => Ok(()),
        Some(edge) => {
            let (a, b) = ends(edge);
            Err(SolidError::Open { a, b, open: open.len() })
        }
    }
}

/// Volume, centroid and inertia tensor as sums over signed tetrahedra (o, a, b, c) with a point o near the middle.
///
/// a, b and c are the corners of a triangle. With o as the origin and s = a + b + c, a tetrahedron has the volume
/// V = a.(b x c)/6 and the second moments int x x^T dV = V/20 (a a^T + b b^T + c c^T + s s^T).
fn volume_properties(vertices: &[DVec3], triangles: &[[u32; 3]]) -> VolumeProperties {
    let origin = vertices.iter().sum::<DVec3>() / vertices.len() as f64;
    let (mut volume, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| vertices[v as usize] - origin);
        let v = a.dot(b.cross(c)) / 6.0;
        let s = a + b + c;
        volume += v;
        first += v / 4.0 * s;
        second += (dyad(a) + dyad(b) + dyad(c) + dyad(s)) * (v / 20.0);
    }
    let mean = first / volume;
    let central = second - dyad(mean) * volume;
    VolumeProperties { volume, centre: origin + mean, inertia: DMat3::IDENTITY * trace(central) - central }
}

fn dyad(a: DVec3) -> DMat3 {
    DMat3::from_cols(a * a.x, a * a.y, a * a.z)
}

fn trace(m: DMat3) -> f64 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Box with the corners `min` and `max`: vertices and 12 triangles.
    pub(crate) fn cuboid(min: DVec3, max: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let corner = |i: usize| {
            DVec3::new(
                if i & 1 == 0 { min.x } else { max.x },
                if i & 2 == 0 { min.y } else { max.y },
                if i & 4 == 0 { min.z } else { max.z },
            )
        };
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
        ((0..8).map(corner).collect(), triangles)
    }

    #[test]
    fn part_of_a_box_below_a_level_is_a_box_or_a_wedge() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0));
        let solid = Solid::new(vertices, triangles).unwrap();
        let check = |up: DVec3, level: f64, volume: f64, centre: DVec3| {
            let found = solid.below(up, level);
            // Rounding.
            assert!((found.0 - volume).abs() < 1e-12 && (found.1 - centre).length() < 1e-12, "{found:?}");
        };
        check(DVec3::Z, -1.0, 0.0, DVec3::ZERO);
        check(DVec3::Z, 0.0, 0.0, DVec3::ZERO);
        check(DVec3::Z, 1.2, 2.4, DVec3::new(0.5, 1.0, 0.6));
        check(DVec3::Z, 5.0, 6.0, DVec3::new(0.5, 1.0, 1.5));
        // The plane x + z = 1 cuts a wedge off.
        check(DVec3::new(1.0, 0.0, 1.0).normalize(), 0.5f64.sqrt(), 1.0, DVec3::new(1.0 / 3.0, 1.0, 1.0 / 3.0));
    }

    #[test]
    fn box_has_textbook_volume_centroid_and_inertia() {
        let (vertices, triangles) = cuboid(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 4.0, 6.0));
        let solid = Solid::new(vertices, triangles).unwrap();
        let p = solid.volume_properties();
        // The integration is exact, so the tolerance allows only for rounding errors.
        assert!((p.volume - 6.0).abs() < 1e-12);
        assert!((p.centre - DVec3::new(1.5, 3.0, 4.5)).length() < 1e-12);
        let textbook = DVec3::new(4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0) * 6.0 / 12.0;
        assert!((p.inertia - DMat3::from_diagonal(textbook)).abs_diff_eq(DMat3::ZERO, 1e-12));
        assert_eq!(solid.bounds(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 4.0, 6.0)]);
    }

    #[test]
    fn distance_is_negative_inside_and_exact_at_a_corner() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        let solid = Solid::new(vertices, triangles).unwrap();
        assert!((solid.signed_distance(DVec3::new(0.5, 0.5, 0.9)) + 0.1).abs() < 1e-12);
        assert!((solid.signed_distance(DVec3::new(2.0, 2.0, 2.0)) - 3f64.sqrt()).abs() < 1e-12);
        let (nearest, distance) = solid.project(DVec3::new(-0.5, 0.25, 0.25));
        assert!((nearest - DVec3::new(0.0, 0.25, 0.25)).length() < 1e-12 && (distance - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_cavity_is_no_separate_body() {
        let (mut vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        let mut add = |low: f64, high: f64, inside_out: bool| {
            let first = vertices.len() as u32;
            let (more, around) = cuboid(DVec3::splat(low), DVec3::splat(high));
            vertices.extend(more);
            triangles.extend(
                around.iter().map(|t| t.map(|v| v + first)).map(
                    |[a, b, c]| {
                        if inside_out { [a, c, b] } else { [a, b, c] }
                    },
                ),
            );
            Solid::new(vertices.clone(), triangles.clone()).unwrap().body_count()
        };
        assert_eq!(add(0.25, 0.75, true), 1);
        assert_eq!(add(2.0, 3.0, false), 2);
    }

    #[test]
    fn open_and_inside_out_surfaces_are_rejected() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        let hole = Solid::new(vertices.clone(), triangles[1..].to_vec()).unwrap_err();
        assert!(hole.to_string().contains("not closed"), "{hole}");
        let reversed = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        assert!(matches!(Solid::new(vertices.clone(), reversed), Err(SolidError::VolumeNotPositive(_))));
        let mut twisted = triangles.clone();
        twisted[0].swap(0, 1);
        assert!(matches!(Solid::new(vertices.clone(), twisted), Err(SolidError::NotOriented { .. })));
        assert!(matches!(Solid::new(vertices, vec![[0, 1, 9]; 4]), Err(SolidError::NoSuchVertex { .. })));
    }
}
