//! A fixed open or closed triangle surface that units can touch, for example a rock, a survey or a model of a mound.
//!
//! The surface is a set of elements that can be nearest to a convex body: triangles, convex edges (ridges) and corners.
//! Edges in flat or concave areas are never nearest and are left out. Border edges, which belong to one triangle only,
//! count as ridges.

use std::collections::HashMap;

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use thiserror::Error;

/// Reason why triangles do not form a usable surface.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TerrainError {
    /// The surface is empty.
    #[error("the surface has no triangles")]
    Empty,
    /// A coordinate is not a finite number.
    #[error("corner {0} has a coordinate that is not a finite number")]
    NotFinite(usize),
    /// A triangle has no area.
    #[error("triangle {triangle} near ({:.6}, {:.6}, {:.6}) m has no area", at.x, at.y, at.z)]
    NoArea { triangle: usize, at: DVec3 },
    /// Two triangles traverse an edge in the same direction, or more than two share it.
    #[error(
        "the triangles at the edge from ({:.6}, {:.6}, {:.6}) to ({:.6}, {:.6}, {:.6}) have opposite orientations, or \
         more than two share the edge", a.x, a.y, a.z, b.x, b.y, b.z
    )]
    NotOriented { a: DVec3, b: DVec3 },
}

/// A triangle, counter-clockwise seen from the units' side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Corners [m].
    pub corners: [DVec3; 3],
    /// Unit normal towards the units.
    pub normal: DVec3,
}

impl Face {
    /// Returns true if the foot of the perpendicular from `point` lies in the triangle, or at most `slack` [m] outside.
    pub fn has_foot_of(&self, point: DVec3, slack: f64) -> bool {
        (0..3).all(|k| {
            let (a, b) = (self.corners[k], self.corners[(k + 1) % 3]);
            self.normal.cross(b - a).dot(point - a) >= -slack * (b - a).length()
        })
    }
}

/// A convex edge or a border edge of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Ridge {
    /// Ends [m].
    pub ends: [DVec3; 2],
    /// Unit vectors normal to the edge that point into its one or two triangles.
    pub into: Vec<DVec3>,
}

/// A vertex at the end of at least one ridge.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// Position [m].
    pub at: DVec3,
    /// Unit vectors along all edges from the corner.
    pub along: Vec<DVec3>,
}

/// An element of the surface that can be nearest to a body.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceElement {
    /// The interior of a triangle.
    Face(Face),
    /// The interior of an edge.
    Ridge(Ridge),
    /// A vertex at the end of a ridge.
    Corner(Corner),
}

impl SurfaceElement {
    fn bounds(&self) -> Aabb {
        match self {
            Self::Face(face) => Aabb::from_points(face.corners.iter().copied()),
            Self::Ridge(ridge) => Aabb::from_points(ridge.ends.iter().copied()),
            Self::Corner(corner) => Aabb::new(corner.at, corner.at),
        }
    }
}

/// Sine of the angle below which two triangles count as one plane [-].
const STRAIGHT: f64 = 1e-6;

/// A triangle counts as a line if (2 area)^2 / (longest edge)^4 is at most this value [-]. Such a triangle has no
/// reliable normal, because a binary STL file stores a coordinate with 24 bits, to 6e-8 of its value.
const LINE: f64 = 1e-14;

/// A fixed triangle surface.
#[derive(Clone)]
pub struct Terrain {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    elements: Vec<SurfaceElement>,
    tree: Bvh,
}

impl std::fmt::Debug for Terrain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Terrain").field("triangles", &self.triangles.len()).finish()
    }
}

impl PartialEq for Terrain {
    fn eq(&self, other: &Self) -> bool {
        self.vertices == other.vertices && self.triangles == other.triangles
    }
}

impl Terrain {
    /// Creates the surface of the given triangles [m], counter-clockwise seen from the units' side.
    ///
    /// # Errors
    /// If there is no triangle, a coordinate is not finite, a triangle has no area, or neighbouring triangles have
    /// opposite orientations.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, TerrainError> {
        if triangles.is_empty() {
            return Err(TerrainError::Empty);
        }
        if let Some(bad) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(TerrainError::NotFinite(bad));
        }
        let corners_of = |triangle: &[u32; 3]| triangle.map(|v| vertices[v as usize]);
        let mut faces = Vec::with_capacity(triangles.len());
        for (index, triangle) in triangles.iter().enumerate() {
            let corners @ [a, b, c] = corners_of(triangle);
            let across = (b - a).cross(c - a);
            let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
            if across.length_squared() <= LINE * longest * longest {
                return Err(TerrainError::NoArea { triangle: index, at: a });
            }
            faces.push(Face { corners, normal: across.normalize() });
        }
        let edges = edges(&vertices, &triangles)?;
        let ridges = ridges(&vertices, &triangles, &faces, &edges);
        let corners = corners(&vertices, &edges, &ridges);
        let elements: Vec<SurfaceElement> = faces
            .into_iter()
            .map(SurfaceElement::Face)
            .chain(ridges.into_iter().map(|(_, ridge)| SurfaceElement::Ridge(ridge)))
            .chain(corners.into_iter().map(SurfaceElement::Corner))
            .collect();
        let boxes: Vec<Aabb> = elements.iter().map(SurfaceElement::bounds).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Ok(Self { vertices, triangles, elements, tree })
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Triangles, counter-clockwise seen from the units' side.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the number of triangles, ridges and corners.
    pub fn element_count(&self) -> u32 {
        self.elements.len() as u32
    }

    /// Lower and upper corner of the axis-aligned bounding box [m].
    pub fn bounds(&self) -> [DVec3; 2] {
        let root = self.tree.root_aabb();
        [root.mins, root.maxs]
    }

    /// Elements whose bounding boxes are nearer than `radius` [m] to `centre`, with their numbers, unordered.
    pub fn near(&self, centre: DVec3, radius: f64) -> impl Iterator<Item = (u32, &SurfaceElement)> {
        let about = Aabb::new(centre - DVec3::splat(radius), centre + DVec3::splat(radius));
        // The result is collected, because the iterator of the tree borrows the local box.
        let found: Vec<u32> = self.tree.intersect_aabb(&about).collect();
        found.into_iter().map(|number| (number, &self.elements[number as usize]))
    }

    /// Level of the highest triangle at (x, y) [m]; `None` outside the surface.
    pub fn level(&self, x: f64, y: f64) -> Option<f64> {
        self.highest(x, y).map(|(level, _)| level)
    }

    /// Level of the highest triangle at (x, y) [m], and whether this triangle faces up; `None` outside the surface.
    pub fn highest(&self, x: f64, y: f64) -> Option<(f64, bool)> {
        let [low, high] = self.bounds();
        let column = Aabb::new(DVec3::new(x, y, low.z), DVec3::new(x, y, high.z));
        let height = |number: u32| match &self.elements[number as usize] {
            SurfaceElement::Face(Face { corners: [a, b, c], normal }) if normal.z.abs() > STRAIGHT => {
                let z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
                let side = |p: &DVec3, q: &DVec3| (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
                let sides = [side(a, b), side(b, c), side(c, a)].map(|s| s * normal.z.signum());
                sides.iter().all(|s| *s >= 0.0).then_some((z, normal.z > 0.0))
            }
            _ => None,
        };
        self.tree.intersect_aabb(&column).filter_map(height).reduce(|a, b| if b.0 > a.0 { b } else { a })
    }
}

/// Every edge (lower and higher vertex index) with the indices of its one or two triangles, sorted by edge.
type Edges = Vec<([u32; 2], Vec<usize>)>;

fn edges(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Edges, TerrainError> {
    let mut sides: HashMap<[u32; 2], [Option<usize>; 2]> = HashMap::with_capacity(2 * triangles.len());
    let mut wrong: Option<[u32; 2]> = None;
    for (index, [a, b, c]) in triangles.iter().copied().enumerate() {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            let (edge, sense) = if p < q { ([p, q], 0) } else { ([q, p], 1) };
            let side = &mut sides.entry(edge).or_default()[sense];
            if side.replace(index).is_some() {
                // The edge with the lowest vertex indices is reported, so that the message is always the same.
                wrong = Some(wrong.map_or(edge, |known| known.min(edge)));
            }
        }
    }
    if let Some([a, b]) = wrong {
        return Err(TerrainError::NotOriented { a: vertices[a as usize], b: vertices[b as usize] });
    }
    let mut edges: Edges =
        sides.into_iter().map(|(edge, sides)| (edge, sides.into_iter().flatten().collect())).collect();
    edges.sort_unstable();
    Ok(edges)
}

/// Convex edges and border edges, with their vertex indices.
fn ridges(vertices: &[DVec3], triangles: &[[u32; 3]], faces: &[Face], edges: &Edges) -> Vec<([u32; 2], Ridge)> {
    let ridge = |(edge, sides): &([u32; 2], Vec<usize>)| {
        let ends = edge.map(|v| vertices[v as usize]);
        let along = (ends[1] - ends[0]).normalize();
        let into = |side: &usize| {
            // `third` is the corner opposite the edge.
            let third = triangles[*side].into_iter().find(|v| !edge.contains(v)).unwrap_or(edge[0]);
            let direction = vertices[third as usize] - ends[0];
            (direction - along * direction.dot(along)).normalize()
        };
        let into: Vec<DVec3> = sides.iter().map(into).collect();
        // The edge is convex if the second triangle lies behind the plane of the first.
        let is_convex = sides.len() == 1 || faces[sides[0]].normal.dot(into[1]) < -STRAIGHT;
        is_convex.then_some((*edge, Ridge { ends, into }))
    };
    edges.iter().filter_map(ridge).collect()
}

/// Corners at the ends of ridges, with the directions of all edges at each corner.
fn corners(vertices: &[DVec3], edges: &Edges, ridges: &[([u32; 2], Ridge)]) -> Vec<Corner> {
    let mut sharp = vec![false; vertices.len()];
    ridges.iter().flat_map(|(edge, _)| edge).for_each(|v| sharp[*v as usize] = true);
    let mut along: Vec<Vec<DVec3>> = vec![Vec::new(); vertices.len()];
    for ([a, b], _) in edges {
        let [a, b] = [*a as usize, *b as usize];
        let direction = (vertices[b] - vertices[a]).normalize();
        along[a].push(direction);
        along[b].push(-direction);
    }
    let corner = |(v, along): (usize, Vec<DVec3>)| sharp[v].then(|| Corner { at: vertices[v], along });
    along.into_iter().enumerate().filter_map(corner).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::geometry::solid::tests::cuboid;

    /// A profile in x, extruded from y = -1 to 1, with two triangles per strip.
    pub(crate) fn extruded_profile(points: &[[f64; 2]]) -> Terrain {
        let at = |i: usize, y: f64| DVec3::new(points[i][0], y, points[i][1]);
        let vertices = (0..points.len()).flat_map(|i| [at(i, -1.0), at(i, 1.0)]).collect();
        let strip = |i: u32| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]];
        let triangles = (0..points.len() as u32 - 1).flat_map(strip).collect();
        Terrain::new(vertices, triangles).unwrap()
    }

    fn count(terrain: &Terrain) -> [usize; 3] {
        let kinds = |kind: fn(&SurfaceElement) -> bool| terrain.elements.iter().filter(|p| kind(p)).count();
        [
            kinds(|p| matches!(p, SurfaceElement::Face(_))),
            kinds(|p| matches!(p, SurfaceElement::Ridge(_))),
            kinds(|p| matches!(p, SurfaceElement::Corner(_))),
        ]
    }

    #[test]
    fn box_has_twelve_ridges_and_eight_corners() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        // The six diagonals lie in flat faces, so they are not ridges.
        assert_eq!(count(&Terrain::new(vertices.clone(), triangles.clone()).unwrap()), [12, 12, 8]);
        let inside_out = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        // Seen from inside, all edges of the box are concave.
        assert_eq!(count(&Terrain::new(vertices, inside_out).unwrap()), [12, 0, 0]);
    }

    #[test]
    fn borders_are_ridges_and_valleys_are_not() {
        // A roof has its top ridge and six border edges; a trough has only the border edges.
        assert_eq!(count(&extruded_profile(&[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])), [4, 7, 6]);
        assert_eq!(count(&extruded_profile(&[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]])), [4, 6, 6]);
    }

    #[test]
    fn level_comes_from_the_highest_triangle() {
        let roof = extruded_profile(&[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
        // 1e-15 allows for rounding errors.
        assert!((roof.level(0.25, 0.3).unwrap() - 0.75).abs() < 1e-15);
        assert_eq!(roof.level(0.25, 1.3), None);
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        assert_eq!(Terrain::new(vertices, triangles).unwrap().level(0.3, 0.4), Some(1.0));
    }

    #[test]
    fn highest_tells_whether_the_surface_faces_up() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        assert_eq!(Terrain::new(vertices.clone(), triangles.clone()).unwrap().highest(0.3, 0.4), Some((1.0, true)));
        let inside_out = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        assert_eq!(Terrain::new(vertices, inside_out).unwrap().highest(0.3, 0.4), Some((1.0, false)));
    }

    #[test]
    fn invalid_surfaces_are_rejected() {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        assert_eq!(Terrain::new(vertices.clone(), Vec::new()), Err(TerrainError::Empty));
        let mut turned = triangles.clone();
        turned[3].swap(0, 1);
        let error = Terrain::new(vertices.clone(), turned).unwrap_err();
        assert!(matches!(error, TerrainError::NotOriented { .. }), "{error}");
        let mut twice = triangles.clone();
        twice.push(triangles[0]);
        assert!(matches!(Terrain::new(vertices.clone(), twice), Err(TerrainError::NotOriented { .. })));
        let mut flat = vertices.clone();
        flat[1] = flat[0] + 1e-9 * DVec3::Y;
        assert!(matches!(Terrain::new(flat, triangles.clone()), Err(TerrainError::NoArea { .. })));
        let mut far = vertices;
        far[2].x = f64::INFINITY;
        assert_eq!(Terrain::new(far, triangles), Err(TerrainError::NotFinite(2)));
    }
}
