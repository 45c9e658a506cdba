//! A flume case: the validated form that the solvers read.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`validate`] | the sections in order |
//! | [`numerics`] | water, and options of the SPH scheme |
//! | [`self_contained`] | the case as a run stores it |
//! | [`estimate`] | number of particles, memory, time step |
//! | [`reynolds`] | warning of over-viscous water |

pub(super) mod estimate;
pub(super) mod numerics;
mod reynolds;
mod self_contained;
mod validate;

use std::path::Path;

use self::numerics::{Fluid, Numerics};
pub(super) use self::validate::surroundings;
use super::breakage::BreakageSettings;
use super::flume::{bed::Flume, domain::Domain, site::Site};
use super::output::{files::Output, gauges::Gauge, stop::Stop};
use super::reading::document::Document;
use super::reading::error::CaseErrors;
use super::reference::Reference;
use super::units::Units;
use super::units::contact::Contact;
use super::units::materials::{FrictionPair, Material};
use super::wave::{Wave, wavemaker::Wavemaker};

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
    /// Hash of all keys but [`Self::KEYS_FREE_AT_START`]: they decide the state of a run until its units move.
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
    pub breakage: Option<BreakageSettings>,
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
    /// Keys that may differ between a run and the run whose checkpoint it starts from: they do not affect units at
    /// rest. The duration must not differ, because the wavemaker's motion is prepared for it.
    pub const KEYS_FREE_AT_START: [&str; 5] = ["title", "assumptions", "reference", "friction", "stop.at_rest"];

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
        let (case, warnings) = document.validate(validate::validate)?;
        Ok(Self { warnings, ..case })
    }

    /// Returns the ground and the limits of the area where units stand.
    pub fn site(&self) -> Site {
        self.domain.site(&self.flume)
    }
}
