//! Points at which the water is measured, validated.

use super::check::{Checker, show};
use super::domain::Domain;
use super::file::{GaugeFile, PointFile, Sides, WaveFile};
use super::flume::Flume;
use super::wavemaker::Wavemaker;

/// Gauges in one case at most.
const MOST_GAUGES: usize = 1000;
/// Letters in a gauge's name at most; names become file names and table headings.
const LONGEST_NAME: usize = 64;

/// A gauge; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Name, unique and safe as a file name.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
    /// Place [m]; the z of an elevation gauge is the still water level.
    pub at: [f64; 3],
    /// Whether it moves.
    pub motion: Motion,
    /// Inside the particle domain; outside it only the flume model writes the gauge.
    pub in_domain: bool,
}

/// How a gauge moves.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Not at all.
    Fixed,
    /// With a unit, counted from 0.
    OnUnit(usize),
    /// Along a way: times from the start of the particles [s] and displacements [m].
    Way(Vec<[f64; 4]>),
}

impl Gauge {
    /// Displacement along its way [m], a time [s] after the start of the particles; nothing for others.
    pub fn displacement(&self, time: f64) -> [f64; 3] {
        let Motion::Way(way) = &self.motion else { return [0.0; 3] };
        let after = way.partition_point(|point| point[0] <= time);
        let place = |i: usize| [way[i][1], way[i][2], way[i][3]];
        if after == 0 || after == way.len() {
            return place(after.saturating_sub(1));
        }
        let (from, to) = (place(after - 1), place(after));
        let share = (time - way[after - 1][0]) / (way[after][0] - way[after - 1][0]);
        std::array::from_fn(|k| from[k] + share * (to[k] - from[k]))
    }
}

/// What a gauge measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Surface elevation above the still water [m].
    Elevation,
    /// Pressure [Pa].
    Pressure,
    /// Velocity [m/s].
    Velocity,
}

/// Where an elevation gauge may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// In the whole flume: its model writes the gauges outside the domain.
    Flume,
    /// In the domain, there being no wave.
    DomainWithoutWave,
    /// In the domain, where the wave is made.
    DomainWithPaddle,
}

impl Reach {
    pub(super) fn of(wave: &WaveFile, wavemaker: Wavemaker) -> Self {
        match wave {
            WaveFile::None {} => Self::DomainWithoutWave,
            WaveFile::File(_) => Self::DomainWithPaddle,
            _ if wavemaker.is_ml_piston() => Self::Flume,
            _ => Self::DomainWithPaddle,
        }
    }
}

/// Validate the gauges.
pub(super) fn validate(
    file: &[GaugeFile],
    flume: Option<&Flume>,
    domain: Option<&Domain>,
    units: usize,
    reach: Reach,
    check: &mut Checker,
) -> Vec<Gauge> {
    if file.len() > MOST_GAUGES {
        check.refuse("gauges", file.len(), format!("at most {MOST_GAUGES} gauges"), "leave out some");
        return Vec::new();
    }
    validate_names(file, check);
    let (Some(flume), Some(domain)) = (flume, domain) else { return Vec::new() };
    let mut gauges = Vec::new();
    for (index, gauge) in file.iter().enumerate() {
        let path = format!("gauges[{index}]");
        let (quantity, at, motion) = match gauge {
            GaugeFile::Elevation(elevation) => {
                let y = elevation.y_m.unwrap_or(0.5 * domain.width);
                validate_elevation(&path, elevation.x_m, y, flume, domain, reach, check);
                (Quantity::Elevation, [elevation.x_m, y, flume.still_level], Motion::Fixed)
            }
            GaugeFile::Pressure(point) | GaugeFile::Velocity(point) => {
                validate_point(&path, point, flume, domain, check);
                let pressure = matches!(gauge, GaugeFile::Pressure(_));
                let quantity = if pressure { Quantity::Pressure } else { Quantity::Velocity };
                (quantity, point.at_m, validate_motion(&path, point, units, check))
            }
        };
        let in_domain = at[0] >= domain.x[0] && at[0] <= domain.x[1];
        gauges.push(Gauge { name: name(gauge).to_owned(), quantity, at, motion, in_domain });
    }
    gauges
}

fn name(gauge: &GaugeFile) -> &str {
    match gauge {
        GaugeFile::Elevation(elevation) => &elevation.name,
        GaugeFile::Pressure(point) | GaugeFile::Velocity(point) => &point.name,
    }
}

fn validate_names(file: &[GaugeFile], check: &mut Checker) {
    for (index, gauge) in file.iter().enumerate() {
        let name = name(gauge);
        let path = format!("gauges[{index}].name");
        let safe = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '-';
        if name.is_empty() || name.len() > LONGEST_NAME || !name.chars().all(safe) {
            check.refuse(
                &path,
                format!("{name:?}"),
                format!("1 to {LONGEST_NAME} of the letters A-Z a-z 0-9 _ -"),
                "the name becomes part of a file's name, e.g. \"WG1\"",
            );
        }
        // File names of some systems do not distinguish capitals.
        if file[..index].iter().any(|other| self::name(other).eq_ignore_ascii_case(name)) {
            check.refuse(&path, format!("{name:?}"), "different from the names before it", "rename one of the two");
        }
    }
}

/// Where gauges can stand across the flume [m]: in two dimensions it is all the same.
fn across(domain: &Domain) -> [f64; 2] {
    let everywhere = [f64::MIN, f64::MAX];
    if domain.sides == Sides::TwoDimensional { everywhere } else { [0.0, domain.width] }
}

fn validate_elevation(path: &str, x: f64, y: f64, flume: &Flume, domain: &Domain, reach: Reach, check: &mut Checker) {
    let (ends, place) = match reach {
        Reach::Flume => (flume.ends(), "the flume"),
        Reach::DomainWithoutWave => (domain.x, "the domain (there is no wave)"),
        Reach::DomainWithPaddle => (domain.x, "the domain (the wave is made there)"),
    };
    within(&format!("{path}.x_m"), x, ends, place, check);
    within(&format!("{path}.y_m"), y, across(domain), "the domain's width", check);
}

fn validate_point(path: &str, point: &PointFile, flume: &Flume, domain: &Domain, check: &mut Checker) {
    let [x, y, z] = point.at_m;
    within(&format!("{path}.at_m[0]"), x, domain.x, "the domain", check);
    within(&format!("{path}.at_m[1]"), y, across(domain), "the domain's width", check);
    within(&format!("{path}.at_m[2]"), z, [flume.profile.z(x), domain.top_z], "the water's height", check);
    if let Some(obstacle) = domain.obstacles.iter().position(|obstacle| obstacle.holds(point.at_m.into())) {
        check.refuse(
            &format!("{path}.at_m"),
            format!("[{}, {}, {}]", show(x), show(y), show(z)),
            format!("outside domain.obstacles[{obstacle}]"),
            "there is no water inside an obstacle: move the gauge to its face",
        );
    }
}

fn validate_motion(path: &str, point: &PointFile, units: usize, check: &mut Checker) -> Motion {
    let rises = point.way.windows(2).all(|pair| pair[1][0] > pair[0][0]);
    let finite = point.way.iter().flatten().all(|value| value.is_finite());
    if !(rises && finite) {
        check.refuse(
            &format!("{path}.way"),
            format!("{} points", point.way.len()),
            "points [t, x, y, z] of finite numbers with rising times",
            "write times from the start of the particles [s] and displacements [m]",
        );
    }
    match point.on_unit {
        None if point.way.is_empty() => Motion::Fixed,
        None => Motion::Way(point.way.clone()),
        Some(unit) => {
            if unit == 0 || unit as usize > units {
                let allowed =
                    if units == 0 { "left out: there are no units".to_owned() } else { format!("1 to {units}") };
                check.refuse(&format!("{path}.on_unit"), unit, allowed, "units are counted from 1, as in the tables");
            }
            if !point.way.is_empty() {
                let advice = "a gauge moves with a unit or along a way of its own";
                check.refuse(&format!("{path}.way"), "given", "left out with `on_unit`", advice);
            }
            Motion::OnUnit((unit as usize).saturating_sub(1))
        }
    }
}

fn within(path: &str, value: f64, [low, high]: [f64; 2], place: &str, check: &mut Checker) {
    if !(value >= low && value <= high) {
        check.refuse(path, show(value), format!("inside {place}, {} to {} m", show(low), show(high)), "move the gauge");
    }
}
