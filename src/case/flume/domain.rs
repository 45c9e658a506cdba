//! The validated particle domain.

use super::bed::Flume;
use super::regions::{self, Region};
use super::site::Site;
use super::zones::{self, DampingZone, RelaxationZone};
use crate::case::file::{DomainFile, Sides, WaterFile};
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit, more_than};

/// Largest number of particles along one direction.
const MOST_ALONG: f64 = 1e6;

/// Still water around units; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StillWater {
    /// Level [m].
    pub level: f64,
    /// Density [kg/m3].
    pub density: f64,
}

/// The particle domain; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Domain {
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Width across the flume [m].
    pub width: f64,
    /// Boundaries at the two sides of the flume.
    pub sides: Sides,
    /// Level of the top of the walls [m].
    pub top_z: f64,
    /// Lowest ground level in the domain [m].
    pub bottom_z: f64,
    /// Particle spacing along x and z [m].
    pub dp: f64,
    /// Particle spacing across the flume [m]: `width` / `ny`, close to `dp`.
    pub dy: f64,
    /// Number of particles along the flume, rounded to the nearest integer.
    pub nx: usize,
    /// Number of particles across the flume.
    pub ny: usize,
    /// Number of particles from the lowest ground to the top of the walls, rounded up.
    pub nz: usize,
    /// Region that is filled with water at the start.
    pub water: Water,
    /// Largest initial water depth [m].
    pub depth: f64,
    /// Time at which the particle simulation starts, if the flume model runs.
    pub start: Start,
    /// Damping zone, which slows the water down, if any.
    pub damping_zone: Option<DampingZone>,
    /// Relaxation zone, which forces the water towards the velocity of the flume model, if any.
    pub relaxation_zone: Option<RelaxationZone>,
    /// Regions of different particle spacing, the finest first; at least one.
    pub regions: Vec<Region>,
    /// For the seaward and the shoreward end, whether the water of another region continues there: the end has no wall.
    pub continues: [bool; 2],
    /// Range of x between the interfaces to other regions [m]; infinite at ends where no region continues.
    pub own_x: [f64; 2],
}

/// Time of the flume model at which the particle simulation starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// At this time of the flume model [s].
    At(f64),
    /// When the depth-averaged water velocity at the wavemaker first reaches this fraction of its maximum [-].
    AtShare(f64),
}

/// Region that is filled with water at the start; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Water {
    /// Water up to the still water level.
    StillLevel,
    /// A block of water from the bed up to a level.
    Block {
        /// x of the seaward and of the shoreward face of the block [m].
        x: [f64; 2],
        /// Level of the top of the block [m].
        top_z: f64,
        /// Level of the shallower water elsewhere [m]; `None` if the rest is dry.
        around_z: Option<f64>,
    },
}

impl Domain {
    /// Returns the still water in the domain, which has the given density [kg/m3]; `None` if the run starts with a
    /// block of water.
    pub(in crate::case) fn still_water(&self, flume: &Flume, density: f64) -> Option<StillWater> {
        (self.water == Water::StillLevel).then_some(StillWater { level: flume.still_water_level, density })
    }

    /// Returns the ground and the boundaries of the area in which units stand.
    pub fn site(&self, flume: &Flume) -> Site {
        let (x, width, sides, top_z) = (self.x, self.width, self.sides, self.top_z);
        let profile = flume.rest.as_ref().unwrap_or(flume.ground()).clone();
        let (covers, parts) = (flume.covers.clone(), flume.parts.clone());
        Site { profile, covers, terrain: None, parts, x, width, sides, top_z }
    }

    /// Returns the particle spacing at x [m].
    pub fn spacing_at(&self, x: f64) -> f64 {
        let region = self.regions.iter().find(|region| region.x[0] <= x && x <= region.x[1]);
        self.dp * region.map_or(1.0, |region| f64::from(region.coarseness))
    }

    /// Returns the levels z of the rows of a moving end at x [m], from the bed to the top of the walls [m].
    pub fn wavemaker_rows(&self, flume: &Flume, x: f64) -> Vec<f64> {
        let bed = flume.profile.z(x);
        (0..).map(|row| bed + (f64::from(row) + 0.5) * self.dp).take_while(|&z| z < self.top_z).collect()
    }
}

/// Validates the domain. `smoothing_factor` is the value of `numerics.smoothing_factor`, which is not yet validated.
pub fn validate(
    file: &DomainFile,
    flume: Option<&Flume>,
    smoothing_factor: f64,
    check: &mut Checker,
) -> Option<Domain> {
    let before = check.count();
    check.number(
        "domain.dp_m",
        file.dp_m,
        at_least(1e-4).up_to(0.5),
        "m",
        "write the particle spacing in metres, e.g. 0.007",
    );
    validate_start(file, check);
    let flume = flume?;
    validate_extent(file, flume, check);
    if check.count() > before {
        return None;
    }
    let width = validate_width(file, smoothing_factor, check)?;
    let (bottom_z, _) = flume.profile.extremes_between(file.x_m);
    let lengths = [file.x_m[1] - file.x_m[0], width, file.top_z_m - bottom_z];
    for (name, length) in ["along the flume", "across the flume", "upwards"].into_iter().zip(lengths) {
        if length / file.dp_m > MOST_ALONG {
            check.reject(
                "domain.dp_m",
                as_text(file.dp_m),
                format!("at least {:e} m, for {MOST_ALONG:e} particles {name}", length / MOST_ALONG),
                "write a larger particle spacing",
            );
        }
    }
    let (water, depth) = validate_water(file, flume, check)?;
    let damping_zone = file.damping_zone.map(|zone| zones::validate_damping(&zone, file.x_m, check));
    let relaxation_zone =
        file.relaxation_zone.map(|zone| zones::validate_relaxation(&zone, file.x_m, damping_zone.as_ref(), check));
    let regions = regions::validate(file, width, smoothing_factor, check);
    if check.count() > before {
        return None;
    }
    let count = |length: f64| ((length / file.dp_m).round() as usize).max(1);
    let ny = count(width);
    Some(Domain {
        x: file.x_m,
        width,
        sides: file.sides,
        top_z: file.top_z_m,
        bottom_z,
        dp: file.dp_m,
        dy: width / ny as f64,
        nx: count(lengths[0]),
        ny,
        nz: (lengths[2] / file.dp_m).ceil() as usize,
        water,
        depth,
        start: file.start_s.map_or(Start::AtShare(file.start_at_share), Start::At),
        damping_zone,
        relaxation_zone,
        regions,
        continues: [false; 2],
        own_x: [f64::NEG_INFINITY, f64::INFINITY],
    })
}

fn validate_start(file: &DomainFile, check: &mut Checker) {
    if let Some(start) = file.start_s {
        check.number("domain.start_s", start, at_least(0.0).up_to(1e4), "s", "write a time of the flume model");
    }
    check.number(
        "domain.start_at_share",
        file.start_at_share,
        more_than(0.0).below(1.0),
        "",
        "0.03 starts the particles just before the wave arrives",
    );
}

fn validate_extent(file: &DomainFile, flume: &Flume, check: &mut Checker) {
    let [start, end] = flume.ends();
    for (index, x) in file.x_m.into_iter().enumerate() {
        if !(x >= start && x <= end) {
            check.reject(
                &format!("domain.x_m[{index}]"),
                as_text(x),
                format!("within the bed, {} to {} m", as_text(start), as_text(end)),
                "move the end of the domain or lengthen `flume.bed_m`",
            );
        }
    }
    if file.x_m[1] - file.x_m[0] < 10.0 * file.dp_m {
        check.reject(
            "domain.x_m",
            format!("[{}, {}]", as_text(file.x_m[0]), as_text(file.x_m[1])),
            "increasing, at least 10 particle spacings apart",
            "write the seaward end first",
        );
        return;
    }
    let (_, ground) = flume.profile.extremes_between(file.x_m);
    let lowest_top = match file.water {
        WaterFile::StillLevel {} => ground.max(flume.still_water_level),
        WaterFile::Block(_) => ground,
    };
    check.number(
        "domain.top_z_m",
        file.top_z_m,
        more_than(lowest_top).up_to(lowest_top + 1000.0),
        "m",
        "the walls must rise above water and ground; leave room for the wave",
    );
}

/// Returns the width across the flume [m]: `width_m`, or one particle spacing in two dimensions.
fn validate_width(file: &DomainFile, smoothing_factor: f64, check: &mut Checker) -> Option<f64> {
    let width = match (file.sides, file.width_m) {
        (Sides::TwoDimensional, None) => return Some(file.dp_m),
        (Sides::TwoDimensional, Some(width)) => {
            check.reject(
                "domain.width_m",
                as_text(width),
                "left out where `domain.sides` is \"two_dimensional\"",
                "remove the key, or set `domain.sides` to \"periodic\" or \"walls\"",
            );
            return None;
        }
        (Sides::Periodic | Sides::Walls, None) => {
            check.reject("domain.width_m", "(missing)", "a width in metres", "write the width across the flume");
            return None;
        }
        (Sides::Periodic | Sides::Walls, Some(width)) => width,
    };
    if !check.number("domain.width_m", width, more_than(0.0).up_to(1e4), "m", "write the width across the flume") {
        return None;
    }
    let h = smoothing_factor * 3f64.sqrt() * file.dp_m;
    let least = 4.0 * h + file.dp_m;
    if file.sides == Sides::Periodic && width < least {
        check.reject(
            "domain.width_m",
            as_text(width),
            format!(
                "at least 4h + dp = {} m with periodic sides; otherwise a particle acts on its own image",
                lower_limit(least)
            ),
            "widen the domain or write a smaller `domain.dp_m`",
        );
    }
    if width < file.dp_m {
        check.reject(
            "domain.width_m",
            as_text(width),
            format!("at least one particle spacing, {} m", as_text(file.dp_m)),
            "widen the domain or write a smaller `domain.dp_m`",
        );
    }
    let layers = (width / file.dp_m).round().max(1.0);
    let stretch = width / layers / file.dp_m;
    // If the particle spacings along and across the flume differ by more than a few per cent, the density of still
    // water drifts.
    if (stretch - 1.0).abs() > 0.03 {
        check.warn(format!(
            "domain.width_m = {} is {:.2} particle spacings: the spacing across the flume becomes {:.3} dp_m; \
             write a width that is a whole number of particle spacings",
            as_text(width),
            width / file.dp_m,
            stretch
        ));
    }
    Some(width)
}

fn validate_water(file: &DomainFile, flume: &Flume, check: &mut Checker) -> Option<(Water, f64)> {
    let (water, depth, path, level) = match file.water {
        WaterFile::StillLevel {} => (
            Water::StillLevel,
            flume.still_water_level - flume.profile.extremes_between(file.x_m).0,
            "flume.still_water_level_m",
            flume.still_water_level,
        ),
        WaterFile::Block(block) => {
            let [x0, x1] = block.x_m;
            if !(x0 >= file.x_m[0] && x1 <= file.x_m[1] && x1 - x0 >= file.dp_m) {
                check.reject(
                    "domain.water.x_m",
                    format!("[{}, {}]", as_text(x0), as_text(x1)),
                    format!("increasing and within the domain, {} to {} m", as_text(file.x_m[0]), as_text(file.x_m[1])),
                    "write the seaward face of the block first",
                );
                return None;
            }
            let (ground, _) = flume.profile.extremes_between(block.x_m);
            let range = more_than(ground).up_to(file.top_z_m);
            if !check.number(
                "domain.water.top_z_m",
                block.top_z_m,
                range,
                "m",
                "between the bed and the top of the walls",
            ) {
                return None;
            }
            if let Some(level) = block.around_z_m {
                let (ground, _) = flume.profile.extremes_between(file.x_m);
                let range = more_than(ground).below(block.top_z_m);
                if !check.number("domain.water.around_z_m", level, range, "m", "below the top of the block") {
                    return None;
                }
            }
            (
                Water::Block { x: block.x_m, top_z: block.top_z_m, around_z: block.around_z_m },
                block.top_z_m - ground,
                "domain.water.top_z_m",
                block.top_z_m,
            )
        }
    };
    if depth < file.dp_m {
        check.reject(
            path,
            as_text(level),
            format!("at least one particle spacing above the ground of the domain (the depth is {} m)", as_text(depth)),
            "raise the water level or move the domain to deeper water",
        );
        return None;
    }
    if depth < 10.0 * file.dp_m {
        check.warn(format!(
            "domain.dp_m = {}: only {:.1} particle spacings over the largest water depth, {} m; use at least 10",
            as_text(file.dp_m),
            depth / file.dp_m,
            as_text(depth)
        ));
    }
    Some((water, depth))
}
