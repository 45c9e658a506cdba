//! The wave that is sent down the flume, validated.

use super::check::{Checker, above, from, show};
use super::domain::Domain;
use super::file::{SolitaryFile, SolitaryTheory, WaterFile, WaveFile};
use super::flume::Flume;

/// Cells of the flume model at most.
const MOST_FLUME_CELLS: f64 = 200_000.0;

/// The wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wave {
    /// No wave.
    None,
    /// A solitary wave made by a piston at the seaward end of the flume.
    Solitary(SolitaryWave),
}

/// A solitary wave; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryWave {
    /// Height above the still water in the offshore depth [m].
    pub height: f64,
    /// Still depth at the seaward end of the flume [m].
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

/// Validate the wave; `water` is that of the domain, as written.
pub(super) fn validate(
    file: &WaveFile,
    water: &WaterFile,
    flume: Option<&Flume>,
    domain: Option<&Domain>,
    check: &mut Checker,
) -> Option<Wave> {
    let file = match file {
        WaveFile::None {} => return Some(Wave::None),
        WaveFile::Solitary(file) => file,
    };
    let before = check.count();
    if matches!(water, WaterFile::Block(_)) {
        check.refuse(
            "wave.kind",
            "\"solitary\"",
            "\"none\" while `domain.water` is a block",
            "remove `domain.water` for a wave, or `wave` for a dam break",
        );
    }
    validate_numbers(file, check);
    let flume = flume?;
    let depth = flume.offshore_depth();
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
    if check.count() > before {
        return None;
    }
    let wave = SolitaryWave {
        height: file.height_m,
        depth,
        theory: file.theory,
        layers: file.layers as usize,
        flume_cell: file.flume_cell_m,
        start: file.start_s.map_or(Start::AtShare(file.start_at_share), Start::At),
    };
    validate_wavemaker(&wave, flume, domain?, check);
    (check.count() == before).then_some(Wave::Solitary(wave))
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
            format!("above the bed at the wavemaker, {} m", show(flume.bed.points()[0][1])),
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

fn validate_wavemaker(wave: &SolitaryWave, flume: &Flume, domain: &Domain, check: &mut Checker) {
    let nearest = flume.ends()[0] + wave.stroke();
    if domain.x[0] <= nearest {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("beyond the piston's reach, > {} m", show(nearest)),
            "start the domain further from the wavemaker; the flume model carries the wave there",
        );
    }
    let depth = flume.still_depth(domain.x[0]);
    // Four particles is the least over which the multi-layer piston can act as a wall.
    if depth < 4.0 * domain.dp {
        check.refuse(
            "domain.x_m[0]",
            show(domain.x[0]),
            format!("in still water at least 4 particles deep (the depth there is {} m)", show(depth)),
            "start the domain further from the shore",
        );
    }
    let particles = wave.height / domain.dp;
    if particles < 5.0 {
        check.warn(format!(
            "domain.dp_m = {}: {particles:.1} particles in the wave height; 5 to 10 are needed (Altomare et al. 2017)",
            show(domain.dp)
        ));
    }
}
