//! Candidate planes for the next cut of a piece.

use glam::DVec3;

use super::piece::Piece;
use super::section::Edge;
use crate::geometry::convex::half_space::HalfSpace;

/// Largest number of planes along reflex edges.
const MOST_ALONG_EDGES: usize = 32;
/// Number of points at reflex edges whose triples define planes.
const MOST_POINTS: usize = 9;
/// Largest number of reflex edges of which planes are formed.
const MOST_EDGES: usize = 400;
/// Planes are equal if their normals differ by less than this value [-] and ...
const SAME_NORMAL: f64 = 0.05;
/// ... if their distances from a common point differ by less than this value, relative to the size of the body [-].
const SAME_OFFSET: f64 = 0.01;
/// Relative positions of planes normal to the axes, between the ends of the piece [-].
const POSITIONS: [f64; 3] = [0.25, 0.5, 0.75];
/// Sine of the angle between two faces below which they count as one plane face.
const FLAT: f64 = 1e-3;

/// An edge at which the angle inside the body exceeds 180 degrees.
struct ReflexEdge {
    ends: [DVec3; 2],
    /// Outward normals of the two faces.
    normals: [DVec3; 2],
    /// Length of the edge times the sine of the angle between the faces.
    weight: f64,
}

/// Candidate planes: planes along the reflex edges, planes through triples of points at these edges, and planes normal
/// to the axes.
pub(super) fn candidates(piece: &Piece) -> Vec<HalfSpace> {
    let edges = reflex_edges(piece);
    let mut planes = along_edges(&edges);
    planes.extend(through_points(&spread(&edges)));
    let vertices = piece.vertices();
    for normal in DVec3::AXES {
        let [low, high] =
            vertices.iter().map(|v| v.dot(normal)).fold([f64::MAX, f64::MIN], |[l, h], p| [l.min(p), h.max(p)]);
        planes.extend(POSITIONS.map(|share| HalfSpace { normal, offset: low + share * (high - low) }));
    }
    planes
}

/// Sum of the lengths of the reflex edges, times the sines of the angles between their faces.
pub(super) fn reflex_weight(piece: &Piece) -> f64 {
    reflex_edges(piece).iter().map(|edge| edge.weight).sum()
}

fn plane(normal: DVec3, point: DVec3) -> HalfSpace {
    HalfSpace { normal, offset: normal.dot(point) }
}

/// Reflex edges of a piece.
fn reflex_edges(piece: &Piece) -> Vec<ReflexEdge> {
    // Ends of each edge in the order of their numbers, direction of the edge, normal of its face.
    let mut sides: Vec<(Edge, bool, DVec3)> = Vec::new();
    for face in piece.faces() {
        if let Some(normal) = piece.area(face).try_normalize() {
            sides.extend(face.iter().map(|&[a, b]| ([a.min(b), a.max(b)], a < b, normal)));
        }
    }
    sides.sort_by_key(|(edge, is_forward, _)| (*edge, *is_forward));
    let mut edges = Vec::new();
    for same in sides.chunk_by(|a, b| a.0 == b.0) {
        let [(_, false, backward), (edge, true, forward)] = *same else { continue };
        let ends = edge.map(|v| piece.vertices()[v as usize]);
        let along = ends[1] - ends[0];
        let weight = backward.cross(forward).dot(along);
        if weight > FLAT * along.length() {
            edges.push(ReflexEdge { ends, normals: [forward, backward], weight });
        }
    }
    edges
}

/// The planes of the two faces and the bisecting plane of each reflex edge; the planes with the largest total weight.
fn along_edges(edges: &[ReflexEdge]) -> Vec<HalfSpace> {
    let mut edges: Vec<&ReflexEdge> = edges.iter().collect();
    edges.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    let stride = edges.len().div_ceil(MOST_EDGES).max(1);
    let mut planes: Vec<(HalfSpace, f64)> = Vec::new();
    for edge in edges.into_iter().step_by(stride) {
        let [a, b] = edge.normals;
        for normal in [a, b, (a - b).normalize_or(a)] {
            let new = plane(normal, edge.ends[0]);
            let same = |known: &HalfSpace| {
                let near = known.distance(edge.ends[0]).abs().max(known.distance(edge.ends[1]).abs()) < SAME_OFFSET;
                near && known.normal.cross(normal).length() < SAME_NORMAL
            };
            match planes.iter_mut().find(|(known, _)| same(known)) {
                Some((_, weight)) => *weight += edge.weight,
                None => planes.push((new, edge.weight)),
            }
        }
    }
    planes.sort_by(|a, b| b.1.total_cmp(&a.1));
    planes.truncate(MOST_ALONG_EDGES);
    planes.into_iter().map(|(plane, _)| plane).collect()
}

/// Points at the reflex edges, each as far as possible from the points before it.
fn spread(edges: &[ReflexEdge]) -> Vec<DVec3> {
    let points: Vec<DVec3> = edges.iter().flat_map(|edge| edge.ends).collect();
    let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let mut distance: Vec<f64> = points.iter().map(|p| p.distance(middle)).collect();
    let mut chosen = Vec::new();
    while chosen.len() < MOST_POINTS.min(points.len()) {
        let furthest = (0..points.len()).max_by(|a, b| distance[*a].total_cmp(&distance[*b]));
        let Some(point) = furthest.map(|index| points[index]) else { break };
        if chosen.is_empty() {
            distance.fill(f64::MAX);
        }
        chosen.push(point);
        distance.iter_mut().zip(&points).for_each(|(d, p)| *d = d.min(p.distance(point)));
    }
    chosen
}

/// Planes through all triples of the points.
fn through_points(points: &[DVec3]) -> Vec<HalfSpace> {
    let mut planes = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().take(i) {
            for c in &points[..j] {
                let normal = (*b - *a).cross(*c - *a);
                if normal.length() > SAME_OFFSET * SAME_OFFSET {
                    planes.push(plane(normal.normalize(), *a));
                }
            }
        }
    }
    planes
}
