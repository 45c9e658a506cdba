//! The validated case: everything that the solvers read.

use std::io::Read;
use std::path::Path;

use super::check::{Checker, show};
use super::domain::{self, Domain};
use super::error::{CaseError, CaseErrors};
use super::file::{CaseFile, GivenWaveFile, HandoverFile, Sides, StopFile, VelxFile, WaveFile, WaveSourceFile};
use super::flume::{self, Flume};
use super::gauges::{self, Gauge};
use super::given_wave::ROWS_FILE;
use super::handover::{self, Handover};
use super::hash::fingerprint;
use super::materials::{self, FrictionPair, Material};
use super::numerics::{self, Fluid, Numerics};
use super::output::{self, Output};
use super::parse::parse;
use super::reference::{self, Reference};
use super::run::{self, Contact, Stop};
use super::site::Site;
use super::thickness;
use super::units::{self, Surroundings, Units};
use super::wave::{self, Wave};
use super::wavemaker::{self, Wavemaker};
use super::zones;

/// Largest case file [bytes].
const LARGEST_FILE: u64 = 16 << 20;
/// Number of particles above which `check` warns.
const MANY_PARTICLES: f64 = 50e6;
/// Largest number of particles.
const MOST_PARTICLES: f64 = 1e9;

/// A validated flume case: its values are valid and consistent; SI units throughout.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Name of the case in reports, one line.
    pub title: String,
    /// Assumptions; the report lists them.
    pub assumptions: Vec<String>,
    /// Warnings about values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Name of the file, as passed by the user.
    pub name: String,
    /// Hash of the case, 32 hexadecimal digits, independent of the layout of the file.
    pub hash: String,
    /// Hash of all keys but [`Self::MAY_DIFFER`]: they decide the state of a run until its units move.
    pub start_hash: String,
    /// Text of the case file, to copy into the run folder.
    pub text: String,
    /// Bed, mound and still water level of the whole flume.
    pub flume: Flume,
    /// Particle domain: the part of the flume that is filled with particles.
    pub domain: Domain,
    /// Water.
    pub fluid: Fluid,
    /// Options and constants of the SPH scheme.
    pub numerics: Numerics,
    /// The wave.
    pub wave: Wave,
    /// Wavemaker at the seaward end of the domain.
    pub wavemaker: Wavemaker,
    /// The armour units, if any.
    pub units: Option<Units>,
    /// Materials; other structs contain indices into this list.
    pub materials: Vec<Material>,
    /// Friction of each pair of materials in the file.
    pub friction: Vec<FrictionPair>,
    /// Contact between units, and between units and the bed.
    pub contact: Contact,
    /// Breakage analysis, if any.
    pub fracture: Option<Handover>,
    /// Measured displacements to compare the run with, if any.
    pub reference: Option<Reference>,
    /// Gauges: points at which the water is measured.
    pub gauges: Vec<Gauge>,
    /// Output files and their intervals.
    pub output: Output,
    /// When the run ends.
    pub stop: Stop,
}

impl Case {
    /// Reads and validates a case file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Validates the text of a case file; `name` is its name in messages.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let file = parse(text, name)?;
        let mut check = Checker::new(name);
        match validate(&file, text, name, &mut check) {
            Some(case) if check.count() == 0 => Ok(Self { warnings: check.warnings, ..case }),
            _ => Err(check.into_errors()),
        }
    }

    /// Keys that may differ between a run and the run whose checkpoint it starts from: they do not affect units at
    /// rest. The duration must not differ, because the wavemaker's motion is prepared for it.
    pub const MAY_DIFFER: [&str; 5] = ["title", "assumptions", "reference", "friction", "stop.at_rest"];

    /// Returns the ground and the limits of the area where units stand.
    pub fn site(&self) -> Site {
        self.domain.site(&self.flume)
    }
}

/// Reads a case file. Returns its text and its name.
pub(super) fn read(path: &Path) -> Result<(String, String), CaseError> {
    let file = path.display().to_string();
    match read_text(path) {
        Ok(text) => Ok((text, file)),
        Err(reason) => Err(CaseError::Read { file, reason }),
    }
}

fn read_text(path: &Path) -> Result<String, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut text = String::new();
    let size = file.take(LARGEST_FILE + 1).read_to_string(&mut text).map_err(|error| error.to_string())?;
    if size as u64 > LARGEST_FILE {
        return Err(format!("larger than {} MiB, the limit for case files", LARGEST_FILE >> 20));
    }
    Ok(text)
}

/// Validates section by section. A section that depends on an invalid one checks what it can and returns `None`.
fn validate(file: &CaseFile, text: &str, name: &str, check: &mut Checker) -> Option<Case> {
    if file.title.trim().is_empty() {
        check.refuse("title", format!("{:?}", file.title), "a line of text", "name the case; reports show the title");
    }
    let materials = materials::validate_materials(&file.materials, check);
    let friction = materials::validate_friction(&file.friction, &materials, check);
    let ground = file.flume.material.as_deref();
    let ground_material = ground.and_then(|name| materials::find(&materials, name, "flume.material", check));
    let flume = flume::validate(&file.flume, ground_material, check);
    let domain = domain::validate(&file.domain, flume.as_ref(), file.numerics.smoothing_factor, check);
    let fluid = numerics::validate_fluid(&file.fluid, domain.as_ref().map(|domain| domain.depth), check);
    let stop = run::validate_stop(&file.stop, file.units.is_some(), check);
    // The hold time has a default, so compare it with the duration only if there are units.
    let longest_hold = if file.units.is_some() && stop.duration > 0.0 { stop.duration } else { f64::MAX };
    let numerics = numerics::validate_numerics(&file.numerics, file.domain.dp_m, longest_hold, check);
    let wavemaker = wavemaker::validate(&file.wavemaker, &file.wave, flume.as_ref(), check);
    let around = wave::Surroundings {
        name,
        domain_file: &file.domain,
        wavemaker,
        gravity: file.fluid.gravity_m_s2,
        flume: flume.as_ref(),
        domain: domain.as_ref(),
    };
    let wave = wave::validate(&file.wave, &around, check);
    let contact = run::validate_contact(&file.contact, check);
    let site = flume.as_ref().zip(domain.as_ref()).map(|(flume, domain)| domain.site(flume));
    let around = Surroundings {
        name,
        site: site.as_ref(),
        dp: Some(file.domain.dp_m),
        obstacles: file.domain.obstacles.len(),
        materials: &materials,
        friction: &friction,
        ground_material,
        ground_key: "flume.material",
        ground_named: ground.is_some(),
        rho0: Some(file.fluid.density_kg_m3),
        rounding_share: contact.rounding_share,
        law: contact.law,
    };
    let units = file.units.as_ref().map(|row| units::validate(row, &around, check));
    let reach = gauges::Reach::of(&file.wave, wavemaker);
    let count = units.as_ref().and_then(Option::as_ref).map_or(0, |units| units.placements.len());
    let gauges = gauges::validate(&file.gauges, flume.as_ref(), domain.as_ref(), count, reach, check);
    let output = output::validate(&file.output, stop.duration, domain.as_ref(), check);
    let units = match units {
        None => None,
        Some(row) => Some(row?),
    };
    let fracture = match &file.fracture {
        None => None,
        Some(entry) => Some(validate_fracture(entry, file, units.as_ref(), name, check)?),
    };
    let reference = file.reference.as_ref().and_then(|path| reference::validate(path, name, check));
    let wave = wave?;
    let relaxation = domain.as_ref().and_then(|domain| domain.relaxation_zone.as_ref());
    zones::validate_wave(relaxation, &wave, wavemaker, check);
    let (file, text, read) = self_contained(file, text, &wave, units.as_ref(), fracture.as_ref());
    let case = Case {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        name: name.to_owned(),
        hash: fingerprint(&CaseFile { schema: None, reference: None, ..file.clone() }, &read),
        start_hash: fingerprint(&without_keys_that_may_differ(&file), &read),
        text,
        flume: flume?,
        domain: domain?,
        fluid: fluid?,
        numerics: numerics?,
        wave,
        wavemaker,
        units,
        materials,
        friction,
        contact,
        fracture,
        reference,
        gauges,
        output,
        stop,
    };
    validate_size(&case, check);
    thickness::warn(&case, check);
    Some(case)
}

/// Returns the case file without its schema and without [`Case::MAY_DIFFER`].
fn without_keys_that_may_differ(file: &CaseFile) -> CaseFile {
    let stop = StopFile { at_rest: None, ..file.stop.clone() };
    let (title, assumptions, friction) = (String::new(), Vec::new(), Vec::new());
    CaseFile { schema: None, title, assumptions, reference: None, friction, stop, ..file.clone() }
}

/// Validates the breakage analysis, which needs units in three dimensions.
fn validate_fracture(
    entry: &HandoverFile,
    file: &CaseFile,
    units: Option<&Units>,
    name: &str,
    check: &mut Checker,
) -> Option<Handover> {
    let Some(units) = units else {
        check.refuse("fracture", "{...}", "left out without units", "remove it: only units have impacts");
        return None;
    };
    if file.domain.sides == Sides::TwoDimensional {
        let advice = "remove it: units in a two-dimensional domain cannot break";
        check.refuse("fracture", "{...}", "left out in two dimensions", advice);
        return None;
    }
    handover::validate(entry, &units.shape, name, check)
}

/// Returns the case as a run stores it: file, text, and the bytes read from other files. It refers only to files in the
/// run folder, so that the folder can be moved and resumed: wave files become one file that the run writes, STL files
/// and the reference folder become copies, and a placement file becomes poses in the case.
fn self_contained(
    file: &CaseFile,
    text: &str,
    wave: &Wave,
    units: Option<&Units>,
    fracture: Option<&Handover>,
) -> (CaseFile, String, Vec<u8>) {
    let (mut kept, mut read) = (file.clone(), Vec::new());
    if let Wave::Given(given) = wave {
        let source = WaveSourceFile::Dualsphysics(VelxFile { path: ROWS_FILE.into() });
        kept.wave = WaveFile::File(GivenWaveFile { source, celerity_m_s: given.celerity });
        read = given.rows_text();
    }
    kept.reference = kept.reference.as_ref().map(|_| Reference::FOLDER.to_owned());
    if let (Some(file), Some(units)) = (&mut kept.units, units) {
        units.make_self_contained(file, &mut read);
    }
    if let Some(handover) = fracture {
        kept.fracture = kept.fracture.as_ref().map(Handover::entry);
        read.extend(&handover.mesh_file);
    }
    // Writing to memory cannot fail, because every key is a string.
    let text = if kept == *file { text.to_owned() } else { serde_json::to_string_pretty(&kept).unwrap_or_default() };
    (kept, text, read)
}

fn validate_size(case: &Case, check: &mut Checker) {
    let particles = case.estimate().particles();
    if particles > MOST_PARTICLES {
        check.refuse(
            "domain.dp_m",
            show(case.domain.dp),
            format!("large enough for at most {MOST_PARTICLES:e} particles (it would be {particles:.1e})"),
            "write a larger particle spacing or a smaller domain",
        );
    } else if particles > MANY_PARTICLES {
        check.warn(format!("domain.dp_m = {}: about {:.0} million particles", show(case.domain.dp), particles / 1e6));
    }
}
