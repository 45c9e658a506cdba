//! The validated wavemaker.

use super::check::{Checker, from, show};
use super::domain::Domain;
use super::file::{WaveFile, WavemakerFile};
use super::flume::Flume;
use super::wave::Wave;
use crate::waves::regular::RegularWave;

/// Largest stroke of a paddle over the length of the domain [-].
const LARGEST_SWEEP: f64 = 0.5;
/// Bed slope above which the wave at a paddle differs visibly from its theory, which assumes a horizontal bed [-].
const EVEN_SLOPE: f64 = 0.02;
/// Largest distance of a hinge from z = 0 [m]; larger values are typing errors.
const FURTHEST_HINGE: f64 = 1e5;

/// Wavemaker at the seaward end of the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wavemaker {
    /// Multi-layer piston: its rows follow the water of the flume model or of the wave files.
    MlPiston {
        /// Distance of the absorption gauge from the piston, if there is one [m].
        absorption_gauge: Option<f64>,
    },
    /// A rigid piston.
    Piston {
        /// Distance of the absorption gauge from the piston, if there is one [m].
        absorption_gauge: Option<f64>,
    },
    /// A flap that rotates about a hinge.
    Flap {
        /// Level of the hinge [m].
        hinge_z: f64,
    },
}

impl Wavemaker {
    /// Whether the wave comes from the flume model or from files.
    pub fn is_ml_piston(&self) -> bool {
        matches!(self, Self::MlPiston { .. })
    }

    /// Returns the distance of the absorption gauge from the piston, if there is one [m].
    pub fn absorption_gauge(&self) -> Option<f64> {
        match *self {
            Self::MlPiston { absorption_gauge } | Self::Piston { absorption_gauge } => absorption_gauge,
            Self::Flap { .. } => None,
        }
    }
}

/// Validates the wavemaker and refuses combinations with the wave that are not implemented.
pub(super) fn validate(file: &WavemakerFile, wave: &WaveFile, flume: Option<&Flume>, check: &mut Checker) -> Wavemaker {
    let mut refuse = |value: &str, allowed: &str, advice: &str| {
        check.refuse("wavemaker.kind", format!("{value:?}"), allowed, advice);
    };
    match (wave, file) {
        (WaveFile::None {}, WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            kind_name(file),
            "left out while `wave` is left out or \"none\"",
            "add a wave, e.g. \"wave\": { \"kind\": \"regular\", \"height_m\": 0.1, \"period_s\": 1.2 }",
        ),
        (WaveFile::Solitary(_), WavemakerFile::Flap(_)) => refuse(
            kind_name(file),
            "\"ml_piston\" or \"piston\" for a solitary wave",
            "a flap cannot generate a solitary wave, which moves the water over the whole depth",
        ),
        (WaveFile::Irregular(_), WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            kind_name(file),
            "\"ml_piston\" for irregular waves",
            "remove `wavemaker`: the flume model carries the waves to the domain",
        ),
        (WaveFile::File(_), WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            kind_name(file),
            "\"ml_piston\" for a wave from files",
            "remove `wavemaker`: the rows of the multi-layer piston follow the velocities in the files",
        ),
        _ => {}
    }
    match file {
        WavemakerFile::MlPiston(piston)
            if piston.absorption_gauge_m.is_some() && matches!(wave, WaveFile::None {} | WaveFile::File(_)) =>
        {
            check.refuse(
                "wavemaker.absorption_gauge_m",
                "present",
                "absent, because no wave comes from the flume model: the generated elevation at the gauge is not known",
                "remove it",
            );
            Wavemaker::MlPiston { absorption_gauge: None }
        }
        WavemakerFile::MlPiston(piston) => Wavemaker::MlPiston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::Piston(piston) => Wavemaker::Piston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::Flap(flap) => {
            let highest = flume.map_or(FURTHEST_HINGE, |flume| flume.still_level);
            // A hinge at the surface would leave the flap no length.
            check.number(
                "wavemaker.hinge_z_m",
                flap.hinge_z_m,
                from(-FURTHEST_HINGE).below(highest),
                "m",
                "write the level in the z of `flume.bed_m`, below the still water level; most hinges lie at the bed",
            );
            Wavemaker::Flap { hinge_z: flap.hinge_z_m }
        }
    }
}

fn kind_name(file: &WavemakerFile) -> &'static str {
    match file {
        WavemakerFile::MlPiston(_) => "ml_piston",
        WavemakerFile::Piston(_) => "piston",
        WavemakerFile::Flap(_) => "flap",
    }
}

/// Validates the position of the wavemaker and its stroke.
pub(super) fn validate_place(wave: &Wave, wavemaker: Wavemaker, flume: &Flume, domain: &Domain, check: &mut Checker) {
    let depth = flume.still_depth(domain.x[0]);
    // A wavemaker needs a depth of at least four particles to act as a wall.
    if depth < 4.0 * domain.dp {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("in still water at least 4 particles deep (the depth there is {} m)", show(depth)),
            "move the seaward end of the domain away from the shore",
        );
    }
    if let Some(gauge) = wavemaker.absorption_gauge() {
        // Nearer than four particle spacings the gauge would measure the gap at the piston.
        let (nearest, furthest) = (4.0 * domain.dp, 0.5 * (domain.x[1] - domain.x[0]));
        let advice = "a distance of about one depth is usual";
        check.number("wavemaker.absorption_gauge_m", gauge, from(nearest).up_to(furthest), "m", advice);
    }
    match wave {
        Wave::None | Wave::Given(_) => {}
        Wave::Solitary(wave) if wavemaker.is_ml_piston() => {
            validate_distance("the stroke of the flume's piston", flume.ends()[0] + wave.stroke_m(), domain, check);
        }
        _ if wavemaker.is_ml_piston() => {
            validate_distance("one depth from the inflow", flume.ends()[0] + flume.offshore_depth(), domain, check);
        }
        Wave::SolitaryInflow(_) | Wave::Irregular { .. } => {}
        Wave::Solitary(wave) => {
            validate_sweep(wave.stroke_m(), wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
        }
        Wave::Regular { wave, ramp_periods } => {
            let bed_z = flume.profile.z(domain.x[0]);
            let top_share = wavemaker.shape(bed_z).share(domain.top_z - bed_z, depth).max(1.0);
            let stroke = 2.0 * top_share * wavemaker.motion(wave, *ramp_periods, bed_z).reach_m();
            validate_sweep(stroke, wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
            warn_of_order(wave, wavemaker, check);
        }
    }
    if let Some(height) = wave.height() {
        let particles = height / domain.dp;
        if particles < 5.0 {
            check.warn(format!(
                "domain.dp_m = {}: {particles:.1} particle spacings per wave height, 5 to 10 needed \
                 (Altomare et al. 2017)",
                show(domain.dp)
            ));
        }
    }
}

fn validate_distance(limit: &str, nearest: f64, domain: &Domain, check: &mut Checker) {
    if domain.x[0] <= nearest {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("beyond {limit}, > {} m", show(nearest)),
            "move the seaward end of the domain shoreward; the flume model carries the wave there",
        );
    }
}

fn validate_sweep(stroke: f64, height: f64, domain: &Domain, check: &mut Checker) {
    let most = LARGEST_SWEEP * (domain.x[1] - domain.x[0]);
    if stroke.is_nan() || stroke > most {
        check.refuse(
            "wave.height_m",
            show(height),
            format!(
                "such that the stroke of the paddle, {} m, is at most half of the domain's length, {} m",
                show(stroke),
                show(most)
            ),
            "lengthen the domain or lower the wave",
        );
    }
}

/// Warns of a sloping bed, because the theory of a paddle assumes a horizontal one.
fn warn_of_slope(flume: &Flume, domain: &Domain, depth: f64, check: &mut Checker) {
    let x0 = domain.x[0];
    let rise = flume.profile.z(x0 + depth) - flume.profile.z(x0);
    if rise.abs() > EVEN_SLOPE * depth {
        check.warn(format!(
            "domain.x_m[0] = {}: the bed changes by {} m over one depth; the wavemaker theory has a horizontal bed",
            show(x0),
            show(rise)
        ));
    }
}

fn warn_of_order(wave: &RegularWave, wavemaker: Wavemaker, check: &mut Checker) {
    if matches!(wavemaker, Wavemaker::Piston { .. }) && !wave.is_second_order() {
        check.warn(format!(
            "wave.height_m = {}: H L^2 / d^3 exceeds 8 pi^2 / 3, the limit of the piston's second-order motion \
             (Madsen 1971); a free secondary wave will follow each crest",
            show(wave.height_m)
        ));
    }
}
