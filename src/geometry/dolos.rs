//! Dolos: a stem with two flukes at its ends, at right angles to each other (Merrifield 1974).
//!
//! Dimensions after Burcharth et al. (1992), relative to the height H: the length of a fluke, and of the unit along its
//! stem. The stem and the middle of the flukes have the width r (the waist ratio), the fluke ends the width 0.20. The
//! chamfers are 0.056 at the fluke ends and along the stem. Assumed: chamfers of the flukes are proportional to their
//! width. The volume agrees with the published formula, 0.675 r^1.285 H^3, within 0.5 % from r = 0.34 to 0.38 (0.9 % at
//! 0.32; see the tests of `armour_unit`). Haunches between stem and fluke, as in some designs, are neglected.

use glam::DVec3;

use super::member::Member;
use super::polyhedron::{Polyhedron, PolyhedronError};
use super::section::Section;

/// Width of a fluke at its ends over the height [-].
const END_WIDTH: f64 = 0.20;
/// Chamfer leg at the fluke ends and along the stem over the height [-].
const CHAMFER: f64 = 0.056;

/// Range of waist ratios with published dimensions [-].
pub const WAIST_RATIOS: [f64; 2] = [0.30, 0.40];

/// Volume over H^3 for the waist ratio r: 0.675 r^1.285 (Burcharth et al. 1992) [-].
pub fn volume_ratio(waist: f64) -> f64 {
    0.675 * waist.powf(1.285)
}

/// Members of a Dolos of height H [m]: the stem along x, the upright fluke at -x, the fluke along y at +x.
fn members(height_m: f64, waist: f64) -> [Member; 3] {
    let [half, width] = [0.5 * height_m, waist * height_m];
    let stem = Member {
        centre: DVec3::ZERO,
        axis: DVec3::X,
        across: DVec3::Y,
        half_length: half - 0.5 * width,
        width: [width; 2],
        chamfer: [CHAMFER * height_m; 2],
    };
    let fluke = |side: f64, axis: DVec3| Member {
        centre: DVec3::X * (side * (half - 0.5 * width)),
        axis,
        across: DVec3::X,
        half_length: half,
        width: [width, END_WIDTH * height_m],
        chamfer: [CHAMFER / END_WIDTH * width, CHAMFER * height_m],
    };
    [stem, fluke(-1.0, DVec3::Z), fluke(1.0, DVec3::Y)]
}

/// Convex blocks of a Dolos of height H [m]: the stem along x, the upright fluke at -x, the fluke along y at +x.
///
/// # Errors
/// If a block is flat.
pub fn blocks(height_m: f64, waist: f64) -> Result<Vec<Polyhedron>, PolyhedronError> {
    let mut blocks = Vec::new();
    for member in members(height_m, waist) {
        blocks.extend(member.blocks()?);
    }
    Ok(blocks)
}

/// Critical sections of a Dolos of height H [m]: stem and flukes where they join.
pub fn sections(height_m: f64, waist: f64) -> Vec<Section> {
    let [stem, flukes @ ..] = members(height_m, waist);
    let width = waist * height_m;
    let of_stem = stem.sections(0.5 * height_m - width);
    of_stem.into_iter().chain(flukes.iter().flat_map(|fluke| fluke.sections(0.5 * width))).collect()
}
