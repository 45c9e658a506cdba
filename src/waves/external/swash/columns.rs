//! Columns of a SWASH table and their values.

use std::path::PathBuf;

use super::TableFile;
use crate::waves::external::error::ExternalError;
use crate::waves::external::text_file::{TextFile, words};

/// Meaning of a column of a SWASH table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Time [s]: `TSEC`.
    Tsec,
    /// Surface level above the datum [m]: `WATL`.
    Watl,
    /// Depth-averaged velocity along x [m/s]: the x component of `VEL`, or `VKSI`.
    VelX,
    /// Velocity of a layer along x [m/s]: the x component of `VELK`, or `VKSIK`. The surface layer is number 1.
    VelkX(usize),
    /// Any other column, such as velocities along y; its values need not be numbers.
    Ignored,
}

/// Times of the rows of a table without a column of times: the first time, and then the same interval between all rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTimes {
    /// Time of the first row [s].
    pub first_s: f64,
    /// Time between two rows [s].
    pub interval_s: f64,
}

/// Returns the columns of the table `TSEC VELK` for a number of layers.
pub fn velk_columns(layers: usize) -> Vec<Column> {
    let mut columns = vec![Column::Tsec];
    columns.extend((1..=layers).map(Column::VelkX));
    columns.extend((1..=layers).map(|_| Column::Ignored));
    columns
}

/// Rows and columns of a table.
pub(super) struct Table {
    path: PathBuf,
    columns: Vec<Column>,
    /// One list per row, NaN in ignored columns.
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a table.
    pub(super) fn read(file: &TableFile) -> Result<Self, ExternalError> {
        let text = TextFile::read(file.path, "give the path of a SWASH table")?;
        let mut columns = file.columns.to_vec();
        let mut rows = Vec::new();
        for (line, row) in text.lines() {
            // The command `OUTPUT OPTIONS` of SWASH can change the comment character.
            let comment = row.strip_prefix(['%', '#', '!', '$']);
            let names = comment.or_else(|| rows.is_empty().then_some(row)).and_then(parse_header);
            if let Some(names) = names {
                if file.columns.is_empty() {
                    columns = names;
                }
            } else if row.starts_with("SWASH") {
                let problem = "the format of TABLE ... SWASH is not supported";
                return Err(text.line_error(line, problem, "write the table with HEADER or NOHEADER"));
            } else if comment.is_none() && columns.is_empty() {
                let advice = "list the columns in file order, or write with HEADER";
                return Err(text.line_error(line, "no header with the column names", advice));
            } else if comment.is_none() {
                rows.push(parse_row(&text, line, row, &columns)?);
            }
        }
        Ok(Self { path: text.path().to_owned(), columns, rows })
    }

    /// Returns true if the table has the column.
    pub(super) fn has(&self, column: Column) -> bool {
        self.columns.contains(&column)
    }

    /// Times of the rows [s]: the column `Tsec`, or `row_times` if the table does not have it.
    pub(super) fn times_s(&self, row_times: Option<RowTimes>) -> Result<Vec<f64>, ExternalError> {
        match row_times {
            Some(RowTimes { first_s, interval_s }) if !self.has(Column::Tsec) => {
                Ok((0..self.rows.len()).map(|row| first_s + interval_s * row as f64).collect())
            }
            _ => self.column(Column::Tsec),
        }
    }

    /// Values of a column, one per row; an error if the table does not have the column.
    pub(super) fn column(&self, column: Column) -> Result<Vec<f64>, ExternalError> {
        match self.columns.iter().position(|&c| c == column) {
            Some(index) => Ok(self.rows.iter().map(|row| row[index]).collect()),
            None => {
                let (name, keyword) = match column {
                    Column::Tsec => ("column `Tsec`".to_owned(), "TSEC"),
                    Column::Watl => ("column `Watlev`".to_owned(), "WATL"),
                    Column::VelkX(layer) => (format!("velocity of layer {layer}"), "VELK"),
                    Column::VelX | Column::Ignored => ("depth-averaged velocity".to_owned(), "VEL or VKSI"),
                };
                let mut advice = format!("add {keyword} to the TABLE command");
                if column == Column::Tsec {
                    advice += ", or write `row_interval_s` in `wave.source`, the time in seconds between two rows";
                }
                Err(ExternalError::file(&self.path, format!("no {name}"), advice))
            }
        }
    }

    /// Velocities along x of at least two layers, one list per layer from the surface downwards.
    pub(super) fn layers(&self) -> Result<Vec<Vec<f64>>, ExternalError> {
        match self.layer_count() {
            0 if !self.has(Column::VelX) => {
                let advice = "add VELK or VKSIK to the TABLE command";
                Err(ExternalError::file(&self.path, "no velocities", advice))
            }
            0 | 1 => {
                let advice = "write VELK of at least 2 layers; for long waves, allow depth-averaged velocities with \
                              `\"depth_averaged\": true` in `wave.source`";
                Err(ExternalError::file(&self.path, "the velocities are depth-averaged", advice))
            }
            layers => (1..=layers).map(|layer| self.column(Column::VelkX(layer))).collect(),
        }
    }

    /// Depth-averaged velocities along x; the velocity of a single layer is depth-averaged too.
    pub(super) fn depth_averaged(&self) -> Result<Vec<f64>, ExternalError> {
        self.column(if self.layer_count() == 1 { Column::VelkX(1) } else { Column::VelX })
    }

    /// Number of layers with velocities.
    fn layer_count(&self) -> usize {
        let numbers = self.columns.iter().filter_map(|column| match column {
            Column::VelkX(layer) => Some(*layer),
            _ => None,
        });
        numbers.max().unwrap_or(0)
    }
}

/// Returns the columns that a header line names; `None` if it names no known column.
fn parse_header(comment: &str) -> Option<Vec<Column>> {
    let mut columns = Vec::new();
    let separates = |c: char| c.is_whitespace() || c == ';' || c == ',';
    for name in comment.split(separates).filter(|name| !name.is_empty()) {
        let name = name.to_ascii_lowercase();
        let column = match name.as_str() {
            "tsec" => Column::Tsec,
            "watlev" | "watl" => Column::Watl,
            "x-vel" | "vksi" => Column::VelX,
            _ => match name.strip_prefix("x-vel_k").or_else(|| name.strip_prefix("vksi_k")) {
                // Without layer numbers, the same name repeats for every layer.
                Some("") => Column::VelkX(1 + columns.iter().filter(|c| matches!(c, Column::VelkX(_))).count()),
                Some(number) => number.parse().map_or(Column::Ignored, Column::VelkX),
                None => Column::Ignored,
            },
        };
        columns.push(column);
    }
    columns.iter().any(|&column| column != Column::Ignored).then_some(columns)
}

/// Parses the values of a row.
fn parse_row(text: &TextFile, line: usize, row: &str, columns: &[Column]) -> Result<Vec<f64>, ExternalError> {
    let words = words(row, columns.len());
    if words.len() != columns.len() {
        return Err(text.line_error(
            line,
            format!("{} values, expected {}, one per column", words.len(), columns.len()),
            "correct the line, or list the columns in file order (VELK: x of every layer, then y of every layer)",
        ));
    }
    let is_used = |column: &Column| *column != Column::Ignored;
    let used: Vec<&str> =
        words.into_iter().zip(columns).filter(|(_, column)| is_used(column)).map(|(word, _)| word).collect();
    let mut values = text.numbers(line, &used)?.into_iter().peekable();
    Ok(columns.iter().map(|column| values.next_if(|_| is_used(column)).unwrap_or(f64::NAN)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str, columns: &[Column]) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tbl");
        std::fs::write(&path, text).unwrap();
        let error = Table::read(&TableFile { path: &path, columns }).err().unwrap().to_string();
        error.split_once("a.tbl: ").unwrap().1.to_owned()
    }

    #[test]
    fn header_may_name_columns_in_any_order() {
        use Column::{Ignored, Tsec, VelkX, Watl};
        assert_eq!(parse_header(" Run:A1  Table:P        SWASH version: 10.05"), None);
        assert_eq!(parse_header(" Xp Watlev Tsec").unwrap(), [Ignored, Watl, Tsec]);
        assert_eq!(parse_header("Tsec X-vel_k X-vel_k Y-vel_k Y-vel_k").unwrap()[1..3], [VelkX(1), VelkX(2)]);
        assert_eq!(parse_header("Vksi_k02 Vksi_k01").unwrap(), [VelkX(2), VelkX(1)]);
    }

    #[test]
    fn error_names_the_wrong_line() {
        let columns = velk_columns(1);
        assert_eq!(
            message("0 0.1 0\n1 0.1\n", &columns),
            "line 2: 2 values, expected 3, one per column; correct the line, or list the columns in file order (VELK: \
             x of every layer, then y of every layer)"
        );
        assert_eq!(
            message("0 ******* 0\n", &columns),
            "line 1: `*******` is not a number; asterisks replace a number that is too wide for its column; write the \
             table without header"
        );
        assert_eq!(
            message("SWASH   1   Swash standard file, version\n", &columns),
            "line 1: the format of TABLE ... SWASH is not supported; write the table with HEADER or NOHEADER"
        );
    }

    #[test]
    fn error_names_the_missing_file() {
        let message = Table::read(&TableFile { path: "no/such.tbl".as_ref(), columns: &[] }).err().unwrap().to_string();
        assert!(message.starts_with("no/such.tbl: cannot be read: "));
        assert!(message.ends_with("; give the path of a SWASH table"));
    }
}
