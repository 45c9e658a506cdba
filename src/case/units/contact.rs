//! Validates the contact settings.

use crate::case::file::{ContactFile, ContactLawName};
use crate::case::reading::check::{Checker, at_least};

/// Contact between units, and between units and the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Rounding radius of the edges of a unit / height of the unit [-].
    pub rounding_share: f64,
    /// Contact law.
    pub law: ContactLawName,
}

/// Validates the contact settings.
pub fn validate(file: &ContactFile, check: &mut Checker) -> Contact {
    check.number(
        "contact.rounding_share",
        file.rounding_share,
        at_least(0.001).up_to(0.12),
        "",
        "0.05 rounds the edges of a unit by a twentieth of its height",
    );
    Contact { rounding_share: file.rounding_share, law: file.law }
}
