//! A block of the bed under a blow.

use glam::{DMat3, DVec3};

use crate::femdem::mesh::Mesh;
use crate::femdem::mesh::block::{Pattern, block};

/// Name of the body and of its held underside.
pub const NAME: &str = "base";
/// Set of the underside.
pub const BOTTOM: &str = "base_bottom";

/// Depth over width of the block [-].
const DEPTH: f64 = 0.5;

/// A block with its upper side at `level` [m] over the place `middle` along the unit vector `normal`, so wide [m], of cells
/// about as long as `cell` [m].
pub fn under(middle: DVec3, normal: DVec3, level: f64, width: f64, cell: f64) -> Mesh {
    let across = ((width / cell).ceil() as usize).max(2);
    let down = ((DEPTH * width / cell).ceil() as usize).max(1);
    let lengths = DVec3::new(width, width, DEPTH * width);
    let mut mesh = block(lengths, [across, across, down], Pattern::Centred);
    let u = normal.any_orthonormal_vector();
    // Right-handed, lest the tetrahedra be turned inside out.
    let axes = DMat3::from_cols(u, normal.cross(u), normal);
    let origin = DVec3::new(0.5 * width, 0.5 * width, DEPTH * width - level);
    mesh.nodes.iter_mut().for_each(|node| *node = middle + axes * (*node - origin));
    mesh.bodies[0].name = NAME.to_owned();
    mesh.sets.retain(|set| set.name == "zmin");
    mesh.sets.iter_mut().for_each(|set| set.name = BOTTOM.to_owned());
    mesh
}
