//! Errors when files of a run are written or read.

use std::path::{Path, PathBuf};

use crate::sph::backend::DeviceError;

/// A file of a run folder cannot be written or read, or is invalid.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The data to be written cannot be read from the device.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// An input or output operation failed.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// An HDF5 operation failed.
    #[error("{}: HDF5: {source}", path.display())]
    Hdf5 {
        /// The file.
        path: PathBuf,
        /// Error of the HDF5 library.
        source: hdf5_metno::Error,
    },
    /// A JSON file is invalid.
    #[error("{}: {source}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
    /// The content of a file is invalid.
    #[error("{}: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what is needed.
        what: String,
    },
    /// The run does not match the published experiment for the comparison.
    #[error("{}: {what}", path.display())]
    NoReference {
        /// The run's summary.
        path: PathBuf,
        /// What does not match, and what is needed.
        what: String,
    },
}

impl OutputError {
    /// Wraps an input or output error of the file at `path`, for `map_err`.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    /// Wraps an HDF5 error of the file at `path`, for `map_err`.
    pub(crate) fn hdf5(path: &Path) -> impl FnOnce(hdf5_metno::Error) -> Self + '_ {
        move |source| Self::Hdf5 { path: path.to_owned(), source }
    }

    /// Wraps a JSON error of the file at `path`, for `map_err`.
    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self + '_ {
        move |source| Self::Json { path: path.to_owned(), source }
    }

    /// Creates an error for invalid content of the file at `path`.
    pub(crate) fn content(path: &Path, what: impl Into<String>) -> Self {
        Self::Content { path: path.to_owned(), what: what.into() }
    }
}
