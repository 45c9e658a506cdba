//! Defects of a tetrahedral mesh.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

/// A node or a tetrahedron in an error message: its number in the file and its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Number in the file.
    pub tag: u64,
    /// Position of the node, or centroid of the tetrahedron [m].
    pub at: DVec3,
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.at;
        write!(f, "{} at ({x:.6}, {y:.6}, {z:.6}) m", self.tag)
    }
}

/// Defect that makes a mesh unusable.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshDefect {
    /// All tetrahedra of a body are inverted.
    #[error(
        "body {body:?}: all {tets} tetrahedra have a negative volume, so the mesh is mirrored; mesh the body itself \
         instead of its reflection, or reverse the elements in Gmsh (gmsh.model.mesh.reverse)"
    )]
    AllInverted { body: String, tets: usize },
    /// Some tetrahedra are inverted.
    #[error(
        "body {body:?}: {count} of {tets} tetrahedra have a negative volume, the first is {first}; mesh again with \
         `Mesh.Optimize = 1`"
    )]
    Inverted { body: String, count: usize, tets: usize, first: Spot },
    /// Some tetrahedra have (almost) no volume.
    #[error(
        "body {body:?}: {count} of {tets} tetrahedra are flat (volume below {limit:e} times the cube of the longest \
         edge), the first is {first}; mesh again with `Mesh.Optimize = 1`"
    )]
    Flat { body: String, count: usize, tets: usize, limit: f64, first: Spot },
    /// More than two tetrahedra share a face.
    #[error(
        "body {body:?}: more than two tetrahedra share a face, among them {first} and {second}; overlapping volumes \
         were meshed twice: unite them before meshing (BooleanUnion, or Coherence;)"
    )]
    CrowdedFace { body: String, first: Spot, second: Spot },
    /// Two tetrahedra fill the same space.
    #[error(
        "body {body:?}: tetrahedra {first} and {second} lie on the same side of their common face; unite overlapping \
         volumes before meshing (BooleanUnion)"
    )]
    SameSide { body: String, first: Spot, second: Spot },
    /// Two bodies share nodes.
    #[error(
        "bodies {one:?} and {other:?} share {count} nodes, the first is {first}; bodies must not share nodes: mesh \
         each as a separate volume (no BooleanFragments between bodies), or put both into one physical volume"
    )]
    SharedNodes { one: String, other: String, count: usize, first: Spot },
    /// A body has several unconnected pieces.
    #[error(
        "body {body:?} has {pieces} pieces that no common face connects; one piece contains tetrahedron {second}; give \
         each piece its own physical volume, or unite the pieces before meshing (BooleanUnion, BooleanFragments)"
    )]
    Pieces { body: String, pieces: usize, second: Spot },
    /// Two nodes have the same position.
    #[error(
        "body {body:?}: nodes {first} and {second} have the same position but are not merged ({count} such nodes); \
         either the parts were meshed separately (use BooleanFragments or Coherence;), or the Crack plugin opened a \
         crack (leave the crack closed and name it Physical Surface(\"crack...\"))"
    )]
    CoincidentNodes { body: String, count: usize, first: Spot, second: Spot },
    /// A node lies on a face but is not a corner of this face.
    #[error(
        "body {body:?}: {count} nodes lie on faces but are not corners of these faces, the first is {first}; parts \
         with different meshes touch: join the parts before meshing (BooleanFragments or Coherence;)"
    )]
    HangingNode { body: String, count: usize, first: Spot },
    /// The surface of a body intersects itself.
    #[error(
        "body {body:?}: its surface intersects itself near ({:.6}, {:.6}, {:.6}) m; parts overlap: unite them before \
         meshing (BooleanUnion)", at.x, at.y, at.z
    )]
    CutsItself { body: String, at: DVec3 },
    /// Triangles of a set are not faces of tetrahedra.
    #[error(
        "physical surface {set:?}: {hanging} of {count} triangles are not faces of tetrahedra, the first near ({:.6}, \
         {:.6}, {:.6}) m; make the surface part of the volume before meshing (BooleanFragments, or Surface {{...}} In \
         Volume {{...}})", at.x, at.y, at.z
    )]
    HangingTriangles { set: String, hanging: usize, count: usize, at: DVec3 },
    /// Triangles of a crack lie on the outside of a body.
    #[error(
        "physical surface {set:?} is a crack because its name begins with \"crack\", but {outside} of {count} \
         triangles are on the outside of a body, the first near ({:.6}, {:.6}, {:.6}) m; a crack must lie \
         inside: remove these triangles, leave the crack closed (no Crack plugin in Gmsh), or choose \
         another name", at.x, at.y, at.z
    )]
    CrackOutside { set: String, outside: usize, count: usize, at: DVec3 },
    /// Triangles of a boundary lie inside a body.
    #[error(
        "physical surface {set:?} is a boundary, but {inside} of {count} triangles are inside a body, the first near \
         ({:.6}, {:.6}, {:.6}) m; remove these triangles, or let the name begin with \"crack\" if the surface is a \
         pre-crack", at.x, at.y, at.z
    )]
    BoundaryInside { set: String, inside: usize, count: usize, at: DVec3 },
}
