//! Errors in case files and their messages.

use std::fmt;

/// One error in a case file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {reason}")]
    Read {
        /// The case file.
        file: String,
        /// Message of the operating system.
        reason: String,
    },
    /// The file is not valid JSON.
    #[error("{file}: line {line}, column {column}: not valid JSON: {problem}")]
    Syntax {
        /// The case file.
        file: String,
        /// Line number, counted from 1.
        line: usize,
        /// Column number, counted from 1.
        column: usize,
        /// Message of the parser.
        problem: String,
    },
    /// A key is unknown, missing or written twice, or its value has the wrong type.
    #[error("{file}: {path} (line {line}): {problem}; {advice}")]
    Key {
        /// The case file.
        file: String,
        /// JSON path of the object or value with the error.
        path: String,
        /// Line number, counted from 1.
        line: usize,
        /// Description of the error.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// A value has the right type but is not allowed.
    #[error("{file}: {path} = {value}: must be {allowed}; {advice}")]
    Invalid {
        /// The case file.
        file: String,
        /// JSON path of the value.
        path: String,
        /// The value in the file, or a value derived from it.
        value: String,
        /// Allowed values with their unit; completes the phrase "must be ...".
        allowed: String,
        /// What to do.
        advice: String,
    },
}

/// All errors in a case file. The list is never empty.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseErrors {
    /// The errors, in the order of validation.
    pub errors: Vec<CaseError>,
}

impl fmt::Display for CaseErrors {
    /// Writes one error per line.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.errors.iter().enumerate() {
            if index > 0 {
                writeln!(out)?;
            }
            write!(out, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for CaseErrors {}

impl From<CaseError> for CaseErrors {
    fn from(error: CaseError) -> Self {
        Self { errors: vec![error] }
    }
}

/// Returns the candidate with the smallest edit distance to `word`; `None` if the distance is too large for a typing
/// error.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // No key has more than 64 letters, and the search would be slow for long words.
    if word.len() > 64 {
        return None;
    }
    let largest_distance = |candidate: &str| 2.max(candidate.len().max(word.len()) / 2);
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= largest_distance(candidate))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Returns true if `word` equals `key` or differs from it by at most two letters.
pub fn is_misspelt(word: &str, key: &str) -> bool {
    word.len().abs_diff(key.len()) <= 2 && edit_distance(word, key) <= 2
}

/// Returns the Levenshtein distance: the number of insertions, deletions and replacements that turn `a` into `b`.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter_a) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, letter_b) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter_a != *letter_b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_key_finds_the_nearest_key() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(nearest("dp", ["x_m", "dp_m", "width_m"]), Some("dp_m"));
        assert_eq!(nearest("hight_m", ["height_m", "mass_kg"]), Some("height_m"));
        assert_eq!(nearest("zzzzzzzzzz", ["height_m", "mass_kg"]), None);
    }
}
