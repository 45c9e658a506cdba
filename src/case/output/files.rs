//! The validated output settings.

use crate::case::file::{FluidField, OutputFile, Sides};
use crate::case::flume::domain::Domain;
use crate::case::reading::check::{Checker, as_text, at_least, more_than};

/// Largest number of snapshots or rows of one output in a run.
const MOST_OUTPUTS: f64 = 1e6;

/// Output settings; SI units. An interval of `None` means that this output is not written.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Interval between snapshots of the water particles [s].
    pub fluid_interval: Option<f64>,
    /// Fields of the water particles in the snapshots, in addition to the position; each only once.
    pub fluid_fields: Vec<FluidField>,
    /// Lower and upper corner of the box whose water particles the snapshots contain [m]; `None` for all particles.
    pub fluid_box: Option<[[f64; 3]; 2]>,
    /// Interval between outputs of the unit surfaces [s].
    pub units_interval: Option<f64>,
    /// Interval between snapshots of the surface of the water [s]; `None` in two dimensions.
    pub surface_interval: Option<f64>,
    /// Interval between rows of the tables with gauges, unit motion, unit forces, energy and diagnostics [s].
    pub series_interval: f64,
    /// Interval between checkpoints [s]; `None` for only one checkpoint, at the end of the run.
    pub checkpoint_interval: Option<f64>,
}

/// Validates the output settings of a run of `duration` [s].
pub fn validate(file: &OutputFile, duration: f64, domain: Option<&Domain>, check: &mut Checker) -> Output {
    let mut interval = |key: &str, value: f64| validate_interval(key, value, duration, check);
    let fluid_interval = interval("fluid_interval_s", file.fluid_interval_s);
    let units_interval = interval("units_interval_s", file.units_interval_s);
    let surface_interval = interval("surface_interval_s", file.surface_interval_s);
    let checkpoint_interval = interval("checkpoint_interval_s", file.checkpoint_interval_s);
    validate_series_interval(file.series_interval_s, duration, check);
    validate_fields(&file.fluid_fields, check);
    if let (Some(corners), Some(domain)) = (file.fluid_box_m, domain) {
        validate_box(corners, domain, check);
    }
    Output {
        fluid_interval,
        fluid_fields: file.fluid_fields.clone(),
        fluid_box: file.fluid_box_m,
        units_interval,
        surface_interval: surface_interval.filter(|_| domain.is_none_or(|d| d.sides != Sides::TwoDimensional)),
        series_interval: file.series_interval_s,
        checkpoint_interval,
    }
}

/// Validates the interval `output.<key>` of a run of `duration` [s]. Returns `None` if it is 0 or invalid.
pub fn validate_interval(key: &str, value: f64, duration: f64, check: &mut Checker) -> Option<f64> {
    if value == 0.0 {
        return None;
    }
    let shortest = (duration / MOST_OUTPUTS).max(0.0);
    let advice = format!("write the time between two outputs, or 0 for none; a run can write at most {MOST_OUTPUTS:e}");
    check.number(&format!("output.{key}"), value, at_least(shortest).up_to(1e6), "s", &advice).then_some(value)
}

/// Validates the interval of the tables. It must not be 0, because the tables are always written.
pub fn validate_series_interval(value: f64, duration: f64, check: &mut Checker) {
    let shortest = duration / MOST_OUTPUTS;
    let range = if shortest > 0.0 { at_least(shortest) } else { more_than(0.0) };
    let advice = "write the time between two rows of the tables, e.g. 0.01";
    check.number("output.series_interval_s", value, range.up_to(1e6), "s", advice);
}

fn validate_fields(fields: &[FluidField], check: &mut Checker) {
    for (index, field) in fields.iter().enumerate() {
        if fields[..index].contains(field) {
            check.reject(
                &format!("output.fluid_fields[{index}]"),
                format!("{:?}", field.name()),
                "different from the fields before it",
                "remove one of the two equal fields",
            );
        }
    }
}

/// Validates the box whose water particles the snapshots contain. It must not be empty and must overlap the domain.
fn validate_box([low, high]: [[f64; 3]; 2], domain: &Domain, check: &mut Checker) {
    let Domain { x, width, bottom_z, top_z, .. } = *domain;
    let ranges = [("x", x), ("y", [0.0, width]), ("z", [bottom_z, top_z])];
    for (axis, (name, domain)) in ranges.into_iter().enumerate() {
        if high[axis] <= low[axis] {
            let path = format!("output.fluid_box_m[1][{axis}]");
            let advice = "write the lower corner first, then the upper corner";
            check.reject(&path, as_text(high[axis]), format!("> {} m, the lower {name}", as_text(low[axis])), advice);
        } else if high[axis] <= domain[0] || low[axis] >= domain[1] {
            let advice = "move the box into the domain, or remove the key to write all water particles";
            let value = format!("{name} from {} to {}", as_text(low[axis]), as_text(high[axis]));
            let allowed =
                format!("at least partly inside the domain, {} to {} m", as_text(domain[0]), as_text(domain[1]));
            check.reject("output.fluid_box_m", value, allowed, advice);
        }
    }
}
