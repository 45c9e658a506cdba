//! Atomic writing of files: a reader never finds a partly written file.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use super::OutputError;

/// Writes `bytes` to `path` atomically: to a temporary file in the same folder, synced to disk, then renamed. Even if
/// the run is killed, readers find the complete old or the complete new file.
///
/// # Errors
/// If the file cannot be written. The old file is then unchanged.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let temporary = path.with_file_name(name);
    let write = || -> std::io::Result<()> {
        let mut file = File::create(&temporary)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&temporary, path)
    };
    // On a full disk, an incomplete file would take the space of other files.
    write().map_err(OutputError::io(path)).inspect_err(|_| drop(fs::remove_file(&temporary)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writing_replaces_the_file_and_leaves_no_temporary_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.bin");
        write_atomically(&path, b"first").unwrap();
        write_atomically(&path, b"second, longer").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second, longer");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn an_error_names_the_file_that_cannot_be_written() {
        let error = write_atomically(Path::new("/nowhere/at/all.json"), b"x").unwrap_err();
        assert!(error.to_string().starts_with("/nowhere/at/all.json: "), "{error}");
    }
}
