//! Dolos: a stem with two flukes at its ends, at right angles to each other (Merrifield 1974).
//!
//! The dimensions follow Burcharth et al. (1992) and are relative to the height H. H is the length of a fluke and the
//! length of the unit along its stem. The stem and the middle of the flukes have the width r (waist ratio); the ends of
//! the flukes have the width 0.20. The chamfers are 0.056 at the fluke ends and along the stem. Assumption: the chamfer
//! of a fluke is proportional to its local width. The volume agrees with the published formula, 0.675 r^1.285 H^3,
//! within 0.5 % from r = 0.34 to 0.38 (0.9 % at 0.32; see the tests of `armour_unit`). Haunches between stem and fluke,
//! as in some designs, are neglected.

use glam::DVec3;

use super::member::Member;
use super::section::Section;
use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};

/// Width of the ends of a fluke, divided by the height [-].
const END_WIDTH: f64 = 0.20;
/// Length of a chamfer along a side at the fluke ends and along the stem, divided by the height [-].
const CHAMFER: f64 = 0.056;

/// Range of waist ratios with published dimensions [-].
pub const WAIST_RATIOS: [f64; 2] = [0.30, 0.40];

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

/// Critical sections of a Dolos of height H [m]: sections of the stem and the flukes where they join each other.
pub fn sections(height_m: f64, waist: f64) -> Vec<Section> {
    let [stem, flukes @ ..] = members(height_m, waist);
    let width = waist * height_m;
    let of_stem = stem.sections(0.5 * height_m - width);
    of_stem.into_iter().chain(flukes.iter().flat_map(|fluke| fluke.sections(0.5 * width))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{ArmourUnit, tests::volume};

    #[test]
    fn dolos_volume_matches_the_published_formula() {
        for waist in [0.32, 0.34, 0.36, 0.38] {
            let unit = ArmourUnit::dolos(1.0, waist, 0.03).unwrap();
            // Volume by Burcharth et al. (1992).
            let published = 0.675 * f64::powf(waist, 1.285);
            println!("r = {waist}: {} H^3, {published}", volume(&unit));
            // The error of the volume must be at most 0.5 % for r >= 0.34, and at most 0.9 % at the lower end of the
            // formula's range.
            let tolerance = if waist < 0.34 { 0.009 } else { 0.005 };
            assert!((volume(&unit) / published - 1.0).abs() < tolerance, "{waist} {}", volume(&unit));
        }
        // The Shore Protection Manual gives the volume 0.16 H^3 for r = 0.32.
        assert!((volume(&ArmourUnit::dolos(2.0, 0.32, 0.03).unwrap()) / 8.0 / 0.16 - 1.0).abs() < 0.02);
    }
}
