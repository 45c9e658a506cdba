//! Coarse surface of a body with a fine mesh, by edge collapse (Garland & Heckbert 1997; Lindstrom & Turk 1998).
//!
//! A collapse replaces the two ends of an edge by one vertex. The position of the vertex minimises the squared distances
//! to the planes of the original triangles, so edges and corners stay sharp, and preserves the volume exactly.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DMat3, DVec3};

/// Number of triangles above which the surface is made coarser. The time of the search grows with this number.
const MOST_TRIANGLES: usize = 1000;
/// Weight of the middle of the edge, relative to that of the planes [-]. In a plane region, only this weight determines
/// the position in the plane.
const MIDDLE_WEIGHT: f64 = 1e-4;
/// Smallest cosine of the angle by which a collapse turns a triangle.
const SMALLEST_COSINE: f64 = 0.5;

/// Weighted sum of squared distances to planes, as a function of the position.
#[derive(Debug, Clone, Copy)]
struct Quadric {
    /// Sum of n n^T, where the length of the normal n is the area of the triangle.
    matrix: DMat3,
    /// Sum of n (n.p), with a point p of the triangle.
    vector: DVec3,
    /// Sum of (n.p)^2.
    constant: f64,
    /// Sum of n.n.
    weight: f64,
}

impl Quadric {
    const ZERO: Self = Self { matrix: DMat3::ZERO, vector: DVec3::ZERO, constant: 0.0, weight: 0.0 };

    fn of_triangle([a, b, c]: [DVec3; 3]) -> Self {
        let n = (b - a).cross(c - a);
        let matrix = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        Self { matrix, vector: n * n.dot(a), constant: n.dot(a).powi(2), weight: n.length_squared() }
    }

    fn plus(&self, other: &Self) -> Self {
        Self {
            matrix: self.matrix + other.matrix,
            vector: self.vector + other.vector,
            constant: self.constant + other.constant,
            weight: self.weight + other.weight,
        }
    }

    /// Mean squared distance of a point from the planes.
    fn mean_square(&self, x: DVec3) -> f64 {
        ((x.dot(self.matrix * x) - 2.0 * x.dot(self.vector) + self.constant) / self.weight).max(0.0)
    }

    /// Position with the least squared distances, close to `middle` in directions that the planes do not determine.
    fn minimum(&self, middle: DVec3) -> DVec3 {
        let matrix = self.matrix + DMat3::from_diagonal(DVec3::splat(MIDDLE_WEIGHT * self.weight));
        middle + matrix.inverse() * (self.vector - self.matrix * middle)
    }
}

/// An edge in the queue: bits of its mean square distance, ends, and the versions of the ends.
type Queued = Reverse<(u64, [u32; 2], [u32; 2])>;

struct Mesh {
    vertices: Vec<DVec3>,
    /// Triangles; `None` after a collapse of one of their edges.
    triangles: Vec<Option<[u32; 3]>>,
    /// Number of triangles left.
    count: usize,
    /// Numbers of the triangles at each vertex.
    around: Vec<Vec<u32>>,
    quadrics: Vec<Quadric>,
    /// Number of changes of each vertex and its neighbours.
    versions: Vec<u32>,
    queue: BinaryHeap<Queued>,
}

/// Coarse surface of the body inside a closed surface: vertices and triangles.
pub(super) fn coarsened(vertices: Vec<DVec3>, triangles: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let count = vertices.len();
    let mut mesh = Mesh {
        vertices,
        triangles: triangles.iter().copied().map(Some).collect(),
        count: triangles.len(),
        around: vec![Vec::new(); count],
        quadrics: vec![Quadric::ZERO; count],
        versions: vec![0; count],
        queue: BinaryHeap::new(),
    };
    for (number, triangle) in triangles.iter().enumerate() {
        let quadric = Quadric::of_triangle(triangle.map(|v| mesh.vertices[v as usize]));
        for v in triangle.map(|v| v as usize) {
            mesh.around[v].push(number as u32);
            mesh.quadrics[v] = mesh.quadrics[v].plus(&quadric);
        }
    }
    for [a, b, c] in triangles {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            if from < to {
                mesh.enqueue(from, to);
            }
        }
    }
    while mesh.count > MOST_TRIANGLES
        && let Some(Reverse((_, [a, b], versions))) = mesh.queue.pop()
    {
        if versions == [a, b].map(|v| mesh.versions[v as usize]) {
            mesh.collapse(a, b);
        }
    }
    (mesh.vertices, mesh.triangles.into_iter().flatten().collect())
}

impl Mesh {
    /// Triangles at either end of an edge: first those at only one end, then those with both ends.
    fn star(&self, a: u32, b: u32) -> [Vec<[u32; 3]>; 2] {
        let at = |v: u32| self.around[v as usize].iter().filter_map(|number| self.triangles[*number as usize]);
        let (common, one): (Vec<_>, Vec<_>) = at(a).partition(|triangle| triangle.contains(&b));
        [one.into_iter().chain(at(b).filter(|triangle| !triangle.contains(&a))).collect(), common]
    }

    /// Position of the vertex that replaces an edge; `None` if the collapse would change the topology of the surface or
    /// turn a triangle over.
    fn replacement(&self, a: u32, b: u32) -> Option<DVec3> {
        let [ring, common] = self.star(a, b);
        // Outside the two triangles at the edge, only their opposite corners may be neighbours of both ends.
        let (of_a, of_b): (Vec<_>, Vec<_>) = ring.iter().partition(|triangle| triangle.contains(&a));
        let is_shared = |v: &&u32| of_b.iter().any(|triangle: &&[u32; 3]| triangle.contains(*v));
        if common.len() != 2 || of_a.iter().copied().flatten().filter(is_shared).count() != 2 {
            return None;
        }
        let middle = 0.5 * (self.vertices[a as usize] + self.vertices[b as usize]);
        let corners = |triangle: &[u32; 3]| triangle.map(|v| self.vertices[v as usize] - middle);
        let tetrahedron = |[a, b, c]: [DVec3; 3]| a.dot(b.cross(c));
        let volume: f64 = ring.iter().chain(&common).map(|triangle| tetrahedron(corners(triangle))).sum();
        // Puts the moved corner first.
        let opened = |triangle: &[u32; 3]| {
            let first = triangle.iter().position(|v| *v == a || *v == b).unwrap_or(0);
            let corners = corners(triangle);
            [corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]]
        };
        let gradient: DVec3 = ring.iter().map(opened).map(|[_, b, c]| b.cross(c)).sum();
        let best = self.quadrics[a as usize].plus(&self.quadrics[b as usize]).minimum(middle) - middle;
        let x = best + gradient * ((volume - gradient.dot(best)) / gradient.length_squared());
        let stays_upright = |[corner, b, c]: [DVec3; 3]| {
            let [old, new] = [corner, x].map(|corner| (b - corner).cross(c - corner));
            new.dot(old) >= SMALLEST_COSINE * new.length() * old.length()
        };
        (x.is_finite() && ring.iter().map(opened).all(stays_upright)).then_some(middle + x)
    }

    /// Adds an edge to the queue, if its collapse is possible and accurate.
    fn enqueue(&mut self, a: u32, b: u32) {
        if let Some(x) = self.replacement(a, b) {
            let error = self.quadrics[a as usize].plus(&self.quadrics[b as usize]).mean_square(x);
            // The bits of positive numbers have the same order as the numbers.
            self.queue.push(Reverse((error.to_bits(), [a, b], [a, b].map(|v| self.versions[v as usize]))));
        }
    }

    /// Replaces the ends of an edge by one vertex, which takes the number of the first end.
    fn collapse(&mut self, a: u32, b: u32) {
        let Some(x) = self.replacement(a, b) else { return };
        self.vertices[a as usize] = x;
        self.quadrics[a as usize] = self.quadrics[a as usize].plus(&self.quadrics[b as usize]);
        for number in std::mem::take(&mut self.around[b as usize]) {
            let triangle = &mut self.triangles[number as usize];
            match triangle {
                Some(corners) if corners.contains(&a) => {
                    *triangle = None;
                    self.count -= 1;
                }
                Some(corners) => {
                    *corners = corners.map(|v| if v == b { a } else { v });
                    self.around[a as usize].push(number);
                }
                None => {}
            }
        }
        let triangles = &self.triangles;
        self.around[a as usize].retain(|number| triangles[*number as usize].is_some());
        self.versions[a as usize] += 1;
        self.versions[b as usize] += 1;
        for neighbour in self.neighbours(a).into_iter().filter(|v| *v != a) {
            self.enqueue(a.min(neighbour), a.max(neighbour));
        }
    }

    /// Vertices of the triangles at a vertex, sorted.
    fn neighbours(&self, v: u32) -> Vec<u32> {
        let triangles = self.around[v as usize].iter().filter_map(|number| self.triangles[*number as usize]);
        let mut found: Vec<u32> = triangles.flatten().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solid::Solid;

    #[test]
    fn coarse_surface_is_closed_and_has_the_same_volume() {
        // A barrel with plane ends: rings of 60 points.
        let (around, rows) = (60u32, 30u32);
        let point = |row: u32, k: u32| {
            let (angle, z) =
                (f64::from(k) * std::f64::consts::TAU / f64::from(around), f64::from(row) / f64::from(rows));
            let radius = 0.4 + 0.3 * z * (1.0 - z);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        };
        let mut vertices: Vec<DVec3> = (0..=rows).flat_map(|row| (0..around).map(move |k| point(row, k))).collect();
        let number = |row: u32, k: u32| row * around + k % around;
        let mut triangles = Vec::new();
        for k in 0..around {
            for row in 0..rows {
                triangles.push([number(row, k), number(row, k + 1), number(row + 1, k + 1)]);
                triangles.push([number(row, k), number(row + 1, k + 1), number(row + 1, k)]);
            }
            let middle = number(rows + 1, 0);
            triangles.push([middle, number(0, k + 1), number(0, k)]);
            triangles.push([middle + 1, number(rows, k), number(rows, k + 1)]);
        }
        vertices.extend([DVec3::ZERO, DVec3::Z]);
        let fine = Solid::new(vertices.clone(), triangles.clone()).unwrap();
        let (coarse_vertices, coarse_triangles) = coarsened(vertices, &triangles);
        assert!(coarse_triangles.len() <= MOST_TRIANGLES);
        let coarse = Solid::new(coarse_vertices, coarse_triangles).unwrap();
        let [volume, expected] = [coarse, fine].map(|solid| solid.volume_properties().volume);
        // Limit 1e-9: rounding errors.
        assert!((volume / expected - 1.0).abs() < 1e-9, "{volume} {expected}");
    }
}
