//! The wave, validated.

use super::check::{Checker, above, from, show};
use super::domain::Domain;
use super::file::{self, RegularFile, SolitaryFile, SolitaryTheory, WaterFile, WaveFile};
use super::flume::Flume;
use super::wavemaker::{self, Wavemaker};
use crate::waves::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::regular;

/// Shortest regular wave, in depths.
const SHORTEST_LENGTH: f64 = 0.1;
/// Cells of the flume model at most.
const MOST_FLUME_CELLS: f64 = 200_000.0;

/// The wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wave {
    /// No wave.
    None,
    /// A solitary wave.
    Solitary(SolitaryWave),
    /// Regular waves.
    Regular(RegularWave),
}

impl Wave {
    /// Height of the wave, if there is one [m].
    pub fn height(&self) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Solitary(wave) => Some(wave.height),
            Self::Regular(wave) => Some(wave.height),
        }
    }
}

/// A solitary wave; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryWave {
    /// Height above the still water in that depth [m].
    pub height: f64,
    /// Still depth at the piston that makes it [m]: at the seaward end of the flume, or of the domain.
    pub depth: f64,
    /// Shape of the wave.
    pub theory: SolitaryTheory,
    /// Layers of the flume model.
    pub layers: usize,
    /// Cell of the flume model [m].
    pub flume_cell: f64,
    /// Flume time at which the particles start.
    pub start: Start,
}

/// Flume time at which the particles start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// At this flume time [s].
    At(f64),
    /// When the velocity at the wavemaker's place reaches this share of its maximum [-].
    AtShare(f64),
}

impl SolitaryWave {
    /// Outskirts decay coefficient k [1/m] (Goring & Raichlen 1980 for Boussinesq's wave; Guizien & Barthelemy 2002 for
    /// Rayleigh's).
    pub fn decay(&self) -> f64 {
        let (height, depth) = (self.height, self.depth);
        match self.theory {
            SolitaryTheory::Boussinesq => (3.0 * height / (4.0 * depth.powi(3))).sqrt(),
            SolitaryTheory::Rayleigh => (3.0 * height / (4.0 * depth.powi(2) * (depth + height))).sqrt(),
        }
    }

    /// Stroke of the piston S = 2 H / (k d) [m].
    pub fn stroke(&self) -> f64 {
        2.0 * self.height / (self.decay() * self.depth)
    }
}

/// Regular waves; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularWave {
    /// Height from trough to crest [m].
    pub height: f64,
    /// Period [s].
    pub period: f64,
    /// Periods over which the stroke grows [-].
    pub ramp_periods: f64,
    /// Still depth at the paddle [m].
    pub depth: f64,
    /// Gravity [m/s2].
    pub gravity: f64,
}

impl RegularWave {
    /// Their theory.
    pub fn theory(&self) -> regular::RegularWave {
        regular::RegularWave {
            height_m: self.height,
            period_s: self.period,
            depth_m: self.depth,
            gravity: self.gravity,
        }
    }

    /// The motion of the paddle over a bed at the level `bed_z` [m].
    pub fn motion(&self, wavemaker: Wavemaker, bed_z: f64) -> RegularMotion {
        RegularMotion::new(&self.theory(), wavemaker.shape(bed_z), self.ramp_periods)
    }
}

impl Wavemaker {
    /// What moves, over a bed at the level `bed_z` [m].
    pub fn shape(self, bed_z: f64) -> PaddleShape {
        match self {
            Self::MlPiston | Self::Piston => PaddleShape::Piston,
            Self::Flap { hinge_z } => PaddleShape::Flap { hinge_m: hinge_z - bed_z },
        }
    }
}

/// What the wave is validated against.
pub(super) struct Surroundings<'a> {
    pub water: &'a WaterFile,
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
    };
    if matches!(around.water, WaterFile::Block(_)) {
        check.refuse(
            "wave.kind",
            kind,
            "\"none\" while `domain.water` is a block",
            "remove `domain.water` for a wave, or `wave` for a dam break",
        );
    }
    let wave = match file {
        WaveFile::None {} => Some(Wave::None),
        WaveFile::Solitary(file) => validate_solitary(file, around, check).map(Wave::Solitary),
        WaveFile::Regular(file) => validate_regular(file, around, check).map(Wave::Regular),
    }?;
    if check.count() > before {
        return None;
    }
    wavemaker::validate_place(&wave, around.wavemaker, around.flume?, around.domain?, check);
    (check.count() == before).then_some(wave)
}

fn validate_solitary(file: &SolitaryFile, around: &Surroundings, check: &mut Checker) -> Option<SolitaryWave> {
    validate_numbers(file, check);
    let flume = around.flume?;
    let depth = if around.wavemaker == Wavemaker::MlPiston {
        flume.offshore_depth()
    } else {
        refuse_keys_of_the_flume_model(file, check);
        around.depth_at_paddle()?
    };
    validate_height(file.height_m, depth, flume, check);
    let length = flume.ends()[1] - flume.ends()[0];
    if file.flume_cell_m > 0.0 && length / file.flume_cell_m > MOST_FLUME_CELLS {
        check.refuse(
            "wave.flume_cell_m",
            show(file.flume_cell_m),
            format!("at least {} m, for {MOST_FLUME_CELLS} cells in the flume", show(length / MOST_FLUME_CELLS)),
            "write a larger cell or shorten `flume.bed_m`",
        );
    }
    Some(SolitaryWave {
        height: file.height_m,
        depth,
        theory: file.theory,
        layers: file.layers as usize,
        flume_cell: file.flume_cell_m,
        start: file.start_s.map_or(Start::AtShare(file.start_at_share), Start::At),
    })
}

/// Keys that would be of no effect.
fn refuse_keys_of_the_flume_model(file: &SolitaryFile, check: &mut Checker) {
    let given = [
        ("layers", f64::from(file.layers), f64::from(file::default_layers())),
        ("flume_cell_m", file.flume_cell_m, file::default_flume_cell_m()),
        ("start_at_share", file.start_at_share, file::default_start_share()),
    ];
    let changed = given.into_iter().filter(|(_, value, default)| value != default).map(|(key, value, _)| (key, value));
    for (key, value) in changed.chain(file.start_s.map(|start| ("start_s", start))) {
        check.refuse(
            &format!("wave.{key}"),
            show(value),
            "left out while `wavemaker.kind` is \"piston\"",
            "it belongs to the flume model, which does not run: the piston starts in still water with the particles",
        );
    }
}

fn validate_regular(file: &RegularFile, around: &Surroundings, check: &mut Checker) -> Option<RegularWave> {
    let sound = check.number("wave.period_s", file.period_s, from(0.01).up_to(1e4), "s", "write the period in seconds");
    check.number(
        "wave.ramp_periods",
        file.ramp_periods,
        from(0.5).up_to(100.0),
        "",
        "2 lets the paddle start without a splash",
    );
    let depth = around.depth_at_paddle()?;
    if depth <= 0.0 {
        check.refuse(
            "domain.x_m[0]",
            show(around.domain?.x[0]),
            "in still water (the bed there is dry)",
            "a paddle stands in the water at the seaward end of the domain",
        );
    }
    // Gravity that pulls the wrong way is refused with the fluid.
    if !sound || depth <= 0.0 || around.gravity.is_nan() || around.gravity <= 0.0 {
        return None;
    }
    let wave = RegularWave {
        height: file.height_m,
        period: file.period_s,
        ramp_periods: file.ramp_periods,
        depth,
        gravity: around.gravity,
    };
    let length = wave.theory().length_m();
    if length < SHORTEST_LENGTH * depth {
        check.refuse(
            "wave.period_s",
            show(file.period_s),
            format!("long enough for a wave of at least {} m, a tenth of the depth", show(SHORTEST_LENGTH * depth)),
            "such short waves move nothing but the surface: make the domain shallower or write a longer period",
        );
        return None;
    }
    check.number(
        "wave.height_m",
        file.height_m,
        above(0.0).up_to(wave.theory().breaking_height_m()),
        "m",
        &format!("higher waves of this period, {} m long in {} m of water, break", show(length), show(depth)),
    );
    Some(wave)
}

impl Surroundings<'_> {
    /// Still depth where a paddle stands [m].
    fn depth_at_paddle(&self) -> Option<f64> {
        Some(self.flume?.still_depth(self.domain?.x[0]))
    }
}

fn validate_numbers(file: &SolitaryFile, check: &mut Checker) {
    if !(1..=8).contains(&file.layers) {
        check.refuse("wave.layers", file.layers, "1 to 8", "2 carry a solitary wave well");
    }
    check.number(
        "wave.flume_cell_m",
        file.flume_cell_m,
        from(0.005).up_to(0.5),
        "m",
        "a twentieth of the depth is enough, e.g. 0.05",
    );
    if let Some(start) = file.start_s {
        check.number("wave.start_s", start, from(0.0).up_to(1e4), "s", "write a flume time, 0 when the piston starts");
    }
    check.number(
        "wave.start_at_share",
        file.start_at_share,
        above(0.0).below(1.0),
        "",
        "0.03 starts the particles just before the wave arrives",
    );
}

fn validate_height(height: f64, depth: f64, flume: &Flume, check: &mut Checker) {
    if depth <= 0.0 {
        check.refuse(
            "flume.still_water_level_m",
            show(flume.still_level),
            format!("above the bed at the wavemaker, {} m", show(flume.still_level - depth)),
            "a solitary wave starts in still water at the seaward end of the bed",
        );
        return;
    }
    // Beyond 0.6 d neither theory is near the exact wave; beyond 0.78 d it would break.
    check.number(
        "wave.height_m",
        height,
        above(0.0).up_to(0.6 * depth),
        "m",
        &format!("at most 0.6 of the offshore depth, {} m", show(depth)),
    );
}
