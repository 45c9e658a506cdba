//! Validates a flume case, section by section.

use super::Case;
use super::crest;
use super::numerics::{self, Numerics};
use super::region;
use super::reynolds;
use super::self_contained::{self_contained, without_keys_free_at_start};
use crate::case::breakage::{self, BreakageSettings};
use crate::case::file::{CaseFile, Sides};
use crate::case::flume::{bathymetry, bed::Flume, domain::Domain, ground, site::Site};
use crate::case::output::gauges::{self, Gauge};
use crate::case::output::{files, stop, stop::Stop};
use crate::case::reading::check::{Checker, as_text};
use crate::case::reading::document::Document;
use crate::case::reading::hash::fingerprint;
use crate::case::reading::identity::CaseIdentity;
use crate::case::reference::{self, Reference};
use crate::case::units::contact::{self, Contact};
use crate::case::units::materials::{self, GroundNames, Materials};
use crate::case::units::{self, Surroundings, Units, WaterAround};
use crate::case::wave::wavemaker::{self, Wavemaker};
use crate::case::wave::{self, Wave};

/// Number of particles above which the validation gives a warning.
const MANY_PARTICLES: f64 = 50e6;
/// Largest number of particles.
const MOST_PARTICLES: f64 = 1e9;

/// Validates the case section by section. If a section depends on an invalid section, its validation checks what it can
/// and returns `None`.
pub(super) fn validate(file: &CaseFile, document: &Document, check: &mut Checker) -> Option<Case> {
    check.title(&file.title);
    let materials = materials::validate(&file.materials, &file.friction, ground_materials(file, check), check);
    let (flume, domain) = ground::validate(file, &document.name, materials.of_ground(), check);
    let fluid = numerics::validate_fluid(&file.fluid, domain.as_ref(), check);
    let stop = stop::validate(&file.stop, file.units.is_some(), check);
    let numerics = validate_numerics(file, &stop, check);
    let wavemaker = wavemaker::validate(&file.wavemaker, &file.wave, flume.as_ref(), domain.as_ref(), check);
    let sections = Sections { file, name: &document.name, flume, domain };
    let wave = sections.wave(wavemaker, check);
    let contact = contact::validate(&file.contact, check);
    let units = sections.units(&materials, contact, check);
    let gauges = sections.gauges(wavemaker, units.as_ref().ok().and_then(Option::as_ref), check);
    let output = files::validate(&file.output, stop.duration, sections.domain.as_ref(), check);
    let units = units.ok()?;
    let breakage = sections.breakage(units.as_ref(), check).ok()?;
    let reference = sections.reference(check);
    let Sections { flume, domain, .. } = sections;
    let (wave, domain) = (wave?, domain?);
    wave::refuse_relaxation_zone(domain.relaxation_zone.as_ref(), &wave, wavemaker, check);
    let (kept, read) = self_contained(file, flume.as_ref()?, &wave, units.as_ref(), breakage.as_ref());
    let text = document.stored_text(file, &kept);
    let case = Case {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        name: document.name.clone(),
        hash: fingerprint(&CaseFile { schema: None, reference: None, ..kept.clone() }, &read),
        start_hash: fingerprint(&without_keys_free_at_start(&kept), &read),
        identity: CaseIdentity::new(&kept, &read, &text),
        text,
        flume: flume?,
        domain,
        fluid: fluid?,
        numerics: numerics?,
        wave,
        wavemaker,
        units,
        materials: materials.list,
        friction: materials.friction,
        contact,
        breakage,
        reference,
        gauges,
        output,
        stop,
    };
    region::validate_contents(&case, check);
    let ends: &[usize] = match (&case.wave, case.wavemaker) {
        (Wave::None, _) => &[],
        (_, Wavemaker::OpenEnds { .. }) => &[0, 1],
        _ => &[0],
    };
    bathymetry::check_ends(&case.flume, &case.domain, ends, check);
    validate_size(&case, check);
    crest::warn(&case, check);
    reynolds::warn(&case, check);
    Some(case)
}

/// Returns the names of the materials of the ground. Without units and materials, these names have no effect.
fn ground_materials<'a>(file: &'a CaseFile, check: &mut Checker) -> GroundNames<'a> {
    let names = GroundNames::new(file.flume.material.as_deref(), file.flume.mound.as_ref(), &file.structure);
    if file.units.is_some() || !file.materials.is_empty() {
        return names;
    }
    let of_parts = file.structure.iter().enumerate();
    let of_parts = of_parts.map(|(index, part)| (format!("structure[{index}].material"), part.material.as_deref()));
    let of_flume = [("flume.material", names.bed), ("flume.mound.material", names.mound)];
    for (key, name) in of_flume.map(|(key, name)| (key.to_owned(), name)).into_iter().chain(of_parts) {
        if let Some(name) = name {
            check.warn(format!("{key} = {name:?}: has no effect without units"));
        }
    }
    GroundNames::default()
}

/// Validated sections on which later sections depend.
struct Sections<'a> {
    file: &'a CaseFile,
    /// Name of the case file.
    name: &'a str,
    flume: Option<Flume>,
    domain: Option<Domain>,
}

/// Error: an optional section is present in the file but invalid.
struct Invalid;

impl Sections<'_> {
    fn wave(&self, wavemaker: Wavemaker, check: &mut Checker) -> Option<Wave> {
        let around = wave::Surroundings {
            name: self.name,
            domain_file: &self.file.domain,
            wavemaker,
            gravity: self.file.fluid.gravity_m_s2,
            flume: self.flume.as_ref(),
            domain: self.domain.as_ref(),
        };
        wave::validate(&self.file.wave, &around, check)
    }

    fn units(&self, materials: &Materials, contact: Contact, check: &mut Checker) -> Result<Option<Units>, Invalid> {
        let Some(file) = &self.file.units else { return Ok(None) };
        let site = self.flume.as_ref().zip(self.domain.as_ref()).map(|(flume, domain)| domain.site(flume));
        let around = surroundings(self.file, self.name, site.as_ref(), materials, contact);
        units::validate(file, &around, check).map(Some).ok_or(Invalid)
    }

    fn gauges(&self, wavemaker: Wavemaker, units: Option<&Units>, check: &mut Checker) -> Vec<Gauge> {
        let reach = gauges::Reach::of(&self.file.wave, wavemaker);
        gauges::validate(&self.file.gauges, self.flume.as_ref(), self.domain.as_ref(), units, reach, check)
    }

    fn reference(&self, check: &mut Checker) -> Option<Reference> {
        self.file.reference.as_ref().and_then(|path| reference::validate(path, self.name, check))
    }

    /// Validates the breakage analysis, which needs units in three dimensions.
    fn breakage(&self, units: Option<&Units>, check: &mut Checker) -> Result<Option<BreakageSettings>, Invalid> {
        let Some(file) = &self.file.breakage else { return Ok(None) };
        let (allowed, advice) = match units {
            None => ("left out without units", "remove it: only units have impacts"),
            Some(_) if self.file.domain.sides == Sides::TwoDimensional => {
                ("left out in two dimensions", "remove it: units in a two-dimensional domain cannot break")
            }
            Some(units) => return breakage::validate(file, units, self.name, check).map(Some).ok_or(Invalid),
        };
        check.reject("breakage", "{...}", allowed, advice);
        Err(Invalid)
    }
}

/// Returns the parts of a flume case on which its units depend.
pub fn surroundings<'a>(
    file: &CaseFile,
    name: &'a str,
    site: Option<&'a Site>,
    materials: &'a Materials,
    contact: Contact,
) -> Surroundings<'a> {
    let (dp, rho0, hold) = (file.domain.dp_m, file.fluid.density_kg_m3, file.numerics.hold_units_s);
    let water = Some(WaterAround { dp, rho0, hold });
    Surroundings { name, site, materials, ground_named: file.flume.material.is_some(), contact, water }
}

fn validate_numerics(file: &CaseFile, stop: &Stop, check: &mut Checker) -> Option<Numerics> {
    // A run without units may be shorter than the default of `hold_units_s`, which then has no effect.
    let longest_hold = if file.units.is_some() && stop.duration > 0.0 { stop.duration } else { f64::MAX };
    numerics::validate_numerics(&file.numerics, file.domain.dp_m, longest_hold, check)
}

fn validate_size(case: &Case, check: &mut Checker) {
    let particles = case.estimate().particles();
    if particles > MOST_PARTICLES {
        check.reject(
            "domain.dp_m",
            as_text(case.domain.dp),
            format!("large enough for at most {MOST_PARTICLES:e} particles (it would be {particles:.1e})"),
            "write a larger particle spacing or a smaller domain",
        );
    } else if particles > MANY_PARTICLES {
        let dp = as_text(case.domain.dp);
        check.warn(format!("domain.dp_m = {dp}: about {:.0} million particles", particles / 1e6));
    }
}
