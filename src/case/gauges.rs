//! Points at which the water is measured, validated.

use super::check::{Checker, show};
use super::domain::Domain;
use super::file::{GaugeFile, PointFile, WaveFile};
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
    /// Inside the particle domain; outside it only the flume model writes the gauge.
    pub in_domain: bool,
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
            _ if wavemaker == Wavemaker::MlPiston => Self::Flume,
            _ => Self::DomainWithPaddle,
        }
    }
}

/// Validate the gauges.
pub(super) fn validate(
    file: &[GaugeFile],
    flume: Option<&Flume>,
    domain: Option<&Domain>,
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
        let (quantity, at) = match gauge {
            GaugeFile::Elevation(elevation) => {
                let y = elevation.y_m.unwrap_or(0.5 * domain.width);
                validate_elevation(&path, elevation.x_m, y, flume, domain, reach, check);
                (Quantity::Elevation, [elevation.x_m, y, flume.still_level])
            }
            GaugeFile::Pressure(point) => (Quantity::Pressure, validate_point(&path, point, flume, domain, check)),
            GaugeFile::Velocity(point) => (Quantity::Velocity, validate_point(&path, point, flume, domain, check)),
        };
        let in_domain = at[0] >= domain.x[0] && at[0] <= domain.x[1];
        gauges.push(Gauge { name: name(gauge).to_owned(), quantity, at, in_domain });
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

fn validate_elevation(path: &str, x: f64, y: f64, flume: &Flume, domain: &Domain, reach: Reach, check: &mut Checker) {
    let (ends, place) = match reach {
        Reach::Flume => (flume.ends(), "the flume"),
        Reach::DomainWithoutWave => (domain.x, "the domain (there is no wave)"),
        Reach::DomainWithPaddle => (domain.x, "the domain (the wave is made there)"),
    };
    within(&format!("{path}.x_m"), x, ends, place, check);
    within(&format!("{path}.y_m"), y, [0.0, domain.width], "the domain's width", check);
}

fn validate_point(path: &str, point: &PointFile, flume: &Flume, domain: &Domain, check: &mut Checker) -> [f64; 3] {
    let [x, y, z] = point.at_m;
    within(&format!("{path}.at_m[0]"), x, domain.x, "the domain", check);
    within(&format!("{path}.at_m[1]"), y, [0.0, domain.width], "the domain's width", check);
    within(&format!("{path}.at_m[2]"), z, [flume.profile.z(x), domain.top_z], "the water's height", check);
    if let Some(obstacle) = domain.obstacles.iter().position(|obstacle| obstacle.holds(point.at_m.into())) {
        check.refuse(
            &format!("{path}.at_m"),
            format!("[{}, {}, {}]", show(x), show(y), show(z)),
            format!("outside domain.obstacles[{obstacle}]"),
            "there is no water inside an obstacle: move the gauge to its face",
        );
    }
    point.at_m
}

fn within(path: &str, value: f64, [low, high]: [f64; 2], place: &str, check: &mut Checker) {
    if !(value >= low && value <= high) {
        check.refuse(path, show(value), format!("inside {place}, {} to {} m", show(low), show(high)), "move the gauge");
    }
}
