//! Validates a dry test: units on a bed without water.

use std::path::Path;

use glam::DVec3;

use super::breakage::{self, BreakageSettings};
use super::file::{DryDomainFile, DryFile, DryOutputFile, DryTestFile, FlumeFile, Sides};
use super::flume::ground::GroundMaterials;
use super::flume::part::Part;
use super::flume::structure::{self, Room};
use super::flume::{bed, site::Site, terrain};
use super::output::{files, stop, stop::Stop};
use super::reading::check::{Checker, as_text, at_least, more_than};
use super::reading::document::Document;
use super::reading::error::CaseErrors;
use super::reading::hash::fingerprint;
use super::reading::identity::CaseIdentity;
use super::units::contact::{self, Contact};
use super::units::materials::{self, GroundNames, Material, Materials};
use super::units::{self, Surroundings, Units};

/// Kind of dry test, with its parameters. SI units; angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DryTestKind {
    /// The units are released from their initial poses.
    Settle,
    /// The units are lifted from their initial poses and then released.
    Drop,
    /// The bed tilts at `rate` [rad/s] up to the angle `to` [rad]. A unit faster than `slide_speed` [m/s] counts as
    /// sliding.
    Tilt { rate: f64, to: f64, slide_speed: f64 },
}

/// Output intervals of a dry test [s]. `None` means that this output is not written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryOutput {
    /// Interval between outputs of the unit surfaces [s].
    pub units_interval: Option<f64>,
    /// Interval between rows of the tables with unit motion and energy [s].
    pub series_interval: f64,
    /// Interval between checkpoints [s].
    pub checkpoint_interval: Option<f64>,
}

/// A validated dry test; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct DryTestCase {
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions of the case, which the report lists.
    pub assumptions: Vec<String>,
    /// Warnings about values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Path of the case file, as the user passed it.
    pub name: String,
    /// Fingerprint of the case: 32 hexadecimal digits.
    pub hash: String,
    /// Identity of the case in checkpoints.
    pub identity: CaseIdentity,
    /// Text of the case file that the run writes into its folder.
    pub text: String,
    /// Kind of dry test.
    pub test: DryTestKind,
    /// Ground and boundaries of the test area.
    pub site: Site,
    /// Gravitational acceleration, positive [m/s2].
    pub gravity: f64,
    /// The armour units.
    pub units: Units,
    /// Materials; other structs contain indices into this list.
    pub materials: Vec<Material>,
    /// Contact between units, and between units and the bed.
    pub contact: Contact,
    /// Breakage analysis, if any.
    pub breakage: Option<BreakageSettings>,
    /// Output intervals.
    pub output: DryOutput,
    /// Criteria that end the run.
    pub stop: Stop,
}

impl DryTestCase {
    /// Reads and validates a case file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::read(path.as_ref())?)
    }

    /// Validates the text of a case file; `name` is its name in messages.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::new(text, name)?)
    }

    /// Validates a document.
    pub fn from_document(document: &Document) -> Result<Self, CaseErrors> {
        let (case, warnings) = document.validate(validate)?;
        Ok(Self { warnings, ..case })
    }
}

fn validate(file: &DryFile, document: &Document, check: &mut Checker) -> Option<DryTestCase> {
    let name = &document.name;
    check.title(&file.title);
    check.number("gravity_m_s2", file.gravity_m_s2, more_than(0.0).up_to(100.0), "m/s2", "9.81 on Earth");
    let ground = validate_ground(file, name, check);
    let stop = stop::validate(&file.stop, true, check);
    let (test, lift) = validate_test(&file.dry_test, check);
    let mut units = units::validate(&file.units, &ground.surroundings(name), check)?;
    let breakage = match &file.breakage {
        None => None,
        Some(entry) => Some(breakage::validate(entry, &units, name, check)?),
    };
    let output = validate_output(&file.output, stop.duration, check);
    let Ground { materials, site, contact } = ground;
    let site = site?;
    let (kept, read) = self_contained(file, &units, &site, breakage.as_ref());
    for pose in &mut units.placements {
        pose.centre += DVec3::Z * lift;
    }
    let text = document.stored_text(file, &kept);
    Some(DryTestCase {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        name: name.clone(),
        hash: fingerprint(&DryFile { schema: None, ..kept.clone() }, &read),
        identity: CaseIdentity::new(&kept, &read, &text),
        text,
        test,
        site,
        gravity: file.gravity_m_s2,
        units,
        materials: materials.list,
        contact,
        breakage,
        output,
        stop,
    })
}

/// Returns the case as a run stores it, and the bytes read from other files. The stored case refers only to files in
/// the run folder.
fn self_contained(
    file: &DryFile,
    units: &Units,
    site: &Site,
    breakage: Option<&BreakageSettings>,
) -> (DryFile, Vec<u8>) {
    let (mut kept, mut read) = (file.clone(), Vec::new());
    units.make_self_contained(&mut kept.units, &mut read);
    if let Some(settings) = breakage {
        kept.breakage = kept.breakage.as_ref().map(BreakageSettings::entry);
        read.extend(&settings.mesh_file);
    }
    // Parts from STL files become polygons and boxes, or have copies of their files.
    let parts = file.structure.iter().zip(&site.parts);
    kept.structure =
        parts.map(|(file, part)| if file.stl.is_some() { part.entry(file) } else { file.clone() }).collect();
    site.parts.iter().filter_map(Part::file).for_each(|(_, content)| read.extend(content));
    if let Some(terrain) = &site.terrain {
        kept.flume.terrain = Some(terrain.entry());
        read.extend(terrain.content.iter());
    }
    (kept, read)
}

/// Materials, ground and contact settings of a dry test.
pub(super) struct Ground {
    pub materials: Materials,
    pub site: Option<Site>,
    pub contact: Contact,
}

/// Validates the materials, the ground and the contact settings.
pub(super) fn validate_ground(file: &DryFile, name: &str, check: &mut Checker) -> Ground {
    let ground = GroundNames::new(Some(&file.flume.material), file.flume.mound.as_ref(), &file.structure);
    let materials = materials::validate(&file.materials, &file.friction, ground, check);
    let site = validate_site(file, name, materials.of_ground(), check);
    let contact = contact::validate(&file.contact, check);
    Ground { materials, site, contact }
}

impl Ground {
    /// Returns the parts of a dry test on which its units depend; `name` is the path of the case file.
    pub(super) fn surroundings<'a>(&'a self, name: &'a str) -> Surroundings<'a> {
        let Self { materials, site, contact } = self;
        Surroundings { name, site: site.as_ref(), materials, ground_named: true, contact: *contact, water: None }
    }
}

/// Validates ground, terrain and boundaries of the test area.
fn validate_site(file: &DryFile, name: &str, materials: GroundMaterials, check: &mut Checker) -> Option<Site> {
    let ground = FlumeFile::dry(file.flume.bed_m.clone(), file.flume.mound.clone());
    let mut flume = bed::validate(&ground, [materials.bed, materials.mound], check)?;
    let before = check.count();
    let terrain = file.flume.terrain.as_ref().and_then(|file| terrain::validate(file, name, check));
    if let Some(y) = file.flume.terrain.as_ref().and_then(|file| file.section_y_m) {
        let advice = "remove it: only the flume model of a wave run needs a section";
        check.reject("flume.terrain.section_y_m", as_text(y), "left out in a dry test", advice);
    }
    let [start, end] = flume.ends();
    for (index, x) in file.domain.x_m.into_iter().enumerate() {
        let advice = "move the end of the domain or lengthen `flume.bed_m`";
        check.number(&format!("domain.x_m[{index}]"), x, at_least(start).up_to(end), "m", advice);
    }
    let [x0, x1] = file.domain.x_m;
    check.number("domain.x_m[1]", x1, more_than(x0).up_to(f64::MAX), "m", "write the seaward end first");
    check.number(
        "domain.width_m",
        file.domain.width_m,
        more_than(0.0).up_to(1e4),
        "m",
        "write the width across the flume",
    );
    if file.domain.sides == Sides::TwoDimensional {
        let advice = "dry tests are three-dimensional";
        check.reject("domain.sides", "\"two_dimensional\"", "\"periodic\" or \"walls\"", advice);
    }
    if check.count() > before {
        return None;
    }
    let DryDomainFile { x_m, width_m, sides, top_z_m } = file.domain;
    let around = Room { name, x: x_m, width: Some(width_m), sides, top_z: top_z_m, dp: None };
    let parts = structure::place_on_bed(&file.structure, materials.parts, &mut flume, &around, check)?;
    let highest = flume.profile.extremes_between(file.domain.x_m).1;
    let room = more_than(highest).up_to(highest + 1000.0);
    if !check.number("domain.top_z_m", file.domain.top_z_m, room, "m", "leave room for the units") {
        return None;
    }
    if let Some(terrain) = &terrain {
        terrain::validate_place(terrain, &flume.profile, [x0, x1], file.domain.width_m, file.domain.top_z_m, check);
    }
    let (x, width, sides, top_z) = (file.domain.x_m, file.domain.width_m, file.domain.sides, file.domain.top_z_m);
    let parts = structure::validate(parts, &file.structure, &[], &flume, width, &around, check)?;
    let (profile, covers) = (flume.rest.unwrap_or(flume.profile), flume.covers);
    (check.count() == before).then_some(Site { profile, covers, terrain, parts, x, width, sides, top_z })
}

/// Returns the test and the height by which it lifts the units [m].
fn validate_test(file: &DryTestFile, check: &mut Checker) -> (DryTestKind, f64) {
    match file {
        DryTestFile::Settle {} => (DryTestKind::Settle, 0.0),
        DryTestFile::Drop(drop) => {
            let advice = "write the height by which the units are lifted";
            check.number("dry_test.height_m", drop.height_m, more_than(0.0).up_to(100.0), "m", advice);
            (DryTestKind::Drop, drop.height_m)
        }
        DryTestFile::Tilt(tilt) => {
            let advice = "at 1 degree/s, the error of the sliding angle is at most 0.3 %";
            check.number("dry_test.rate_deg_s", tilt.rate_deg_s, more_than(0.0).up_to(90.0), "degrees/s", advice);
            check.number(
                "dry_test.to_deg",
                tilt.to_deg,
                more_than(0.0).below(90.0),
                "degrees",
                "write the largest tilt angle",
            );
            let advice = "a unit that is faster than this speed counts as sliding";
            check.number("dry_test.slide_speed_m_s", tilt.slide_speed_m_s, more_than(0.0).up_to(1.0), "m/s", advice);
            let (rate, to, slide_speed) =
                (tilt.rate_deg_s.to_radians(), tilt.to_deg.to_radians(), tilt.slide_speed_m_s);
            (DryTestKind::Tilt { rate, to, slide_speed }, 0.0)
        }
    }
}

fn validate_output(file: &DryOutputFile, duration: f64, check: &mut Checker) -> DryOutput {
    let mut interval = |key: &str, value: f64| files::validate_interval(key, value, duration, check);
    let units_interval = interval("units_interval_s", file.units_interval_s);
    let checkpoint_interval = interval("checkpoint_interval_s", file.checkpoint_interval_s);
    files::validate_series_interval(file.series_interval_s, duration, check);
    DryOutput { units_interval, series_interval: file.series_interval_s, checkpoint_interval }
}
