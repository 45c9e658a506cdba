//! Validates the wavemaker.

use crate::case::file::{WaveFile, WavemakerFile};
use crate::case::flume::bed::Flume;
use crate::case::reading::check::{Checker, at_least};
use crate::waves::generation::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::theory::regular::RegularWave;

/// Largest allowed distance of a hinge from z = 0 [m]. Larger values are probably typing errors.
const FURTHEST_HINGE: f64 = 1e5;

/// Wavemaker at the seaward end of the particle domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wavemaker {
    /// Multi-layer piston. Its rows move with the water of the flume model or of the wave files.
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
    /// Returns true for the multi-layer piston, which takes the wave from the flume model or from files.
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

    /// Returns the shape of the paddle; `bed_z` is the bed level at the paddle [m].
    pub fn shape(self, bed_z: f64) -> PaddleShape {
        match self {
            Self::MlPiston { .. } | Self::Piston { .. } => PaddleShape::Piston,
            Self::Flap { hinge_z } => PaddleShape::Flap { hinge_m: hinge_z - bed_z },
        }
    }

    /// Returns the motion of the paddle for regular waves; `bed_z` is the bed level at the paddle [m].
    pub fn motion(self, wave: &RegularWave, ramp_periods: f64, bed_z: f64) -> RegularMotion {
        RegularMotion::new(wave, self.shape(bed_z), ramp_periods)
    }
}

/// Validates the wavemaker and refuses combinations with the wave that are not implemented.
pub fn validate(file: &WavemakerFile, wave: &WaveFile, flume: Option<&Flume>, check: &mut Checker) -> Wavemaker {
    let mut refuse = |value: &str, allowed: &str, advice: &str| {
        check.reject("wavemaker.kind", format!("{value:?}"), allowed, advice);
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
            check.reject(
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
        WavemakerFile::Piston(_) => "piston",
        WavemakerFile::Flap(_) => "flap",
    }
}
