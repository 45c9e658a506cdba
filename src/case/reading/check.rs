//! Collects the errors and warnings of a case file, so that the user sees all of them at once.

use super::error::{CaseError, CaseErrors};

/// Errors and warnings found so far in one case file.
#[derive(Debug)]
pub struct Checker {
    file: String,
    errors: Vec<CaseError>,
    pub warnings: Vec<String>,
}

impl Checker {
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), errors: Vec::new(), warnings: Vec::new() }
    }

    /// Returns the number of errors so far. A section is valid if its validation does not increase this number.
    pub fn count(&self) -> usize {
        self.errors.len()
    }

    /// Adds an error with the message "`path` = `value`: must be `allowed`; `advice`".
    pub fn reject(&mut self, path: &str, value: impl ToString, allowed: impl Into<String>, advice: impl Into<String>) {
        self.errors.push(CaseError::Invalid {
            file: self.file.clone(),
            path: path.to_owned(),
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
        self.warnings.push(warning.into());
    }

    /// Returns the collected errors.
    pub fn into_errors(self) -> CaseErrors {
        CaseErrors { errors: self.errors }
    }
}

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
        let low = if self.low_open { value > self.low } else { value >= self.low };
        let high = if self.high_open { value < self.high } else { value <= self.high };
        low && high
    }

    fn text(self) -> String {
        let low = if self.low_open { ">" } else { "at least" };
        let high = if self.high_open { "<" } else { "at most" };
        format!("{low} {} and {high} {}", rounded_limit(self.low, true), rounded_limit(self.high, false))
    }
}

/// Formats a limit for messages, rounded into the allowed range: upwards or downwards.
fn rounded_limit(limit: f64, upwards: bool) -> String {
    let text = as_text(limit);
    let shown: f64 = text.parse().unwrap_or(limit);
    if shown == limit || (shown > limit) == upwards {
        return text;
    }
    // Move the last digit of the text by one.
    let decimals = text.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    let step = 10_f64.powi(-decimals);
    if text.contains('e') { limit.to_string() } else { as_text(if upwards { shown + step } else { shown - step }) }
}

/// Formats a number for messages, with at most six significant digits and six decimals. Integers keep all digits.
pub fn as_text(value: f64) -> String {
    if value == 0.0 || (1e-4..1e7).contains(&value.abs()) {
        // Six decimals are enough for any case file and hide the rounding errors of derived values.
        let decimals = 5 - value.abs().max(0.1).log10().floor() as i32;
        let shift = 10_f64.powi(decimals.max(0));
        format!("{}", (value * shift).round() / shift)
    } else {
        // Rounding to six digits; the second conversion removes trailing zeros.
        let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
        format!("{rounded:e}")
    }
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
