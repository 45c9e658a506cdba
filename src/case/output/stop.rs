//! Validates the stop criteria.

use crate::case::file::StopFile;
use crate::case::reading::check::{Checker, as_text, at_least, more_than};

/// Criteria that end the run; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Simulated time after which the run ends at the latest [s].
    pub duration: f64,
    /// Rest criterion, which can end the run before `duration`, if any.
    pub at_rest: Option<AtRest>,
}

/// Rest criterion; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtRest {
    /// Speed below which a unit counts as at rest [m/s].
    pub speed: f64,
    /// Time for which all units must be at rest [s].
    pub hold: f64,
    /// Earliest time at which the rest criterion can end the run [s].
    pub not_before: f64,
}

/// Validates the stop criteria.
pub fn validate(file: &StopFile, has_units: bool, check: &mut Checker) -> Stop {
    let is_duration_valid = check.number(
        "stop.duration_s",
        file.duration_s,
        at_least(1e-6).up_to(1e4),
        "s",
        "write the simulated time from the start of the particles",
    );
    if let Some(rest) = &file.at_rest {
        if !has_units {
            check.reject("stop.at_rest", "{ ... }", "left out in a case without units", "remove it, or add `units`");
        }
        check.number(
            "stop.at_rest.speed_m_s",
            rest.speed_m_s,
            more_than(0.0).up_to(1.0),
            "m/s",
            "a unit that is slower than this speed counts as at rest; write e.g. 0.002",
        );
        if is_duration_valid {
            let end = as_text(file.duration_s);
            let advice = format!("the run ends after {end} s");
            check.number("stop.at_rest.for_s", rest.for_s, more_than(0.0).up_to(file.duration_s), "s", &advice);
            check.number(
                "stop.at_rest.not_before_s",
                rest.not_before_s,
                at_least(0.0).up_to(file.duration_s),
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
