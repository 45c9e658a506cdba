//! Reads the measured data next to the crate.

use std::{fs, path::Path};

/// Returns the rows of numbers of a file in `../shared/data`, without headings and citations. Without the file it
/// prints "skipped" and returns `None`.
pub fn rows(name: &str) -> Option<Vec<Vec<f64>>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    let Ok(bytes) = fs::read(&path) else {
        println!("skipped: the data file {} is missing", path.display());
        return None;
    };
    // Citations are not all in UTF-8.
    let text = String::from_utf8_lossy(&bytes);
    let rows: Vec<Vec<f64>> = text.lines().filter_map(numbers).collect();
    assert!(!rows.is_empty(), "{}: the file contains no numbers", path.display());
    Some(rows)
}

/// Returns the rows that have exactly `N` numbers.
pub fn rows_of<const N: usize>(name: &str) -> Option<Vec<[f64; N]>> {
    let rows: Vec<[f64; N]> = rows(name)?.into_iter().filter_map(|row| row.try_into().ok()).collect();
    assert!(rows.len() > 2, "{name}: only {} rows have {N} numbers", rows.len());
    Some(rows)
}

/// Returns the numbers of a line that consists of at least two numbers and nothing else.
fn numbers(line: &str) -> Option<Vec<f64>> {
    let fields = line.split(|c: char| c.is_whitespace() || c == ',').filter(|field| !field.is_empty());
    let numbers: Vec<f64> = fields.map(str::parse).collect::<Result<_, _>>().ok()?;
    (numbers.len() > 1).then_some(numbers)
}

#[test]
fn only_rows_of_numbers_are_read() {
    assert_eq!(numbers("0.5, 1e-3"), Some(vec![0.5, 1e-3]));
    assert_eq!(numbers("  1\t2  3"), Some(vec![1.0, 2.0, 3.0]));
    assert_eq!(numbers("time_s,tip_m"), None);
    assert_eq!(numbers("1996"), None);
}
