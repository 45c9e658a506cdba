//! What can be wrong with a file of another program, and how it is told to the user.

use std::path::{Path, PathBuf};

use thiserror::Error;

/// One thing that is wrong with a file of another program: where, what, and what to do.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExternalError {
    /// The file or folder cannot be read.
    #[error("{file}: cannot be read: {reason}; {advice}")]
    Read {
        /// The file or folder.
        file: PathBuf,
        /// What the operating system says.
        reason: String,
        /// What to do.
        advice: String,
    },
    /// A line is not as it should be.
    #[error("{file}: line {line}: {problem}; {advice}")]
    Line {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The file as a whole cannot be used.
    #[error("{file}: {problem}; {advice}")]
    File {
        /// The file or folder.
        file: PathBuf,
        /// What is wrong.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The values of a moment make no sense.
    #[error("{file}: at t = {time_s} s: {problem}; {advice}")]
    Moment {
        /// The file, or the folder of files that were joined.
        file: PathBuf,
        /// Time in the file [s].
        time_s: f64,
        /// What is wrong.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// The file tells too little of how the velocity varies over the height.
    #[error(
        "{file}: at t = {time_s} s: velocities at {layers} levels in the water, at least 2 are needed; \
         sample more levels, or allow a velocity averaged over the depth"
    )]
    TooFewLayers {
        /// The file, or the folder of files that were joined.
        file: PathBuf,
        /// Time in the file [s].
        time_s: f64,
        /// How many levels there are.
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
