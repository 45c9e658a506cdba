//! Errors of writing or reading the files of a run.

use std::io::ErrorKind;
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
    #[error("{}: HDF5: {}", path.display(), reason(source))]
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
    /// Returns true if the file cannot be written because the disk or the quota of the user is full.
    pub fn is_full_disk(&self) -> bool {
        match self {
            Self::Io { source, .. } => matches!(source.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded),
            Self::Hdf5 { source, .. } => {
                let reason = reason(source);
                ["No space left on device", "Disk quota exceeded"].iter().any(|words| reason.contains(words))
            }
            _ => false,
        }
    }

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

/// Returns the message of the operating system in an HDF5 error if there is one, or else the whole error in one line.
fn reason(error: &hdf5_metno::Error) -> String {
    let text = error.to_string();
    let message = text.split_once("error message = '").and_then(|(_, rest)| rest.split_once('\''));
    message.map_or_else(|| text.replace('\n', " "), |(message, _)| message.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_recognised_and_its_message_is_short() {
        let text = "H5Dwrite(): can't write data: file write failed: time = Wed Nov 25 23:17:19\n, filename = 'a.h5', \
                    errno = 28, error message = 'No space left on device', buf = 0x7f20, offset = 0";
        let full = OutputError::hdf5(Path::new("a.h5"))(text.into());
        assert_eq!(full.to_string(), "a.h5: HDF5: No space left on device");
        let damaged = OutputError::hdf5(Path::new("a.h5"))("H5Fopen(): bad\nsignature".into());
        assert_eq!(damaged.to_string(), "a.h5: HDF5: H5Fopen(): bad signature");
        let table = OutputError::io(Path::new("a.csv"))(ErrorKind::StorageFull.into());
        assert_eq!([full, damaged, table].map(|error| error.is_full_disk()), [true, false, true]);
    }
}
