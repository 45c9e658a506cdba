//! Collects all errors and warnings of a case file, so that the user sees all of them at once.

use super::error::{CaseError, CaseErrors};

/// Errors and warnings found so far in one case file.
#[derive(Debug)]
pub(super) struct Checker {
    file: String,
    errors: Vec<CaseError>,
    pub warnings: Vec<String>,
}

impl Checker {
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), errors: Vec::new(), warnings: Vec::new() }
    }

    /// Returns the number of errors so far. If it does not grow over a section, the section is valid.
    pub fn count(&self) -> usize {
        self.errors.len()
    }

    /// Adds the error that the value at `path` "must be" `allowed`.
    pub fn refuse(&mut self, path: &str, value: impl ToString, allowed: impl Into<String>, advice: impl Into<String>) {
        self.errors.push(CaseError::Invalid {
            file: self.file.clone(),
            path: path.to_owned(),
            value: value.to_string(),
            allowed: allowed.into(),
            advice: advice.into(),
        });
    }

    /// Returns whether a number lies within a range, and adds an error if not; `unit` may be empty.
    pub fn number(&mut self, path: &str, value: f64, range: Range, unit: &str, advice: &str) -> bool {
        let inside = range.contains(value);
        if !inside {
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            self.refuse(path, show(value), format!("{}{unit}", range.text()), advice);
        }
        inside
    }

    /// Adds a warning about something that is allowed but probably not intended.
    pub fn warn(&mut self, warning: impl Into<String>) {
        self.warnings.push(warning.into());
    }

    /// Returns the errors.
    pub fn into_errors(self) -> CaseErrors {
        CaseErrors { errors: self.errors }
    }
}

/// An interval of allowed numbers; each end is open or closed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    low: f64,
    low_open: bool,
    high: f64,
    high_open: bool,
}

/// Numbers greater than `low`.
pub(super) fn above(low: f64) -> Range {
    Range { low, low_open: true, high: f64::MAX, high_open: false }
}

/// Numbers of at least `low`.
pub(super) fn from(low: f64) -> Range {
    Range { low, low_open: false, high: f64::MAX, high_open: false }
}

impl Range {
    /// At most `high`.
    pub fn up_to(self, high: f64) -> Self {
        Self { high, high_open: false, ..self }
    }

    /// Less than `high`.
    pub fn below(self, high: f64) -> Self {
        Self { high, high_open: true, ..self }
    }

    fn contains(self, value: f64) -> bool {
        let low = if self.low_open { value > self.low } else { value >= self.low };
        let high = if self.high_open { value < self.high } else { value <= self.high };
        low && high
    }

    fn text(self) -> String {
        let low = if self.low_open { ">" } else { "at least" };
        let high = if self.high_open { "<" } else { "at most" };
        format!("{low} {} and {high} {}", show(self.low), show(self.high))
    }
}

/// Formats a number for messages.
pub(super) fn show(value: f64) -> String {
    if value == 0.0 || (1e-4..1e7).contains(&value.abs()) {
        // Six decimals are enough for any case file and hide the rounding errors of derived values.
        format!("{}", (value * 1e6).round() / 1e6)
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_for_a_number_names_file_path_value_and_range() {
        let mut check = Checker::new("x.json");
        assert!(check.number("a", 0.5, above(0.0).up_to(0.5), "m", ""));
        assert!(!check.number("domain.dp_m", -0.01, above(0.0).up_to(0.5), "m", "write it in metres"));
        assert!(!check.number("b", f64::NAN, from(0.0).below(1.0), "", "write a number"));
        let text = check.into_errors().to_string();
        assert_eq!(
            text,
            "x.json: domain.dp_m = -0.01: must be > 0 and at most 0.5 m; write it in metres\n\
             x.json: b = NaN: must be at least 0 and < 1; write a number"
        );
    }
}
