//! Validates the wavemaker.

use crate::case::file::{WaveFile, WavemakerFile};
use crate::case::flume::bed::Flume;
use crate::case::flume::domain::Domain;
use crate::case::reading::check::{Checker, at_least};
use crate::waves::generation::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::theory::regular::RegularWave;

/// Largest allowed distance of a hinge from z = 0 [m]. Larger values are probably typing errors.
const FURTHEST_HINGE: f64 = 1e5;

/// Largest distance of an absorption gauge from its end of the domain, divided by the length of the region at this end
/// [-].
pub const SHARE_TO_GAUGE: f64 = 0.5;

/// Smallest distance of an absorption gauge from the piston, divided by the particle spacing [-]. A nearer gauge would
/// measure the gap between piston and water.
pub(super) const NEAREST_GAUGE: f64 = 4.0;
/// The same for the gauges of open ends, which measure the water between the end and twice this distance [-].
pub(super) const NEAREST_OPEN_GAUGE: f64 = 6.0;
/// Distance of the gauges of open ends, divided by the still water depth at the seaward end [-].
const USUAL_GAUGE: f64 = 0.5;

/// Wavemaker at the seaward end of the particle domain, or open ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wavemaker {
    /// Multi-layer piston. Its rows move with the water of the flume model or of the wave files.
    MlPiston {
        /// Distance of the absorption gauge from the piston, if there is one [m].
        absorption_gauge: Option<f64>,
    },
    /// Open ends: at both ends of the domain, water flows in and out as in the flume model.
    OpenEnds {
        /// Distance of the gauges from the ends [m].
        gauge: f64,
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
    /// Returns true for the multi-layer piston and for open ends, which take the wave from the flume model or from
    /// files.
    pub fn follows_flume_model(&self) -> bool {
        matches!(self, Self::MlPiston { .. } | Self::OpenEnds { .. })
    }

    /// Returns the distance of the absorption gauge from the piston, if there is one [m].
    pub fn absorption_gauge(&self) -> Option<f64> {
        match *self {
            Self::MlPiston { absorption_gauge } | Self::Piston { absorption_gauge } => absorption_gauge,
            Self::OpenEnds { gauge } => Some(gauge),
            Self::Flap { .. } => None,
        }
    }

    /// Returns the shape of the paddle; `bed_z` is the bed level at the paddle [m].
    pub fn shape(self, bed_z: f64) -> PaddleShape {
        match self {
            Self::MlPiston { .. } | Self::OpenEnds { .. } | Self::Piston { .. } => PaddleShape::Piston,
            Self::Flap { hinge_z } => PaddleShape::Flap { hinge_m: hinge_z - bed_z },
        }
    }

    /// Returns the motion of the paddle for regular waves; `bed_z` is the bed level at the paddle [m].
    pub fn motion(self, wave: &RegularWave, ramp_periods: f64, bed_z: f64) -> RegularMotion {
        RegularMotion::new(wave, self.shape(bed_z), ramp_periods)
    }
}

/// Validates the wavemaker and refuses combinations with the wave that are not implemented.
pub fn validate(
    file: &WavemakerFile,
    wave: &WaveFile,
    flume: Option<&Flume>,
    domain: Option<&Domain>,
    check: &mut Checker,
) -> Wavemaker {
    let mut refuse = |value: &str, allowed: &str, advice: &str| {
        check.reject("wavemaker.kind", format!("{value:?}"), allowed, advice);
    };
    match (wave, file) {
        (WaveFile::None {}, WavemakerFile::Piston(_) | WavemakerFile::Flap(_)) => refuse(
            kind_name(file),
            "left out while `wave` is left out or \"none\"",
            "add a wave, e.g. \"wave\": { \"kind\": \"regular\", \"height_m\": 0.1, \"period_s\": 1.2 }",
        ),
        (WaveFile::None {} | WaveFile::File(_), WavemakerFile::OpenEnds(_)) => refuse(
            kind_name(file),
            "\"ml_piston\" while no wave comes from the flume model",
            "remove `wavemaker`, or use a wave that the flume model carries",
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
            check.reject(
                "wavemaker.absorption_gauge_m",
                "present",
                "absent, because no wave comes from the flume model: the generated elevation at the gauge is not known",
                "remove it",
            );
            Wavemaker::MlPiston { absorption_gauge: None }
        }
        WavemakerFile::MlPiston(piston) => Wavemaker::MlPiston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::OpenEnds(ends) => {
            let usual = |(flume, domain): (&Flume, &Domain)| {
                (USUAL_GAUGE * flume.still_depth(domain.x[0])).max(NEAREST_OPEN_GAUGE * domain.spacing_at(domain.x[0]))
            };
            Wavemaker::OpenEnds { gauge: ends.gauge_m.or(flume.zip(domain).map(usual)).unwrap_or(f64::NAN) }
        }
        WavemakerFile::Piston(piston) => Wavemaker::Piston { absorption_gauge: piston.absorption_gauge_m },
        WavemakerFile::Flap(flap) => {
            let highest = flume.map_or(FURTHEST_HINGE, |flume| flume.still_water_level);
            // With a hinge at the still water level, the flap would have no length below the water surface.
            check.number(
                "wavemaker.hinge_z_m",
                flap.hinge_z_m,
                at_least(-FURTHEST_HINGE).below(highest),
                "m",
                "write a z coordinate as in `flume.bed_m`, below the still water level; a hinge at the bed is usual",
            );
            Wavemaker::Flap { hinge_z: flap.hinge_z_m }
        }
    }
}

fn kind_name(file: &WavemakerFile) -> &'static str {
    match file {
        WavemakerFile::MlPiston(_) => "ml_piston",
        WavemakerFile::OpenEnds(_) => "open_ends",
        WavemakerFile::Piston(_) => "piston",
        WavemakerFile::Flap(_) => "flap",
    }
}
