//! Checksums, which tell whether a file is exactly as it was written.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Marks the checksum at the end of a file.
const MARK: &[u8; 8] = b"CHECKSUM";

/// Length of the mark and the checksum at the end of a file [bytes].
const LENGTH: u64 = 16;

/// Returns a checksum of 64 bits. It is the hash FNV-1a (Fowler, Noll, Vo) over words of eight bytes, with a rotation
/// that carries the highest bit of a word to the other bits.
///
/// # Errors
/// If the bytes cannot be read.
pub(crate) fn checksum(mut bytes: impl Read) -> io::Result<u64> {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    let (mut sum, mut chunk) = (OFFSET, Vec::new());
    loop {
        chunk.clear();
        bytes.by_ref().take(1 << 20).read_to_end(&mut chunk)?;
        if chunk.is_empty() {
            return Ok(sum);
        }
        for part in chunk.chunks(8) {
            let mut word = [0; 8];
            word[..part.len()].copy_from_slice(part);
            sum = (sum ^ u64::from_le_bytes(word)).wrapping_mul(PRIME).rotate_left(29);
        }
    }
}

/// Appends the checksum of a file to the file, and syncs the file to disk.
///
/// # Errors
/// If the file cannot be read or written.
pub(crate) fn append_checksum(path: &Path) -> io::Result<()> {
    let mut file = OpenOptions::new().read(true).append(true).open(path)?;
    let sum = checksum(&mut file)?;
    file.write_all(&[*MARK, sum.to_le_bytes()].concat())?;
    file.sync_all()
}

/// Returns true if the file ends with the checksum of the bytes before it.
///
/// # Errors
/// If the file cannot be read.
pub(crate) fn has_valid_checksum(path: &Path) -> io::Result<bool> {
    let mut file = File::open(path)?;
    let Some(length) = file.metadata()?.len().checked_sub(LENGTH) else { return Ok(false) };
    let sum = checksum((&file).take(length))?;
    file.seek(SeekFrom::Start(length))?;
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    Ok(end == [*MARK, sum.to_le_bytes()].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_changed_or_missing_byte_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state.h5");
        let content: Vec<u8> = (0..100).map(|byte| byte % 7).collect();
        std::fs::write(&path, &content).unwrap();
        assert!(!has_valid_checksum(&path).unwrap(), "a file without a checksum was accepted");
        append_checksum(&path).unwrap();
        assert!(has_valid_checksum(&path).unwrap());
        let whole = std::fs::read(&path).unwrap();
        assert_eq!(whole[..100], content);
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 0x80;
            std::fs::write(&path, &damaged).unwrap();
            assert!(!has_valid_checksum(&path).unwrap(), "byte {at} was changed");
            std::fs::write(&path, &whole[..at]).unwrap();
            assert!(!has_valid_checksum(&path).unwrap(), "the file was cut at byte {at}");
        }
    }
}
