//! Validates rocks: random shapes, and their sizes by the grading.

use crate::case::file::{RockFile, UnitsFile};
use crate::case::reading::check::{Checker, at_least};

/// Number of shapes of a group of rocks. The table of contact laws grows with its square.
const SHAPES: usize = 16;
/// Largest grading D85 / D15 [-]. Wider gradings would need more than [`SHAPES`] shapes.
const WIDEST: f64 = 2.0;
/// Standard normal quantile of the probability 0.85 [-].
const QUANTILE_85: f64 = 1.036_433;
/// Standard normal quantiles of the probabilities 1/32, 3/32, ..., 15/32, with the opposite sign [-].
const QUANTILES: [f64; SHAPES / 2] =
    [1.862_732, 1.318_011, 1.009_990, 0.776_422, 0.579_132, 0.402_250, 0.237_202, 0.078_412];
/// The shapes follow each other in steps of this rank in size, so that neighbours in a layer differ.
const STEP: usize = 7;

/// Validates the rocks, except for their size. Returns nominal diameter [m] and seed of each of their shapes.
pub(super) fn shapes(file: &UnitsFile, check: &mut Checker) -> Option<Vec<(f64, u64)>> {
    let Some(RockFile { d_n50_m, grading, seed }) = file.rock else {
        check.reject(".rock", "(missing)", "the size of the rocks", "write \"rock\": { \"d_n50_m\": 0.05 }");
        return None;
    };
    let before = check.count();
    let advice = "narrow gradings have 1.2 to 1.5; split a wider grading into several groups";
    check.number(".rock.grading", grading, at_least(1.0).up_to(WIDEST), "", advice);
    for (key, written) in [("centres_m", file.centres_m.is_some()), ("count", file.count.is_some())] {
        if written {
            let advice = "write `armour` and run `breakwater place`, or write `poses`";
            check.reject(&format!(".{key}"), "...", "left out with rocks, which differ in size", advice);
        }
    }
    let sizes = relative_sizes(grading);
    let shape = |shape: usize| (d_n50_m * sizes[STEP * shape % SHAPES], seed.wrapping_add(shape as u64));
    (check.count() == before).then(|| (0..SHAPES).map(shape).collect())
}

/// Returns the nominal diameters of the shapes, divided by D_n50 [-], in increasing order. The diameters are log-normal.
/// D_n50 and the grading count the mass of the rocks, but a group has equal numbers of all shapes: the median by number
/// is smaller by the factor exp(-3 sigma^2) (Hatch & Choate 1929).
fn relative_sizes(grading: f64) -> [f64; SHAPES] {
    let sigma = 0.5 * grading.ln() / QUANTILE_85;
    std::array::from_fn(|rank| {
        let mirrored = SHAPES - 1 - rank;
        let quantile = if rank < mirrored { -QUANTILES[rank] } else { QUANTILES[mirrored] };
        (sigma * quantile - 3.0 * sigma * sigma).exp()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the size below which rocks of a share of the total mass are, interpolated between the shapes.
    fn size_at(share: f64, sizes: &[f64]) -> f64 {
        let total: f64 = sizes.iter().map(|d| d.powi(3)).sum();
        let mut below = 0.0;
        let mut points = Vec::new();
        for size in sizes {
            let mass = size.powi(3) / total;
            points.push((below + 0.5 * mass, *size));
            below += mass;
        }
        let upper = points.iter().position(|(at, _)| *at >= share).unwrap();
        let ((a, from), (b, to)) = (points[upper - 1], points[upper]);
        from + (to - from) * (share - a) / (b - a)
    }

    #[test]
    fn half_of_the_mass_is_below_d_n50_and_the_grading_is_that_of_the_case() {
        for grading in [1.0001, 1.25, 1.5, WIDEST] {
            let sizes = relative_sizes(grading);
            let (median, found) = (size_at(0.5, &sizes), size_at(0.85, &sizes) / size_at(0.15, &sizes));
            println!("grading {grading}: D_n50 {median:.3}, D85 / D15 {found:.3}");
            // Sixteen shapes stand for a smooth curve, whose largest rocks have most of the mass. The deviations are 0.5 %
            // for narrow gradings and 6 % for the widest one.
            let limit = if grading < 1.6 { 0.006 } else { 0.07 };
            assert!((median - 1.0).abs() < limit && (found / grading - 1.0).abs() < limit, "{grading}");
        }
    }
}
