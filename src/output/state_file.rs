//! HDF5 files with the exact state of a run, written atomically. A checksum follows the HDF5 data.

use std::path::Path;

use glam::DVec3;
use hdf5_metno::{File, Group, H5Type, types::VarLenUnicode};

use super::OutputError;
use super::checksum::{append_checksum, has_valid_checksum};

/// Result of the HDF5 library.
pub(crate) type Hdf5Result<T> = hdf5_metno::Result<T>;

/// Name of the HDF5 attribute for the text with all data of the state that are not arrays.
const TEXT: &str = "state";

/// Writes `text` and the datasets that `fill` creates to a temporary file, appends a checksum, syncs this file, and
/// renames it to `path`. The old file remains until the new file is complete.
///
/// # Errors
/// If the file cannot be written.
pub(crate) fn write_state(
    path: &Path,
    text: &str,
    fill: impl FnOnce(&File) -> Hdf5Result<()>,
) -> Result<(), OutputError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let temporary = path.with_file_name(name);
    let write = || -> Hdf5Result<()> {
        let file = File::create(&temporary)?;
        let text: VarLenUnicode =
            text.parse().map_err(|_| hdf5_metno::Error::from("the state contains a NUL character"))?;
        file.new_attr::<VarLenUnicode>().create(TEXT)?.write_scalar(&text)?;
        fill(&file)?;
        file.close()
    };
    let publish = || {
        append_checksum(&temporary)?;
        std::fs::rename(&temporary, path)
    };
    let written = write().map_err(OutputError::hdf5(path)).and_then(|()| publish().map_err(OutputError::io(path)));
    // On a full disk, an incomplete file would take the space of other files.
    written.inspect_err(|_| drop(std::fs::remove_file(&temporary)))
}

/// Opens a file of [`write_state`]; returns its text and the result of `read`. Refuses a file that has changed since it
/// was written: the HDF5 library would read many damaged files without an error, and crash on some.
///
/// # Errors
/// If the file is missing or invalid, or its checksum is wrong.
pub(crate) fn read_state<T>(
    path: &Path,
    read: impl FnOnce(&File) -> Hdf5Result<T>,
) -> Result<(String, T), OutputError> {
    if !has_valid_checksum(path).map_err(OutputError::io(path))? {
        return Err(OutputError::content(path, DAMAGED));
    }
    let open = || -> Hdf5Result<(String, T)> {
        let file = File::open(path)?;
        let text = file.attr(TEXT)?.read_scalar::<VarLenUnicode>()?;
        Ok((text.to_string(), read(&file)?))
    };
    open().map_err(OutputError::hdf5(path))
}

/// Message for a file whose checksum is wrong or missing.
pub(crate) const DAMAGED: &str =
    "is damaged or incomplete, or was written by another version of breakwater (wrong checksum); rerun the case";

/// Writes a dataset of one column.
pub(crate) fn write_column<T: H5Type>(group: &Group, name: &str, values: &[T]) -> Hdf5Result<()> {
    group.new_dataset::<T>().shape(values.len()).create(name)?.write_raw(values)
}

/// Writes a dataset of `N` columns with one row per entry of `rows`.
pub(crate) fn write_rows<T: H5Type, const N: usize>(group: &Group, name: &str, rows: &[[T; N]]) -> Hdf5Result<()> {
    group.new_dataset::<T>().shape((rows.len(), N)).create(name)?.write_raw(rows.as_flattened())
}

/// Writes a dataset of three columns with one row per vector.
pub(crate) fn write_vectors(group: &Group, name: &str, values: &[DVec3]) -> Hdf5Result<()> {
    let rows: Vec<[f64; 3]> = values.iter().map(|v| v.to_array()).collect();
    write_rows(group, name, &rows)
}

/// Reads rows written by [`write_rows`].
pub(crate) fn read_rows<T: H5Type + Copy, const N: usize>(group: &Group, name: &str) -> Hdf5Result<Vec<[T; N]>> {
    let flat: Vec<T> = group.dataset(name)?.read_raw()?;
    Ok(flat.as_chunks::<N>().0.to_vec())
}

/// Reads vectors written by [`write_vectors`].
pub(crate) fn read_vectors(group: &Group, name: &str) -> Hdf5Result<Vec<DVec3>> {
    Ok(read_rows(group, name)?.into_iter().map(DVec3::from_array).collect())
}
