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

/// A larger case file is no case file [bytes].
const LARGEST_FILE: u64 = 16 << 20;
/// Particles above which a run is probably not meant.
const MANY_PARTICLES: f64 = 50e6;
/// Particles at most.
const MOST_PARTICLES: f64 = 1e9;

/// A case whose values make sense, each alone and together; SI units throughout.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// One line that names the case in reports.
    pub title: String,
    /// What had to be assumed; listed in the report.
    pub assumptions: Vec<String>,
    /// What is allowed and probably not meant.
    pub warnings: Vec<String>,
    /// Name of the file as given.
    pub name: String,
    /// 32 hexadecimal digits that stay the same for the same case, whatever the layout of the file.
    pub hash: String,
    /// Fingerprint of what decides where a run stands while its units have not moved: all but [`Self::MAY_DIFFER`].
    pub start_hash: String,
    /// The file as written, to copy into the run's folder.
    pub text: String,
    /// Bed, mound and still water of the whole flume.
    pub flume: Flume,
    /// The part of the flume that is filled with particles.
    pub domain: Domain,
    /// Water.
    pub fluid: Fluid,
    /// Constants of the SPH scheme.
    pub numerics: Numerics,
    /// The wave.
    pub wave: Wave,
    /// What makes it in the particles.
    pub wavemaker: Wavemaker,
    /// The armour units, if any.
    pub units: Option<Units>,
    /// Elastic constants; other structs hold indices into this list.
    pub materials: Vec<Material>,
    /// Friction of each pair of materials in the file.
    pub friction: Vec<FrictionPair>,
    /// Contact between units and with the bed.
    pub contact: Contact,
    /// What is done with the hardest impacts.
    pub fracture: Option<Handover>,
    /// Measured displacements that the run can be compared with.
    pub reference: Option<Reference>,
    /// Points at which the water is measured.
    pub gauges: Vec<Gauge>,
    /// What is written, and how often.
    pub output: Output,
    /// When the run ends.
    pub stop: Stop,
}

impl Case {
    /// Read and validate a case file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Validate the text of a case file; `name` is its name in messages.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let file = parse(text, name)?;
        let mut check = Checker::new(name);
        match validate(&file, text, name, &mut check) {
            Some(case) if check.count() == 0 => Ok(Self { warnings: check.warnings, ..case }),
            _ => Err(check.into_errors()),
        }
    }

    /// Keys that may differ between a run and the one at whose checkpoint it begins: units at rest do not feel them.
    /// The duration is none of them, for the wavemaker's motion is prepared up to there.
    pub const MAY_DIFFER: [&str; 5] = ["title", "assumptions", "reference", "friction", "stop.at_rest"];

    /// Ground and limits of the place where the units stand.
    pub fn site(&self) -> Site {
        self.domain.site(&self.flume)
    }
}

/// Text and name of a case file.
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
        return Err(format!("larger than {} MiB, which no case file is", LARGEST_FILE >> 20));
    }
    Ok(text)
}

/// Validate section by section. A section that rests on an unsound one checks what it can and gives `None`.
fn validate(file: &CaseFile, text: &str, name: &str, check: &mut Checker) -> Option<Case> {
    if file.title.trim().is_empty() {
        check.refuse("title", format!("{:?}", file.title), "a line of text", "name the case; reports show it");
    }
    let materials = materials::validate_materials(&file.materials, check);
    let friction = materials::validate_friction(&file.friction, &materials, check);
    let ground = file.flume.material.as_deref();
    let ground_material = ground.and_then(|name| materials::find(&materials, name, "flume.material", check));
    let flume = flume::validate(&file.flume, ground_material, check);
    let domain = domain::validate(&file.domain, flume.as_ref(), file.numerics.smoothing_factor, check);
    let fluid = numerics::validate_fluid(&file.fluid, domain.as_ref().map(|domain| domain.depth), check);
    let stop = run::validate_stop(&file.stop, file.units.is_some(), check);
    // The holding time has a default: compare it with the duration only where it means something.
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
        start_hash: fingerprint(&without_what_may_differ(&file), &read),
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

/// The case without its schema and [`Case::MAY_DIFFER`].
fn without_what_may_differ(file: &CaseFile) -> CaseFile {
    let stop = StopFile { at_rest: None, ..file.stop.clone() };
    let (title, assumptions, friction) = (String::new(), Vec::new(), Vec::new());
    CaseFile { schema: None, title, assumptions, reference: None, friction, stop, ..file.clone() }
}

/// Impacts are those of units in three dimensions.
fn validate_fracture(
    entry: &HandoverFile,
    file: &CaseFile,
    units: Option<&Units>,
    name: &str,
    check: &mut Checker,
) -> Option<Handover> {
    let Some(units) = units else {
        check.refuse("fracture", "{...}", "left out without units", "impacts are those of units");
        return None;
    };
    if file.domain.sides == Sides::TwoDimensional {
        let advice = "units of a two-dimensional domain are slices";
        check.refuse("fracture", "{...}", "left out in two dimensions", advice);
        return None;
    }
    handover::validate(entry, &units.shape, name, check)
}

/// The case as a run keeps it: file, text, and what it has read besides. A wave from other programs' files becomes one
/// from the file that the run writes beside its case, STL files and the reference folder those that it copies there, and a
/// placement file becomes poses in the case, so that the folder can be moved and resumed.
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
    // Writing to memory cannot fail: every key is a string.
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
            "write a larger particle distance or a smaller domain",
        );
    } else if particles > MANY_PARTICLES {
        check.warn(format!("domain.dp_m = {}: about {:.0} million particles", show(case.domain.dp), particles / 1e6));
    }
}
