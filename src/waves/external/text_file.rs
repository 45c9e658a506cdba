//! A text file of numbers; errors give the line number.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::ExternalError;
use super::numbers;

/// A text file in memory.
pub(super) struct TextFile {
    path: PathBuf,
    text: String,
}

impl TextFile {
    /// Reads the file; `advice` tells the user what to do if the file cannot be read. Bytes that are not UTF-8 may
    /// occur in names and comments, because other programs use other encodings. A byte order mark is skipped.
    pub(super) fn read(path: &Path, advice: &str) -> Result<Self, ExternalError> {
        let bytes = fs::read(path).map_err(|reason| ExternalError::Read {
            file: path.to_owned(),
            reason: reason.to_string(),
            advice: advice.to_owned(),
        })?;
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(ExternalError::file(path, "the text is UTF-16", "save the file as ASCII or UTF-8 text"));
        }
        let text = String::from_utf8_lossy(&bytes);
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
        Ok(Self { path: path.to_owned(), text })
    }

    /// Path of the file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Lines with their numbers, from 1, without lines of blanks and separators only.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        let is_blank = |text: &str| text.chars().all(|c| c.is_whitespace() || c == ';' || c == ',');
        let lines = self.text.lines().enumerate().map(|(index, text)| (index + 1, text.trim()));
        lines.filter(move |(_, text)| !is_blank(text))
    }

    /// Parses a word of a line as a number.
    pub(super) fn number(&self, line: usize, word: &str) -> Result<f64, ExternalError> {
        numbers::parse(word).ok_or_else(|| {
            let advice = if word.contains('*') {
                "asterisks replace a number that is too wide for its column; write the table without header"
            } else if word.contains(',') {
                "write decimal points, and no separators of thousands"
            } else {
                "correct or delete the line"
            };
            // A binary file may have words of any length.
            let shown: String = word.chars().take(30).flat_map(char::escape_debug).collect();
            let problem =
                if word.is_empty() { "a value is missing".to_owned() } else { format!("`{shown}` is not a number") };
            self.line_error(line, problem, advice)
        })
    }

    /// Parses words of a line as numbers; an error if some have a decimal point and others a decimal comma, because the
    /// commas may then separate thousands.
    pub(super) fn numbers(&self, line: usize, words: &[&str]) -> Result<Vec<f64>, ExternalError> {
        let first_with = |mark: char| words.iter().find(|word| word.contains(mark));
        let values: Result<Vec<f64>, _> = words.iter().map(|word| self.number(line, word)).collect();
        match first_with('.').zip(first_with(',')) {
            Some((point, comma)) if values.is_ok() => Err(self.line_error(
                line,
                format!("`{point}` has a decimal point, but `{comma}` a comma"),
                "write decimal points only",
            )),
            _ => values,
        }
    }

    /// Parses the numbers of a line; blanks and round brackets separate the numbers.
    pub(super) fn numbers_in_brackets(&self, line: usize, text: &str) -> Result<Vec<f64>, ExternalError> {
        let words = text.split(|c: char| c.is_whitespace() || c == '(' || c == ')').filter(|word| !word.is_empty());
        self.numbers(line, &words.collect::<Vec<_>>())
    }

    /// Creates an error with the file, the line number, the problem and the advice.
    pub(super) fn line_error(
        &self,
        line: usize,
        problem: impl Into<String>,
        advice: impl Into<String>,
    ) -> ExternalError {
        ExternalError::Line { file: self.path.clone(), line, problem: problem.into(), advice: advice.into() }
    }
}

/// Splits a line at each separator into words without blanks around them. Separators at the end of the line are
/// ignored.
pub(super) fn split(text: &str, separator: char) -> Vec<&str> {
    let mut words: Vec<&str> = text.split(separator).map(str::trim).collect();
    while words.last().is_some_and(|word| word.is_empty()) {
        words.pop();
    }
    words
}

/// Splits a line into words, of which `expected` should result. Semicolons separate words; without semicolons, blanks.
/// Commas separate words only if this gives the expected number and blanks do not, because commas may be decimal.
pub(super) fn words(text: &str, expected: usize) -> Vec<&str> {
    if text.contains(';') {
        return split(text, ';');
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    if words.len() != expected || words.iter().any(|word| word.ends_with(',')) {
        let by_comma = split(text, ',');
        if by_comma.len() == expected {
            return by_comma;
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_split_at_the_separator_of_the_line() {
        for (line, expected) in [
            ("0 0.1\t0.2", ["0", "0.1", "0.2"]),
            ("0,0 0,1 0,2", ["0,0", "0,1", "0,2"]),
            ("0;0,1;0,2;", ["0", "0,1", "0,2"]),
            ("0,0.1,0.2,", ["0", "0.1", "0.2"]),
            ("0, 0.1, 0.2", ["0", "0.1", "0.2"]),
        ] {
            assert_eq!(words(line, 3), expected, "{line}");
        }
        assert_eq!(words("0,05", 1), ["0,05"]);
        assert_eq!(words("0,1 0,5", 4), ["0,1", "0,5"], "commas could be decimal");
    }

    #[test]
    fn mixed_decimal_marks_and_utf_16_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "\u{feff}1.5 1,234\n").unwrap();
        let text = TextFile::read(&path, "").unwrap();
        let error = text.numbers(1, &["1.5", "1,234"]).unwrap_err().to_string();
        assert!(
            error.ends_with("a: line 1: `1.5` has a decimal point, but `1,234` a comma; write decimal points only")
        );
        assert_eq!(text.lines().next(), Some((1, "1.5 1,234")), "the byte order mark is skipped");
        std::fs::write(&path, [0xff, 0xfe, b'1', 0]).unwrap();
        let error = TextFile::read(&path, "").err().unwrap().to_string();
        assert!(error.ends_with("a: the text is UTF-16; save the file as ASCII or UTF-8 text"), "{error}");
    }
}
