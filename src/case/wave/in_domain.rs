//! Checks the wave and its wavemaker against the particle domain.

use super::Wave;
use super::wavemaker::{NEAREST_GAUGE, NEAREST_OPEN_GAUGE, SHARE_TO_GAUGE, Wavemaker};
use crate::case::flume::bed::Flume;
use crate::case::flume::domain::Domain;
use crate::case::flume::zones::RelaxationZone;
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit};
use crate::waves::theory::regular::RegularWave;

/// Largest allowed stroke of a paddle / length of the particle domain [-].
const LARGEST_SWEEP: f64 = 0.5;
/// Bed slope above which the generated wave differs visibly from wavemaker theory [-]. The theory assumes a horizontal
/// bed.
const EVEN_SLOPE: f64 = 0.02;

/// Validates position and stroke of the wavemaker against the particle domain.
pub(super) fn validate(wave: &Wave, wavemaker: Wavemaker, flume: &Flume, domain: &Domain, check: &mut Checker) {
    let depth = flume.still_depth(domain.x[0]);
    // A moving end acts as a wall only if the water in front of it is at least four particles deep.
    let is_open = matches!(wavemaker, Wavemaker::OpenEnds { .. });
    for (end, name) in ["seaward", "shoreward"].into_iter().enumerate().take(if is_open { 2 } else { 1 }) {
        let depth = flume.still_depth(domain.x[end]);
        if depth < 4.0 * domain.spacing_at(domain.x[end]) {
            check.reject(
                &format!("domain.x_m[{end}]"),
                as_text(domain.x[end]),
                format!("in still water at least 4 particles deep (the depth there is {} m)", as_text(depth)),
                format!("move the {name} end of the domain away from the shore"),
            );
        }
    }
    if let Some(gauge) = wavemaker.absorption_gauge() {
        let spacing = domain.spacing_at(domain.x[0]);
        let (key, nearest) = if is_open {
            ("wavemaker.gauge_m", NEAREST_OPEN_GAUGE * spacing)
        } else {
            ("wavemaker.absorption_gauge_m", NEAREST_GAUGE * spacing)
        };
        let of_end = |end: usize| domain.regions.iter().find(|region| region.x[end] == domain.x[end]);
        let length = |end: usize| of_end(end).map_or(f64::INFINITY, |region| region.x[1] - region.x[0]);
        let furthest = SHARE_TO_GAUGE * if is_open { length(0).min(length(1)) } else { length(0) };
        let advice = "a distance of about one depth is usual";
        check.number(key, gauge, at_least(nearest).up_to(furthest), "m", advice);
    }
    match wave {
        Wave::None | Wave::External(_) => {}
        Wave::Solitary(wave) if wavemaker.follows_flume_model() => {
            let nearest = flume.ends()[0] + wave.stroke_m();
            validate_distance("shoreward of the stroke of the flume's piston", nearest, domain, check);
        }
        _ if wavemaker.follows_flume_model() => {
            let nearest = flume.ends()[0] + flume.offshore_depth();
            validate_distance("more than one water depth from the inflow", nearest, domain, check);
        }
        Wave::SolitaryInflow(_) | Wave::Irregular { .. } => {}
        Wave::Solitary(wave) => {
            validate_sweep(wave.stroke_m(), wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
        }
        Wave::Regular { wave, ramp_periods } => {
            let bed_z = flume.section().z(domain.x[0]);
            let top_share = wavemaker.shape(bed_z).relative_displacement(domain.top_z - bed_z, depth).max(1.0);
            let stroke = 2.0 * top_share * wavemaker.motion(wave, *ramp_periods, bed_z).max_displacement_m();
            validate_sweep(stroke, wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
            warn_of_order(wave, wavemaker, check);
        }
    }
    if let Some(height) = wave.height() {
        let spacing = domain.spacing_at(domain.x[0]);
        let particles = height / spacing;
        if particles < 5.0 {
            check.warn(format!(
                "domain.dp_m = {}: {particles:.1} particle spacings per wave height at the wavemaker, but 5 to 10 are \
                 needed (Altomare et al. 2017)",
                as_text(domain.dp)
            ));
        }
    }
}

fn validate_distance(limit: &str, nearest: f64, domain: &Domain, check: &mut Checker) {
    if domain.x[0] <= nearest {
        check.reject(
            "domain.x_m[0]",
            as_text(domain.x[0]),
            format!("{limit}, > {} m", lower_limit(nearest)),
            "move the seaward end of the domain shoreward; the flume model computes the wave up to this end",
        );
    }
}

fn validate_sweep(stroke: f64, height: f64, domain: &Domain, check: &mut Checker) {
    let most = LARGEST_SWEEP * (domain.x[1] - domain.x[0]);
    if stroke.is_nan() || stroke > most {
        check.reject(
            "wave.height_m",
            as_text(height),
            format!(
                "such that the stroke of the paddle, {} m, is at most {} m, half of the length of the domain",
                as_text(stroke),
                as_text(most)
            ),
            "lengthen the domain or lower the wave",
        );
    }
}

/// Warns of a sloping bed at the wavemaker, because wavemaker theory assumes a horizontal bed.
fn warn_of_slope(flume: &Flume, domain: &Domain, depth: f64, check: &mut Checker) {
    let x0 = domain.x[0];
    let rise = flume.section().z(x0 + depth) - flume.section().z(x0);
    if rise.abs() > EVEN_SLOPE * depth {
        check.warn(format!(
            "domain.x_m[0] = {}: the bed level changes by {} m over a distance of one depth, but wavemaker theory \
             assumes a horizontal bed",
            as_text(x0),
            as_text(rise)
        ));
    }
}

fn warn_of_order(wave: &RegularWave, wavemaker: Wavemaker, check: &mut Checker) {
    if matches!(wavemaker, Wavemaker::Piston { .. }) && !wave.is_second_order() {
        check.warn(format!(
            "wave.height_m = {}: H L^2 / d^3 exceeds 8 pi^2 / 3, the limit of the piston's second-order motion \
             (Madsen 1971); a free secondary wave will follow each crest",
            as_text(wave.height_m)
        ));
    }
}

/// Refuses a relaxation zone if the wave does not come from the flume model.
pub fn refuse_relaxation_zone(zone: Option<&RelaxationZone>, wave: &Wave, wavemaker: Wavemaker, check: &mut Checker) {
    let from_flume = wavemaker.follows_flume_model() && !matches!(wave, Wave::None | Wave::External(_));
    if zone.is_some() && !from_flume {
        check.reject(
            "domain.relaxation_zone",
            "present",
            "absent, because no wave comes from the flume model",
            "remove it, or use a wave that the flume model carries and the wavemaker \"ml_piston\"",
        );
    }
}
