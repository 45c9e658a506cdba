//! What can be wrong with a case file, and how it is told to the user.

use std::fmt;

/// One thing that is wrong with a case file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {reason}")]
    Read {
        /// The case file.
        file: String,
        /// What the operating system says.
        reason: String,
    },
    /// The file is not JSON.
    #[error("{file}: line {line}, column {column}: not valid JSON: {problem}")]
    Syntax {
        /// The case file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the parser says.
        problem: String,
    },
    /// A key is unknown or missing, or its value is of the wrong type.
    #[error("{file}: {path} (line {line}): {problem}; {advice}")]
    Key {
        /// The case file.
        file: String,
        /// JSON path of the object or value.
        path: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
        /// What to do.
        advice: String,
    },
    /// A value has the right type and makes no sense.
    #[error("{file}: {path} = {value}: must be {allowed}; {advice}")]
    Invalid {
        /// The case file.
        file: String,
        /// JSON path of the value.
        path: String,
        /// The value as written or as derived.
        value: String,
        /// What is allowed, with its unit; completes "must be".
        allowed: String,
        /// What to do.
        advice: String,
    },
}

/// Everything that is wrong with a case file; never empty.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseErrors {
    /// In the order of the file.
    pub errors: Vec<CaseError>,
}

impl fmt::Display for CaseErrors {
    /// One error a line.
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

/// The candidate nearest to `word` by edit distance, if it is near enough to be a slip of the keyboard.
pub(super) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A word longer than any key is no slip, and would cost a long table.
    if word.len() > 64 {
        return None;
    }
    let near = |candidate: &str| 2.max(candidate.len().max(word.len()) / 2);
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= near(candidate))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Levenshtein's distance: insertions, deletions and replacements that turn `a` into `b`.
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
    fn a_slip_of_the_keyboard_finds_its_key() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(nearest("dp", ["x_m", "dp_m", "width_m"]), Some("dp_m"));
        assert_eq!(nearest("hight_m", ["height_m", "mass_kg"]), Some("height_m"));
        assert_eq!(nearest("zzzzzzzzzz", ["height_m", "mass_kg"]), None);
    }
}
