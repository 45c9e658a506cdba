//! A text file of numbers, whose lines can be named when they are wrong.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::ExternalError;

/// A text file in memory.
pub(super) struct TextFile {
    path: PathBuf,
    text: String,
}

impl TextFile {
    /// Read the file; `advice` tells what to do if that fails.
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

    /// Where the file lies.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The lines that are not blank, with their numbers from 1.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(index, text)| (index + 1, text.trim())).filter(|(_, text)| !text.is_empty())
    }

    /// The number that a word of a line stands for.
    pub(super) fn number(&self, line: usize, word: &str) -> Result<f64, ExternalError> {
        let advice = if word.contains('*') {
            "the column was too narrow for its number when it was written; write the table without header"
        } else {
            "correct or delete the line"
        };
        word.parse().map_err(|_| self.wrong(line, format!("`{word}` is not a number"), advice))
    }

    /// The numbers of a line, in which round brackets only separate.
    pub(super) fn numbers(&self, line: usize, text: &str) -> Result<Vec<f64>, ExternalError> {
        let words = text.split(|c: char| c.is_whitespace() || c == '(' || c == ')').filter(|word| !word.is_empty());
        words.map(|word| self.number(line, word)).collect()
    }

    /// An error in a line.
    pub(super) fn wrong(&self, line: usize, problem: impl Into<String>, advice: impl Into<String>) -> ExternalError {
        ExternalError::Line { file: self.path.clone(), line, problem: problem.into(), advice: advice.into() }
    }
}
