//! Errors of writing or reading the files of a run.

use std::path::{Path, PathBuf};

use crate::sph::solver::backend::DeviceError;

/// A file of a run folder cannot be written or read, or is invalid.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The data for an output file cannot be copied from the graphics card.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// An input or output operation of the operating system failed.
    #[error("{}: {source}", path.display())]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// An HDF5 operation failed.
    #[error("{}: HDF5: {source}", path.display())]
    Hdf5 {
        /// Path of the file.
        path: PathBuf,
        /// Error of the HDF5 library.
        source: hdf5_metno::Error,
    },
    /// A JSON file is invalid.
    #[error("{}: {source}", path.display())]
    Json {
        /// Path of the file.
        path: PathBuf,
        /// Error of the JSON library, with line and column.
        source: serde_json::Error,
    },
    /// The content of a file is invalid.
    #[error("{}: {what}", path.display())]
    Content {
        /// Path of the file.
        path: PathBuf,
        /// Description of the error, and of what is required.
        what: String,
    },
    /// The run does not match the measurements with which it is compared.
    #[error("{}: {what}", path.display())]
    NoReference {
        /// Path of the summary of the run.
        path: PathBuf,
        /// Description of what does not match, and of what is required.
        what: String,
    },
}

impl OutputError {
    /// Wraps an input or output error of the file at `path`, for use with `map_err`.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    /// Wraps an HDF5 error of the file at `path`, for use with `map_err`.
    pub(crate) fn hdf5(path: &Path) -> impl FnOnce(hdf5_metno::Error) -> Self + '_ {
        move |source| Self::Hdf5 { path: path.to_owned(), source }
    }

    /// Wraps a JSON error of the file at `path`, for use with `map_err`.
    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self + '_ {
        move |source| Self::Json { path: path.to_owned(), source }
    }

    /// Creates an error for invalid content of the file at `path`.
    pub(crate) fn content(path: &Path, what: impl Into<String>) -> Self {
        Self::Content { path: path.to_owned(), what: what.into() }
    }
}
