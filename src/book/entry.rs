//! A run in the book.

use std::{
    fs,
    path::{Path, PathBuf},
};

use serde_json::Value;

use crate::{
    case::{BreakageSettings, file::CaseFile},
    output::{OutputError, Summary, Table, write_atomically},
    simulation::breakage::results::Breakage,
};

/// Rows that the series of a run has at most: all of them in the runs of the paper, 8 s at 10 ms.
const ROWS: usize = 1000;

/// What the book keeps of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Name of the run's folder.
    pub name: String,
    /// The case as it was run.
    pub case: Value,
    /// The summary.
    pub summary: Summary,
    /// Series against `time_s`, flume time: `unit_1_fx_n`, `unit_1_fz_n` and `unit_1_moved_m` of each unit,
    /// `<gauge>_eta_m` and `<gauge>.flume_eta_m` of each gauge. Forces are means over the interval of the series.
    pub series: Table,
    /// Whatever else the case needs or the comparison reads: names and contents.
    others: Vec<(&'static str, Vec<u8>)>,
}

impl Entry {
    /// Folder of the runs in a book.
    pub const RUNS: &str = "runs";
    const CASE: &str = "case.json";
    const SERIES: &str = "series.csv";

    /// What the book would keep of a finished run.
    ///
    /// # Errors
    /// If it is not finished, or one of its files cannot be read.
    pub fn of_run(run: &Path) -> Result<Self, OutputError> {
        // By its own name, whatever way it was called.
        let run = fs::canonicalize(run).map_err(OutputError::io(run))?;
        let summary = Summary::read(&run)?;
        let series = series_of(&run, summary.units.len())?;
        Self::with(&run, summary, series)
    }

    #[cfg(test)]
    pub(super) fn for_tests(name: &str, case: Value, summary: Summary, series: Table) -> Self {
        Self { name: name.to_owned(), case, summary, series, others: Vec::new() }
    }

    /// The entry in a folder of the book.
    fn read(folder: &Path) -> Result<Self, OutputError> {
        Self::with(folder, Summary::read(folder)?, Table::read(&folder.join(Self::SERIES))?)
    }

    fn with(folder: &Path, summary: Summary, series: Table) -> Result<Self, OutputError> {
        let path = folder.join(Self::CASE);
        let text = fs::read_to_string(&path).map_err(OutputError::io(&path))?;
        let case = serde_json::from_str(&text).map_err(OutputError::json(&path))?;
        let name = folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy().into_owned();
        let mut others = Vec::new();
        for file in [BreakageSettings::MESH, Breakage::FILE] {
            match fs::read(folder.join(file)) {
                Ok(content) => others.push((file, content)),
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
                Err(error) => return Err(OutputError::io(&folder.join(file))(error)),
            }
        }
        Ok(Self { name, case, summary, series, others })
    }

    /// All entries of a book, by name.
    ///
    /// # Errors
    /// If one of them cannot be read.
    pub fn all(book: &Path) -> Result<Vec<Self>, OutputError> {
        let runs = book.join(Self::RUNS);
        let folders = match fs::read_dir(&runs) {
            Ok(folders) => folders,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(OutputError::io(&runs)(error)),
        };
        let paths = folders.map(|folder| folder.map(|folder| folder.path())).collect::<Result<Vec<_>, _>>();
        let mut paths: Vec<PathBuf> = paths.map_err(OutputError::io(&runs))?;
        // A hidden one was being written when the program was killed.
        let is_hidden = |path: &Path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        paths.retain(|path| path.is_dir() && !is_hidden(path));
        paths.sort();
        paths.iter().map(|path| Self::read(path)).collect()
    }

    /// Where it is in a book.
    pub fn folder(&self, book: &Path) -> PathBuf {
        book.join(Self::RUNS).join(&self.name)
    }

    /// Puts it into a book, in the place of an older one with its name: whole or not at all.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn keep(&self, book: &Path) -> Result<(), OutputError> {
        let (folder, part) = (self.folder(book), book.join(Self::RUNS).join(format!(".{}.part", self.name)));
        let clear = |folder: &Path| if folder.exists() { fs::remove_dir_all(folder) } else { Ok(()) };
        clear(&part).and_then(|()| fs::create_dir_all(&part)).map_err(OutputError::io(&part))?;
        write_atomically(&part.join(Self::CASE), format!("{:#}\n", self.case).as_bytes())?;
        write_atomically(&part.join(Self::SERIES), csv(&self.series).as_bytes())?;
        self.others.iter().try_for_each(|(file, content)| write_atomically(&part.join(file), content))?;
        self.summary.write(&part)?;
        clear(&folder).and_then(|()| fs::rename(&part, &folder)).map_err(OutputError::io(&folder))
    }

    /// The command that makes runs of a book again and takes them in, given in the folder of the book.
    pub fn again<'a>(runs: impl IntoIterator<Item = &'a Self>) -> String {
        let plain = |c: char| c.is_ascii_alphanumeric() || ".-_".contains(c);
        let quoted = |name: &str| {
            if name.chars().all(plain) { name.to_owned() } else { format!("'{}'", name.replace('\'', r"'\''")) }
        };
        let names: Vec<String> = runs.into_iter().map(|entry| quoted(&entry.name)).collect();
        let run = |name: &str| format!("breakwater run {}/{name}/case.json --out again/{name}", Self::RUNS);
        let make = match &names[..] {
            [] => return "breakwater book --out .".to_owned(),
            [name] => run(name),
            _ => format!("for run in {}; do {}; done", names.join(" "), run("\"$run\"")),
        };
        format!("{make}; breakwater book again/* --out .")
    }

    /// The case with the defaults that it does not write; none if it is no case of this version.
    pub fn case_file(&self) -> Option<CaseFile> {
        serde_json::from_value(self.case.clone()).ok()
    }

    /// Points of a series against the time, where there is one.
    pub fn points(&self, column: &str) -> Option<Vec<[f64; 2]>> {
        let (times, values) = (self.series.get("time_s")?, self.series.get(column)?);
        Some(times.iter().zip(values).map(|(time, value)| [*time, *value]).collect())
    }

    /// Names of the gauges in the series.
    pub fn gauges(&self) -> impl Iterator<Item = &str> {
        let names = self.series.names().iter().filter_map(|name| name.strip_suffix("_eta_m"));
        // Names of gauges have no dots.
        names.filter(|name| !name.contains('.'))
    }
}

/// The series of a run at the moments of its units, every so many of them.
fn series_of(run: &Path, units: usize) -> Result<Table, OutputError> {
    let path = run.join("units.csv");
    let table = Table::read(&path)?;
    let numbers = table.column("unit")?;
    let in_turn = numbers.iter().enumerate().all(|(row, unit)| *unit == (row % units.max(1) + 1) as f64);
    if !in_turn || table.rows() == 0 || table.rows() % units.max(1) != 0 {
        return Err(OutputError::content(&path, format!("must hold rows of {units} units in turn")));
    }
    let rows = table.rows() / units.max(1);
    let stride = rows.div_ceil(ROWS).max(1);
    let times: Vec<f64> = table.column("time_s")?.iter().step_by(units.max(1) * stride).copied().collect();
    let mut names = vec!["time_s".to_owned()];
    let mut columns = vec![times];
    for unit in 0..units {
        let of = |column: &str| -> Result<Vec<f64>, OutputError> {
            Ok(table.column(column)?.iter().skip(unit).step_by(units * stride).copied().collect())
        };
        let (x, y) = (of("x_m")?, of("y_m")?);
        let moved = x.iter().zip(&y).map(|(a, b)| (a - x[0]).hypot(b - y[0])).collect();
        for (what, values) in [("fx_n", of("fluid_fx_n")?), ("fz_n", of("fluid_fz_n")?), ("moved_m", moved)] {
            names.push(format!("unit_{}_{what}", unit + 1));
            columns.push(values);
        }
    }
    for (file, suffix) in [("gauges.csv", "_eta_m"), ("flume_gauges.csv", ".flume_eta_m")] {
        let Some(gauges) = Table::read_if_present(&run.join(file))? else { continue };
        let at = gauges.column("time_s")?;
        for name in gauges.names().iter().filter_map(|name| name.strip_suffix("_eta_m")) {
            let values = gauges.column(&format!("{name}_eta_m"))?;
            names.push(format!("{name}{suffix}"));
            columns.push(columns[0].iter().map(|time| interpolated(at, values, *time)).collect());
        }
    }
    let column = |(name, values): (String, Vec<f64>)| (name, values.into_iter().map(rounded).collect());
    Ok(Table::of_columns(&path, names.into_iter().zip(columns).map(column)))
}

/// Value at a time between the rows of a series; not a number outside of it.
fn interpolated(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|t| *t < time);
    if times.get(after).is_some_and(|t| *t == time) {
        return values[after];
    }
    let Some(before) = after.checked_sub(1).filter(|_| after < times.len()) else { return f64::NAN };
    let share = (time - times[before]) / (times[after] - times[before]);
    values[before] + share * (values[after] - values[before])
}

/// A micrometre, a micronewton, a microsecond: finer than any figure.
fn rounded(value: f64) -> f64 {
    (1e6 * value).round() / 1e6
}

fn csv(table: &Table) -> String {
    let columns: Vec<&[f64]> = table.names().iter().filter_map(|name| table.get(name)).collect();
    let number = |value: f64| if value.is_nan() { String::new() } else { value.to_string() };
    let row = |row: usize| columns.iter().map(|column| number(column[row])).collect::<Vec<_>>().join(",") + "\n";
    table.names().join(",") + "\n" + &(0..table.rows()).map(row).collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_between_two_rows_lies_between_theirs() {
        let (times, values) = ([1.0, 2.0, 4.0], [0.0, 1.0, 5.0]);
        let at = |time: f64| interpolated(&times, &values, time);
        assert_eq!([at(1.0), at(1.5), at(3.0), at(4.0)], [0.0, 0.5, 3.0, 5.0]);
        assert!(at(0.9).is_nan() && at(4.1).is_nan());
    }

    #[test]
    fn the_command_that_makes_runs_again_is_one_for_the_shell() {
        let entry = |name: &str| {
            let series = Table::of_columns(Path::new("series.csv"), std::iter::empty());
            Entry::for_tests(name, Value::Null, Summary::default(), series)
        };
        let one = Entry::again([&entry("H4.5-9mm")]);
        assert_eq!(one, "breakwater run runs/H4.5-9mm/case.json --out again/H4.5-9mm; breakwater book again/* --out .");
        let two = Entry::again([&entry("my run"), &entry("b")]);
        assert!(two.starts_with("for run in 'my run' b; do breakwater run runs/\"$run\"/case.json --out"), "{two}");
    }

    #[test]
    fn the_series_of_long_runs_are_thinned() {
        let folder = tempfile::tempdir().unwrap();
        let mut text = "time_s,unit,x_m,y_m,fluid_fx_n,fluid_fz_n\n".to_owned();
        for row in 0..3000 {
            for unit in 0..2 {
                let x = f64::from(unit) + 3e-3 * f64::from(row);
                text += &format!("{},{},{x},{},{row},0\n", 0.01 * f64::from(row), unit + 1, 4e-3 * f64::from(row));
            }
        }
        fs::write(folder.path().join("units.csv"), text).unwrap();
        fs::write(folder.path().join("gauges.csv"), "time_s,front_eta_m\n0,0\n30,3\n").unwrap();
        let series = series_of(folder.path(), 2).unwrap();
        assert_eq!(series.rows(), 1000);
        let moved = series.column("unit_2_moved_m").unwrap();
        // Three and four thousandths a row: five.
        assert!((moved[1] - 0.015).abs() < 1e-9 && series.column("unit_2_fx_n").unwrap()[1] == 3.0);
        assert_eq!(series.column("front_eta_m").unwrap()[1], 0.003);
    }
}
