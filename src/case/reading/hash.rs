//! Fingerprint (hash) of a case, independent of the layout of its file.

use serde::Serialize;

use super::parse::RENAMED_KEYS;

/// Returns the hash FNV-1a (128 bits) of a case as 32 hexadecimal digits. The input of the hash is the parsed case
/// `file` with its defaults, without the key `$schema`, and `read`, the content of the files that the case refers to.
/// White space and key order in the case file do not matter.
pub fn fingerprint(file: &impl Serialize, read: &[u8]) -> String {
    // The structs fix the order of the keys. Serializing to a string cannot fail: every key is a string.
    let canonical = serde_json::to_string(file).unwrap_or_default();
    // Renamed keys are hashed under their old names, so that the hash of old runs stays valid and they can resume. The
    // replacement changes no values, because quotes in values are escaped.
    let canonical = RENAMED_KEYS
        .iter()
        .fold(canonical, |text, (old, new)| text.replace(&format!("\"{new}\":"), &format!("\"{old}\":")));
    format!("{:032x}", fnv1a_128(canonical.as_bytes().iter().chain(read)))
}

/// Computes FNV-1a with 128 bits (Fowler, Noll, Vo; draft-eastlake-fnv).
fn fnv1a_128<'a>(bytes: impl IntoIterator<Item = &'a u8>) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.into_iter().fold(OFFSET, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fnv_1a_matches_published_test_vectors() {
        assert_eq!(fnv1a_128(b""), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(fnv1a_128(b"a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    }
}
