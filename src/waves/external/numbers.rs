//! Numbers in the text of files and messages.

/// Formats a number for messages, with six significant digits.
pub(super) fn as_text(value: f64) -> String {
    // Files have single precision or fewer digits; more digits would only show rounding errors.
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) {
        // Adding zero turns -0 into 0.
        format!("{}", rounded + 0.0)
    } else {
        format!("{rounded:e}")
    }
}

/// Parses a number. It may have a Fortran exponent, as in `1.5D-3`, or a decimal comma.
pub(super) fn parse(word: &str) -> Option<f64> {
    if !word.starts_with(|c: char| c.is_ascii_digit() || "+-.,".contains(c)) {
        return word.parse().ok();
    }
    let text = word.replace(['D', 'd'], "e");
    if text.matches(',').count() == 1 && !text.contains('.') {
        return text.replace(',', ".").parse().ok();
    }
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_has_six_significant_digits() {
        let texts = [-0.270_000_011_253_514_97, -0.080_000_000_000_000_02, 0.1 + 0.2, 1234.5678, -0.0].map(as_text);
        assert_eq!(texts, ["-0.27", "-0.08", "0.3", "1234.57", "0"]);
        assert_eq!([-1e300, 1.234_567_8e-7, f64::NAN].map(as_text), ["-1e300", "1.23457e-7", "NaN"]);
    }

    #[test]
    fn numbers_of_fortran_and_of_spreadsheets_are_read() {
        for (word, value) in
            [("1.0D-3", 0.001), ("-2d1", -20.0), ("0,05", 0.05), ("-,5", -0.5), ("1,5E+02", 150.0), ("+3", 3.0)]
        {
            assert_eq!(parse(word), Some(value), "{word}");
        }
        assert!(parse("NaN").is_some_and(f64::is_nan));
        for word in ["", "1,234.5", "1.234,5", "1,2,3", "0x1", "1 2", "D1", "fast"] {
            assert_eq!(parse(word), None, "{word}");
        }
    }
}
