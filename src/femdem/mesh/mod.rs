//! Tetrahedral meshes: reading, checking, ordering, faces.
//!
//! [`read`] is the entry to this module: it reads an MSH 4.1 file and returns a checked [`PreparedMesh`].
//!
//! | file | contents |
//! | --- | --- |
//! | `msh` | reads MSH 4.1: named volumes are bodies, surfaces are triangle sets, curves and points are node sets |
//! | `quality` | volume, edges, heights and angles of each body; finds inverted and flat tetrahedra |
//! | `order` | sorts tetrahedra along a space-filling curve, and nodes in the order in which tetrahedra use them |
//! | `faces` | interior faces with their two tetrahedra, exterior faces, cracks and boundaries |
//! | `conformity` | finds shared nodes, unconnected pieces, hanging nodes and overlaps |
//! | `defect` | mesh defects and their error messages |
//! | `block` | structured meshes of a box, for verification |

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use glam::DVec3;
use thiserror::Error;

pub mod block;
mod conformity;
pub mod defect;
pub mod faces;
pub mod msh;
pub mod order;
pub mod quality;
pub mod unit_mesh;

use defect::MeshDefect;
use faces::Faces;
use msh::MshError;
use quality::BodyQuality;
pub use unit_mesh::UnitMesh;

/// Reason why a mesh file cannot be used.
#[derive(Debug, Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("{path}: {source}")]
    Io { path: PathBuf, source: std::io::Error },
    /// The file is not an MSH 4.1 file with named volumes of tetrahedra.
    #[error("{path}: {source}")]
    Msh { path: PathBuf, source: MshError },
    /// The mesh in the file has a defect.
    #[error("{path}: {source}")]
    Defect { path: PathBuf, source: MeshDefect },
}

/// Linear tetrahedra grouped in bodies, with named sets of triangles and nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Positions of the nodes [m].
    pub nodes: Vec<DVec3>,
    /// Number of each node in the file.
    pub node_tags: Vec<u64>,
    /// Nodes of each tetrahedron. Seen from the fourth node, the first three are in anticlockwise order.
    pub tets: Vec<[u32; 4]>,
    /// Number of each tetrahedron in the file.
    pub tet_tags: Vec<u64>,
    /// Bodies. Their ranges of tetrahedra are consecutive and without gaps.
    pub bodies: Vec<Body>,
    /// Triangle sets: boundaries and pre-cracks.
    pub sets: Vec<TriangleSet>,
    /// Node sets from physical curves and points.
    pub node_sets: Vec<NodeSet>,
}

/// A solid: a named range of tetrahedra.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name of the physical volume.
    pub name: String,
    /// Numbers of the tetrahedra of the body.
    pub tets: Range<usize>,
}

/// A named set of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleSet {
    /// Name of the physical surface.
    pub name: String,
    /// Nodes of each triangle, in clockwise or anticlockwise order.
    pub triangles: Vec<[u32; 3]>,
}

/// A named set of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeSet {
    /// Name of the physical curve or point.
    pub name: String,
    /// Numbers of the nodes, in ascending order without duplicates.
    pub nodes: Vec<u32>,
}

impl TriangleSet {
    /// Returns true if the name of the set begins with `crack`. Such a set is a pre-crack: an interior surface that is
    /// broken at the start.
    pub fn is_crack(&self) -> bool {
        self.name.starts_with("crack")
    }
}

impl Mesh {
    /// Returns the positions of the corners of a tetrahedron [m].
    pub fn corners(&self, tet: usize) -> [DVec3; 4] {
        self.tets[tet].map(|node| self.nodes[node as usize])
    }

    /// Returns the centroid of a tetrahedron [m].
    pub fn centroid(&self, tet: usize) -> DVec3 {
        self.corners(tet).iter().sum::<DVec3>() / 4.0
    }

    /// Returns the body that a tetrahedron belongs to.
    pub fn body_of(&self, tet: usize) -> &Body {
        &self.bodies[self.bodies.partition_point(|body| body.tets.end <= tet)]
    }

    /// Returns the faces of tetrahedra whose three nodes lie in a region, each face once. `region` returns true for a
    /// position [m] in the region.
    pub fn faces_within(&self, region: impl Fn(DVec3) -> bool) -> Vec<[u32; 3]> {
        let within: Vec<bool> = self.nodes.iter().map(|node| region(*node)).collect();
        let all = self.tets.iter().flat_map(|tet| faces::LOCAL_FACES.map(|face| face.map(|v| tet[v as usize])));
        let mut found: Vec<[u32; 3]> = all.filter(|face| face.iter().all(|node| within[*node as usize])).collect();
        found.iter_mut().for_each(|face| face.sort_unstable());
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// A checked and sorted mesh, with its faces and its quality.
#[derive(Debug, Clone)]
pub struct PreparedMesh {
    /// The sorted mesh. Its tags are the numbers of nodes and tetrahedra in the file.
    pub mesh: Mesh,
    /// Interior and exterior faces, cracks and boundaries.
    pub faces: Faces,
    /// Sizes and angles of the tetrahedra, one entry per body.
    pub quality: Vec<BodyQuality>,
}

/// Reads, checks and sorts the mesh of an MSH 4.1 file. Lengths are multiplied by `scale` (0.001 for a file in mm).
pub fn read(path: &Path, scale: f64) -> Result<PreparedMesh, MeshError> {
    let bytes = fs::read(path).map_err(|source| MeshError::Io { path: path.to_owned(), source })?;
    parse(&bytes, path, scale)
}

/// Parses, checks and sorts the content of an MSH 4.1 file. `path` is the name of the file in error messages.
pub fn parse(bytes: &[u8], path: &Path, scale: f64) -> Result<PreparedMesh, MeshError> {
    let mesh = msh::parse(bytes, scale).map_err(|source| MeshError::Msh { path: path.to_owned(), source })?;
    prepare(mesh).map_err(|source| MeshError::Defect { path: path.to_owned(), source })
}

/// Checks a mesh, sorts it and finds its faces.
pub fn prepare(mesh: Mesh) -> Result<PreparedMesh, MeshDefect> {
    let quality = quality::measure(&mesh)?;
    conformity::check_bodies_apart(&mesh)?;
    let mesh = order::along_curve(&mesh);
    let faces = Faces::new(&mesh)?;
    conformity::check_one_piece(&mesh, &faces)?;
    conformity::check_surface(&mesh, &faces)?;
    Ok(PreparedMesh { mesh, faces, quality })
}
