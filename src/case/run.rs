//! The validated contact settings and stop criteria.

use super::check::{Checker, above, from, show};
use super::file::{ContactFile, ContactLawName, StopFile};

/// Contact between units, and between units and the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Rounding radius of a unit's edges over its height [-].
    pub rounding_share: f64,
    /// Contact law.
    pub law: ContactLawName,
}

/// When the run ends; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Longest simulated time [s].
    pub duration: f64,
    /// Rest criterion, which can end the run earlier.
    pub at_rest: Option<AtRest>,
}

/// Rest criterion; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtRest {
    /// Largest speed of a unit at rest [m/s].
    pub speed: f64,
    /// Time for which all units must be at rest [s].
    pub hold: f64,
    /// Earliest end of the run [s].
    pub not_before: f64,
}

/// Validates the contact settings.
pub(super) fn validate_contact(file: &ContactFile, check: &mut Checker) -> Contact {
    check.number(
        "contact.rounding_share",
        file.rounding_share,
        from(0.001).up_to(0.12),
        "",
        "0.05 rounds the edges of a unit by a twentieth of its height",
    );
    Contact { rounding_share: file.rounding_share, law: file.law }
}

/// Validates the stop criteria.
pub(super) fn validate_stop(file: &StopFile, has_units: bool, check: &mut Checker) -> Stop {
    let is_duration_valid = check.number(
        "stop.duration_s",
        file.duration_s,
        from(1e-6).up_to(1e4),
        "s",
        "write the simulated time from the start of the particles",
    );
    if let Some(rest) = &file.at_rest {
        if !has_units {
            check.refuse("stop.at_rest", "{ ... }", "left out in a case without units", "remove it, or add `units`");
        }
        check.number(
            "stop.at_rest.speed_m_s",
            rest.speed_m_s,
            above(0.0).up_to(1.0),
            "m/s",
            "a unit slower than this is at rest, e.g. 0.002",
        );
        if is_duration_valid {
            let end = show(file.duration_s);
            let advice = format!("the run ends after {end} s");
            check.number("stop.at_rest.for_s", rest.for_s, above(0.0).up_to(file.duration_s), "s", &advice);
            check.number(
                "stop.at_rest.not_before_s",
                rest.not_before_s,
                from(0.0).up_to(file.duration_s),
                "s",
                &advice,
            );
        }
    }
    let at_rest = file.at_rest.as_ref().map(|rest| AtRest {
        speed: rest.speed_m_s,
        hold: rest.for_s,
        not_before: rest.not_before_s,
    });
    Stop { duration: file.duration_s, at_rest }
}
