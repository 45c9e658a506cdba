//! Regions of the particle domain along the flume with different particle spacings.

use crate::case::file::{DomainFile, Sides, WaterFile};
use crate::case::reading::check::{Checker, as_text, lower_limit};

/// Largest number of ranges of fine water. With each range, the spacing doubles outside it.
const MOST_RANGES: usize = 2;

/// Shortest length of a range of fine water, and of a region of coarser water beside it, divided by the spacing of the
/// coarser water [-]. The buffers of the neighbouring regions (see [`Region::buffer`]) must fit between its ends.
const SHORTEST: f64 = 16.0;

/// A part of the particle domain along the flume with one particle spacing; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Particle spacing, divided by the spacing of the finest region: 1, 2 or 4.
    pub coarseness: u32,
    /// For both ends, whether water of another region continues there.
    pub continues: [bool; 2],
}

impl Region {
    /// Returns the regions after the ends of the finest region have moved by `moved` [m]. All interfaces on the same side
    /// of the finest region move with its end; the ends of the domain stay.
    pub fn moved(regions: &[Self], moved: [f64; 2]) -> Vec<Self> {
        let finest = regions[0].x;
        let of_region = |region: &Self| {
            let end = |end: usize| match (region.continues[end], region.x[end]) {
                (false, x) => x,
                (true, x) if x <= finest[0] => x + moved[0],
                (true, x) => x + moved[1],
            };
            Self { x: [end(0), end(1)], ..*region }
        };
        regions.iter().map(of_region).collect()
    }

    /// Returns how far both ends of the finest region can move outwards [m]; 0 at an end of the domain. `dp` is the
    /// particle spacing of the finest region [m]; the regions at the ends of the domain keep at least the length `least`
    /// [m].
    pub fn room(regions: &[Self], dp: f64, least: f64) -> [f64; 2] {
        [0, 1].map(|end| {
            let is_outermost = |region: &&Self| region.continues[1 - end] && !region.continues[end];
            let Some(outermost) = regions.iter().skip(1).find(is_outermost) else { return 0.0 };
            outermost.x[1] - outermost.x[0] - least.max(SHORTEST * f64::from(outermost.coarseness) * dp)
        })
    }

    /// Returns the width of a buffer [m]: water beyond an end that takes its state from the neighbouring region. It is
    /// as wide as two kernel radii 2h, so that sums over the neighbours of the particles that act on the water of the
    /// region are complete, and one particle wider, because its outermost layer is incomplete.
    pub fn buffer(h: f64, dp: f64) -> f64 {
        ((4.0 * h / dp).ceil() + 1.0) * dp
    }
}

/// Validates the ranges of fine water; returns the regions, the finest first. The ends of the ranges are rounded to
/// whole particle spacings of the coarser water beside them, so that no gap remains between the regions.
pub fn validate(file: &DomainFile, width: f64, smoothing_factor: f64, check: &mut Checker) -> Vec<Region> {
    let whole = Region { x: file.x_m, coarseness: 1, continues: [false; 2] };
    if file.fine_x_m.is_empty() {
        return vec![whole];
    }
    if file.fine_x_m.len() > MOST_RANGES {
        check.reject(
            "domain.fine_x_m",
            as_list(&file.fine_x_m),
            format!("at most {MOST_RANGES} ranges"),
            "keep the innermost ranges",
        );
        return vec![whole];
    }
    let before = check.count();
    if !matches!(file.water, WaterFile::StillLevel {}) {
        check.reject(
            "domain.fine_x_m",
            as_list(&file.fine_x_m),
            "left out with a block of water (domain.water)",
            "remove the key",
        );
    }
    validate_width(file, width, smoothing_factor, check);
    let mut around = file.x_m;
    let mut ranges = Vec::new();
    for (index, &range) in file.fine_x_m.iter().enumerate().rev() {
        let coarse = file.dp_m * f64::from(2u32 << index);
        let Some(snapped) = validate_range(index, range, around, coarse, check) else { return vec![whole] };
        ranges.push(snapped);
        around = snapped;
    }
    if check.count() > before {
        return vec![whole];
    }
    ranges.reverse();
    let inner = ranges[0];
    let mut regions =
        vec![Region { x: inner, coarseness: 1, continues: [inner[0] > file.x_m[0], inner[1] < file.x_m[1]] }];
    for (level, range) in ranges.iter().enumerate() {
        let around = ranges.get(level + 1).copied().unwrap_or(file.x_m);
        let coarseness = 2 << level;
        if range[0] > around[0] {
            let continues = [around[0] > file.x_m[0], true];
            regions.push(Region { x: [around[0], range[0]], coarseness, continues });
        }
        if range[1] < around[1] {
            let continues = [true, around[1] < file.x_m[1]];
            regions.push(Region { x: [range[1], around[1]], coarseness, continues });
        }
    }
    regions
}

fn as_list(ranges: &[[f64; 2]]) -> String {
    let of_range = |[from, to]: &[f64; 2]| format!("[{}, {}]", as_text(*from), as_text(*to));
    format!("[{}]", ranges.iter().map(of_range).collect::<Vec<_>>().join(", "))
}

/// Validates a range of fine water inside the range `around`; returns it with rounded ends. `coarse` is the particle
/// spacing outside the range [m].
fn validate_range(
    index: usize,
    [from, to]: [f64; 2],
    around: [f64; 2],
    coarse: f64,
    check: &mut Checker,
) -> Option<[f64; 2]> {
    let least = SHORTEST * coarse;
    let path = format!("domain.fine_x_m[{index}]");
    let given = || format!("[{}, {}]", as_text(from), as_text(to));
    if !(from >= around[0] && to <= around[1] && to - from >= least) {
        check.reject(
            &path,
            given(),
            format!(
                "within {} to {} m, the seaward end first, at least {} m long",
                as_text(around[0]),
                as_text(around[1]),
                lower_limit(least)
            ),
            "write the ranges from the innermost to the outermost",
        );
        return None;
    }
    let outside = [from - around[0], around[1] - to];
    if outside.iter().any(|length| *length > 1e-9 && *length < least) {
        check.reject(
            &path,
            given(),
            format!(
                "at the ends of {} to {} m, or at least {} m from them",
                as_text(around[0]),
                as_text(around[1]),
                lower_limit(least)
            ),
            format!("a region of coarser water must be at least {SHORTEST} of its particle spacings long"),
        );
        return None;
    }
    let whole = |length: f64| (length / coarse).round() * coarse;
    let from = around[0] + whole(outside[0]);
    let to = if outside[1] > 1e-9 { from + whole(to - from) } else { around[1] };
    Some([from, to])
}

/// Checks that the coarsest water fits across the flume.
fn validate_width(file: &DomainFile, width: f64, smoothing_factor: f64, check: &mut Checker) {
    let coarsest = file.dp_m * f64::from(1u32 << file.fine_x_m.len());
    let least = match file.sides {
        Sides::TwoDimensional => return,
        Sides::Periodic => (4.0 * smoothing_factor * 3f64.sqrt() + 1.0) * coarsest,
        Sides::Walls => coarsest,
    };
    if width < least {
        check.reject(
            "domain.fine_x_m",
            as_list(&file.fine_x_m),
            format!(
                "left out or shorter, because the coarsest water, with a spacing of {} m, needs a width of {} m",
                as_text(coarsest),
                lower_limit(least)
            ),
            "leave out the outermost range, widen the domain or write a smaller `domain.dp_m`",
        );
    }
    let layers = (width / coarsest).round().max(1.0);
    let stretch = width / layers / coarsest;
    if (stretch - 1.0).abs() > 0.03 {
        check.warn(format!(
            "domain.width_m = {}: in the coarsest water, the spacing across the flume is {stretch:.3} times the \
             spacing along it; write a width that is a whole number of coarse particle spacings",
            as_text(width)
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regions(x: [f64; 2], fine: &[[f64; 2]]) -> (Vec<Region>, usize) {
        let text = serde_json::json!({
            "x_m": x, "width_m": 0.16, "sides": "walls", "top_z_m": 0.5, "dp_m": 0.01, "fine_x_m": fine,
        });
        let file: DomainFile = serde_json::from_value(text).unwrap();
        let mut check = Checker::new("x.json");
        (validate(&file, 0.16, 1.0, &mut check), check.count())
    }

    #[test]
    fn regions_fill_the_domain_without_gaps() {
        let (regions, errors) = regions([1.0, 7.005], &[[3.003, 4.0], [2.0, 5.0]]);
        assert_eq!(errors, 0);
        let mut sorted = regions.clone();
        sorted.sort_by(|a, b| a.x[0].total_cmp(&b.x[0]));
        assert_eq!(sorted.iter().map(|region| region.coarseness).collect::<Vec<_>>(), [4, 2, 1, 2, 4]);
        assert_eq!(regions[0].coarseness, 1);
        assert_eq!([sorted[0].x[0], sorted[4].x[1]], [1.0, 7.005]);
        for pair in sorted.windows(2) {
            assert_eq!(pair[0].x[1], pair[1].x[0]);
        }
        for (region, coarse) in sorted[1..4].iter().zip([0.02, 0.02, 0.02]) {
            let spacings = (region.x[1] - region.x[0]) / coarse;
            assert!((spacings - spacings.round()).abs() < 1e-9, "{spacings}");
        }
        assert_eq!(
            sorted.iter().map(|region| region.continues).collect::<Vec<_>>(),
            [[false, true], [true, true], [true, true], [true, true], [true, false]]
        );
    }

    #[test]
    fn interfaces_move_with_the_ends_of_the_finest_region() {
        let (regions, _) = regions([1.0, 7.005], &[[3.003, 4.0], [2.0, 5.0]]);
        let mut moved = Region::moved(&regions, [-0.2, 0.4]);
        assert_eq!(moved[0].x, [regions[0].x[0] - 0.2, regions[0].x[1] + 0.4]);
        moved.sort_by(|a, b| a.x[0].total_cmp(&b.x[0]));
        assert_eq!([moved[0].x[0], moved[4].x[1]], [1.0, 7.005]);
        for pair in moved.windows(2) {
            assert_eq!(pair[0].x[1], pair[1].x[0]);
        }
        // The outermost regions, 1.0 m and 2.0 m long, keep at least 16 of their spacings of 0.04 m.
        let room = Region::room(&regions, 0.01, 0.0);
        assert!((room[0] - 0.36).abs() < 0.02 && (room[1] - 1.36).abs() < 0.02, "{room:?}");
    }

    #[test]
    fn ranges_outside_each_other_or_too_short_are_refused() {
        for fine in
            [vec![[0.5, 4.0]], vec![[3.0, 3.2]], vec![[2.0, 5.0], [3.0, 4.0]], vec![[1.1, 4.0]], vec![[2.0, 5.0]; 3]]
        {
            assert_eq!(regions([1.0, 7.0], &fine).1, 1, "{fine:?}");
        }
    }
}
