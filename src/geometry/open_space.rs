//! The space above the bed and between the walls, and the part of the surface of a body that lies in it.
//!
//! The space consists of convex cells, one above each segment of the bed. A surface is cut by the planes of each cell.

use glam::DVec3;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::TriMesh;

use super::convex::half_space::{HalfSpace, split};
use super::profile::Profile;

/// Cut triangles with a smaller area are left out, divided by the square of their longest edge [-].
const LINE: f64 = 1e-9;

/// Longest edge of the triangles around the samples of a surface, divided by their spacing [-]: a right triangle then has
/// the area of the square of the spacing.
const LONGEST: f64 = 2.0;

/// The space above the bed and between the walls.
#[derive(Debug, Clone)]
pub struct OpenSpace {
    /// Planes around each convex cell.
    cells: Vec<Vec<HalfSpace>>,
}

impl OpenSpace {
    /// Returns the space between two `x`, and two `y` if the flume has sides [m]. The space ends `inset` [m] in front of
    /// bed, ends and sides, so that surfaces that touch them are outside.
    pub fn new(bed: &Profile, x: [f64; 2], y: Option<[f64; 2]>, inset: f64) -> Self {
        let [x0, x1] = [x[0] + inset, x[1] - inset];
        let inner = bed.points().iter().map(|point| point[0]).filter(|at| *at > x0 && *at < x1);
        let ends: Vec<f64> = [x0].into_iter().chain(inner).chain([x1]).collect();
        let along = |normal: DVec3, at: f64| HalfSpace { normal, offset: at };
        let sides = y.map(|[y0, y1]| [along(DVec3::NEG_Y, -(y0 + inset)), along(DVec3::Y, y1 - inset)]);
        let cell = |from: f64, to: f64| {
            let foot = DVec3::new(from, 0.0, bed.z(from));
            let rise = DVec3::new(to, 0.0, bed.z(to)) - foot;
            let down = DVec3::new(rise.z, 0.0, -rise.x).normalize();
            let above = HalfSpace { normal: down, offset: down.dot(foot) - inset };
            let walls = [along(DVec3::NEG_X, -from), along(DVec3::X, to)];
            walls.into_iter().chain([above]).chain(sides.into_iter().flatten()).collect()
        };
        Self { cells: ends.windows(2).filter(|pair| pair[1] > pair[0]).map(|pair| cell(pair[0], pair[1])).collect() }
    }

    /// Returns true if a point lies in the space.
    pub fn contains(&self, point: DVec3) -> bool {
        self.cells.iter().any(|cell| cell.iter().all(|plane| plane.distance(point) <= 0.0))
    }

    /// Returns the part of a surface of `triangles` [m] that lies in the space; `None` if there is none.
    pub fn part_of(&self, triangles: impl Iterator<Item = [DVec3; 3]>) -> Option<OpenSurface> {
        let mut found = Vec::new();
        for triangle in triangles {
            let size = triangle[0].distance(triangle[1]).max(triangle[0].distance(triangle[2]));
            let tolerance = LINE * size;
            for cell in &self.cells {
                let whole = triangle.to_vec();
                let ring = cell.iter().fold(whole, |ring, plane| {
                    if ring.is_empty() { ring } else { split(&ring, plane, tolerance)[0].clone() }
                });
                found.extend((2..ring.len()).map(|corner| [ring[0], ring[corner - 1], ring[corner]]));
            }
        }
        found.retain(|[a, b, c]| {
            let (one, other) = (*b - *a, *c - *a);
            one.cross(other).length() > LINE * one.length_squared().max(other.length_squared())
        });
        let vertices = found.as_flattened().to_vec();
        let indices = (0..found.len() as u32).map(|first| [3 * first, 3 * first + 1, 3 * first + 2]).collect();
        let mesh = TriMesh::new(vertices, indices).ok()?;
        Some(OpenSurface { mesh })
    }
}

/// The part of the surface of a body that lies in an open space.
pub struct OpenSurface {
    mesh: TriMesh,
}

impl OpenSurface {
    /// Returns the point of the surface nearest to `point` [m].
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        self.mesh.project_local_point(point, false).point
    }

    /// Returns points about `spacing` [m] apart, each with the outward unit normal times the area that it represents
    /// [m2]. Triangles are halved across their longest edge.
    pub fn samples(&self, spacing: f64) -> impl Iterator<Item = (DVec3, DVec3)> {
        let mut left: Vec<[DVec3; 3]> = self.triangles().collect();
        // From the end, the order is reversed.
        left.reverse();
        std::iter::from_fn(move || {
            loop {
                let [a, b, c] = left.pop()?;
                let lengths = [(a, b, c), (b, c, a), (c, a, b)].map(|edge| (edge.0.distance(edge.1), edge));
                let (length, (a, b, c)) = lengths.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
                if length <= LONGEST * spacing {
                    return Some(((a + b + c) / 3.0, 0.5 * (b - a).cross(c - a)));
                }
                let middle = 0.5 * (a + b);
                left.extend([[middle, b, c], [a, middle, c]]);
            }
        })
    }

    /// Returns the triangles, counter-clockwise seen from outside the body [m].
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.mesh.triangles().map(|triangle| [triangle.a, triangle.b, triangle.c])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::axis_box::AxisBox;

    fn triangles_of(bounds: &AxisBox) -> Vec<[DVec3; 3]> {
        let (vertices, triangles) = bounds.surface();
        triangles.iter().map(|triangle| triangle.map(|v| vertices[v as usize])).collect()
    }

    fn area(surface: &OpenSurface) -> DVec3 {
        surface.triangles().map(|[a, b, c]| 0.5 * (b - a).cross(c - a).abs()).sum()
    }

    #[test]
    fn surface_of_a_box_in_a_slope_is_cut_at_the_slope() {
        // The slope rises by 1 m over 2 m. The box from x = 0.5 to 1.5 m is 1 m high above the bed in its middle.
        let bed = Profile::new(vec![[0.0, 0.0], [2.0, 1.0], [4.0, 1.0]]);
        let space = OpenSpace::new(&bed, [0.0, 4.0], None, 0.0);
        let bounds = AxisBox::free(DVec3::new(0.5, 0.0, -1.0), DVec3::new(1.5, 1.0, 1.5));
        let surface = space.part_of(triangles_of(&bounds).into_iter()).unwrap();
        // Front 1.25 m and rear 0.75 m high, two sides of 1 m2, top 1 m2. Limit 1e-9: rounding.
        assert!((area(&surface) - DVec3::new(2.0, 2.0, 1.0)).length() < 1e-9, "{}", area(&surface));
        let sampled: DVec3 = surface.samples(0.1).map(|(_, area)| area.abs()).sum();
        assert!((sampled - DVec3::new(2.0, 2.0, 1.0)).length() < 1e-9, "{sampled}");
        let foot = surface.nearest(DVec3::new(0.6, 0.5, 0.2));
        assert!((foot - DVec3::new(0.5, 0.5, 0.25)).length() < 1e-9, "{foot}");
    }

    #[test]
    fn faces_on_the_bed_and_at_the_sides_are_outside() {
        let bed = Profile::new(vec![[0.0, 0.0], [4.0, 0.0]]);
        let space = OpenSpace::new(&bed, [0.0, 4.0], Some([0.0, 1.0]), 1e-3);
        assert!(space.contains(DVec3::new(1.0, 0.5, 0.1)) && !space.contains(DVec3::new(1.0, 0.5, 0.0)));
        let bounds = AxisBox::free(DVec3::new(1.0, 0.0, 0.0), DVec3::new(2.0, 1.0, 1.0));
        let surface = space.part_of(triangles_of(&bounds).into_iter()).unwrap();
        // Front and rear 0.998 m x 0.999 m, top 0.998 m x 1 m.
        assert!((area(&surface) - DVec3::new(2.0 * 0.998 * 0.999, 0.0, 0.998)).length() < 1e-9, "{}", area(&surface));
        let below = AxisBox::free(DVec3::new(1.0, 0.0, -1.0), DVec3::new(2.0, 1.0, 0.0));
        assert!(space.part_of(triangles_of(&below).into_iter()).is_none());
    }
}
