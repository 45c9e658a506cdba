//! Closed bodies with plane faces, and their cutting by planes.
//!
//! A face is a set of directed edges in a plane; the body lies to their left, seen from outside. A face may have holes
//! and needs no triangles. Every edge of a face occurs with the opposite direction in another face. A cut preserves
//! this property without tolerances: it counts, for every vertex, the edges that arrive and leave.

use std::collections::HashMap;

use glam::DVec3;

use super::section::{self, Edge};
use crate::geometry::convex::half_space::HalfSpace;

/// Distance below which a vertex lies on the plane of a cut. Lengths are relative to the size of the whole body. The
/// value exceeds the rounding errors of the single-precision coordinates of an STL file.
const ON_PLANE: f64 = 1e-6;
/// Volume below which a piece is a rounding error of a cut, relative to the cube of the size of the whole body [-].
const NEGLIGIBLE_VOLUME: f64 = 1e-9;

/// A connected body with plane faces. The whole body has a size of about 1.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    vertices: Vec<DVec3>,
    faces: Faces,
}

/// Directed edges of faces, as pairs of vertex indices.
#[derive(Debug, Clone, Default)]
struct Faces {
    edges: Vec<Edge>,
    /// For each face, the index behind its last edge.
    ends: Vec<usize>,
}

impl Faces {
    fn push(&mut self, edges: &[Edge]) {
        self.edges.extend(edges);
        self.ends.push(self.edges.len());
    }

    fn iter(&self) -> impl Iterator<Item = &[Edge]> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, end)| &self.edges[begin..*end])
    }
}

impl Piece {
    /// Creates the piece inside a closed triangle surface.
    pub(super) fn new(vertices: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let mut faces = Faces::default();
        triangles.iter().for_each(|[a, b, c]| faces.push(&[[*a, *b], [*b, *c], [*c, *a]]));
        Self { vertices, faces }
    }

    pub(super) fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Edges of each face.
    pub(super) fn faces(&self) -> impl Iterator<Item = &[Edge]> {
        self.faces.iter()
    }

    /// Vector normal to a face, outwards, with the area of the face as its length.
    pub(super) fn area(&self, face: &[Edge]) -> DVec3 {
        section::area(&self.vertices, face)
    }

    /// Volume by the divergence theorem: the sum of p . A / 3 over the faces, with a point p of the face.
    pub(super) fn volume(&self) -> f64 {
        let origin = self.vertices[0];
        self.faces().map(|face| (self.vertices[face[0][0] as usize] - origin).dot(self.area(face)) / 3.0).sum()
    }

    /// Connected pieces on both sides of a plane.
    pub(super) fn cut(&self, plane: &HalfSpace) -> Vec<Piece> {
        let opposite = HalfSpace { normal: -plane.normal, offset: -plane.offset };
        let mut pieces = self.behind(plane);
        pieces.extend(self.behind(&opposite));
        pieces
    }

    /// Connected pieces of the body in a half-space.
    fn behind(&self, half_space: &HalfSpace) -> Vec<Piece> {
        let height = |v: &DVec3| {
            let distance = half_space.distance(*v);
            if distance.abs() < ON_PLANE { 0.0 } else { distance }
        };
        let mut clip = Clip {
            heights: self.vertices.iter().map(height).collect(),
            vertices: self.vertices.clone(),
            crossings: HashMap::new(),
        };
        let mut kept = Faces::default();
        for face in self.faces() {
            let heights = || face.iter().map(|[a, _]| clip.heights[*a as usize]);
            let (has_low, has_high) = (heights().any(|h| h < 0.0), heights().any(|h| h > 0.0));
            if has_low && has_high {
                let area = self.area(face);
                let edges = clip.face(face, half_space.normal.cross(area));
                // A cut triangle stays connected, but another face may fall apart.
                if face.len() == 3 {
                    kept.push(&edges);
                } else {
                    let parts = section::polygons(&clip.vertices, edges.into_iter(), area);
                    parts.iter().for_each(|part| kept.push(part));
                }
            } else if has_low || (!has_high && self.area(face).dot(half_space.normal) > 0.0) {
                // A face in the plane belongs to the body below it.
                kept.push(face);
            }
        }
        let Clip { vertices, heights, .. } = clip;
        let in_plane = kept.edges.iter().filter(|edge| edge.iter().all(|v| heights[*v as usize] == 0.0));
        for cap in section::polygons(&vertices, in_plane.map(|[a, b]| [*b, *a]), half_space.normal) {
            kept.push(&cap);
        }
        connected(&vertices, &kept)
    }
}

/// State of a cut by a plane.
struct Clip {
    vertices: Vec<DVec3>,
    /// Distance of each vertex from the plane; zero within the tolerance.
    heights: Vec<f64>,
    /// Vertex at which an edge crosses the plane. The lower vertex index of the edge comes first.
    crossings: HashMap<Edge, u32>,
}

impl Clip {
    /// Edges of the part of a face below the plane. The edges along the plane follow from the other edges: between two
    /// neighbouring vertices on the plane, there are as many edges as have arrived but not left so far.
    fn face(&mut self, face: &[Edge], along: DVec3) -> Vec<Edge> {
        let (mut kept, mut on_plane) = (Vec::new(), Vec::new());
        for &[a, b] in face {
            let [below_a, below_b] = [a, b].map(|v| self.heights[v as usize] < 0.0);
            match (below_a, below_b) {
                (true, true) => kept.push([a, b]),
                (true, false) => {
                    let c = self.crossing(a, b);
                    kept.push([a, c]);
                    on_plane.push((c, 1));
                }
                (false, true) => {
                    let c = self.crossing(b, a);
                    kept.push([c, b]);
                    on_plane.push((c, -1));
                }
                (false, false) if self.heights[a as usize] == 0.0 => on_plane.push((a, 0)),
                (false, false) => {}
            }
        }
        let position = |v: u32| self.vertices[v as usize].dot(along);
        on_plane.sort_by(|(a, _), (b, _)| position(*a).total_cmp(&position(*b)).then(a.cmp(b)));
        let mut excess: i32 = 0;
        for pair in on_plane.windows(2) {
            let [(from, arrived), (to, _)] = [pair[0], pair[1]];
            excess += arrived;
            if from != to {
                let edge = if excess > 0 { [from, to] } else { [to, from] };
                kept.extend(std::iter::repeat_n(edge, excess.unsigned_abs() as usize));
            }
        }
        kept
    }

    /// Vertex on the plane of an edge from a vertex below to a vertex not below.
    fn crossing(&mut self, below: u32, other: u32) -> u32 {
        let [h_below, h_other] = [below, other].map(|v| self.heights[v as usize]);
        if h_other == 0.0 {
            return other;
        }
        *self.crossings.entry([below.min(other), below.max(other)]).or_insert_with(|| {
            let [a, b] = [below, other].map(|v| self.vertices[v as usize]);
            self.vertices.push(a.lerp(b, h_below / (h_below - h_other)));
            self.heights.push(0.0);
            (self.vertices.len() - 1) as u32
        })
    }
}

/// Divides faces into connected bodies. The surface of a cavity goes to the body around it.
fn connected(vertices: &[DVec3], faces: &Faces) -> Vec<Piece> {
    // All edges of a face belong together, also those of its holes.
    let links = faces.iter().flat_map(|face| face.iter().flat_map(|[a, b]| [[*a, *b], [face[0][0], *a]]));
    let group = section::groups(vertices.len(), links);
    let mut number: HashMap<u32, usize> = HashMap::new();
    let mut bodies: Vec<Faces> = Vec::new();
    for face in faces.iter().filter(|face| !face.is_empty()) {
        let index = *number.entry(group[face[0][0] as usize]).or_insert(bodies.len());
        if index == bodies.len() {
            bodies.push(Faces::default());
        }
        bodies[index].push(face);
    }
    let pieces = bodies.iter().map(|faces| compact(vertices, faces));
    let (mut pieces, hollow): (Vec<_>, Vec<_>) =
        pieces.filter(|piece| piece.volume().abs() > NEGLIGIBLE_VOLUME).partition(|piece| piece.volume() > 0.0);
    for cavity in hollow {
        let around = |piece: &&mut Piece| {
            let ([low, high], [inner_low, inner_high]) = (bounds(piece), bounds(&cavity));
            low.cmple(inner_low).all() && high.cmpge(inner_high).all()
        };
        if let Some(body) = pieces.iter_mut().filter(around).min_by(|a, b| a.volume().total_cmp(&b.volume())) {
            let first = body.vertices.len() as u32;
            body.vertices.extend(&cavity.vertices);
            cavity.faces().for_each(|face| {
                let moved: Vec<Edge> = face.iter().map(|edge| edge.map(|v| v + first)).collect();
                body.faces.push(&moved);
            });
        }
    }
    pieces
}

fn bounds(piece: &Piece) -> [DVec3; 2] {
    piece.vertices.iter().fold([DVec3::MAX, DVec3::MIN], |[low, high], v| [low.min(*v), high.max(*v)])
}

/// The piece with only the vertices that its faces use.
fn compact(vertices: &[DVec3], faces: &Faces) -> Piece {
    let mut index = vec![u32::MAX; vertices.len()];
    let mut used = Vec::new();
    let mut renumber = |v: u32| {
        let new = &mut index[v as usize];
        if *new == u32::MAX {
            *new = used.len() as u32;
            used.push(vertices[v as usize]);
        }
        *new
    };
    let edges = faces.edges.iter().map(|edge| edge.map(&mut renumber)).collect();
    Piece { vertices: used, faces: Faces { edges, ends: faces.ends.clone() } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::convex::polyhedron::Polyhedron;
    use crate::geometry::convex::union;
    use crate::geometry::solid::tests::cuboid;

    fn piece(boxes: &[[[f64; 3]; 2]]) -> Piece {
        let block = |[low, high]: &[[f64; 3]; 2]| Polyhedron::hull(&cuboid((*low).into(), (*high).into()).0).unwrap();
        let (vertices, triangles) = union::surface(&boxes.iter().map(block).collect::<Vec<_>>());
        Piece::new(vertices, &triangles)
    }

    fn volumes(pieces: &[Piece]) -> Vec<f64> {
        let mut volumes: Vec<f64> = pieces.iter().map(|piece| (piece.volume() * 1e9).round() / 1e9).collect();
        volumes.sort_by(f64::total_cmp);
        volumes
    }

    fn plane(normal: DVec3, offset: f64) -> HalfSpace {
        HalfSpace { normal, offset }
    }

    /// Square frame around a square hole.
    fn frame() -> Piece {
        piece(&[
            [[0.0, 0.0, 0.0], [3.0, 1.0, 1.0]],
            [[0.0, 2.0, 0.0], [3.0, 3.0, 1.0]],
            [[0.0, 1.0, 0.0], [1.0, 2.0, 1.0]],
            [[2.0, 1.0, 0.0], [3.0, 2.0, 1.0]],
        ])
    }

    #[test]
    fn cut_in_the_plane_of_a_face_divides_at_the_step() {
        let step = piece(&[[[0.0, 0.0, 0.0], [2.0, 1.0, 1.0]], [[0.0, 0.0, 1.0], [1.0, 1.0, 2.0]]]);
        let pieces = step.cut(&plane(DVec3::Z, 1.0));
        assert_eq!(volumes(&pieces), [1.0, 2.0]);
        // The upper piece has no flap along the plane of the cut.
        let upper = pieces.iter().find(|piece| piece.volume() < 1.5).unwrap();
        assert!(upper.vertices().iter().all(|v| v.x < 1.0 + 1e-9));
        // A plane that only touches the body does not cut it.
        assert_eq!(volumes(&step.cut(&plane(DVec3::Z, 2.0))), [3.0]);
    }

    #[test]
    fn cut_through_a_hole_gives_separate_pieces() {
        assert_eq!(volumes(&frame().cut(&plane(DVec3::Y, 1.0))), [3.0, 5.0]);
        let sides = frame().cut(&plane(DVec3::Y, 1.0)).into_iter().find(|piece| piece.volume() > 4.0).unwrap();
        assert_eq!(volumes(&sides.cut(&plane(DVec3::Y, 2.0))), [1.0, 1.0, 3.0]);
    }

    #[test]
    fn section_with_a_hole_keeps_the_hole() {
        let pieces = frame().cut(&plane(DVec3::Z, 0.25));
        assert_eq!(volumes(&pieces), [2.0, 6.0]);
        // The hole of the section remains open in the next cut.
        let upper = pieces.into_iter().find(|piece| piece.volume() > 3.0).unwrap();
        assert_eq!(volumes(&upper.cut(&plane(DVec3::X, 1.5))), [3.0, 3.0]);
    }

    #[test]
    fn cavity_stays_in_the_body_around_it() {
        let (mut vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::splat(3.0));
        let (inner, around) = cuboid(DVec3::ONE, DVec3::splat(2.0));
        vertices.extend(inner);
        triangles.extend(around.iter().map(|[a, b, c]| [a + 8, c + 8, b + 8]));
        let hollow = Piece::new(vertices, &triangles);
        assert_eq!(volumes(&hollow.cut(&plane(DVec3::X, 0.5))), [4.5, 21.5]);
        assert_eq!(volumes(&hollow.cut(&plane(DVec3::X, 1.5))), [13.0, 13.0]);
    }

    #[test]
    fn oblique_cuts_preserve_the_volume() {
        for k in 0..40 {
            let (a, b) = (0.7 * f64::from(k), 0.37 * f64::from(k));
            let normal = DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos());
            let cut = |piece: &Piece| piece.cut(&plane(normal, normal.dot(DVec3::new(1.0, 1.0, 0.5))));
            let turned = HalfSpace { normal: normal.any_orthonormal_vector(), offset: 0.3 };
            let pieces: Vec<Piece> = cut(&frame()).iter().flat_map(|piece| piece.cut(&turned)).collect();
            let total: f64 = pieces.iter().map(Piece::volume).sum();
            // Limit 1e-4: the tolerance of a plane, times the area of the sections.
            assert!((total - 8.0).abs() < 1e-4, "{k}: {total}");
        }
    }
}
