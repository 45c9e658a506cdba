//! Warns if the wave is expected to rise above the walls of the particle domain.

use std::f64::consts::LN_2;

use super::Case;
use crate::case::reading::check::{Checker, as_text};
use crate::case::wave::Wave;
use crate::waves::theory::regular::{MeanFlow, RegularWave};
use crate::waves::theory::stream_function::StreamFunctionWave;

/// Height of a wave divided by the depth at which it breaks on a level bed [-].
const BREAKING: f64 = 0.78;

/// Warns if the crest of the wave, or the water at the shoreward end, is expected to rise above the walls.
pub fn warn(case: &Case, check: &mut Checker) {
    let Some(crest) = crest(case) else { return };
    let (still, top) = (case.flume.still_water_level, case.domain.top_z);
    let shoreward = shoreward(case, crest);
    let (rise, place) = if shoreward > crest { (shoreward, "shoreward end") } else { (crest, "wavemaker") };
    if still + rise > top {
        check.warn(format!(
            "domain.top_z_m = {}: water is expected to rise to z = {:.3} m at the {place}, above the walls; raise \
             domain.top_z_m",
            as_text(top),
            still + rise
        ));
    }
}

/// Returns the height of the highest crest above still water at the seaward end of the domain [m]. Where the wave is
/// generated in another depth, the height follows Green's law, H proportional to d^(-1/4), up to breaking.
fn crest(case: &Case) -> Option<f64> {
    let (crest, generated) = match &case.wave {
        Wave::None | Wave::External(_) => return None,
        Wave::Solitary(wave) => (wave.height_m, wave.depth_m),
        Wave::SolitaryInflow(wave) => (wave.height_m, wave.depth_m),
        Wave::Regular { wave, .. } => (permanent_crest(*wave), wave.depth_m),
        Wave::Irregular { sea, .. } => {
            // Most probable height of the highest of N waves: H_s sqrt(ln(N) / 2) (Longuet-Higgins 1952).
            let waves = (case.stop.duration / sea.peak_period_s).max(1.0);
            let height_m = sea.significant_height_m * (waves.ln().max(LN_2) / 2.0).sqrt();
            let (period_s, depth_m, gravity) = (sea.peak_period_s, sea.depth_m, sea.gravity);
            (permanent_crest(RegularWave { height_m, period_s, depth_m, gravity }), depth_m)
        }
    };
    let depth = case.flume.still_depth(case.domain.x[0]);
    Some(shoaled(crest, generated, depth))
}

/// Returns the crest height of a regular wave of permanent form [m]; half the height where the theory has no solution.
fn permanent_crest(wave: RegularWave) -> f64 {
    StreamFunctionWave::new(wave, MeanFlow::NoTransport).map_or(0.5 * wave.height_m, |wave| wave.elevation_m(0.0))
}

/// Returns the crest height [m] in the depth `to` [m] of a wave with the crest height `crest` [m] in the depth `from`.
fn shoaled(crest: f64, from: f64, to: f64) -> f64 {
    (crest * (from / to).powf(0.25)).min(BREAKING * to).max(0.0)
}

/// Returns the rise of the water above still water at the shoreward end of the domain [m]: the crest at a wall, or the
/// run-up on a bed that rises above still water up to the end. Returns 0 if the water can flow over a crest of the bed.
fn shoreward(case: &Case, crest: f64) -> f64 {
    let (flume, [x0, x1]) = (&case.flume, case.domain.x);
    let depth = flume.still_depth(x0);
    let highest = flume.section().extremes_between([x0, x1]).1 - flume.still_water_level;
    if highest >= 0.0 {
        let ends_at_top = flume.section().z(x1) - flume.still_water_level >= highest;
        let place = shoreline(case).filter(|_| ends_at_top);
        return place.map_or(0.0, |x| run_up(case, crest, depth, flume.section().slope(x)));
    }
    let at_end = flume.still_depth(x1);
    // Behind a submerged mound the wave has split or broken; its rise at the wall is not estimated.
    if case.domain.damping_zone.is_some() || -highest < at_end {
        return 0.0;
    }
    let at_wall = shoaled(crest, depth, at_end);
    // Run-up of a solitary wave on a wall, third order (Su & Mirie 1980); for other waves it is an upper estimate.
    let ratio = at_wall / at_end;
    at_wall * (2.0 + ratio / 2.0 + 0.75 * ratio * ratio)
}

/// Returns the first x in the domain where the bed rises above still water [m].
fn shoreline(case: &Case) -> Option<f64> {
    let (flume, [x0, x1]) = (&case.flume, case.domain.x);
    let corners = flume.section().points().iter().map(|point| point[0]).filter(|x| (x0..x1).contains(x));
    let mut places: Vec<f64> = corners.chain([x0, x1]).collect();
    places.sort_by(f64::total_cmp);
    places.windows(2).find_map(|pair| {
        let [low, high] = [pair[0], pair[1]].map(|x| flume.section().z(x) - flume.still_water_level);
        (low < 0.0 && high >= 0.0).then(|| pair[0] - low / (high - low) * (pair[1] - pair[0]) - 1e-9)
    })
}

/// Returns the run-up on a slope tan(beta) [m] of a wave with the given crest height [m] in the depth d [m].
///
/// Solitary waves: the smaller of the laws for waves that do not break and that break (Synolakis 1987). Other waves:
/// tan(beta) sqrt(H L0) (Hunt 1959), at most twice the height H.
fn run_up(case: &Case, crest: f64, depth: f64, slope: f64) -> f64 {
    match case.wave.period() {
        None => {
            let ratio = crest / depth;
            let surging = 2.831 * (1.0 / slope).sqrt() * ratio.powf(1.25);
            depth * surging.min(1.109 * ratio.powf(0.582))
        }
        Some(period) => {
            let (height, deep_length) = (2.0 * crest, case.fluid.gravity * period * period / std::f64::consts::TAU);
            (slope * (height * deep_length).sqrt()).min(2.0 * height)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the warnings about the top of the walls.
    fn warnings(bed: &str, domain: &str, wave: &str) -> Vec<String> {
        let text = format!(
            r#"{{
                "title": "crest", "flume": {{ "bed_m": {bed}, "still_water_level_m": 0.4 }},
                "domain": {{ {domain}, "sides": "two_dimensional", "dp_m": 0.02 }},
                "wave": {wave}, "stop": {{ "duration_s": 10.0 }}
            }}"#
        );
        let case = Case::from_str(&text, "crest.json").unwrap();
        case.warnings.into_iter().filter(|warning| warning.starts_with("domain.top_z_m")).collect()
    }

    const LEVEL: &str = "[[0, 0], [10, 0]]";

    #[test]
    fn crest_and_wall_are_compared_with_the_top() {
        let solitary = r#"{ "kind": "solitary", "height_m": 0.1 }"#;
        // At the wall: 0.1 (2 + 0.25 / 2 + 0.75 / 16) = 0.217 m above 0.4 m.
        let rise = warnings(LEVEL, r#""x_m": [2, 5], "top_z_m": 0.6"#, solitary);
        assert_eq!(
            rise,
            ["domain.top_z_m = 0.6: water is expected to rise to z = 0.617 m at the shoreward end, above the walls; \
              raise domain.top_z_m"]
        );
        assert!(warnings(LEVEL, r#""x_m": [2, 5], "top_z_m": 0.62"#, solitary).is_empty());
        let damped = r#""damping_zone": { "x_m": [4, 5] }, "x_m": [2, 5]"#;
        assert!(warnings(LEVEL, &format!(r#"{damped}, "top_z_m": 0.52"#), solitary).is_empty());
        let low = warnings(LEVEL, &format!(r#"{damped}, "top_z_m": 0.49"#), solitary);
        assert!(low[0].contains("z = 0.500 m at the wavemaker"), "{low:?}");
    }

    #[test]
    fn run_up_on_a_slope_is_compared_with_the_top() {
        let slope = "[[0, 0], [4, 0], [10, 0.6]]";
        let solitary = r#"{ "kind": "solitary", "height_m": 0.04 }"#;
        // Run-up 2.831 sqrt(10) 0.1^1.25 = 0.50 depths, more than a breaking wave has: 1.109 * 0.1^0.582 = 0.29 depths.
        let run_up = warnings(slope, r#""x_m": [2, 8.5], "top_z_m": 0.5"#, solitary);
        assert!(run_up[0].contains("z = 0.516 m at the shoreward end"), "{run_up:?}");
        assert!(warnings(slope, r#""x_m": [2, 8.5], "top_z_m": 0.52"#, solitary).is_empty());
        // A dike with its crest at 0.45 m and a lee slope: the water flows over it.
        let dike = "[[0, 0], [4, 0], [8.5, 0.45], [9, 0.3]]";
        assert!(warnings(dike, r#""x_m": [2, 9], "top_z_m": 0.5"#, solitary).is_empty());
        // Hunt: 0.1 sqrt(H L0) with H = 0.1 m and L0 = 6.2 m: 0.079 m. The crest is higher than H / 2, so a little more.
        let regular = r#"{ "kind": "regular", "height_m": 0.1, "period_s": 2.0 }"#;
        assert!(!warnings(slope, r#""x_m": [2, 8.7], "top_z_m": 0.475"#, regular).is_empty());
        assert!(warnings(slope, r#""x_m": [2, 8.7], "top_z_m": 0.5"#, regular).is_empty());
    }

    #[test]
    fn the_highest_of_the_irregular_waves_counts() {
        let sea = r#"{ "kind": "irregular", "significant_height_m": 0.06, "peak_period_s": 1.8 }"#;
        let zone = r#""damping_zone": { "x_m": [4, 5] }, "x_m": [2, 5]"#;
        // Five waves: the highest crest is about H_s sqrt(ln(5.6) / 2) / 2 = 0.028 m or a little more.
        assert!(!warnings(LEVEL, &format!(r#"{zone}, "top_z_m": 0.425"#), sea).is_empty());
        assert!(warnings(LEVEL, &format!(r#"{zone}, "top_z_m": 0.45"#), sea).is_empty());
    }
}
