//! Errors in files of other programs.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::numbers::as_text;

/// An error in a file of another program: where it is, what is wrong, and what to do.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExternalError {
    /// The file or folder cannot be read.
    #[error("{file}: cannot be read: {reason}; {advice}")]
    Read {
        /// The file or folder.
        file: PathBuf,
        /// Message of the operating system.
        reason: String,
        /// What to do.
        advice: String,
    },
    /// A line is wrong.
    #[error("{file}: line {line}: {problem}; {advice}")]
    Line {
        /// The file.
        file: PathBuf,
        /// Line number, from 1.
        line: usize,
        /// The problem.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The file as a whole cannot be used.
    #[error("{file}: {problem}; {advice}")]
    File {
        /// The file or folder.
        file: PathBuf,
        /// The problem.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The values at one time are implausible.
    #[error("{file}: at t = {} s: {problem}; {advice}", as_text(*.time_s))]
    Moment {
        /// The file, or the folder of files that were joined.
        file: PathBuf,
        /// Time in the file [s].
        time_s: f64,
        /// The problem.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The file has too few levels with velocities.
    #[error(
        "{file}: at t = {} s: {layers} level(s) in the water with a velocity; at least 2 are needed; \
         sample more levels",
        as_text(*.time_s)
    )]
    TooFewLayers {
        /// The file, or the folder of files that were joined.
        file: PathBuf,
        /// Time in the file [s].
        time_s: f64,
        /// Number of levels with a velocity.
        layers: usize,
    },
}

impl ExternalError {
    pub(super) fn file(file: &Path, problem: impl Into<String>, advice: impl Into<String>) -> Self {
        Self::File { file: file.to_owned(), problem: problem.into(), advice: advice.into() }
    }

    pub(super) fn moment(file: &Path, time_s: f64, problem: impl Into<String>, advice: impl Into<String>) -> Self {
        Self::Moment { file: file.to_owned(), time_s, problem: problem.into(), advice: advice.into() }
    }
}
