//! Validates a dry test: units on a bed without water.

use std::path::Path;

use glam::DVec3;

use super::check::{Checker, above, from};
use super::error::CaseErrors;
use super::file::{DryFile, DryOutputFile, DryTestFile, FlumeFile, Sides};
use super::handover::{self, Handover};
use super::hash::fingerprint;
use super::materials::{self, Material};
use super::parse::parse;
use super::run::{self, Contact, Stop};
use super::site::Site;
use super::units::{self, Surroundings, Units};
use super::validate::read;
use super::{flume, output, terrain};

/// The kind of dry test. SI units, angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DryTest {
    /// The units are released where they are.
    Settle,
    /// The units are lifted, then released.
    Drop,
    /// The bed is tilted at `rate` [rad/s] up to the angle `to` [rad]; a unit faster than `slide_speed` [m/s] slides.
    Tilt { rate: f64, to: f64, slide_speed: f64 },
}

/// Output intervals of a dry test [s]; `None` for no output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryOutput {
    /// Surfaces of the units.
    pub units_interval: Option<f64>,
    /// Motion and energy.
    pub series_interval: f64,
    /// Checkpoints.
    pub checkpoint_interval: Option<f64>,
}

/// A validated dry test; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct DryCase {
    /// One line that names the case.
    pub title: String,
    /// Assumptions listed in the case file.
    pub assumptions: Vec<String>,
    /// Values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Name of the file as given.
    pub name: String,
    /// Fingerprint of the case: 32 hexadecimal digits.
    pub hash: String,
    /// Case text that is saved with the run.
    pub text: String,
    /// The test.
    pub test: DryTest,
    /// Ground and walls.
    pub site: Site,
    /// Acceleration of gravity [m/s2].
    pub gravity: f64,
    /// The units.
    pub units: Units,
    /// Elastic constants; other structs hold indices into this list.
    pub materials: Vec<Material>,
    /// Contact parameters.
    pub contact: Contact,
    /// Breakage analysis of the hardest impacts, if requested.
    pub fracture: Option<Handover>,
    /// Output intervals.
    pub output: DryOutput,
    /// Stop criteria.
    pub stop: Stop,
}

impl DryCase {
    /// Returns whether the text of a case file describes a dry test.
    pub fn is_one(text: &str) -> bool {
        serde_json::from_str::<serde_json::Value>(text).is_ok_and(|value| value.get("dry").is_some())
    }

    /// Reads and validates a case file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Validates the text of a case file; `name` is its name in messages.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let file: DryFile = parse(text, name)?;
        let mut check = Checker::new(name);
        match validate(&file, text, name, &mut check) {
            Some(case) if check.count() == 0 => Ok(Self { warnings: check.warnings, ..case }),
            _ => Err(check.into_errors()),
        }
    }
}

fn validate(file: &DryFile, text: &str, name: &str, check: &mut Checker) -> Option<DryCase> {
    if file.title.trim().is_empty() {
        check.refuse("title", format!("{:?}", file.title), "a line of text", "name the case");
    }
    check.number("gravity_m_s2", file.gravity_m_s2, above(0.0).up_to(100.0), "m/s2", "9.81 on Earth");
    let materials = materials::validate_materials(&file.materials, check);
    let friction = materials::validate_friction(&file.friction, &materials, check);
    let ground_material = materials::find(&materials, &file.flume.material, "flume.material", check);
    let site = validate_site(file, name, ground_material, check);
    let stop = run::validate_stop(&file.stop, true, check);
    let contact = run::validate_contact(&file.contact, check);
    let (test, lift) = validate_test(&file.dry, check);
    let around = Surroundings {
        name,
        site: site.as_ref(),
        dp: None,
        obstacles: 0,
        materials: &materials,
        friction: &friction,
        ground_material,
        ground_key: "flume.material",
        ground_named: true,
        rho0: None,
        rounding_share: contact.rounding_share,
        law: contact.law,
    };
    let mut units = units::validate(&file.units, &around, check)?;
    let fracture = file.fracture.as_ref().map(|entry| handover::validate(entry, &units.shape, name, check));
    let fracture = match fracture {
        None => None,
        Some(found) => Some(found?),
    };
    let (mut kept, mut read) = (file.clone(), Vec::new());
    units.make_self_contained(&mut kept.units, &mut read);
    if let Some(handover) = &fracture {
        kept.fracture = kept.fracture.as_ref().map(Handover::entry);
        read.extend(&handover.mesh_file);
    }
    if let Some(terrain) = site.as_ref().and_then(|site| site.terrain.as_ref()) {
        kept.flume.terrain = Some(terrain.entry());
        read.extend(terrain.content.iter());
    }
    for placement in &mut units.placements {
        placement.centre += DVec3::Z * lift;
    }
    let canonical = DryFile { schema: None, ..kept.clone() };
    // Serializing to a string cannot fail: every key is a string.
    let text = if kept == *file { text.to_owned() } else { serde_json::to_string_pretty(&kept).unwrap_or_default() };
    Some(DryCase {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        name: name.to_owned(),
        hash: fingerprint(&canonical, &read),
        text,
        test,
        site: site?,
        gravity: file.gravity_m_s2,
        units,
        materials,
        contact,
        fracture,
        output: validate_output(&file.output, stop.duration, check),
        stop,
    })
}

/// Validates ground, ends and walls.
pub(super) fn validate_site(file: &DryFile, name: &str, material: Option<usize>, check: &mut Checker) -> Option<Site> {
    let ground = FlumeFile::dry(file.flume.bed_m.clone(), file.flume.mound.clone());
    let flume = flume::validate(&ground, material, check)?;
    let before = check.count();
    let terrain = file.flume.terrain.as_ref().and_then(|file| terrain::validate(file, name, check));
    let [start, end] = flume.ends();
    for (index, x) in file.domain.x_m.into_iter().enumerate() {
        let advice = "move the end of the domain or lengthen `flume.bed_m`";
        check.number(&format!("domain.x_m[{index}]"), x, from(start).up_to(end), "m", advice);
    }
    let [x0, x1] = file.domain.x_m;
    check.number("domain.x_m[1]", x1, above(x0).up_to(f64::MAX), "m", "write the seaward end first");
    check.number("domain.width_m", file.domain.width_m, above(0.0).up_to(1e4), "m", "write the width across the flume");
    if file.domain.sides == Sides::TwoDimensional {
        let advice = "dry tests are three-dimensional";
        check.refuse("domain.sides", "\"two_dimensional\"", "\"periodic\" or \"walls\"", advice);
    }
    if check.count() > before {
        return None;
    }
    let highest = flume.profile.extremes_between(file.domain.x_m).1;
    let room = above(highest).up_to(highest + 1000.0);
    let sound = check.number("domain.top_z_m", file.domain.top_z_m, room, "m", "leave room for the units");
    let (x, width, sides, top_z) = (file.domain.x_m, file.domain.width_m, file.domain.sides, file.domain.top_z_m);
    sound.then_some(Site { profile: flume.profile, terrain, x, width, sides, top_z })
}

/// Returns the test and the height by which it lifts the units [m].
fn validate_test(file: &DryTestFile, check: &mut Checker) -> (DryTest, f64) {
    match file {
        DryTestFile::Settle {} => (DryTest::Settle, 0.0),
        DryTestFile::Drop(drop) => {
            check.number("dry.height_m", drop.height_m, above(0.0).up_to(100.0), "m", "write the lift height");
            (DryTest::Drop, drop.height_m)
        }
        DryTestFile::Tilt(tilt) => {
            let advice = "at 1 degree/s the angle of sliding is found within 0.3 %";
            check.number("dry.rate_deg_s", tilt.rate_deg_s, above(0.0).up_to(90.0), "degrees/s", advice);
            check.number("dry.to_deg", tilt.to_deg, above(0.0).below(90.0), "degrees", "write the largest tilt angle");
            let advice = "below this speed a unit counts as at rest";
            check.number("dry.slide_speed_m_s", tilt.slide_speed_m_s, above(0.0).up_to(1.0), "m/s", advice);
            let (rate, to, slide_speed) =
                (tilt.rate_deg_s.to_radians(), tilt.to_deg.to_radians(), tilt.slide_speed_m_s);
            (DryTest::Tilt { rate, to, slide_speed }, 0.0)
        }
    }
}

fn validate_output(file: &DryOutputFile, duration: f64, check: &mut Checker) -> DryOutput {
    let mut interval = |key: &str, value: f64| output::validate_interval(key, value, duration, check);
    let units_interval = interval("units_interval_s", file.units_interval_s);
    let checkpoint_interval = interval("checkpoint_interval_s", file.checkpoint_interval_s);
    output::validate_series_interval(file.series_interval_s, duration, check);
    DryOutput { units_interval, series_interval: file.series_interval_s, checkpoint_interval }
}
