//! Collects the errors and warnings of a case file, so that the user sees all of them at once.

use super::error::{CaseError, CaseErrors};

/// Errors and warnings found so far in one case file.
#[derive(Debug)]
pub struct Checker {
    file: String,
    /// Path of the section that is being checked, empty outside of a section.
    section: String,
    errors: Vec<CaseError>,
    pub warnings: Vec<String>,
}

impl Checker {
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), section: String::new(), errors: Vec::new(), warnings: Vec::new() }
    }

    /// Returns the number of errors so far. A section is valid if its validation does not increase this number.
    pub fn count(&self) -> usize {
        self.errors.len()
    }

    /// Validates a section of the file. In `validate`, paths that begin with a full stop are relative to `section`, and
    /// "." is the section itself.
    pub fn in_section<T>(&mut self, section: &str, validate: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.section, section.to_owned());
        let result = validate(self);
        self.section = outer;
        result
    }

    /// Returns the whole path of a key, which may be relative to the section.
    pub fn path(&self, path: &str) -> String {
        match path {
            "." => self.section.clone(),
            _ if path.starts_with('.') => format!("{}{path}", self.section),
            _ => path.to_owned(),
        }
    }

    /// Adds an error with the message "`path` = `value`: must be `allowed`; `advice`".
    pub fn reject(&mut self, path: &str, value: impl ToString, allowed: impl Into<String>, advice: impl Into<String>) {
        self.errors.push(CaseError::Invalid {
            file: self.file.clone(),
            path: self.path(path),
            value: value.to_string(),
            allowed: allowed.into(),
            advice: advice.into(),
        });
    }

    /// Returns true if `value` is within `range`. Otherwise adds an error and returns false. `unit` may be empty.
    pub fn number(&mut self, path: &str, value: f64, range: Range, unit: &str, advice: &str) -> bool {
        let inside = range.contains(value);
        if !inside {
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            self.reject(path, as_text(value), format!("{}{unit}", range.text()), advice);
        }
        inside
    }

    /// Adds an error if the title is empty.
    pub fn title(&mut self, title: &str) {
        if title.trim().is_empty() {
            self.reject("title", format!("{title:?}"), "a line of text", "name the case; reports show the title");
        }
    }

    /// Adds a warning about a value that is allowed but probably not intended.
    pub fn warn(&mut self, warning: impl Into<String>) {
        let warning = self.path(&warning.into());
        self.warnings.push(warning);
    }

    /// Returns the collected errors.
    pub fn into_errors(self) -> CaseErrors {
        CaseErrors { errors: self.errors }
    }
}

/// Relative rounding error of a derived limit [-]. A number that exceeds a limit by less than this equals the limit.
const ROUNDING: f64 = 1e-12;

/// An interval of allowed numbers; each end is open or closed.
#[derive(Debug, Clone, Copy)]
pub struct Range {
    low: f64,
    low_open: bool,
    high: f64,
    high_open: bool,
}

/// Returns the range of numbers greater than `low`.
pub fn more_than(low: f64) -> Range {
    Range { low, low_open: true, high: f64::MAX, high_open: false }
}

/// Returns the range of numbers greater than or equal to `low`.
pub fn at_least(low: f64) -> Range {
    Range { low, low_open: false, high: f64::MAX, high_open: false }
}

impl Range {
    /// Limits the range to numbers less than or equal to `high`.
    pub fn up_to(self, high: f64) -> Self {
        Self { high, high_open: false, ..self }
    }

    /// Limits the range to numbers less than `high`.
    pub fn below(self, high: f64) -> Self {
        Self { high, high_open: true, ..self }
    }

    fn contains(self, value: f64) -> bool {
        let low = if self.low_open { value > self.low } else { value >= self.low - ROUNDING * self.low.abs() };
        let high = if self.high_open { value < self.high } else { value <= self.high + ROUNDING * self.high.abs() };
        value.is_finite() && low && high
    }

    fn text(self) -> String {
        let low = if self.low_open { ">" } else { "at least" };
        let high = if self.high_open { "<" } else { "at most" };
        format!("{low} {} and {high} {}", lower_limit(self.low), upper_limit(self.high))
    }
}

/// Formats the smallest allowed number for messages, rounded up, so that the number in the message is allowed too.
pub fn lower_limit(limit: f64) -> String {
    rounded_limit(limit, true)
}

/// Formats the largest allowed number for messages, rounded down, so that the number in the message is allowed too.
pub fn upper_limit(limit: f64) -> String {
    rounded_limit(limit, false)
}

fn rounded_limit(limit: f64, upwards: bool) -> String {
    let shown: f64 = as_text(limit).parse().unwrap_or(limit);
    if (shown - limit).abs() <= ROUNDING * limit.abs() || (shown > limit) == upwards {
        return as_text(limit);
    }
    // Move the last of the digits that `as_text` shows by one.
    let step = if shows_exponent(limit) { 1e-5 * 10_f64.powf(limit.abs().log10().floor()) } else { 1.0 / scale(limit) };
    as_text(if upwards { shown + step } else { shown - step })
}

/// Formats a number for messages, with at most six significant digits and six decimals. Integers keep all digits.
pub fn as_text(value: f64) -> String {
    if shows_exponent(value) {
        // Rounding to six digits; the second conversion removes trailing zeros.
        let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
        format!("{rounded:e}")
    } else {
        format!("{}", (value * scale(value)).round() / scale(value))
    }
}

fn shows_exponent(value: f64) -> bool {
    value != 0.0 && !(1e-4..1e7).contains(&value.abs())
}

/// Returns 10 to the power of the number of decimals that a message shows. Six decimals are enough for any case file and
/// hide the rounding errors of derived values.
fn scale(value: f64) -> f64 {
    let decimals = 5 - value.abs().max(0.1).log10().floor() as i32;
    10_f64.powi(decimals.max(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_and_limits_stay_inside_the_range() {
        let texts = [1.418503, 0.166667, 36.5123456, 123456.0, 2.0000000000000004e10, 1e-7 / 3.0].map(as_text);
        assert_eq!(texts, ["1.4185", "0.166667", "36.5123", "123456", "2e10", "3.33333e-8"]);
        let range = at_least(1.0 / 6.0).up_to(2.0 / 3.0);
        assert_eq!(range.text(), "at least 0.166667 and at most 0.666666");
        assert!(range.contains(0.166667) && range.contains(0.666666));
        assert_eq!(at_least(0.1).up_to(0.3).text(), "at least 0.1 and at most 0.3");
        let sum = 0.1 + 0.2;
        assert_eq!(at_least(sum).up_to(2.0 * sum).text(), "at least 0.3 and at most 0.6");
        assert!(at_least(sum).contains(0.3));
        assert_eq!(at_least(1.1000001).up_to(1.1999999).text(), "at least 1.10001 and at most 1.19999");
        assert_eq!(at_least(1.2e-7 / 0.9).up_to(1.1e8 / 0.9).text(), "at least 1.33334e-7 and at most 1.22222e8");
    }

    #[test]
    fn paths_in_a_section_are_relative() {
        let mut check = Checker::new("x.json");
        check.in_section("units[1]", |check| {
            check.reject(".mass_kg", 0, "positive", "weigh a unit");
            check.reject(".", "a", "b", "c");
            check.reject("friction", "a", "b", "c");
            check.warn(".count = 1: few");
        });
        assert_eq!(check.warnings, ["units[1].count = 1: few"]);
        let text = check.into_errors().to_string();
        let lines: Vec<&str> = text.lines().map(|line| line.split(" = ").next().unwrap()).collect();
        assert_eq!(lines, ["x.json: units[1].mass_kg", "x.json: units[1]", "x.json: friction"]);
    }

    #[test]
    fn error_for_a_number_names_file_path_value_and_range() {
        let mut check = Checker::new("x.json");
        assert!(check.number("a", 0.5, more_than(0.0).up_to(0.5), "m", ""));
        assert!(!check.number("domain.dp_m", -0.01, more_than(0.0).up_to(0.5), "m", "write it in metres"));
        assert!(!check.number("b", f64::NAN, at_least(0.0).below(1.0), "", "write a number"));
        let text = check.into_errors().to_string();
        assert_eq!(
            text,
            "x.json: domain.dp_m = -0.01: must be > 0 and at most 0.5 m; write it in metres\n\
             x.json: b = NaN: must be at least 0 and < 1; write a number"
        );
    }
}
