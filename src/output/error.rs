//! What can go wrong when files of a run are written or read.

use std::path::{Path, PathBuf};

use crate::sph::solver::backend::DeviceError;

/// A file of a run folder could not be written, read or understood.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// What is to be written cannot be had from the device any more.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The HDF5 library refused.
    #[error("{}: HDF5: {source}", path.display())]
    Hdf5 {
        /// The file.
        path: PathBuf,
        /// What the library said.
        source: hdf5_metno::Error,
    },
    /// A JSON file is not what it should be.
    #[error("{}: {source}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
    /// The content of a file is not what it should be.
    #[error("{}: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what is needed.
        what: String,
    },
    /// The run does not belong to the published experiment it should be compared with.
    #[error("{}: {what}", path.display())]
    NoReference {
        /// The run's summary.
        path: PathBuf,
        /// What does not fit, and what would.
        what: String,
    },
}

impl OutputError {
    /// For `map_err`: an input or output error of the file at `path`.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    /// For `map_err`: an HDF5 error of the file at `path`.
    pub(crate) fn hdf5(path: &Path) -> impl FnOnce(hdf5_metno::Error) -> Self + '_ {
        move |source| Self::Hdf5 { path: path.to_owned(), source }
    }

    /// For `map_err`: a JSON error of the file at `path`.
    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self + '_ {
        move |source| Self::Json { path: path.to_owned(), source }
    }

    /// The content of the file at `path` is not what it should be.
    pub(crate) fn content(path: &Path, what: impl Into<String>) -> Self {
        Self::Content { path: path.to_owned(), what: what.into() }
    }
}
