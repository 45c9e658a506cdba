//! Convex hull of points as triangles (Barber et al. 1996), for points that may lie in common planes.
//!
//! A triangle whose plane contains a new point within the tolerance counts as visible from the point. The new triangles
//! replace it, so that no narrow or folded triangles arise in a plane face. The convex hull of parry lacks this rule; it
//! is sometimes not convex for cut pieces of STL surfaces.

use glam::DVec3;

use super::section::Edge;

/// Distance below which a point lies in a plane. The points have a size of 1. The value exceeds the rounding errors of
/// the single-precision coordinates of an STL file.
const IN_PLANE: f64 = 1e-6;

/// Edges around a set of facets, with the numbers of the facets outside.
type Rim = Vec<(Edge, usize)>;

/// A triangle of the hull.
struct Facet {
    corners: [u32; 3],
    /// Facets at the edges that start at the respective corners.
    neighbours: [usize; 3],
    normal: DVec3,
    offset: f64,
    /// Points in front of the facet.
    in_front: Vec<u32>,
    is_removed: bool,
}

impl Facet {
    fn new(points: &[DVec3], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self { corners, neighbours: [0; 3], normal, offset: normal.dot(a), in_front: Vec::new(), is_removed: false }
    }

    fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// Triangles of the convex hull, counter-clockwise seen from outside; `None` if the points are flat. The points have a
/// size of about 1.
pub(super) fn convex_hull(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let mut facets = tetrahedron(points)?;
    distribute(points, &mut facets, 0, 0..points.len() as u32);
    let mut next = 0;
    while next < facets.len() {
        let facet = &facets[next];
        let height = |v: &u32| facet.distance(points[*v as usize]);
        match facet.in_front.iter().copied().max_by(|a, b| height(a).total_cmp(&height(b))) {
            Some(apex) if !facet.is_removed => {
                if !add(points, &mut facets, next, apex) {
                    facets[next].in_front.retain(|v| *v != apex);
                }
            }
            _ => next += 1,
        }
    }
    Some(facets.iter().filter(|facet| !facet.is_removed).map(|facet| facet.corners).collect())
}

/// Tetrahedron of four points that are far from each other.
fn tetrahedron(points: &[DVec3]) -> Option<Vec<Facet>> {
    let furthest = |distance: &dyn Fn(DVec3) -> f64| {
        let distances = points.iter().enumerate().map(|(index, p)| (distance(*p), index as u32));
        distances.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(distance, _)| *distance > IN_PLANE)
    };
    let at = |index: u32| points[index as usize];
    let first = *points.first()?;
    let (_, a) = furthest(&|p| p.distance(first))?;
    let (_, b) = furthest(&|p| p.distance(at(a)))?;
    let along = (at(b) - at(a)).normalize();
    let (_, c) = furthest(&|p| (p - at(a)).cross(along).length())?;
    let normal = (at(b) - at(a)).cross(at(c) - at(a)).normalize();
    let (_, d) = furthest(&|p| (p - at(a)).dot(normal).abs())?;
    let [b, c] = if (at(d) - at(a)).dot(normal) > 0.0 { [c, b] } else { [b, c] };
    // Facets [a, b, c], [a, d, b], [b, d, c] and [c, d, a], with d behind the first.
    let neighbours = [[1, 2, 3], [3, 2, 0], [1, 3, 0], [2, 1, 0]];
    let corners = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
    let facet = |(corners, neighbours)| Facet { neighbours, ..Facet::new(points, corners) };
    Some(corners.into_iter().zip(neighbours).map(facet).collect())
}

/// Assigns each candidate to the facet, from number `first` on, that is furthest behind it. Points behind all facets are
/// inside.
fn distribute(points: &[DVec3], facets: &mut [Facet], first: usize, candidates: impl Iterator<Item = u32>) {
    for v in candidates {
        let distances = facets[first..].iter().map(|facet| facet.distance(points[v as usize])).enumerate();
        if let Some((index, distance)) = distances.max_by(|a, b| a.1.total_cmp(&b.1))
            && distance > IN_PLANE
        {
            facets[first + index].in_front.push(v);
        }
    }
}

/// Replaces the facets that are visible from a point by facets with the point as a corner. Returns false if this is
/// impossible because of rounding errors.
fn add(points: &[DVec3], facets: &mut Vec<Facet>, start: usize, apex: u32) -> bool {
    let Some((visible, rim)) = horizon(facets, start, points[apex as usize]) else { return false };
    let first = facets.len();
    for (index, ([a, b], outside)) in rim.iter().enumerate() {
        let mut facet = Facet::new(points, [*a, *b, apex]);
        let before = (index + rim.len() - 1) % rim.len();
        facet.neighbours = [*outside, first + (index + 1) % rim.len(), first + before];
        let edge = facets[*outside].corners.iter().position(|v| v == b);
        if let Some(edge) = edge {
            facets[*outside].neighbours[edge] = first + index;
        }
        facets.push(facet);
    }
    let mut freed: Vec<u32> = Vec::new();
    for index in visible {
        facets[index].is_removed = true;
        freed.append(&mut facets[index].in_front);
    }
    distribute(points, facets, first, freed.into_iter().filter(|v| *v != apex));
    true
}

/// Facets that are visible from a point, and the edges around them in order, with the facets outside. `None` if these
/// edges are not a simple ring.
fn horizon(facets: &[Facet], start: usize, point: DVec3) -> Option<(Vec<usize>, Rim)> {
    let mut visible = vec![start];
    let mut edges = Rim::new();
    let mut next = 0;
    while next < visible.len() {
        let facet = &facets[visible[next]];
        for (side, &neighbour) in facet.neighbours.iter().enumerate() {
            if facets[neighbour].distance(point) <= -IN_PLANE {
                edges.push(([facet.corners[side], facet.corners[(side + 1) % 3]], neighbour));
            } else if !visible.contains(&neighbour) {
                visible.push(neighbour);
            }
        }
        next += 1;
    }
    let mut ring = vec![edges.pop()?];
    while let Some(index) = edges.iter().position(|(edge, _)| edge[0] == ring[ring.len() - 1].0[1]) {
        ring.push(edges.swap_remove(index));
    }
    let is_simple = edges.is_empty() && ring.len() >= 3 && ring[0].0[0] == ring[ring.len() - 1].0[1];
    is_simple.then_some((visible, ring))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(points: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let tetrahedron = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        triangles.iter().map(tetrahedron).sum()
    }

    #[test]
    fn hull_of_a_lattice_is_its_box() {
        // Most points lie in common planes and on common lines. The turn adds rounding errors, like those of a file.
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1);
        for precise in [true, false] {
            let lattice = (0..6 * 5 * 4).map(|n| DVec3::new((n % 6) as f64, (n / 6 % 5) as f64, (n / 30) as f64) / 5.0);
            let points: Vec<DVec3> =
                lattice.map(|p| if precise { p } else { (turn * p).as_vec3().as_dvec3() }).collect();
            let triangles = convex_hull(&points).unwrap();
            // Limit 1e-5: the tolerance of a plane, times the area of the surface.
            assert!((volume(&points, &triangles) - 0.8 * 0.6).abs() < 1e-5);
            for facet in triangles.iter().map(|corners| Facet::new(&points, *corners)) {
                assert!(points.iter().all(|p| facet.distance(*p) < 3.0 * IN_PLANE));
            }
        }
    }

    #[test]
    fn flat_points_have_no_hull() {
        let in_plane: Vec<DVec3> = (0..20).map(|n| DVec3::new((n % 5) as f64, (n / 5) as f64, 1e-8)).collect();
        assert!(convex_hull(&in_plane).is_none());
        assert!(convex_hull(&[DVec3::ONE; 5]).is_none());
        assert!(convex_hull(&[]).is_none());
    }
}
