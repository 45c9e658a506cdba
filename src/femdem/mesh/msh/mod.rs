//! Reads and writes MSH 4.1, the mesh format of Gmsh, as text or binary.
//!
//! Each named physical volume becomes a body, each named physical surface a triangle set, and each named physical curve
//! or point a node set. Format: Gmsh reference manual, section "MSH file format".

mod assemble;
mod error;
mod sections;
mod source;
#[cfg(test)]
mod tests;
mod write;

pub use error::{FilePosition, MshError};
pub use write::write;

use super::Mesh;
use sections::Sections;

/// Parses the content of a file. Lengths are multiplied by `scale` to convert them to metres (0.001 for a file in mm).
///
/// Bodies and sets are in the order of their physical tags, elements and nodes in the order of the file. Unused nodes
/// are left out. In the result, indices are valid and coordinates are finite. Shapes of elements are not checked here.
pub fn parse(bytes: &[u8], scale: f64) -> Result<Mesh, MshError> {
    assemble::mesh(&Sections::read(bytes)?, scale)
}
