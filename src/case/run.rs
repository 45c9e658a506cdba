//! Contact, output and the end of the run, validated.

use super::check::{Checker, above, from, show};
use super::file::{ContactFile, OutputFile, StopFile};

/// Steps of one output at most: more would fill a disk with files nobody reads.
const MOST_OUTPUTS: f64 = 1e6;

/// Contact between units and with the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Rounding radius of a unit's edges as a share of its height [-].
    pub rounding_share: f64,
}

/// Intervals of the outputs; SI units, `None` where none is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output {
    /// Interval of the fluid snapshots [s].
    pub fluid_interval: Option<f64>,
    /// Interval of the units' surfaces [s].
    pub units_interval: Option<f64>,
    /// Interval of gauges, motion, forces and energy [s].
    pub series_interval: f64,
    /// Interval of the checkpoints [s]; without it one is written at the end.
    pub checkpoint_interval: Option<f64>,
}

/// When the run ends; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Simulated time at most [s].
    pub duration: f64,
    /// End earlier when the units have come to rest.
    pub at_rest: Option<AtRest>,
}

/// When the units count as come to rest; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtRest {
    /// A unit slower than this is at rest [m/s].
    pub speed: f64,
    /// For how long all must be at rest [s].
    pub hold: f64,
    /// Not before this simulated time [s].
    pub not_before: f64,
}

/// Validate the contact's constants.
pub(super) fn validate_contact(file: &ContactFile, check: &mut Checker) -> Contact {
    check.number(
        "contact.rounding_share",
        file.rounding_share,
        from(0.001).up_to(0.12),
        "",
        "0.05 rounds the edges of a unit by a twentieth of its height",
    );
    Contact { rounding_share: file.rounding_share }
}

/// Validate the outputs of a run of `duration` [s].
pub(super) fn validate_output(file: &OutputFile, duration: f64, check: &mut Checker) -> Output {
    let shortest = duration / MOST_OUTPUTS;
    let mut interval = |key: &str, value: f64| {
        let path = format!("output.{key}");
        if value == 0.0 {
            return None;
        }
        let advice =
            format!("write the time between two outputs, or 0 for none; a run can write {MOST_OUTPUTS:e} at most");
        check.number(&path, value, from(shortest.max(0.0)).up_to(1e6), "s", &advice).then_some(value)
    };
    let fluid_interval = interval("fluid_interval_s", file.fluid_interval_s);
    let units_interval = interval("units_interval_s", file.units_interval_s);
    let checkpoint_interval = interval("checkpoint_interval_s", file.checkpoint_interval_s);
    let series_range = if shortest > 0.0 { from(shortest) } else { above(0.0) };
    check.number(
        "output.series_interval_s",
        file.series_interval_s,
        series_range.up_to(1e6),
        "s",
        "the tables need an interval, e.g. 0.01",
    );
    Output { fluid_interval, units_interval, series_interval: file.series_interval_s, checkpoint_interval }
}

/// Validate the end of the run.
pub(super) fn validate_stop(file: &StopFile, has_units: bool, check: &mut Checker) -> Stop {
    let sound = check.number(
        "stop.duration_s",
        file.duration_s,
        from(1e-6).up_to(1e4),
        "s",
        "write the simulated time, counted from the start of the particles",
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
        if sound {
            let end = show(file.duration_s);
            let within = format!("the run ends after {end} s");
            check.number("stop.at_rest.for_s", rest.for_s, above(0.0).up_to(file.duration_s), "s", &within);
            check.number(
                "stop.at_rest.not_before_s",
                rest.not_before_s,
                from(0.0).up_to(file.duration_s),
                "s",
                &within,
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
