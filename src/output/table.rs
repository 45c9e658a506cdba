//! Reads the CSV files of a run folder.

use std::path::{Path, PathBuf};

use super::OutputError;

/// A table of numbers with named columns. Lines starting with `#` are comments; an empty field is `NaN`.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    path: PathBuf,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a CSV file. Ignores a last line without line end, which a killed run may have left.
    ///
    /// # Errors
    /// If the file cannot be read, has no header, or has a field that is not a number.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = std::fs::read_to_string(path).map_err(OutputError::io(path))?;
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        Self::parse(path, whole)
    }

    /// Reads a CSV file; returns `None` if the file does not exist.
    ///
    /// # Errors
    /// As for [`Table::read`].
    pub fn read_if_present(path: &Path) -> Result<Option<Self>, OutputError> {
        if path.exists() { Self::read(path).map(Some) } else { Ok(None) }
    }

    /// Reads a table from CSV text; error messages name `path`.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Self, OutputError> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let Some((_, header)) = lines.next() else {
            return Err(OutputError::content(path, "is empty; it needs a header line with the column names"));
        };
        let names: Vec<String> = header.split(',').map(|name| name.trim().to_owned()).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for (number, line) in lines {
            let fields: Vec<&str> = line.split(',').map(str::trim).collect();
            if fields.len() != names.len() {
                let what = format!("line {}: has {} fields, but must have {}", number + 1, fields.len(), names.len());
                return Err(OutputError::content(path, what));
            }
            for ((column, field), name) in columns.iter_mut().zip(fields).zip(&names) {
                let value = if field.is_empty() { Ok(f64::NAN) } else { field.parse::<f64>() };
                column.push(value.map_err(|_| {
                    OutputError::content(path, format!("line {}: {name} is \"{field}\", not a number", number + 1))
                })?);
            }
        }
        Ok(Self { path: path.to_owned(), names, columns })
    }

    /// Returns the column names in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the number of rows, without the header line.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Returns the column with this name; `None` if the column does not exist.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.names.iter().position(|n| n == name).map(|i| self.columns[i].as_slice())
    }

    /// Returns the column with this name.
    ///
    /// # Errors
    /// If the column does not exist; the message lists the existing columns.
    pub fn column(&self, name: &str) -> Result<&[f64], OutputError> {
        self.get(name).ok_or_else(|| {
            let what = format!("has no column \"{name}\"; its columns are {}", self.names.join(", "));
            OutputError::content(&self.path, what)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_incomplete_last_line_is_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, "# a comment\ntime_s,x_m\n0,1.5\n0.1,\n0.2,3").unwrap();
        let table = Table::read(&path).unwrap();
        assert_eq!(table.rows(), 2);
        assert_eq!(table.column("time_s").unwrap(), [0.0, 0.1]);
        assert!(table.column("x_m").unwrap()[1].is_nan());
    }

    #[test]
    fn an_error_names_the_line_or_the_column() {
        let path = Path::new("t.csv");
        let message = |text: &str| Table::parse(path, text).unwrap_err().to_string();
        assert_eq!(message("a,b\n1,2\n3\n"), "t.csv: line 3: has 1 fields, but must have 2");
        assert_eq!(message("a,b\n1,wet\n"), "t.csv: line 2: b is \"wet\", not a number");
        assert!(message("").contains("is empty"));
        let table = Table::parse(path, "a,b\n1,2\n").unwrap();
        assert_eq!(table.column("c").unwrap_err().to_string(), "t.csv: has no column \"c\"; its columns are a, b");
    }
}
