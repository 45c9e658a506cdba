//! Measurements: short tables in the repository, and the full series if the folder `../shared/data` exists.

use std::ffi::c_int;
use std::io::{Write, stdout};
use std::{fs, path::Path, sync::Mutex};

/// Folder of the full series, relative to the repository.
const FULL_SERIES: &str = "../shared/data";

/// Returns the rows of numbers of a table in `tests/validation/measured`.
pub fn table(name: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/validation/measured").join(name);
    read(&path).unwrap_or_else(|| panic!("{}: cannot read this table", path.display()))
}

/// Returns the rows of a table that has `N` columns.
pub fn table_of<const N: usize>(name: &str) -> Vec<[f64; N]> {
    let whole = |row: Vec<f64>| row.try_into().unwrap_or_else(|row| panic!("{name}: {row:?} needs {N} numbers"));
    table(name).into_iter().map(whole).collect()
}

/// Returns the rows of numbers of a file in `../shared/data`. The error names the missing folder or file.
pub fn series(name: &str) -> Result<Vec<Vec<f64>>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(FULL_SERIES);
    if !folder.is_dir() {
        return Err(format!("no {FULL_SERIES} next to the repository"));
    }
    read(&folder.join(name)).ok_or_else(|| format!("no {name} in {FULL_SERIES}"))
}

/// Returns the rows of a file in `../shared/data` that have exactly `N` numbers.
pub fn series_of<const N: usize>(name: &str) -> Result<Vec<[f64; N]>, String> {
    let rows: Vec<[f64; N]> = series(name)?.into_iter().filter_map(|row| row.try_into().ok()).collect();
    assert!(rows.len() > 2, "{name}: only {} rows have {N} numbers", rows.len());
    Ok(rows)
}

/// Returns the measurements to compare with, each with its name: always the table, and the full series if it exists.
/// A missing full series is counted and reported at the end of the test run.
pub fn table_and_series<T>(table: T, series: Result<T, String>) -> Vec<(&'static str, T)> {
    let mut measurements = vec![("table", table)];
    measurements.extend(series_or_left_out(series).map(|series| ("full series", series)));
    measurements
}

/// Returns the full series for a test without a table. A missing series is counted and reported at the end of the run.
pub fn series_or_left_out<T>(series: Result<T, String>) -> Option<T> {
    series.map_err(leave_out).ok()
}

/// Reasons why comparisons with full series were left out, one per comparison.
static LEFT_OUT: Mutex<Vec<String>> = Mutex::new(Vec::new());

unsafe extern "C" {
    /// Registers a function that runs when the program ends (C standard library).
    safe fn atexit(at_end: extern "C" fn()) -> c_int;
}

fn leave_out(reason: String) {
    let mut left_out = LEFT_OUT.lock().unwrap();
    if left_out.is_empty() {
        assert_eq!(atexit(report_left_out), 0);
    }
    left_out.push(reason);
}

/// Prints the number of left-out comparisons after the last test, when the test harness no longer captures output.
extern "C" fn report_left_out() {
    let Ok(left_out) = LEFT_OUT.lock() else { return };
    let count = match left_out.len() {
        1 => "1 comparison".to_owned(),
        count => format!("{count} comparisons"),
    };
    let mut reasons = left_out.clone();
    reasons.sort();
    reasons.dedup();
    let line = format!("*** {count} with full series left out: {} ***", reasons.join("; "));
    // This function must not panic, so the error of a closed output is ignored.
    let _ = writeln!(stdout(), "{line}\n");
}

/// Returns the rows of numbers of a file, without headings and citations; `None` if it cannot be read.
fn read(path: &Path) -> Option<Vec<Vec<f64>>> {
    let bytes = fs::read(path).ok()?;
    // Some citations are not valid UTF-8.
    let text = String::from_utf8_lossy(&bytes);
    let rows: Vec<Vec<f64>> = text.lines().filter_map(numbers).collect();
    assert!(!rows.is_empty(), "{}: the file contains no numbers", path.display());
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
    assert_eq!(numbers("# 1, 2"), None);
    assert_eq!(numbers("1996"), None);
}
