//! Validates waves from wave theory: solitary, regular and irregular waves.

use super::{Surroundings, Wave};
use crate::case::file::{IrregularFile, RegularFile, SolitaryFile, SolitaryTheory};
use crate::case::reading::check::{Checker, as_text, at_least, more_than};
use crate::waves::theory::irregular::{IrregularWave, JonswapSea};
use crate::waves::theory::regular::{MeanFlow, RegularWave, WaveError};
use crate::waves::theory::solitary::{PistonTheory, SolitaryWave, ThirdOrderSolitary};
use crate::waves::theory::stream_function::StreamFunctionWave;

/// Smallest allowed wavelength of regular waves / water depth [-].
const SHORTEST_LENGTH: f64 = 0.1;

pub(super) fn solitary(file: &SolitaryFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let (flume, depth) = (around.flume?, around.depth()?);
    if depth <= 0.0 {
        check.reject(
            "flume.still_water_level_m",
            as_text(flume.still_water_level),
            format!("above the bed where the wave is generated, {} m", as_text(around.bed_z()?)),
            "raise the still water level: the wave must be generated in water",
        );
        return None;
    }
    // For a height above 0.6 depths, no theory is close to the exact wave. Above 0.78 depths, the wave breaks.
    check.number(
        "wave.height_m",
        file.height_m,
        more_than(0.0).up_to(0.6 * depth),
        "m",
        &format!("the limit is 0.6 times the depth where the wave is generated, {} m", as_text(depth)),
    );
    let (height_m, depth_m, gravity) = (file.height_m, depth, around.gravity);
    let piston = |theory| Wave::Solitary(SolitaryWave { height_m, depth_m, gravity, theory });
    Some(match file.theory {
        SolitaryTheory::Boussinesq => piston(PistonTheory::Boussinesq),
        SolitaryTheory::Rayleigh => piston(PistonTheory::Rayleigh),
        SolitaryTheory::ThirdOrder => {
            if !around.wavemaker.follows_flume_model() {
                check.reject(
                    "wave.theory",
                    "\"third_order\"",
                    "\"rayleigh\" or \"boussinesq\" with a piston in the particle domain",
                    "a third-order wave enters the flume model: remove `wavemaker`",
                );
            }
            Wave::SolitaryInflow(ThirdOrderSolitary { height_m, depth_m, gravity })
        }
    })
}

pub(super) fn regular(file: &RegularFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let is_valid =
        check.number("wave.period_s", file.period_s, at_least(0.01).up_to(1e4), "s", "write the period in seconds");
    validate_ramp(file.ramp_periods, check);
    let depth = around.wet_depth(check)?;
    if !is_valid || around.gravity.is_nan() || around.gravity <= 0.0 {
        return None;
    }
    let (height_m, period_s, gravity) = (file.height_m, file.period_s, around.gravity);
    let wave = RegularWave { height_m, period_s, depth_m: depth, gravity };
    let length = wave.wavelength_m();
    if length < SHORTEST_LENGTH * depth {
        check.reject(
            "wave.period_s",
            as_text(period_s),
            format!("such that the wavelength is at least {} m, depth / 10", as_text(SHORTEST_LENGTH * depth)),
            "shorter waves move only the surface layer: write a longer period or a smaller water depth",
        );
        return None;
    }
    let is_valid = check.number(
        "wave.height_m",
        height_m,
        more_than(0.0).up_to(wave.breaking_height_m()),
        "m",
        &format!("higher waves of this period (wavelength {} m, depth {} m) break", as_text(length), as_text(depth)),
    );
    if is_valid && around.wavemaker.follows_flume_model() {
        let permanent = StreamFunctionWave::new(wave, MeanFlow::NoTransport);
        refuse_impossible(permanent.err(), "wave.height_m", height_m, check);
    }
    Some(Wave::Regular { wave, ramp_periods: file.ramp_periods })
}

pub(super) fn irregular(file: &IrregularFile, around: &Surroundings, check: &mut Checker) -> Option<Wave> {
    let before = check.count();
    let period = "write the peak period of the spectrum in seconds";
    check.number("wave.peak_period_s", file.peak_period_s, at_least(0.01).up_to(1e4), "s", period);
    let mean = "3.3 is the mean of the JONSWAP spectra";
    check.number("wave.peak_enhancement", file.peak_enhancement, at_least(1.0).up_to(10.0), "", mean);
    // An irregular wave has at most 5,000 components; 2000 periods need 4,800 components.
    let repeat = "with 200, the waves repeat after 200 peak periods";
    check.number("wave.repeat_periods", file.repeat_periods, at_least(20.0).up_to(2000.0), "", repeat);
    validate_ramp(file.ramp_periods, check);
    let depth = around.wet_depth(check)?;
    // The highest of 3,000 waves is twice as high as H_s: at most 0.8 depths. A solitary wave of this height breaks.
    let height = format!("the limit is 0.4 times the depth, {} m", as_text(depth));
    check.number(
        "wave.significant_height_m",
        file.significant_height_m,
        more_than(0.0).up_to(0.4 * depth),
        "m",
        &height,
    );
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
    let components = IrregularWave::new(sea);
    refuse_impossible(components.err(), "wave.significant_height_m", file.significant_height_m, check);
    Some(Wave::Irregular { sea, ramp_periods: file.ramp_periods })
}

/// Refuses a wave for which wave theory has no solution, which `error` describes.
fn refuse_impossible(error: Option<WaveError>, path: &str, value: f64, check: &mut Checker) {
    if let Some(error) = error {
        let advice = "lower the wave or change its period or the depth";
        check.reject(path, as_text(value), format!("a height for which wave theory has a solution ({error})"), advice);
    }
}

fn validate_ramp(ramp_periods: f64, check: &mut Checker) {
    let advice = "with a ramp of 2 periods, the waves start smoothly";
    check.number("wave.ramp_periods", ramp_periods, at_least(0.5).up_to(100.0), "", advice);
}
