//! Core-Loc: a member between two others that are parallel to each other and normal to it (Melby & Turk 1997; US patent
//! 5,441,362).
//!
//! Every member is as long as the unit, C, and the unit is as wide. Assumed: the members are 0.362 C wide in their
//! middle and 0.181 C at their ends, with chamfers in proportion to the width. The chamfer follows from the volume of
//! the unit that was tested to failure, 8 m3 at C = 3.31 m: 0.2206 C^3.

use glam::DVec3;

use super::member::Member;
use super::polyhedron::{Polyhedron, PolyhedronError};
use super::section::Section;

/// Width of a member over C in its middle and at its ends [-].
const WIDTH: [f64; 2] = [0.362, 0.181];
/// What the chamfer takes of each side over the width there [-].
const CHAMFER: f64 = 0.1146;

/// Volume over C^3 [-].
pub const VOLUME_RATIO: f64 = 0.2206;

/// The member along x, then the two upright ones at both sides along y, of a Core-Loc of size C [m].
fn members(size_m: f64) -> [Member; 3] {
    let width = WIDTH.map(|w| w * size_m);
    let member = |y: f64, axis: DVec3| Member {
        centre: DVec3::Y * y,
        axis,
        across: DVec3::Y,
        half_length: 0.5 * size_m,
        width,
        chamfer: width.map(|w| CHAMFER * w),
    };
    let aside = 0.5 * (size_m - width[0]);
    [member(0.0, DVec3::X), member(aside, DVec3::Z), member(-aside, DVec3::Z)]
}

/// Convex blocks of a Core-Loc of size C [m]: the two parallel members upright at both sides along y, the third along x.
///
/// # Errors
/// If the dimensions leave nothing.
pub fn blocks(size_m: f64) -> Result<Vec<Polyhedron>, PolyhedronError> {
    let mut blocks = Vec::new();
    for member in members(size_m) {
        blocks.extend(member.blocks()?);
    }
    Ok(blocks)
}

/// Sections of a Core-Loc of size C [m] where its members leave the block in the middle.
pub fn sections(size_m: f64) -> Vec<Section> {
    let width = WIDTH[0] * size_m;
    // Half a diagonal: the upright members have their sections in the same planes.
    let of = |member: &Member| member.sections(0.5 * width).map(|section| section.reaching(0.75 * width));
    members(size_m).iter().flat_map(of).collect()
}
