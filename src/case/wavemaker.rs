//! What makes the wave in the particles, validated.

use super::check::{Checker, from, show};
use super::domain::Domain;
use super::file::{WaveFile, WavemakerFile};
use super::flume::Flume;
use super::wave::Wave;
use crate::waves::regular::RegularWave;

/// Share of the domain's length that a paddle may sweep.
const LARGEST_SWEEP: f64 = 0.5;
/// Slope of the bed beyond which the wave before a paddle is visibly not that of theory, which has an even bed.
const EVEN_SLOPE: f64 = 0.02;
/// A hinge further from the bed than this is a slip of the keyboard [m].
const FURTHEST_HINGE: f64 = 1e5;

/// What makes the wave in the particles; it stands at the seaward end of the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wavemaker {
    /// Rows that follow the water of the flume model.
    MlPiston {
        /// Distance of the gauge by which they absorb what comes back, if they do [m].
        absorption_gauge: Option<f64>,
    },
    /// A rigid piston.
    Piston {
        /// Distance of the gauge by which it absorbs what comes back, if it does [m].
        absorption_gauge: Option<f64>,
    },
    /// A paddle that turns about a hinge.
    Flap {
        /// Level of the hinge [m].
        hinge_z: f64,
    },
}

impl Wavemaker {
    /// Whether the wave comes from the flume model or files.
    pub fn is_ml_piston(&self) -> bool {
        matches!(self, Self::MlPiston { .. })
    }

    /// Distance of the gauge by which it absorbs what comes back, if it does [m].
    pub fn absorption_gauge(&self) -> Option<f64> {
        match *self {
            Self::MlPiston { absorption_gauge } | Self::Piston { absorption_gauge } => absorption_gauge,
            Self::Flap { .. } => None,
        }
    }
}

/// Validate the kind of wavemaker against that of the wave: what is not implemented does not pass.
pub(super) fn validate(file: &WavemakerFile, wave: &WaveFile, flume: Option<&Flume>, check: &mut Checker) -> Wavemaker {
    let mut refuse = |value: &str, allowed: &str, advice: &str| {
        check.refuse("wavemaker.kind", format!("{value:?}"), allowed, advice);
    };
    match (wave, file) {
        (WaveFile::None {}, WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            name(file),
            "left out while `wave` is left out or \"none\"",
            "add a wave, e.g. \"wave\": { \"kind\": \"regular\", \"height_m\": 0.1, \"period_s\": 1.2 }",
        ),
        (WaveFile::Solitary(_), WavemakerFile::Flap(_)) => refuse(
            name(file),
            "\"ml_piston\" or \"piston\" for a solitary wave",
            "a solitary wave moves the water to the bed: no flap makes it",
        ),
        (WaveFile::Irregular(_), WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            name(file),
            "\"ml_piston\" for irregular waves",
            "leave `wavemaker` out: the flume model carries the sea to the domain",
        ),
        (WaveFile::File(_), WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            name(file),
            "\"ml_piston\" for a wave from files",
            "leave `wavemaker` out: its rows follow the velocities in the files",
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
                "absent, because no wave comes from the flume model: the surface that the gauge should show is not known",
                "leave it out",
            );
            Wavemaker::MlPiston { absorption_gauge: None }
        }
        WavemakerFile::MlPiston(piston) => Wavemaker::MlPiston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::Piston(piston) => Wavemaker::Piston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::Flap(flap) => {
            let highest = flume.map_or(FURTHEST_HINGE, |flume| flume.still_level);
            // At the surface the flap would have no arm.
            check.number(
                "wavemaker.hinge_z_m",
                flap.hinge_z_m,
                from(-FURTHEST_HINGE).below(highest),
                "m",
                "the hinge lies below the still water, in the z of `flume.bed_m`; most flaps turn about the bed",
            );
            Wavemaker::Flap { hinge_z: flap.hinge_z_m }
        }
    }
}

fn name(file: &WavemakerFile) -> &'static str {
    match file {
        WavemakerFile::MlPiston(_) => "ml_piston",
        WavemakerFile::Piston(_) => "piston",
        WavemakerFile::Flap(_) => "flap",
    }
}

/// Validate where the wavemaker stands and how far it goes.
pub(super) fn validate_place(wave: &Wave, wavemaker: Wavemaker, flume: &Flume, domain: &Domain, check: &mut Checker) {
    let depth = flume.still_depth(domain.x[0]);
    // Four particles is the least over which a wavemaker can act as a wall.
    if depth < 4.0 * domain.dp {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("in still water at least 4 particles deep (the depth there is {} m)", show(depth)),
            "start the domain further from the shore",
        );
    }
    if let Some(gauge) = wavemaker.absorption_gauge() {
        // Nearer than four particles the gauge would show the gap at the piston.
        let (nearest, furthest) = (4.0 * domain.dp, 0.5 * (domain.x[1] - domain.x[0]));
        let advice = "a depth from the piston is usual; what comes back must not be what has just gone out";
        check.number("wavemaker.absorption_gauge_m", gauge, from(nearest).up_to(furthest), "m", advice);
    }
    match wave {
        Wave::None | Wave::Given(_) => {}
        Wave::Solitary(wave) if wavemaker.is_ml_piston() => {
            validate_distance("the piston's reach", flume.ends()[0] + wave.stroke_m(), domain, check);
        }
        _ if wavemaker.is_ml_piston() => {
            validate_distance("a depth from the inflow", flume.ends()[0] + flume.offshore_depth(), domain, check);
        }
        Wave::SolitaryInflow(_) | Wave::Irregular { .. } => {}
        Wave::Solitary(wave) => {
            validate_sweep(wave.stroke_m(), wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
        }
        Wave::Regular { wave, ramp_periods } => {
            let bed_z = flume.profile.z(domain.x[0]);
            let at_top = wavemaker.shape(bed_z).share(domain.top_z - bed_z, depth).max(1.0);
            let stroke = 2.0 * at_top * wavemaker.motion(wave, *ramp_periods, bed_z).reach_m();
            validate_sweep(stroke, wave.height_m, domain, check);
            warn_of_slope(flume, domain, depth, check);
            warn_of_order(wave, wavemaker, check);
        }
    }
    if let Some(height) = wave.height() {
        let particles = height / domain.dp;
        if particles < 5.0 {
            check.warn(format!(
                "domain.dp_m = {}: {particles:.1} particles in the wave height; 5 to 10 are needed (Altomare et al. 2017)",
                show(domain.dp)
            ));
        }
    }
}

fn validate_distance(beyond: &str, nearest: f64, domain: &Domain, check: &mut Checker) {
    if domain.x[0] <= nearest {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("beyond {beyond}, > {} m", show(nearest)),
            "start the domain further from the wavemaker; the flume model carries the wave there",
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

/// A paddle moves by the theory of an even bed.
fn warn_of_slope(flume: &Flume, domain: &Domain, depth: f64, check: &mut Checker) {
    let x0 = domain.x[0];
    let rise = flume.profile.z(x0 + depth) - flume.profile.z(x0);
    if rise.abs() > EVEN_SLOPE * depth {
        check.warn(format!(
            "domain.x_m[0] = {}: the bed rises by {} m over one depth before the wavemaker, whose theory has an even bed",
            show(x0),
            show(rise)
        ));
    }
}

fn warn_of_order(wave: &RegularWave, wavemaker: Wavemaker, check: &mut Checker) {
    if matches!(wavemaker, Wavemaker::Piston { .. }) && !wave.is_second_order() {
        check.warn(format!(
            "wave.height_m = {}: H L^2 / d^3 exceeds 8 pi^2 / 3, where the second-order motion of the piston holds no longer \
             (Madsen 1971); a free second wave will follow each crest",
            show(wave.height_m)
        ));
    }
}
