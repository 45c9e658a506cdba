//! Measurements beside the crate, read in place.

use std::{fs, path::Path};

/// Rows of numbers in a file of `../shared/data`, what stands between them (headings, citations) left out; `None`, said
/// in the test's output, where the data do not lie beside the crate.
pub fn rows(name: &str) -> Option<Vec<Vec<f64>>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    let Ok(bytes) = fs::read(&path) else {
        println!("skipped: no data at {}", path.display());
        return None;
    };
    // Citations are not all in UTF-8.
    let text = String::from_utf8_lossy(&bytes);
    let rows: Vec<Vec<f64>> = text.lines().filter_map(numbers).collect();
    assert!(!rows.is_empty(), "{}: no numbers in it", path.display());
    Some(rows)
}

/// The same where every row has `N` numbers; rows with another number of them are left out.
pub fn rows_of<const N: usize>(name: &str) -> Option<Vec<[f64; N]>> {
    let rows: Vec<[f64; N]> = rows(name)?.into_iter().filter_map(|row| row.try_into().ok()).collect();
    assert!(rows.len() > 2, "{name}: only {} rows understood", rows.len());
    Some(rows)
}

/// Numbers of a line, if there are two or more and nothing else.
fn numbers(line: &str) -> Option<Vec<f64>> {
    let fields = line.split(|c: char| c.is_whitespace() || c == ',').filter(|field| !field.is_empty());
    let numbers: Vec<f64> = fields.map(str::parse).collect::<Result<_, _>>().ok()?;
    (numbers.len() > 1).then_some(numbers)
}

#[test]
fn only_rows_of_numbers_are_taken() {
    assert_eq!(numbers("0.5, 1e-3"), Some(vec![0.5, 1e-3]));
    assert_eq!(numbers("  1\t2  3"), Some(vec![1.0, 2.0, 3.0]));
    assert_eq!(numbers("time_s,tip_m"), None);
    assert_eq!(numbers("1996"), None);
}
