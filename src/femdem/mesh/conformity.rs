//! Checks that bodies share no nodes, and that each body is one piece with a conforming mesh without overlaps.
//!
//! If two touching parts of a body do not share nodes, each part gets a free surface there. Such a mesh looks correct,
//! but the body falls apart in the first time step. The checks find this error, because the surface of such a body
//! touches or intersects itself.

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{PointQuery, intersection_test};
use parry3d_f64::shape::Triangle;

use super::defect::{MeshDefect, Spot};
use super::faces::{Exterior, Faces};
use super::{Body, Mesh};

/// Distance up to which a node counts as lying on a face, divided by the shortest edge of the surface [-]. This value
/// is far above the rounding errors of coordinates, and far below any gap that a mesh can resolve.
const TOUCHING: f64 = 1e-6;

/// Marks a node that no body has used yet.
const NOBODY: usize = usize::MAX;

/// Checks that no node belongs to two bodies.
pub(super) fn check_bodies_apart(mesh: &Mesh) -> Result<(), MeshDefect> {
    let mut owner = vec![NOBODY; mesh.nodes.len()];
    for (number, body) in mesh.bodies.iter().enumerate() {
        let mut shared: Vec<u32> = Vec::new();
        for node in mesh.tets[body.tets.clone()].iter().flatten() {
            let owner = &mut owner[*node as usize];
            if *owner == NOBODY {
                *owner = number;
            } else if *owner != number {
                shared.push(*node);
            }
        }
        shared.sort_unstable();
        shared.dedup();
        if let Some(first) = shared.first() {
            let other = owner[*first as usize];
            let count = shared.iter().filter(|node| owner[**node as usize] == other).count();
            let [one, other] = [other, number].map(|number| mesh.bodies[number].name.clone());
            return Err(MeshDefect::SharedNodes { one, other, count, first: node_spot(mesh, *first) });
        }
    }
    Ok(())
}

/// Checks that common faces connect all tetrahedra of each body. In this check, the faces of pre-cracks also connect
/// tetrahedra.
pub(super) fn check_one_piece(mesh: &Mesh, faces: &Faces) -> Result<(), MeshDefect> {
    // Union-find: each tetrahedron points to itself or to a lower-numbered tetrahedron of the same piece. The chain of
    // these links ends at the first tetrahedron of the piece.
    let mut leader: Vec<u32> = (0..mesh.tets.len() as u32).collect();
    for interface in &faces.interfaces {
        let [a, b] = interface.tets.map(|tet| find_leader(&mut leader, tet));
        leader[a.max(b) as usize] = a.min(b);
    }
    for body in &mesh.bodies {
        let firsts = || body.tets.clone().filter(|tet| leader[*tet] as usize == *tet);
        if let Some(second) = firsts().nth(1) {
            let second = Spot { tag: mesh.tet_tags[second], at: mesh.centroid(second) };
            return Err(MeshDefect::Pieces { body: body.name.clone(), pieces: firsts().count(), second });
        }
    }
    Ok(())
}

/// Returns the first tetrahedron of the piece to which `tet` belongs, and shortens the chain of links for later calls.
fn find_leader(leader: &mut [u32], mut tet: u32) -> u32 {
    while leader[tet as usize] != tet {
        leader[tet as usize] = leader[leader[tet as usize] as usize];
        tet = leader[tet as usize];
    }
    tet
}

/// Checks that the surface of each body does not touch or intersect itself, except at shared nodes.
pub(super) fn check_surface(mesh: &Mesh, faces: &Faces) -> Result<(), MeshDefect> {
    for body in &mesh.bodies {
        let bound = |tet: usize| faces.exteriors.partition_point(|face| (face.tet as usize) < tet);
        let surface = Surface::new(mesh, &faces.exteriors[bound(body.tets.start)..bound(body.tets.end)]);
        surface.check_nodes(mesh, body)?;
        if let Some(at) = surface.first_cut() {
            return Err(MeshDefect::CutsItself { body: body.name.clone(), at });
        }
    }
    Ok(())
}

/// Exterior faces of a body, with a bounding volume tree for spatial search.
struct Surface {
    corners: Vec<[u32; 3]>,
    triangles: Vec<Triangle>,
    boxes: Vec<Aabb>,
    tree: Bvh,
}

impl Surface {
    fn new(mesh: &Mesh, exteriors: &[Exterior]) -> Self {
        let nodes = |face: &Exterior| face.nodes.map(|v| mesh.tets[face.tet as usize][v as usize]);
        let corners: Vec<[u32; 3]> = exteriors.iter().map(nodes).collect();
        let position = |node: u32| mesh.nodes[node as usize];
        let triangle = |[a, b, c]: &[u32; 3]| Triangle::new(position(*a), position(*b), position(*c));
        let triangles: Vec<Triangle> = corners.iter().map(triangle).collect();
        let boxes: Vec<Aabb> = triangles.iter().map(Triangle::local_aabb).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { corners, triangles, boxes, tree }
    }

    /// Checks that every node that lies on a face is a corner of this face.
    fn check_nodes(&self, mesh: &Mesh, body: &Body) -> Result<(), MeshDefect> {
        let edges = self.triangles.iter().flat_map(|triangle| triangle.edges().map(|edge| edge.length()));
        let tolerance = TOUCHING * edges.fold(f64::INFINITY, f64::min);
        let mut nodes = self.corners.as_flattened().to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let mut coincident: Vec<[u32; 2]> = Vec::new();
        let mut hanging: Vec<u32> = Vec::new();
        for &node in &nodes {
            let at = mesh.nodes[node as usize];
            let near = Aabb::new(at - DVec3::splat(tolerance), at + DVec3::splat(tolerance));
            let faces = self.tree.intersect_aabb(&near).map(|face| face as usize);
            let mut touched = faces.filter(|&face| {
                let distance = |face: usize| self.triangles[face].distance_to_local_point(at, false);
                !self.corners[face].contains(&node) && distance(face) <= tolerance
            });
            let Some(face) = touched.next() else { continue };
            let twin = self.corners[face].iter().find(|other| mesh.nodes[**other as usize].distance(at) <= tolerance);
            match twin {
                Some(twin) => coincident.push([node, *twin]),
                None => hanging.push(node),
            }
        }
        let name = body.name.clone();
        if let Some([first, second]) = coincident.first().map(|pair| pair.map(|node| node_spot(mesh, node))) {
            return Err(MeshDefect::CoincidentNodes { body: name, count: coincident.len(), first, second });
        }
        match hanging.first() {
            None => Ok(()),
            Some(first) => {
                let first = node_spot(mesh, *first);
                Err(MeshDefect::HangingNode { body: name, count: hanging.len(), first })
            }
        }
    }

    /// Returns the centre [m] of the first face that intersects a face with which it has no common corner.
    fn first_cut(&self) -> Option<DVec3> {
        // The intersection test supports triangles, so it cannot fail.
        let here = Pose::IDENTITY;
        let cuts = |a: usize, b: usize| {
            !self.corners[a].iter().any(|corner| self.corners[b].contains(corner))
                && intersection_test(&here, &self.triangles[a], &here, &self.triangles[b])
                    .is_ok_and(|found| found.intersecting)
        };
        (0..self.boxes.len()).find_map(|a| {
            let mut near = self.tree.intersect_aabb(&self.boxes[a]).map(|b| b as usize).filter(|b| *b > a);
            near.any(|b| cuts(a, b)).then(|| self.triangles[a].center())
        })
    }
}

fn node_spot(mesh: &Mesh, node: u32) -> Spot {
    Spot { tag: mesh.node_tags[node as usize], at: mesh.nodes[node as usize] }
}

#[cfg(test)]
mod tests {
    use super::super::block::{Pattern, block};
    use super::super::prepare;
    use super::*;

    /// Combines two meshes into one body (`bodies` = 1) or two bodies (`bodies` = 2). `shift` [m] moves the second
    /// mesh.
    fn joined(mut one: Mesh, other: Mesh, shift: DVec3, bodies: usize) -> Mesh {
        let [nodes, tets] = [one.nodes.len() as u32, one.tets.len() as u32];
        one.nodes.extend(other.nodes.iter().map(|node| *node + shift));
        one.tets.extend(other.tets.iter().map(|tet| tet.map(|node| node + nodes)));
        one.node_tags = (1..=one.nodes.len() as u64).collect();
        one.tet_tags = (1..=one.tets.len() as u64).collect();
        one.sets.clear();
        if bodies == 2 {
            one.bodies.push(Body { name: "second".to_owned(), tets: tets as usize..one.tets.len() });
        } else {
            one.bodies[0].tets.end = one.tets.len();
        }
        one
    }

    fn cube(cells: usize) -> Mesh {
        block(DVec3::ONE, [cells; 3], Pattern::Diagonal)
    }

    /// Merges nodes that have the same position.
    fn merged(mut mesh: Mesh) -> Mesh {
        for tet in &mut mesh.tets {
            *tet = tet.map(|node| {
                let at = mesh.nodes[node as usize];
                mesh.nodes.iter().position(|other| *other == at).unwrap() as u32
            });
        }
        mesh
    }

    #[test]
    fn adjacent_bodies_are_accepted_unless_they_share_nodes() {
        let apart = joined(cube(2), cube(2), DVec3::X, 2);
        assert_eq!(prepare(apart.clone()).unwrap().quality.len(), 2);
        let error = prepare(merged(apart)).unwrap_err();
        let MeshDefect::SharedNodes { one, other, count, first } = &error else { panic!("{error}") };
        assert_eq!((one.as_str(), other.as_str(), *count), ("block", "second", 9));
        assert_eq!(first.at.x, 1.0);
    }

    #[test]
    fn parts_meshed_separately_are_refused() {
        // Two more cubes, a bridge, keep the body in one piece, so the coincident nodes are its only defect.
        let bridge = |mesh: Mesh| {
            let far = joined(mesh, cube(1), DVec3::new(1.0, 1.0, 0.0), 1);
            let mut bridged = joined(far, cube(1), DVec3::Y, 1);
            // Merges all nodes except those at x = 1, y < 1, between the first two cubes.
            for tet in &mut bridged.tets {
                *tet = tet.map(|node| {
                    let at = bridged.nodes[node as usize];
                    if at.x == 1.0 && at.y < 1.0 {
                        return node;
                    }
                    bridged.nodes.iter().position(|other| *other == at).unwrap() as u32
                });
            }
            bridged
        };
        let error = prepare(bridge(joined(cube(1), cube(1), DVec3::X, 1))).unwrap_err();
        let MeshDefect::CoincidentNodes { count: 4, first, second, .. } = &error else { panic!("{error}") };
        assert!(first.at == second.at && first.tag != second.tag && first.at.x == 1.0);
    }

    #[test]
    fn a_body_in_several_pieces_is_refused() {
        let error = prepare(joined(cube(1), cube(1), DVec3::splat(3.0), 1)).unwrap_err();
        assert!(matches!(error, MeshDefect::Pieces { pieces: 2, .. }), "{error}");
        // Contact along an edge or at a corner does not connect pieces.
        for shift in [DVec3::new(1.0, 1.0, 0.0), DVec3::ONE] {
            let error = prepare(merged(joined(cube(1), cube(1), shift, 1))).unwrap_err();
            assert!(matches!(error, MeshDefect::Pieces { pieces: 2, .. }), "{error}");
        }
    }

    #[test]
    fn a_body_may_touch_itself_along_an_edge() {
        // The body consists of six of the eight cells of a cube: the lower layer of four, and two upper cells that have
        // only an edge in common.
        let mut mesh = cube(2);
        let keep = |at: DVec3| (at.z < 0.5) || ((at.x < 0.5) == (at.y < 0.5));
        let kept: Vec<usize> = (0..mesh.tets.len()).filter(|tet| keep(mesh.centroid(*tet))).collect();
        mesh.tets = kept.iter().map(|tet| mesh.tets[*tet]).collect();
        mesh.tet_tags.truncate(kept.len());
        mesh.bodies[0].tets.end = kept.len();
        mesh.sets.clear();
        assert_eq!(prepare(mesh).unwrap().mesh.tets.len(), 36);
    }

    #[test]
    fn hanging_nodes_are_found() {
        // Two tetrahedra have the common face (0, 1, 2). The upper one is divided at the middle of an edge of this
        // face, the lower one is not.
        let mut mesh = Mesh {
            nodes: vec![
                DVec3::ZERO,
                DVec3::X,
                DVec3::Y,
                DVec3::Z,
                DVec3::new(0.5, 0.5, -1.0),
                DVec3::new(0.5, 0.5, 0.0),
            ],
            node_tags: (1..=6).collect(),
            tets: vec![[0, 1, 5, 3], [0, 5, 2, 3], [0, 2, 1, 4]],
            tet_tags: (1..=3).collect(),
            bodies: vec![Body { name: "unit".to_owned(), tets: 0..3 }],
            sets: Vec::new(),
            node_sets: Vec::new(),
        };
        let faces = Faces::new(&mesh).unwrap();
        let error = check_surface(&mesh, &faces).unwrap_err();
        assert!(matches!(error, MeshDefect::HangingNode { count: 1, first: Spot { tag: 6, .. }, .. }), "{error}");
        mesh.tets = vec![[0, 1, 5, 3], [0, 5, 2, 3], [0, 5, 1, 4], [0, 2, 5, 4]];
        mesh.tet_tags.push(4);
        mesh.bodies[0].tets.end = 4;
        assert_eq!(prepare(mesh).map(|prepared| prepared.faces.interfaces.len()), Ok(4));
    }

    #[test]
    fn overlapping_parts_are_found() {
        let crossing = joined(cube(1), cube(2), DVec3::new(0.3, 0.4, 0.45), 1);
        let faces = Faces::new(&crossing).unwrap();
        assert!(matches!(check_surface(&crossing, &faces), Err(MeshDefect::CutsItself { .. })));
    }
}
