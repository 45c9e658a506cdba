//! A text file of numbers; errors give the line number.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::ExternalError;

/// A text file in memory.
pub(super) struct TextFile {
    path: PathBuf,
    text: String,
}

impl TextFile {
    /// Reads the file; `advice` tells the user what to do if the file cannot be read.
    pub(super) fn read(path: &Path, advice: &str) -> Result<Self, ExternalError> {
        match fs::read_to_string(path) {
            Ok(text) => Ok(Self { path: path.to_owned(), text }),
            Err(reason) => Err(ExternalError::Read {
                file: path.to_owned(),
                reason: reason.to_string(),
                advice: advice.to_owned(),
            }),
        }
    }

    /// Path of the file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Non-blank lines with their numbers, from 1.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(index, text)| (index + 1, text.trim())).filter(|(_, text)| !text.is_empty())
    }

    /// Parses a word of a line as a number.
    pub(super) fn number(&self, line: usize, word: &str) -> Result<f64, ExternalError> {
        let advice = if word.contains('*') {
            "asterisks replace a number that is too wide for its column; write the table without header"
        } else {
            "correct or delete the line"
        };
        word.parse().map_err(|_| self.line_error(line, format!("`{word}` is not a number"), advice))
    }

    /// Parses the numbers of a line; blanks and round brackets separate the numbers.
    pub(super) fn numbers(&self, line: usize, text: &str) -> Result<Vec<f64>, ExternalError> {
        let words = text.split(|c: char| c.is_whitespace() || c == '(' || c == ')').filter(|word| !word.is_empty());
        words.map(|word| self.number(line, word)).collect()
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
