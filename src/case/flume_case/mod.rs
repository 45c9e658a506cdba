//! A flume case: the validated form that the solvers read.
//!
//! | file | contents |
//! | --- | --- |
//! | [`validate`] | validates the sections of the file in order |
//! | [`numerics`] | properties of the water and options of the SPH scheme |
//! | [`self_contained`] | the case file that a run stores in its folder |
//! | [`estimate`] | estimated number of particles, memory and time step |
//! | [`region`] | the case of one region of the particle domain |
//! | [`crest`] | warning about water above the walls |
//! | [`reynolds`] | warning about over-viscous water |

mod crest;
pub(super) mod estimate;
pub(super) mod numerics;
mod region;
mod reynolds;
mod self_contained;
mod validate;

use std::path::Path;

use self::numerics::{Fluid, Numerics};
pub(super) use self::validate::surroundings;
use super::breakage::BreakageSettings;
use super::flume::{
    bed::Flume,
    domain::{Domain, StillWater},
    site::Site,
};
use super::output::{files::Output, gauges::Gauge, stop::Stop};
use super::reading::document::Document;
use super::reading::error::CaseErrors;
use super::reading::identity::CaseIdentity;
use super::reference::Reference;
use super::units::Units;
use super::units::contact::Contact;
use super::units::materials::{FrictionPair, Material};
use super::wave::{Wave, wavemaker::Wavemaker};

/// A validated flume case: its values are valid and consistent; SI units throughout.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions of the case, which the report lists.
    pub assumptions: Vec<String>,
    /// Warnings about values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Path of the case file, as the user passed it.
    pub name: String,
    /// Hash of the case, 32 hexadecimal digits, independent of the layout of the file.
    pub hash: String,
    /// Hash of all keys except [`Self::KEYS_FREE_AT_START`]. Two runs with the same `start_hash` have the same
    /// state until their units move.
    pub start_hash: String,
    /// Identity of the case in checkpoints.
    pub identity: CaseIdentity,
    /// Text of the case file that the run writes into its folder.
    pub text: String,
    /// Bed, mound and still water level of the whole flume.
    pub flume: Flume,
    /// Particle domain: the part of the flume that is filled with particles.
    pub domain: Domain,
    /// Properties of the water.
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
    /// Gauges: points at which elevation, pressure or velocity of the water is measured.
    pub gauges: Vec<Gauge>,
    /// Output files and their intervals.
    pub output: Output,
    /// Criteria that end the run.
    pub stop: Stop,
}

impl Case {
    /// Keys that may differ between two runs of which one starts from a checkpoint of the other. These keys have no
    /// effect before the units move. `stop.duration_s` must be the same, because the wavemaker's motion is prepared for
    /// this duration.
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

    /// Returns the still water at the start; `None` if the run starts with a block of water.
    pub fn still_water(&self) -> Option<StillWater> {
        self.domain.still_water(&self.flume, self.fluid.rho0)
    }

    /// Returns the ground and the boundaries of the area in which units stand.
    pub fn site(&self) -> Site {
        self.domain.site(&self.flume)
    }
}
