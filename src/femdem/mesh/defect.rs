//! What can be wrong with a tetrahedral mesh.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

/// A node or a tetrahedron, by its number in the file and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Number in the file.
    pub tag: u64,
    /// Position, of a tetrahedron its centroid [m].
    pub at: DVec3,
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.at;
        write!(f, "{} at ({x:.6}, {y:.6}, {z:.6}) m", self.tag)
    }
}

/// Why a mesh cannot be computed with.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshDefect {
    /// The whole body is turned inside out.
    #[error(
        "body {body:?}: all {tets} tetrahedra have a negative volume: the mesh is mirrored; mesh the body itself, not a \
         reflection of it, or reverse the elements in Gmsh (gmsh.model.mesh.reverse)"
    )]
    AllInverted { body: String, tets: usize },
    /// Some tetrahedra are turned inside out.
    #[error(
        "body {body:?}: {count} of {tets} tetrahedra have a negative volume, the first {first}; mesh again, with \
         `Mesh.Optimize = 1`"
    )]
    Inverted { body: String, count: usize, tets: usize, first: Spot },
    /// Some tetrahedra have no volume.
    #[error(
        "body {body:?}: {count} of {tets} tetrahedra are flat (volume below {limit:e} of the cube of the longest edge), the \
         first {first}; mesh again, with `Mesh.Optimize = 1`"
    )]
    Flat { body: String, count: usize, tets: usize, limit: f64, first: Spot },
    /// More than two tetrahedra at one face.
    #[error(
        "body {body:?}: more than two tetrahedra share a face, among them {first} and {second}: volumes that overlap were \
         meshed twice; unite them first (BooleanUnion, or Coherence;)"
    )]
    CrowdedFace { body: String, first: Spot, second: Spot },
    /// Two tetrahedra fill the same space.
    #[error(
        "body {body:?}: tetrahedra {first} and {second} lie on the same side of their common face; unite volumes that \
         overlap before meshing (BooleanUnion)"
    )]
    SameSide { body: String, first: Spot, second: Spot },
    /// Two bodies are glued together.
    #[error(
        "bodies {one:?} and {other:?} share {count} nodes, the first {first}; bodies meet by contact only: mesh each as a \
         volume of its own (no BooleanFragments between bodies), or give them one physical volume"
    )]
    SharedNodes { one: String, other: String, count: usize, first: Spot },
    /// A body falls apart.
    #[error(
        "body {body:?} is in {pieces} pieces that no face joins, one of them with tetrahedron {second}; give each piece a \
         physical volume of its own, or unite them before meshing (BooleanUnion, BooleanFragments)"
    )]
    Pieces { body: String, pieces: usize, second: Spot },
    /// Two nodes in one place.
    #[error(
        "body {body:?}: nodes {first} and {second} are in the same place but not joined ({count} such nodes): the parts \
         were meshed apart (use BooleanFragments or Coherence;), or a crack was opened by the Crack plugin (leave it \
         closed and name it Physical Surface(\"crack...\"))"
    )]
    CoincidentNodes { body: String, count: usize, first: Spot, second: Spot },
    /// A node on a face that it does not belong to.
    #[error(
        "body {body:?}: {count} nodes lie on faces that do not have them as a corner, the first {first}: parts with \
         different meshes touch; join them before meshing (BooleanFragments or Coherence;)"
    )]
    HangingNode { body: String, count: usize, first: Spot },
    /// The surface of a body runs through itself.
    #[error(
        "body {body:?}: its surface cuts itself near ({:.6}, {:.6}, {:.6}) m: parts overlap; unite them before meshing \
         (BooleanUnion)", at.x, at.y, at.z
    )]
    CutsItself { body: String, at: DVec3 },
    /// A surface that the tetrahedra do not follow.
    #[error(
        "physical surface {set:?}: {hanging} of {count} triangles are no face of a tetrahedron, the first near ({:.6}, \
         {:.6}, {:.6}) m; make the surface part of the volume before meshing (BooleanFragments, or Surface {{...}} In \
         Volume {{...}})", at.x, at.y, at.z
    )]
    HangingTriangles { set: String, hanging: usize, count: usize, at: DVec3 },
    /// A crack where there is nothing to break.
    #[error(
        "physical surface {set:?} is a crack by its name, but {outside} of {count} triangles are on the outside of a body, \
         the first near ({:.6}, {:.6}, {:.6}) m; a crack lies inside: take them out, leave it closed (no Crack plugin in \
         Gmsh), or choose a name that does not begin with \"crack\"", at.x, at.y, at.z
    )]
    CrackOutside { set: String, outside: usize, count: usize, at: DVec3 },
    /// A boundary where there is none.
    #[error(
        "physical surface {set:?} is a boundary, but {inside} of {count} triangles are inside a body, the first near \
         ({:.6}, {:.6}, {:.6}) m; take them out, or begin the name with \"crack\" for a pre-crack", at.x, at.y, at.z
    )]
    BoundaryInside { set: String, inside: usize, count: usize, at: DVec3 },
}
