//! The wave, validated.

use super::check::{Checker, above, from, show};
use super::domain::{Domain, Start};
use super::file::{
    self, DomainFile, GivenWaveFile, IrregularFile, RegularFile, SolitaryFile, SolitaryTheory, WaterFile, WaveFile,
};
use super::flume::Flume;
use super::given_wave::{self, GivenWave};
use super::wavemaker::{self, Wavemaker};
use crate::waves::irregular::{IrregularWave, JonswapSea};
use crate::waves::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::regular::{MeanFlow, RegularWave, WaveError};
use crate::waves::solitary::{PistonTheory, SolitaryWave, ThirdOrderSolitary};
use crate::waves::stream_function::StreamFunctionWave;

/// Shortest regular wave, in depths.
const SHORTEST_LENGTH: f64 = 0.1;

/// The wave, for the depth where it is made: at the seaward end of the flume, or of the domain if a paddle makes it
/// there.
#[derive(Debug, Clone, PartialEq)]
pub enum Wave {
    /// No wave.
    None,
    /// A solitary wave that a piston makes.
    Solitary(SolitaryWave),
    /// A solitary wave that flows into the flume.
    SolitaryInflow(ThirdOrderSolitary),
    /// Regular waves.
    Regular {
        /// One of them.
        wave: RegularWave,
        /// Periods over which they grow from nothing [-].
        ramp_periods: f64,
    },
    /// A sea that flows into the flume.
    Irregular {
        /// The sea.
        sea: JonswapSea,
        /// Peak periods over which it grows from nothing [-].
        ramp_periods: f64,
    },
    /// A wave from another program.
    Given(GivenWave),
}

impl Wave {
    /// Height of the wave, of a sea the significant one, where it is known [m].
    pub fn height(&self) -> Option<f64> {
        match self {
            Self::None | Self::Given(_) => None,
            Self::Solitary(wave) => Some(wave.height_m),
            Self::SolitaryInflow(wave) => Some(wave.height_m),
            Self::Regular { wave, .. } => Some(wave.height_m),
            Self::Irregular { sea, .. } => Some(sea.significant_height_m),
        }
    }

    /// Period, of a sea that of its peak; none for a solitary wave, nor where it is not known [s].
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::None | Self::Solitary(_) | Self::SolitaryInflow(_) | Self::Given(_) => None,
            Self::Regular { wave, .. } => Some(wave.period_s),
            Self::Irregular { sea, .. } => Some(sea.peak_period_s),
        }
    }
}

impl Wavemaker {
    /// What moves, over a bed at the level `bed_z` [m].
    pub fn shape(self, bed_z: f64) -> PaddleShape {
        match self {
            Self::MlPiston { .. } | Self::Piston { .. } => PaddleShape::Piston,
            Self::Flap { hinge_z } => PaddleShape::Flap { hinge_m: hinge_z - bed_z },
        }
    }

    /// The motion of the paddle for regular waves over a bed at the level `bed_z` [m].
    pub fn motion(self, wave: &RegularWave, ramp_periods: f64, bed_z: f64) -> RegularMotion {
        RegularMotion::new(wave, self.shape(bed_z), ramp_periods)
    }
}

/// What the wave is validated against.
pub(super) struct Surroundings<'a> {
    /// Name of the case file, from whose folder paths are seen.
    pub name: &'a str,
    pub domain_file: &'a DomainFile,
    pub wavemaker: Wavemaker,
    pub gravity: f64,
    pub flume: Option<&'a Flume>,
    pub domain: Option<&'a Domain>,
}

/// Validate the wave.
pub(super) fn validate(file: &WaveFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let (kind, before) = match file {
        WaveFile::None {} => return Some(Wave::None),
        WaveFile::Solitary(_) => ("\"solitary\"", check.count()),
        WaveFile::Regular(_) => ("\"regular\"", check.count()),
        WaveFile::Irregular(_) => ("\"irregular\"", check.count()),
        WaveFile::File(_) => ("\"file\"", check.count()),
    };
    if matches!(around.domain_file.water, WaterFile::Block(_)) {
        check.refuse(
            "wave.kind",
            kind,
            "\"none\" while `domain.water` is a block",
            "remove `domain.water` for a wave, or `wave` for a dam break",
        );
    }
    if !around.wavemaker.is_ml_piston() {
        refuse_start(around.domain_file, check);
    }
    let wave = match file {
        WaveFile::None {} => Some(Wave::None),
        WaveFile::Solitary(file) => validate_solitary(file, around, check),
        WaveFile::Regular(file) => validate_regular(file, around, check),
        WaveFile::Irregular(file) => validate_irregular(file, around, check),
        WaveFile::File(file) => validate_given(file, around, check),
    }?;
    if check.count() > before {
        return None;
    }
    wavemaker::validate_place(&wave, around.wavemaker, around.flume?, around.domain?, check);
    (check.count() == before).then_some(wave)
}

/// Keys that would be of no effect.
fn refuse_start(file: &DomainFile, check: &mut Checker) {
    let share = Some(file.start_at_share).filter(|&share| share != file::default_start_share());
    for (key, value) in [("start_s", file.start_s), ("start_at_share", share)] {
        if let Some(value) = value {
            check.refuse(
                &format!("domain.{key}"),
                show(value),
                "left out while `wavemaker.kind` is \"piston\" or \"flap\"",
                "it is a time of the flume model, which does not run: the paddle starts in still water with the particles",
            );
        }
    }
}

fn validate_solitary(file: &SolitaryFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let (flume, depth) = (around.flume?, around.depth()?);
    if depth <= 0.0 {
        check.refuse(
            "flume.still_water_level_m",
            show(flume.still_level),
            format!("above the bed at the wavemaker, {} m", show(flume.still_level - depth)),
            "a solitary wave starts in still water at the seaward end of the bed",
        );
        return None;
    }
    // Beyond 0.6 d no theory is near the exact wave; beyond 0.78 d it would break.
    check.number(
        "wave.height_m",
        file.height_m,
        above(0.0).up_to(0.6 * depth),
        "m",
        &format!("at most 0.6 of the offshore depth, {} m", show(depth)),
    );
    let (height_m, depth_m, gravity) = (file.height_m, depth, around.gravity);
    let piston = |theory| Wave::Solitary(SolitaryWave { height_m, depth_m, gravity, theory });
    Some(match file.theory {
        SolitaryTheory::Boussinesq => piston(PistonTheory::Boussinesq),
        SolitaryTheory::Rayleigh => piston(PistonTheory::Rayleigh),
        SolitaryTheory::ThirdOrder => {
            if !around.wavemaker.is_ml_piston() {
                check.refuse(
                    "wave.theory",
                    "\"third_order\"",
                    "\"rayleigh\" or \"boussinesq\" with a piston in the particles",
                    "a wave of third order flows into the flume model: leave `wavemaker` out for it",
                );
            }
            Wave::SolitaryInflow(ThirdOrderSolitary { height_m, depth_m, gravity })
        }
    })
}

fn validate_regular(file: &RegularFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let sound = check.number("wave.period_s", file.period_s, from(0.01).up_to(1e4), "s", "write the period in seconds");
    validate_ramp(file.ramp_periods, check);
    let depth = around.wet_depth(check)?;
    if !sound || around.gravity.is_nan() || around.gravity <= 0.0 {
        return None;
    }
    let (height_m, period_s, gravity) = (file.height_m, file.period_s, around.gravity);
    let wave = RegularWave { height_m, period_s, depth_m: depth, gravity };
    let length = wave.length_m();
    if length < SHORTEST_LENGTH * depth {
        check.refuse(
            "wave.period_s",
            show(period_s),
            format!("long enough for a wave of at least {} m, a tenth of the depth", show(SHORTEST_LENGTH * depth)),
            "such short waves move nothing but the surface: make the domain shallower or write a longer period",
        );
        return None;
    }
    let sound = check.number(
        "wave.height_m",
        height_m,
        above(0.0).up_to(wave.breaking_height_m()),
        "m",
        &format!("higher waves of this period, {} m long in {} m of water, break", show(length), show(depth)),
    );
    if sound && around.wavemaker.is_ml_piston() {
        let permanent = StreamFunctionWave::new(wave, MeanFlow::NoTransport);
        refuse_impossible(permanent.err(), "wave.height_m", height_m, check);
    }
    Some(Wave::Regular { wave, ramp_periods: file.ramp_periods })
}

fn validate_irregular(file: &IrregularFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let before = check.count();
    let period = "write the period of the spectrum's peak in seconds";
    check.number("wave.peak_period_s", file.peak_period_s, from(0.01).up_to(1e4), "s", period);
    check.number("wave.peak_enhancement", file.peak_enhancement, from(1.0).up_to(10.0), "", "3.3 is the average");
    // The longest is what 5,000 waves can make.
    let repeat = "200 repeats after two hundred peak periods";
    check.number("wave.repeat_periods", file.repeat_periods, from(20.0).up_to(2000.0), "", repeat);
    validate_ramp(file.ramp_periods, check);
    let depth = around.wet_depth(check)?;
    // Twice this height, the highest wave in 3,000, is what a solitary wave breaks at.
    let height = format!("at most 0.4 of the depth, {} m", show(depth));
    check.number("wave.significant_height_m", file.significant_height_m, above(0.0).up_to(0.4 * depth), "m", &height);
    if check.count() > before || around.gravity.is_nan() || around.gravity <= 0.0 {
        return None;
    }
    let sea = JonswapSea {
        significant_height_m: file.significant_height_m,
        peak_period_s: file.peak_period_s,
        peak_enhancement: file.peak_enhancement,
        depth_m: depth,
        gravity: around.gravity,
        repeat_s: file.repeat_periods * file.peak_period_s,
        seed: file.seed,
    };
    let drawn = IrregularWave::new(sea);
    refuse_impossible(drawn.err(), "wave.significant_height_m", file.significant_height_m, check);
    Some(Wave::Irregular { sea, ramp_periods: file.ramp_periods })
}

fn validate_given(file: &GivenWaveFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let (flume, domain) = (around.flume?, around.domain?);
    let wave = given_wave::validate(file, around.name, flume, domain, around.gravity, check)?;
    if let Start::At(start) = domain.start {
        given_wave::refuse_late_start(&wave, start, check);
    }
    Some(Wave::Given(wave))
}

/// What the theory of the wave itself refuses.
fn refuse_impossible(error: Option<WaveError>, path: &str, value: f64, check: &mut Checker) {
    if let Some(error) = error {
        let advice = "lower the wave, or write another period or depth";
        check.refuse(path, show(value), format!("the height of a wave that exists ({error})"), advice);
    }
}

fn validate_ramp(ramp_periods: f64, check: &mut Checker) {
    let advice = "2 lets the waves start without a splash";
    check.number("wave.ramp_periods", ramp_periods, from(0.5).up_to(100.0), "", advice);
}

impl Surroundings<'_> {
    /// Still depth where the wave is made [m].
    fn depth(&self) -> Option<f64> {
        let flume = self.flume?;
        if self.wavemaker.is_ml_piston() {
            return Some(flume.offshore_depth());
        }
        Some(flume.still_depth(self.domain?.x[0]))
    }

    /// The same, above zero.
    fn wet_depth(&self, check: &mut Checker) -> Option<f64> {
        let depth = self.depth()?;
        if depth > 0.0 {
            return Some(depth);
        }
        if self.wavemaker.is_ml_piston() {
            check.refuse(
                "flume.still_water_level_m",
                show(self.flume?.still_level),
                format!("above the bed at the seaward end, {} m", show(self.flume?.still_level - depth)),
                "waves flow in where there is water",
            );
        } else {
            check.refuse(
                "domain.x_m[0]",
                show(self.domain?.x[0]),
                "in still water (the bed there is dry)",
                "a paddle stands in the water at the seaward end of the domain",
            );
        }
        None
    }
}
