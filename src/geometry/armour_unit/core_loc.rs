//! Core-Loc: a central member between two parallel outer members normal to it (Melby & Turk 1997; US patent 5,441,362).
//!
//! Every member has the length C, and the unit has the width C. Assumptions: the members are 0.362 C wide in the middle
//! and 0.181 C at the ends, and the chamfers are proportional to the width. The size of the chamfers follows from the
//! volume 0.2206 C^3 of a unit that was tested to failure (8 m3 at C = 3.31 m).

use glam::DVec3;

use super::member::Member;
use super::section::Section;
use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};

/// Width of a member in the middle and at the ends, divided by C [-].
const WIDTH: [f64; 2] = [0.362, 0.181];
/// Length of a chamfer along a side, divided by the local width [-].
const CHAMFER: f64 = 0.1146;

/// Members of a Core-Loc of size C [m]: the central member along x, then the upright members at +y and -y.
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

/// Convex blocks of a Core-Loc of size C [m]: the central member lies along x, the upright members at +y and -y.
///
/// # Errors
/// If a block is flat.
pub fn blocks(size_m: f64) -> Result<Vec<Polyhedron>, PolyhedronError> {
    let mut blocks = Vec::new();
    for member in members(size_m) {
        blocks.extend(member.blocks()?);
    }
    Ok(blocks)
}

/// Critical sections of a Core-Loc of size C [m], where its members leave the central block.
pub fn sections(size_m: f64) -> Vec<Section> {
    let width = WIDTH[0] * size_m;
    // The sections of both upright members lie in the same planes. The reach excludes loads on the other member. It is
    // 0.75 widths, a little more than half a diagonal of the section (0.71 widths).
    let sections = |member: &Member| member.sections(0.5 * width).map(|section| section.with_reach(0.75 * width));
    members(size_m).iter().flat_map(sections).collect()
}
