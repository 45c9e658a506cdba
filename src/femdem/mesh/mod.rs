//! Tetrahedral meshes: reading, checking, ordering, faces.
//!
//! [`read`] is the entry: it reads an MSH 4.1 file and returns a checked [`PreparedMesh`].
//!
//! | file | contents |
//! | --- | --- |
//! | `msh` | reads MSH 4.1: named volumes become bodies, surfaces triangle sets, curves and points node sets |
//! | `quality` | volume, edges, heights and angles of each body; finds inverted and flat tetrahedra |
//! | `order` | sorts tetrahedra along a space-filling curve, nodes by first use |
//! | `faces` | interior faces with their two tetrahedra, exterior faces, cracks and boundaries |
//! | `conformity` | finds shared nodes, unconnected pieces, hanging nodes and overlaps |
//! | `defect` | mesh defects and their messages |
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

/// Linear tetrahedra grouped in bodies, and named sets of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Positions of the nodes [m].
    pub nodes: Vec<DVec3>,
    /// Number of each node in the file.
    pub node_tags: Vec<u64>,
    /// Nodes of each tetrahedron; seen from the fourth, the first three run anticlockwise (positive volume).
    pub tets: Vec<[u32; 4]>,
    /// Number of each tetrahedron in the file.
    pub tet_tags: Vec<u64>,
    /// Bodies; their ranges of tetrahedra are consecutive without gaps.
    pub bodies: Vec<Body>,
    /// Boundaries and cracks.
    pub sets: Vec<TriangleSet>,
    /// Node sets from physical curves and points.
    pub node_sets: Vec<NodeSet>,
}

/// A named part of the tetrahedra: one solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name of the physical volume.
    pub name: String,
    /// Its tetrahedra.
    pub tets: Range<usize>,
}

/// A named set of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleSet {
    /// Name of the physical surface.
    pub name: String,
    /// Nodes of each triangle, clockwise or anticlockwise.
    pub triangles: Vec<[u32; 3]>,
}

/// A named set of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeSet {
    /// Name of the physical curve or point.
    pub name: String,
    /// Its nodes, ascending, each once.
    pub nodes: Vec<u32>,
}

impl TriangleSet {
    /// Whether the set is a pre-crack, an interior surface that is broken at the start: its name begins with `crack`.
    pub fn is_crack(&self) -> bool {
        self.name.starts_with("crack")
    }
}

impl Mesh {
    /// Corners of a tetrahedron [m].
    pub fn corners(&self, tet: usize) -> [DVec3; 4] {
        self.tets[tet].map(|node| self.nodes[node as usize])
    }

    /// Centroid of a tetrahedron [m].
    pub fn centroid(&self, tet: usize) -> DVec3 {
        self.corners(tet).iter().sum::<DVec3>() / 4.0
    }

    /// Returns the body that a tetrahedron belongs to.
    pub fn body_of(&self, tet: usize) -> &Body {
        &self.bodies[self.bodies.partition_point(|body| body.tets.end <= tet)]
    }

    /// Returns the faces whose three nodes lie in a region of positions [m], each face once.
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

/// A mesh that is checked and sorted, with its faces.
#[derive(Debug, Clone)]
pub struct PreparedMesh {
    /// The sorted mesh; the tags are the numbers in the file.
    pub mesh: Mesh,
    /// Interior and exterior faces, cracks and boundaries.
    pub faces: Faces,
    /// Sizes and shapes, one entry per body.
    pub quality: Vec<BodyQuality>,
}

/// Reads an MSH 4.1 file; lengths are multiplied by `scale` (0.001 for a file in mm).
pub fn read(path: &Path, scale: f64) -> Result<PreparedMesh, MeshError> {
    let bytes = fs::read(path).map_err(|source| MeshError::Io { path: path.to_owned(), source })?;
    parse(&bytes, path, scale)
}

/// Parses the content of an MSH 4.1 file; `path` is its name in messages.
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
