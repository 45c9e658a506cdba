//! Faces of a tetrahedral mesh: interfaces between two tetrahedra, where joints are inserted, and exterior faces.
//!
//! Common faces are found by sorting 128-bit keys. A key consists of the three node numbers of a face in ascending
//! order, and the number of the face.

use std::array;

use glam::DVec3;

use super::Mesh;
use super::defect::{MeshDefect, Spot};

/// Corners of each face of a tetrahedron, anticlockwise seen from outside. Face k lies opposite to corner k.
pub const LOCAL_FACES: [[u8; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Largest number of tetrahedra whose faces can be numbered with 32 bits.
pub const MOST_TETS: usize = u32::MAX as usize / 4;

/// Marks a face that belongs to only one tetrahedron.
const NONE: u32 = u32::MAX;

/// A face between two tetrahedra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interface {
    /// Numbers of the two tetrahedra, in ascending order.
    pub tets: [u32; 2],
    /// Corner numbers (0 to 3) of the face in each tetrahedron. Entries with the same index are the same mesh node. The
    /// corners are anticlockwise seen from the second tetrahedron, so the normal points from the first to the second.
    pub nodes: [[u8; 3]; 2],
}

/// A face on the outside of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exterior {
    /// Number of the tetrahedron of the face.
    pub tet: u32,
    /// Corner numbers (0 to 3) of the face in the tetrahedron, anticlockwise seen from outside.
    pub nodes: [u8; 3],
}

/// A named set of faces.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceSet {
    /// Name of the physical surface.
    pub name: String,
    /// Numbers of the faces, in ascending order without duplicates.
    pub faces: Vec<u32>,
}

/// All faces of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Faces {
    /// Faces between two tetrahedra, sorted by the number of the first tetrahedron.
    pub interfaces: Vec<Interface>,
    /// Faces on the outside, sorted by the number of their tetrahedron.
    pub exteriors: Vec<Exterior>,
    /// Pre-cracks: sets of interfaces.
    pub cracks: Vec<FaceSet>,
    /// Boundaries: sets of exterior faces.
    pub boundaries: Vec<FaceSet>,
}

impl Faces {
    /// Finds the faces of a mesh, and checks that the triangles of its named sets are faces.
    ///
    /// In a valid mesh, at most two tetrahedra share a face, and they lie on opposite sides of the face. The exterior
    /// faces then form a closed surface. Each edge borders an even number of exterior faces: usually two, but four or
    /// more where the body touches itself along an edge.
    ///
    /// # Panics
    /// If the mesh has more than [`MOST_TETS`] tetrahedra.
    pub fn new(mesh: &Mesh) -> Result<Self, MeshDefect> {
        assert!(mesh.tets.len() <= MOST_TETS, "{} tetrahedra are too many", mesh.tets.len());
        let keys = sorted_keys(mesh);
        let partner = partners(mesh, &keys)?;
        let mut faces = Self::default();
        // Index of each face in the list of interfaces or of exterior faces.
        let mut index = vec![NONE; partner.len()];
        for (id, &other) in (0..).zip(&partner) {
            if other == NONE {
                index[id as usize] = faces.exteriors.len() as u32;
                faces.exteriors.push(Exterior { tet: id / 4, nodes: LOCAL_FACES[id as usize % 4] });
            } else if id < other {
                let interface = interface(mesh, id, other).ok_or_else(|| same_side(mesh, id, other))?;
                index[id as usize] = faces.interfaces.len() as u32;
                index[other as usize] = faces.interfaces.len() as u32;
                faces.interfaces.push(interface);
            }
        }
        for set in &mesh.sets {
            let ids: Vec<Option<u32>> = set.triangles.iter().map(|triangle| find_face(&keys, *triangle)).collect();
            let count = ids.len();
            // Returns the number of triangles for which `misfit` is true, and the centre of the first such triangle.
            let misfits = |misfit: &dyn Fn(&Option<u32>) -> bool| {
                let first = ids.iter().position(misfit)?;
                Some((ids.iter().filter(|id| misfit(id)).count(), centre(mesh, set.triangles[first])))
            };
            let name = set.name.clone();
            if let Some((hanging, at)) = misfits(&Option::is_none) {
                return Err(MeshDefect::HangingTriangles { set: name, hanging, count, at });
            }
            let on_outside = |id: &Option<u32>| id.is_some_and(|id| partner[id as usize] == NONE);
            if set.is_crack() {
                if let Some((outside, at)) = misfits(&on_outside) {
                    return Err(MeshDefect::CrackOutside { set: name, outside, count, at });
                }
            } else if let Some((inside, at)) = misfits(&|id| !on_outside(id)) {
                return Err(MeshDefect::BoundaryInside { set: name, inside, count, at });
            }
            let mut numbers: Vec<u32> = ids.into_iter().flatten().map(|id| index[id as usize]).collect();
            numbers.sort_unstable();
            numbers.dedup();
            let sets = if set.is_crack() { &mut faces.cracks } else { &mut faces.boundaries };
            sets.push(FaceSet { name, faces: numbers });
        }
        Ok(faces)
    }
}

/// Returns the nodes of face `id`, in the corner order of its tetrahedron. Tetrahedron t has the faces 4 t to 4 t + 3.
fn face_nodes(mesh: &Mesh, id: u32) -> [u32; 3] {
    LOCAL_FACES[id as usize % 4].map(|v| mesh.tets[id as usize / 4][v as usize])
}

/// Returns the key of a triangle: its sorted nodes in the upper 96 bits; the lower 32 bits are zero.
fn key(mut nodes: [u32; 3]) -> u128 {
    nodes.sort_unstable();
    nodes.iter().fold(0, |key, node| (key << 32) | u128::from(*node)) << 32
}

/// Returns the keys of all faces in ascending order, with the face numbers in the lower 32 bits.
fn sorted_keys(mesh: &Mesh) -> Vec<u128> {
    let faces = 0..4 * mesh.tets.len() as u32;
    let mut keys: Vec<u128> = faces.map(|id| key(face_nodes(mesh, id)) | u128::from(id)).collect();
    keys.sort_unstable();
    keys
}

/// For every face, returns the number of the same face in the neighbouring tetrahedron; [`NONE`] without a neighbour.
fn partners(mesh: &Mesh, keys: &[u128]) -> Result<Vec<u32>, MeshDefect> {
    let mut partner = vec![NONE; keys.len()];
    for same in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
        match *same {
            [_] => {}
            [a, b] => {
                let [a, b] = [a, b].map(|key| key as u32);
                partner[a as usize] = b;
                partner[b as usize] = a;
            }
            _ => {
                let [first, second] = array::from_fn(|i| spot(mesh, same[i] as u32));
                return Err(MeshDefect::CrowdedFace { body: body_name(mesh, same[0] as u32), first, second });
            }
        }
    }
    Ok(partner)
}

/// Creates the interface from two faces with the same nodes; `None` if both tetrahedra lie on the same side of the
/// face.
fn interface(mesh: &Mesh, id: u32, other: u32) -> Option<Interface> {
    let tets = [id / 4, other / 4];
    let corners = LOCAL_FACES[id as usize % 4];
    let nodes = face_nodes(mesh, id);
    let second = mesh.tets[tets[1] as usize];
    // Every node of the face belongs to the second tetrahedron.
    let matching = nodes.map(|node| second.iter().position(|other| *other == node).unwrap_or_default() as u8);
    // The second tetrahedron must list the corners of the face in the opposite sense; it may start at any corner.
    let [a, b, c] = LOCAL_FACES[other as usize % 4];
    let opposite = [[a, c, b], [c, b, a], [b, a, c]].contains(&matching);
    opposite.then_some(Interface { tets, nodes: [corners, matching] })
}

/// Returns the number of the face with the nodes of a triangle; `None` if there is no such face.
fn find_face(keys: &[u128], triangle: [u32; 3]) -> Option<u32> {
    let key = key(triangle);
    let found = *keys.get(keys.partition_point(|other| *other < key))?;
    (found >> 32 == key >> 32).then_some(found as u32)
}

fn centre(mesh: &Mesh, triangle: [u32; 3]) -> DVec3 {
    triangle.iter().map(|node| mesh.nodes[*node as usize]).sum::<DVec3>() / 3.0
}

fn same_side(mesh: &Mesh, id: u32, other: u32) -> MeshDefect {
    MeshDefect::SameSide { body: body_name(mesh, id), first: spot(mesh, id), second: spot(mesh, other) }
}

fn spot(mesh: &Mesh, id: u32) -> Spot {
    let tet = id as usize / 4;
    Spot { tag: mesh.tet_tags[tet], at: mesh.centroid(tet) }
}

fn body_name(mesh: &Mesh, id: u32) -> String {
    mesh.body_of(id as usize / 4).name.clone()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::block::{Pattern, block};
    use super::super::{Body, TriangleSet, order};
    use super::*;

    fn positions(mesh: &Mesh, tet: u32, nodes: [u8; 3]) -> [DVec3; 3] {
        nodes.map(|v| mesh.corners(tet as usize)[v as usize])
    }

    /// Outward area vector of a triangle [m2].
    fn area([a, b, c]: [DVec3; 3]) -> DVec3 {
        (b - a).cross(c - a) / 2.0
    }

    fn with_set(name: &str, region: impl Fn(DVec3) -> bool) -> Mesh {
        let mut mesh = block(DVec3::ONE, [2; 3], Pattern::Diagonal);
        mesh.sets = vec![TriangleSet { name: name.to_owned(), triangles: mesh.faces_within(region) }];
        mesh
    }

    #[test]
    fn local_face_normals_point_away_from_the_opposite_corner() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        for (opposite, face) in LOCAL_FACES.iter().enumerate() {
            let [a, b, c] = face.map(|v| corners[v as usize]);
            assert!(area([a, b, c]).dot(corners[opposite] - a) < 0.0);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn faces_match_node_by_node_and_close_the_body(
            cells in prop::array::uniform3(1usize..4),
            centred: bool,
            sorted: bool,
            turns in prop::collection::vec(0usize..12, 24),
        ) {
            let pattern = if centred { Pattern::Centred } else { Pattern::Diagonal };
            let mut mesh = block(DVec3::new(1.0, 0.7, 0.4), cells, pattern);
            // Renumbers the corners of each tetrahedron by even permutations, which keep its volume positive.
            for (tet, turn) in mesh.tets.iter_mut().zip(turns.iter().cycle()) {
                tet[..3].rotate_left(turn % 3);
                for _ in 0..turn / 3 {
                    *tet = [tet[1], tet[2], tet[0], tet[3]];
                    *tet = [tet[0], tet[2], tet[3], tet[1]];
                }
            }
            if sorted {
                mesh = order::along_curve(&mesh);
            }
            let faces = Faces::new(&mesh).unwrap();
            prop_assert_eq!(4 * mesh.tets.len(), 2 * faces.interfaces.len() + faces.exteriors.len());
            prop_assert!(faces.interfaces.is_sorted_by_key(|face| face.tets[0]));
            prop_assert!(faces.exteriors.is_sorted_by_key(|face| face.tet));
            for Interface { tets, nodes } in &faces.interfaces {
                prop_assert!(tets[0] < tets[1]);
                let [own, other] = [0, 1].map(|i| nodes[i].map(|v| mesh.tets[tets[i] as usize][v as usize]));
                prop_assert_eq!(own, other);
                let way = mesh.centroid(tets[1] as usize) - mesh.centroid(tets[0] as usize);
                prop_assert!(area(positions(&mesh, tets[0], nodes[0])).dot(way) > 0.0);
            }
            // Gauss's theorem: on a closed surface, the area vectors A of the faces add up to 0. The products x.A, with
            // a point x of each face, add up to three times the volume.
            let outside = faces.exteriors.iter().map(|face| positions(&mesh, face.tet, face.nodes));
            let (mut sum, mut volume) = (DVec3::ZERO, 0.0);
            for corners in outside {
                sum += area(corners);
                volume += area(corners).dot(corners[0]) / 3.0;
            }
            // Tolerance: rounding of sums of a few hundred terms of order one.
            prop_assert!(sum.length() < 1e-13 && (volume - 0.28).abs() < 1e-13);
        }
    }

    #[test]
    fn cracks_must_be_inside_and_boundaries_outside() {
        let mesh = with_set("crack", |node| node.x == 0.5);
        let faces = Faces::new(&mesh).unwrap();
        assert_eq!((faces.cracks[0].faces.len(), faces.boundaries.len()), (8, 0));
        for number in &faces.cracks[0].faces {
            let Interface { tets, nodes } = faces.interfaces[*number as usize];
            assert!(positions(&mesh, tets[0], nodes[0]).iter().all(|corner| corner.x == 0.5));
        }
        let error = Faces::new(&with_set("crack", |node| node.x >= 0.5)).unwrap_err();
        assert!(matches!(error, MeshDefect::CrackOutside { outside: 24, .. }), "{error}");
        let error = Faces::new(&with_set("middle", |node| node.x == 0.5)).unwrap_err();
        assert!(matches!(error, MeshDefect::BoundaryInside { inside: 8, count: 8, .. }), "{error}");
    }

    #[test]
    fn triangles_that_are_not_faces_of_tetrahedra_are_counted() {
        let mut mesh = with_set("side", |node| node.x == 0.0);
        let far = mesh.nodes.iter().position(|node| *node == DVec3::ONE).unwrap() as u32;
        mesh.sets[0].triangles[2][1] = far;
        let error = Faces::new(&mesh).unwrap_err().to_string();
        assert!(error.contains("1 of 8 triangles are not faces"), "{error}");
        mesh.sets[0].triangles = vec![[1, 1, 1]; 2];
        assert!(matches!(Faces::new(&mesh), Err(MeshDefect::HangingTriangles { hanging: 2, count: 2, .. })));
    }

    #[test]
    fn a_triangle_that_is_listed_twice_counts_once() {
        let mut mesh = with_set("side", |node| node.x == 0.0);
        let again: Vec<[u32; 3]> = mesh.sets[0].triangles.iter().map(|[a, b, c]| [*c, *b, *a]).collect();
        mesh.sets[0].triangles.extend(again);
        assert_eq!(Faces::new(&mesh).unwrap().boundaries[0].faces.len(), 8);
    }

    #[test]
    fn tetrahedra_that_fill_the_same_space_are_refused() {
        let nodes = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::splat(0.2), DVec3::new(0.1, 0.1, -1.0)];
        let mesh = |tets: &[[u32; 4]]| Mesh {
            nodes: nodes.to_vec(),
            node_tags: (1..=6).collect(),
            tets: tets.to_vec(),
            tet_tags: (1..).take(tets.len()).collect(),
            bodies: vec![Body { name: "unit".to_owned(), tets: 0..tets.len() }],
            sets: Vec::new(),
            node_sets: Vec::new(),
        };
        assert!(Faces::new(&mesh(&[[0, 1, 2, 3], [0, 2, 1, 5]])).is_ok());
        let same_side = Faces::new(&mesh(&[[0, 1, 2, 3], [0, 1, 2, 4]])).unwrap_err();
        assert!(matches!(same_side, MeshDefect::SameSide { .. }), "{same_side}");
        let crowded = Faces::new(&mesh(&[[0, 1, 2, 3], [0, 1, 2, 4], [0, 2, 1, 5]])).unwrap_err();
        assert!(matches!(crowded, MeshDefect::CrowdedFace { .. }), "{crowded}");
        let twice = Faces::new(&mesh(&[[0, 1, 2, 3], [1, 2, 0, 3]])).unwrap_err();
        assert!(matches!(twice, MeshDefect::SameSide { .. }), "{twice}");
    }
}
