//! An input file of any kind, read and validated once.

use std::path::Path;

use super::dry_test::DryTestCase;
use super::file::{PlacementFile, SweepFile};
use super::flume_case::Case;
use super::fracture::FractureCase;
use super::reading::document::{Document, InputKind};
use super::reading::error::CaseErrors;
use super::reference::Reference;

/// An input file of any kind.
#[derive(Debug, Clone)]
pub enum InputFile {
    /// A flume case: a flume with water.
    Flume(Box<Case>),
    /// A dry test: units on a bed without water.
    DryTest(Box<DryTestCase>),
    /// A fracture case: deformable bodies that crack.
    Fracture(Box<FractureCase>),
    /// A sweep: many runs of one case, in which some keys vary.
    Sweep(SweepFile),
    /// A placement file: the poses of units that `breakwater place` has placed.
    Placement(PlacementFile),
    /// A reference folder: measured displacements that runs are compared with.
    Reference(Box<Reference>),
}

impl InputFile {
    /// Reads and validates an input file. For a sweep, it does not read the case file that the sweep varies.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::read(path.as_ref())?)
    }

    /// Validates a document. The keys of the document determine which kind of file it is.
    pub fn from_document(document: &Document) -> Result<Self, CaseErrors> {
        Ok(match document.kind() {
            InputKind::Flume => Self::Flume(Box::new(Case::from_document(document)?)),
            InputKind::DryTest => Self::DryTest(Box::new(DryTestCase::from_document(document)?)),
            InputKind::Fracture => Self::Fracture(Box::new(FractureCase::from_document(document)?)),
            InputKind::Sweep => Self::Sweep(document.parse()?),
            InputKind::Placement => Self::Placement(document.parse()?),
            InputKind::Reference => {
                let folder = Path::new(&document.name).parent().unwrap_or(Path::new(""));
                Self::Reference(Box::new(Reference::load(folder)?))
            }
        })
    }

    /// Returns the warnings of the validation: values that are allowed but probably not intended.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::Flume(case) => &case.warnings,
            Self::DryTest(case) => &case.warnings,
            Self::Fracture(case) => &case.warnings,
            Self::Sweep(_) | Self::Placement(_) | Self::Reference(_) => &[],
        }
    }

    /// Returns the kind of the file.
    pub fn kind(&self) -> InputKind {
        match self {
            Self::Flume(_) => InputKind::Flume,
            Self::DryTest(_) => InputKind::DryTest,
            Self::Fracture(_) => InputKind::Fracture,
            Self::Sweep(_) => InputKind::Sweep,
            Self::Placement(_) => InputKind::Placement,
            Self::Reference(_) => InputKind::Reference,
        }
    }
}
