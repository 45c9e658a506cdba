//! The validated gauges.

use std::collections::HashSet;
use std::ops::Range;

use glam::{DVec2, DVec3};

use crate::case::file::{ForceFile, GaugeFile, LineFile, PointFile, Sides, WaveFile};
use crate::case::flume::bed::Flume;
use crate::case::flume::domain::Domain;
use crate::case::flume::part::{Part, PartShape};
use crate::case::reading::check::{Checker, as_text};
use crate::case::units::{Units, way::Way};
use crate::case::wave::wavemaker::Wavemaker;

/// Depth inside a part at which a point still counts as on its face, divided by the particle spacing [-].
const FLUSH: f64 = 1e-3;

/// Largest number of gauges in a case.
const MOST_GAUGES: usize = 1000;
/// Largest number of characters in the name of a gauge. Names become parts of file names and table headings.
const LONGEST_NAME: usize = 64;

/// A gauge; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Name, unique and safe as a file name.
    pub name: String,
    /// Measured quantity.
    pub quantity: Quantity,
    /// Initial position [x, y, z] [m]; z of an elevation gauge is the still water level. For a force, the point about
    /// which its moment acts.
    pub at: [f64; 3],
    /// Motion of the gauge.
    pub motion: Motion,
    /// true if the gauge is inside the particle domain. Outside the domain, only the flume model writes values for the
    /// gauge.
    pub in_domain: bool,
}

/// Motion of a gauge.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Fixed in space.
    Fixed,
    /// Moves with the unit of this index, counted from 0.
    OnUnit(usize),
    /// Moves along a path.
    Way(Way),
}

/// Quantity that a gauge measures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Quantity {
    /// Elevation of the free surface above the still water level [m].
    Elevation,
    /// Pressure [Pa].
    Pressure,
    /// Velocity [m/s].
    Velocity,
    /// Force [N] and moment [N m] on the units with these indices.
    Force(Range<usize>),
    /// Force [N] and moment [N m] on the part with this index in the flume.
    PartForce(usize),
}

/// Region in which elevation gauges are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// The whole flume, because the flume model computes the gauges outside the domain.
    Flume,
    /// Only the particle domain, because the case has no wave and the flume model does not run.
    DomainWithoutWave,
    /// Only the particle domain, because the wave is generated there and the flume model does not run.
    DomainWithPaddle,
}

impl Reach {
    pub(in crate::case) fn of(wave: &WaveFile, wavemaker: Wavemaker) -> Self {
        match wave {
            WaveFile::None {} => Self::DomainWithoutWave,
            WaveFile::File(_) => Self::DomainWithPaddle,
            _ if wavemaker.follows_flume_model() => Self::Flume,
            _ => Self::DomainWithPaddle,
        }
    }
}

/// Validates the gauges.
pub fn validate(
    file: &[GaugeFile],
    flume: Option<&Flume>,
    domain: Option<&Domain>,
    units: Option<&Units>,
    reach: Reach,
    check: &mut Checker,
) -> Vec<Gauge> {
    if file.len() > MOST_GAUGES {
        check.reject("gauges", file.len(), format!("at most {MOST_GAUGES} gauges"), "remove some gauges");
        return Vec::new();
    }
    let count: u64 = file.iter().map(|gauge| u64::from(line_of(gauge).map_or(1, |line| line.count))).sum();
    if count > MOST_GAUGES as u64 {
        let allowed = format!("at most {MOST_GAUGES} gauges, with those of lines");
        check.reject("gauges", count, allowed, "write shorter lines, or remove some gauges");
        return Vec::new();
    }
    validate_names(file, check);
    let (Some(flume), Some(domain)) = (flume, domain) else { return Vec::new() };
    let mut gauges: Vec<Gauge> = Vec::new();
    for (index, gauge) in file.iter().enumerate() {
        let path = format!("gauges[{index}]");
        let (quantity, at, motion) = match gauge {
            GaugeFile::Elevation(elevation) => {
                let y = elevation.y_m.unwrap_or(0.5 * domain.width);
                validate_elevation(&path, elevation.x_m, y, flume, domain, reach, check);
                (Quantity::Elevation, [elevation.x_m, y, flume.still_water_level], Motion::Fixed)
            }
            GaugeFile::Pressure(point) | GaugeFile::Velocity(point) => {
                let places = places(&path, point, check);
                places.iter().for_each(|(_, at)| validate_point(&path, *at, flume, domain, check));
                let pressure = matches!(gauge, GaugeFile::Pressure(_));
                let quantity = if pressure { Quantity::Pressure } else { Quantity::Velocity };
                let count = units.map_or(0, Units::count);
                let motion = validate_motion(&path, point, count, check);
                for (name, at) in places {
                    let (quantity, motion) = (quantity.clone(), motion.clone());
                    gauges.push(Gauge { name, quantity, at, motion, in_domain: is_inside(at, domain) });
                }
                continue;
            }
            GaugeFile::Force(force) => {
                let Some((quantity, at)) = validate_force(&path, force, flume, domain, units, check) else { continue };
                (quantity, at, Motion::Fixed)
            }
        };
        let is_force = matches!(quantity, Quantity::Force(_) | Quantity::PartForce(_));
        let in_domain = is_force || is_inside(at, domain);
        gauges.push(Gauge { name: gauge_name(gauge).to_owned(), quantity, at, motion, in_domain });
    }
    let mut names = HashSet::new();
    if let Some(gauge) = gauges.iter().find(|gauge| !names.insert(gauge.name.to_ascii_lowercase())) {
        let advice = "a line of gauges adds _1, _2, ... to its name: rename one of the two";
        check.reject("gauges", format!("{:?}", gauge.name), "the name of one gauge only", advice);
    }
    gauges
}

fn line_of(gauge: &GaugeFile) -> Option<LineFile> {
    match gauge {
        GaugeFile::Pressure(point) | GaugeFile::Velocity(point) => point.line,
        GaugeFile::Elevation(_) | GaugeFile::Force(_) => None,
    }
}

fn gauge_name(gauge: &GaugeFile) -> &str {
    match gauge {
        GaugeFile::Elevation(elevation) => &elevation.name,
        GaugeFile::Pressure(point) | GaugeFile::Velocity(point) => &point.name,
        GaugeFile::Force(force) => &force.name,
    }
}

fn validate_names(file: &[GaugeFile], check: &mut Checker) {
    for (index, gauge) in file.iter().enumerate() {
        let name = gauge_name(gauge);
        let path = format!("gauges[{index}].name");
        let is_allowed = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '-';
        if name.is_empty() || name.len() > LONGEST_NAME || !name.chars().all(is_allowed) {
            check.reject(
                &path,
                format!("{name:?}"),
                format!("1 to {LONGEST_NAME} of the characters A-Z a-z 0-9 _ -"),
                "the name becomes part of a file name, e.g. \"WG1\"",
            );
        }
        // Some file systems do not distinguish capital from small letters.
        if file[..index].iter().any(|other| self::gauge_name(other).eq_ignore_ascii_case(name)) {
            check.reject(&path, format!("{name:?}"), "different from the names before it", "rename one of the two");
        }
    }
}

/// Returns the allowed range of y for gauges [m]. In two dimensions, any y is allowed.
fn y_range(domain: &Domain) -> [f64; 2] {
    let everywhere = [f64::MIN, f64::MAX];
    if domain.sides == Sides::TwoDimensional { everywhere } else { [0.0, domain.width] }
}

fn validate_elevation(path: &str, x: f64, y: f64, flume: &Flume, domain: &Domain, reach: Reach, check: &mut Checker) {
    let (ends, range) = match reach {
        Reach::Flume => (flume.ends(), "the flume"),
        Reach::DomainWithoutWave => (domain.x, "the domain (there is no wave)"),
        Reach::DomainWithPaddle => (domain.x, "the domain (the wave is generated there)"),
    };
    check_inside(&format!("{path}.x_m"), x, ends, range, check);
    check_inside(&format!("{path}.y_m"), y, y_range(domain), "the domain's width", check);
}

fn is_inside(at: [f64; 3], domain: &Domain) -> bool {
    at[0] >= domain.x[0] && at[0] <= domain.x[1]
}

/// Returns name and position [m] of a gauge, or of all gauges of a line.
fn places(path: &str, point: &PointFile, check: &mut Checker) -> Vec<(String, [f64; 3])> {
    let Some(LineFile { to_m, count }) = point.line else { return vec![(point.name.clone(), point.at_m)] };
    if !(2..=MOST_GAUGES as u32).contains(&count) {
        let advice = "leave out `line` for a single gauge";
        check.reject(&format!("{path}.line.count"), count, format!("2 to {MOST_GAUGES}"), advice);
        return Vec::new();
    }
    let place = |number: u32| {
        let share = f64::from(number) / f64::from(count - 1);
        let at = std::array::from_fn(|axis| point.at_m[axis] + share * (to_m[axis] - point.at_m[axis]));
        (format!("{}_{}", point.name, number + 1), at)
    };
    (0..count).map(place).collect()
}

fn validate_point(path: &str, [x, y, z]: [f64; 3], flume: &Flume, domain: &Domain, check: &mut Checker) {
    check_inside(&format!("{path}.at_m[0]"), x, domain.x, "the domain", check);
    check_inside(&format!("{path}.at_m[1]"), y, y_range(domain), "the domain's width", check);
    let range = "the range from the bed to the top of the walls";
    check_inside(&format!("{path}.at_m[2]"), z, [flume.profile.z(x), domain.top_z], range, check);
    let is_in = |part: &&Part| match &part.shape {
        PartShape::Bed(_) | PartShape::Porous(..) => false,
        PartShape::Section(polygon) => polygon.distance(DVec2::new(x, z)) < -FLUSH * domain.dp,
        PartShape::Box(bounds) => bounds.contains(DVec3::new(x, y, z)),
        PartShape::Body(body) => body.solid.signed_distance(DVec3::new(x, y, z)) < -FLUSH * domain.dp,
    };
    if let Some(part) = flume.parts.iter().find(is_in) {
        check.reject(
            &format!("{path}.at_m"),
            format!("[{}, {}, {}]", as_text(x), as_text(y), as_text(z)),
            format!("outside {:?}", part.name),
            "there is no water inside: move the gauge to its face",
        );
    }
}

/// Returns the force that a gauge measures, and the point about which its moment acts [m].
fn validate_force(
    path: &str,
    file: &ForceFile,
    flume: &Flume,
    domain: &Domain,
    units: Option<&Units>,
    check: &mut Checker,
) -> Option<(Quantity, [f64; 3])> {
    if let Some(axis) = file.about_m.and_then(|about| about.iter().position(|value| !value.is_finite())) {
        check.reject(&format!("{path}.about_m[{axis}]"), "not finite", "a finite number", "write a point in metres");
        return None;
    }
    let groups = units.map_or(&[][..], |units| &units.groups);
    let names = || flume.parts.iter().map(|part| &part.name).chain(groups.iter().map(|group| &group.name));
    if names().filter(|name| **name == file.on).count() > 1 {
        let advice = "give the part and the group of units different names";
        check.reject(&format!("{path}.on"), format!("{:?}", file.on), "the name of one part or group", advice);
        return None;
    }
    if let Some(part) = flume.parts.iter().position(|part| part.name == file.on) {
        if flume.parts[part].medium().is_some() {
            let advice = "measure the pressure in it with gauges of the kind `pressure`";
            check.reject(&format!("{path}.on"), format!("{:?}", file.on), "a part without `porous`", advice);
            return None;
        }
        let middle = flume.parts[part].middle(domain.width).to_array();
        return Some((Quantity::PartForce(part), file.about_m.unwrap_or(middle)));
    }
    let Some(group) = groups.iter().find(|group| group.name == file.on) else {
        let names: Vec<String> = names().map(|name| format!("{name:?}")).collect();
        let (allowed, advice) = match names.is_empty() {
            true => {
                ("left out without parts and units".to_owned(), "add a `structure` or `units`, or remove the gauge")
            }
            false => (format!("one of {}", names.join(", ")), "write the `name` of a part or of a group of units"),
        };
        check.reject(&format!("{path}.on"), format!("{:?}", file.on), allowed, advice);
        return None;
    };
    let members = group.members.clone();
    let poses = units.map_or(&[][..], |units| &units.placements[members.clone()]);
    let middle = poses.iter().map(|pose| pose.centre).sum::<DVec3>() / members.len().max(1) as f64;
    Some((Quantity::Force(members), file.about_m.unwrap_or(middle.to_array())))
}

fn validate_motion(path: &str, point: &PointFile, units: usize, check: &mut Checker) -> Motion {
    let way = Way::validate(&point.way, &format!("{path}.way"), check);
    match point.on_unit {
        None => way.map_or(Motion::Fixed, Motion::Way),
        Some(unit) => {
            if unit == 0 || unit as usize > units {
                let allowed =
                    if units == 0 { "left out: there are no units".to_owned() } else { format!("1 to {units}") };
                check.reject(&format!("{path}.on_unit"), unit, allowed, "units are numbered from 1, as in units.csv");
            }
            if way.is_some() {
                let advice = "a gauge moves either with a unit or along a path";
                check.reject(&format!("{path}.way"), "given", "left out with `on_unit`", advice);
            }
            Motion::OnUnit((unit as usize).saturating_sub(1))
        }
    }
}

fn check_inside(path: &str, value: f64, [low, high]: [f64; 2], range: &str, check: &mut Checker) {
    if !(value >= low && value <= high) {
        check.reject(
            path,
            as_text(value),
            format!("inside {range}, {} to {} m", as_text(low), as_text(high)),
            "move the gauge",
        );
    }
}
