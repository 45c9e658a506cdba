//! Convex hulls of pieces: volume, thickness, and polyhedra with few corners.

use glam::DVec3;

use super::convex_hull::convex_hull;
use crate::geometry::convex::{half_space::HalfSpace, polyhedron::Polyhedron};

/// Largest number of corners of a part. The search for contacts compares all corners of a part with all faces of
/// another part, and all edges with all edges. With 64 corners, a round bar becomes a prism with 32 sides, which lie
/// within 0.5 % of its radius.
pub const MOST_CORNERS: usize = 64;

/// Distance from a plane below which the corners of a triangle belong to the same face, relative to the size of the part
/// [-].
const FLAT: f64 = 1e-5;
/// Number of steps in the search for a ball inside a hull.
const BALL_STEPS: usize = 60;

/// Convex hull of points.
#[derive(Debug, Clone)]
pub(super) struct Hull {
    corners: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    volume: f64,
}

impl Hull {
    /// Returns the hull of the points, or `None` if they are flat.
    pub(super) fn new(points: &[DVec3]) -> Option<Self> {
        let [low, high] = points.iter().fold([DVec3::MAX, DVec3::MIN], |[l, h], p| [l.min(*p), h.max(*p)]);
        let (middle, size) = (0.5 * (low + high), 0.5 * (high - low).max_element());
        let scaled: Vec<DVec3> = points.iter().map(|p| (*p - middle) / size).collect();
        let mut triangles = convex_hull(&scaled)?;
        let tetrahedron = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| scaled[v as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        let volume = size.powi(3) * triangles.iter().map(tetrahedron).sum::<f64>();
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let new_number = |v: u32| used.binary_search(&v).unwrap_or_default() as u32;
        triangles.iter_mut().for_each(|triangle| *triangle = triangle.map(new_number));
        let corners = used.iter().map(|v| points[*v as usize]).collect();
        (volume > 0.0).then_some(Self { corners, triangles, volume })
    }

    pub(super) fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    pub(super) fn volume(&self) -> f64 {
        self.volume
    }

    /// Plane and area of each triangle.
    fn planes(&self) -> Vec<(HalfSpace, f64)> {
        let plane = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|v| self.corners[v as usize]);
            let twice = (b - a).cross(c - a);
            let normal = twice.try_normalize()?;
            Some((HalfSpace { normal, offset: normal.dot(a) }, 0.5 * twice.length()))
        };
        self.triangles.iter().filter_map(plane).collect()
    }

    /// Returns true if a ball of the given radius fits into the hull.
    pub(super) fn has_room_for(&self, radius: f64) -> bool {
        let planes = self.planes();
        let area: f64 = planes.iter().map(|(_, area)| area).sum();
        // The radius of the largest ball in a convex body is between V / A and 3 V / A.
        if radius <= self.volume / area || radius > 3.0 * self.volume / area {
            return radius <= self.volume / area;
        }
        // The centre moves to the inside of the plane that the ball crosses most.
        let mut centre = self.corners.iter().sum::<DVec3>() / self.corners.len() as f64;
        for _ in 0..BALL_STEPS {
            let crossed = planes.iter().map(|(plane, _)| (plane.distance(centre) + radius, plane.normal));
            let Some((depth, normal)) = crossed.max_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
            if depth <= 0.0 {
                return true;
            }
            // The factor above 1 reaches the inside in a limited number of steps.
            centre -= 1.3 * depth * normal;
        }
        false
    }

    /// Polyhedron with about the volume of the hull and at most [`MOST_CORNERS`] corners, multiplied by `size` and moved
    /// by `shift`.
    pub(super) fn polyhedron(&self, size: f64, shift: DVec3) -> Option<Polyhedron> {
        let within_bound = |part: &Polyhedron| part.corners().len() <= MOST_CORNERS;
        if self.corners.len() <= MOST_CORNERS
            && let Some(part) = self.with_plane_faces(size, shift).filter(within_bound)
        {
            return Some(part);
        }
        // A corner of more than three faces can become several corners.
        let coarse = |share: usize| self.simplified(MOST_CORNERS * share / 8)?.with_plane_faces(size, shift);
        [8, 7, 6, 4].into_iter().filter_map(coarse).find(within_bound)
    }

    /// Polyhedron whose triangles in one plane are one face, multiplied by `size` and moved by `shift`.
    fn with_plane_faces(&self, size: f64, shift: DVec3) -> Option<Polyhedron> {
        let middle = self.corners.iter().sum::<DVec3>() / self.corners.len() as f64;
        let reach = self.corners.iter().map(|c| c.distance(middle)).fold(0.0, f64::max);
        let scaled: Vec<DVec3> = self.corners.iter().map(|c| (*c - middle) / reach).collect();
        let mut triangles: Vec<[DVec3; 3]> = self.triangles.iter().map(|t| t.map(|v| scaled[v as usize])).collect();
        let area = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).length();
        // A plane face gets the plane of its largest triangle, because that of a narrow triangle is inaccurate.
        triangles.sort_by(|a, b| area(b).total_cmp(&area(a)));
        let mut planes: Vec<HalfSpace> = Vec::new();
        for [a, b, c] in triangles {
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
            let contains = |plane: &HalfSpace| {
                plane.normal.dot(normal) > 0.5 && [a, b, c].iter().all(|p| plane.distance(*p).abs() < FLAT)
            };
            if !planes.iter().any(contains) {
                // All corners lie behind the plane, also behind that of a narrow triangle.
                let offset = scaled.iter().map(|c| normal.dot(*c)).fold(f64::MIN, f64::max);
                planes.push(HalfSpace { normal, offset });
            }
        }
        planes.iter_mut().for_each(|plane| plane.offset *= size * reach);
        Some(Polyhedron::from_planes(&planes, 2.0 * size * reach)?.translated(size * middle + shift))
    }

    /// Hull of at most `most` of the corners, enlarged to the volume of this hull.
    fn simplified(&self, most: usize) -> Option<Hull> {
        let furthest = |direction: DVec3| {
            let further = |a: DVec3, b: DVec3| if b.dot(direction) > a.dot(direction) { b } else { a };
            self.corners.iter().copied().reduce(further)
        };
        let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
        let mut chosen: Vec<DVec3> = axes.filter_map(furthest).collect();
        let mut coarse = Hull::new(&chosen)?;
        while chosen.len() < most.min(self.corners.len()) {
            let planes = coarse.planes();
            let height = |c: &DVec3| planes.iter().map(|(plane, _)| plane.distance(*c)).fold(f64::MIN, f64::max);
            let heights = self.corners.iter().map(|c| (height(c), *c));
            let (_, corner) = heights.max_by(|a, b| a.0.total_cmp(&b.0))?;
            chosen.push(corner);
            coarse = Hull::new(&chosen)?;
        }
        let growth = (self.volume / coarse.volume).cbrt();
        let middle = chosen.iter().sum::<DVec3>() / chosen.len() as f64;
        coarse.corners.iter_mut().for_each(|c| *c = middle + growth * (*c - middle));
        Some(coarse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polyhedron_of_a_ball_has_few_corners_and_the_same_volume() {
        let point = |k: u32| {
            let (a, b) = (2.4 * f64::from(k), (1.0 - 2.0 * (f64::from(k) + 0.5) / 2000.0).acos());
            DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos())
        };
        let hull = Hull::new(&(0..2000).map(point).collect::<Vec<_>>()).unwrap();
        let part = hull.polyhedron(2.0, DVec3::X).unwrap();
        assert!(part.corners().len() <= MOST_CORNERS);
        // Limit 1e-4: the tolerance of plane faces.
        assert!((part.volume() / (8.0 * hull.volume()) - 1.0).abs() < 1e-4);
        assert!((part.bounding_sphere().0 - DVec3::X).length() < 0.1);
    }

    #[test]
    fn largest_ball_in_a_slab_has_half_its_thickness_as_radius() {
        let corner = |n: usize| DVec3::new((n & 1) as f64, (n >> 1 & 1) as f64, 0.2 * (n >> 2 & 1) as f64);
        let slab = Hull::new(&(0..8).map(corner).collect::<Vec<_>>()).unwrap();
        assert!(slab.has_room_for(0.099) && !slab.has_room_for(0.101));
        let tetrahedron = Hull::new(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]).unwrap();
        // The inscribed sphere of this tetrahedron has the radius 1 / (3 + sqrt 3) = 0.2113.
        assert!(tetrahedron.has_room_for(0.21) && !tetrahedron.has_room_for(0.2125));
    }
}
