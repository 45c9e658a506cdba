//! CSV files that grow during a run.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;

/// A CSV file of numbers with one header line, extended row by row.
///
/// A number is written as the shortest text that reads back to the same bits; `NaN` is an empty field. Every call that
/// appends rows passes them to the operating system, so that no rows are lost if the run is killed. A checkpoint stores
/// the length of the file [bytes]. A resumed run cuts the file at this length and then writes the same bytes as an
/// uninterrupted run.
#[derive(Debug)]
pub struct CsvSeries {
    path: PathBuf,
    file: File,
    columns: usize,
    bytes: u64,
    line: String,
}

impl CsvSeries {
    /// Creates a file with the given column names, which include the unit (`time_s`). Overwrites an existing file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create<S: AsRef<str>>(path: &Path, columns: &[S]) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io(path))?;
        let mut series =
            Self { path: path.to_owned(), file, columns: columns.len(), bytes: 0, line: String::with_capacity(256) };
        let names: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
        series.line.push_str(&names.join(","));
        series.line.push('\n');
        series.write_line()?;
        Ok(series)
    }

    /// Opens the file of an interrupted run and cuts the file to `bytes`, its length in the checkpoint [bytes].
    ///
    /// # Errors
    /// If the file cannot be opened, is shorter than `bytes`, `bytes` is not the end of a line, or the file does not have
    /// the given columns.
    pub fn open_truncated<S: AsRef<str>>(path: &Path, columns: &[S], bytes: u64) -> Result<Self, OutputError> {
        let text = std::fs::read(path).map_err(OutputError::io(path))?;
        let Some(kept) = usize::try_from(bytes).ok().and_then(|n| text.get(..n)) else {
            let what = format!("has {} bytes, fewer than the {bytes} at the checkpoint", text.len());
            return Err(OutputError::content(path, what));
        };
        let Some(header) = kept.split(|b| *b == b'\n').next().filter(|_| kept.last() == Some(&b'\n')) else {
            let what = format!("its length at the checkpoint, {bytes} bytes, is not the end of a line");
            return Err(OutputError::content(path, what));
        };
        let names: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
        if header != names.join(",").as_bytes() {
            let what = format!("its first line must be `{}`; restore this line", names.join(","));
            return Err(OutputError::content(path, what));
        }
        let file = OpenOptions::new().append(true).open(path).map_err(OutputError::io(path))?;
        file.set_len(bytes).map_err(OutputError::io(path))?;
        Ok(Self { path: path.to_owned(), file, columns: columns.len(), bytes, line: String::with_capacity(256) })
    }

    /// Appends one row.
    ///
    /// # Errors
    /// If the file cannot be written.
    ///
    /// # Panics
    /// If the row does not have one value per column.
    pub fn append(&mut self, row: &[f64]) -> Result<(), OutputError> {
        self.append_rows(std::iter::once(row))
    }

    /// Appends several rows in one write.
    ///
    /// # Errors
    /// If the file cannot be written.
    ///
    /// # Panics
    /// If a row does not have one value per column.
    pub fn append_rows<R: AsRef<[f64]>>(&mut self, rows: impl IntoIterator<Item = R>) -> Result<(), OutputError> {
        for row in rows {
            let row = row.as_ref();
            assert_eq!(row.len(), self.columns, "{}: number of values and of columns", self.path.display());
            for (column, value) in row.iter().enumerate() {
                if column > 0 {
                    self.line.push(',');
                }
                push_number(&mut self.line, *value);
            }
            self.line.push('\n');
        }
        self.write_line()
    }

    /// Returns the length of the file, including the last appended row [bytes].
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns the path of the CSV file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn write_line(&mut self) -> Result<(), OutputError> {
        self.file.write_all(self.line.as_bytes()).map_err(OutputError::io(&self.path))?;
        self.bytes += self.line.len() as u64;
        self.line.clear();
        Ok(())
    }
}

/// Appends a number to `text`: the shortest text that reads back to the same bits. Very large and very small numbers
/// have an exponent, and NaN is empty.
fn push_number(text: &mut String, value: f64) {
    use std::fmt::Write;
    let magnitude = value.abs();
    // Writing to a String cannot fail.
    let _ = if value.is_nan() {
        Ok(())
    } else if magnitude == 0.0 || (1e-4..1e15).contains(&magnitude) {
        write!(text, "{value}")
    } else {
        write!(text, "{value:e}")
    };
}

#[cfg(test)]
mod tests {
    use super::super::Table;
    use super::*;

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gauges.csv");
        let values = [0.1 + 0.2, 1.0 / 3.0, 1e-17, -2.5e300, 0.0, -0.0, 123456789.0, f64::MIN_POSITIVE];
        let mut series = CsvSeries::create(&path, &["time_s", "WG1_eta_m"]).unwrap();
        for v in values {
            series.append(&[v, -v]).unwrap();
        }
        assert_eq!(series.bytes(), std::fs::metadata(&path).unwrap().len());
        let table = Table::read(&path).unwrap();
        for (read, v) in table.column("time_s").unwrap().iter().zip(values) {
            assert_eq!(read.to_bits(), v.to_bits());
        }
    }

    #[test]
    fn a_resumed_file_equals_an_uninterrupted_one() {
        let folder = tempfile::tempdir().unwrap();
        let rows: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i) * 0.01, f64::from(i).sin()]).collect();
        let (whole, broken) = (folder.path().join("whole.csv"), folder.path().join("broken.csv"));
        CsvSeries::create(&whole, &["time_s", "x_m"]).unwrap().append_rows(&rows).unwrap();

        let mut series = CsvSeries::create(&broken, &["time_s", "x_m"]).unwrap();
        series.append_rows(&rows[..8]).unwrap();
        let at_checkpoint = series.bytes();
        series.append_rows(&rows[8..13]).unwrap();
        drop(series);
        let mut series = CsvSeries::open_truncated(&broken, &["time_s", "x_m"], at_checkpoint).unwrap();
        series.append_rows(&rows[8..]).unwrap();
        assert_eq!(std::fs::read(&whole).unwrap(), std::fs::read(&broken).unwrap());
        assert_eq!(series.bytes(), std::fs::metadata(&whole).unwrap().len());
    }

    #[test]
    fn a_wrong_checkpoint_length_or_header_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("energy.csv");
        CsvSeries::create(&path, &["time_s"]).unwrap().append(&[1.5]).unwrap();
        let error = CsvSeries::open_truncated(&path, &["time_s"], 1000).unwrap_err().to_string();
        assert!(error.contains("fewer than the 1000"), "{error}");
        let error = CsvSeries::open_truncated(&path, &["time_s"], 9).unwrap_err().to_string();
        assert!(error.contains("not the end of a line"), "{error}");
        let error = CsvSeries::open_truncated(&path, &["time_s", "x_m"], 11).unwrap_err().to_string();
        assert!(error.contains("its first line must be `time_s,x_m`"), "{error}");
        assert_eq!(std::fs::read(&path).unwrap(), b"time_s\n1.5\n");
    }
}
