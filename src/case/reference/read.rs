//! Reads and validates a reference folder.

use std::path::Path;

use super::{Reference, ReferenceWave, Resolution, Series};
use crate::case::{
    file::{ReferenceFile, ReferenceWaveFile, SeriesRole},
    reading::{
        check::{Checker, Range, at_least, more_than},
        document::Document,
        error::CaseErrors,
    },
};

/// Largest number of units in a series [-].
const MAX_UNITS: u32 = 10_000;

/// Largest damage distance [m]: more than the height of the largest armour units.
const LONGEST_DAMAGE_DISTANCE_M: f64 = 20.0;

/// Largest ratio of a displacement or wave height to the damage distance, and of the damage distance to a wave height
/// [-]. The ratio is larger if the lengths have different units, for example metres and millimetres.
const LARGEST_RATIO: f64 = 100.0;

impl Reference {
    /// Reads and validates a reference folder.
    ///
    /// # Errors
    /// Lists all errors in `reference.json` and its CSV files. Each error names the key and the allowed values.
    pub fn load(folder: &Path) -> Result<Self, CaseErrors> {
        let path = folder.join(Self::FILE);
        let document = Document::read(&path)?;
        let file: ReferenceFile = document.parse()?;
        let mut check = Checker::new(&document.name);
        let mut files = vec![(Self::FILE.to_owned(), document.text.into_bytes())];
        check_keys(&file, &mut check);
        let waves: Vec<Option<ReferenceWave>> =
            (0..file.waves.len()).map(|index| read_wave(&file, index, folder, &mut files, &mut check)).collect();
        if check.count() > 0 {
            return Err(check.into_errors());
        }
        let mut waves: Vec<ReferenceWave> = waves.into_iter().flatten().collect();
        let order = |wave: &ReferenceWave| (wave.height_m, wave.period_s.unwrap_or(0.0));
        waves.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
        Ok(Self { title: file.title, source: file.source, notes: file.notes, waves, files })
    }
}

/// Reads and validates the reference folder that a case names. `path` is relative to the folder of the case file
/// `case_name`.
pub(in crate::case) fn validate(path: &str, case_name: &str, check: &mut Checker) -> Option<Reference> {
    let folder = Path::new(case_name).parent().unwrap_or(Path::new("")).join(path);
    match Reference::load(&folder) {
        Ok(reference) => Some(reference),
        Err(errors) => {
            let found: Vec<String> = errors.errors.iter().map(ToString::to_string).collect();
            let allowed = format!("a folder with a valid {} ({})", Reference::FILE, found.join("; "));
            check.reject("reference", format!("{path:?}"), allowed, "paths are relative to the case file");
            None
        }
    }
}

fn check_keys(file: &ReferenceFile, check: &mut Checker) {
    for (key, text) in [("title", &file.title), ("source", &file.source)] {
        if text.trim().is_empty() {
            check.reject(key, format!("{text:?}"), "a line of text", "comparison pages show it");
        }
    }
    if !(1..=MAX_UNITS).contains(&file.units) {
        check.reject("units", file.units, format!("between 1 and {MAX_UNITS}"), "write the number of units");
    }
    if let Some([first, last]) =
        file.inner_units.filter(|[first, last]| !(1 <= *first && first <= last && *last <= file.units))
    {
        let allowed = format!("first and last unit in ascending order, between 1 and {}", file.units);
        check.reject("inner_units", format!("[{first}, {last}]"), allowed, "leave it out if no unit stands at a wall");
    }
    check.number(
        "damage_distance_m",
        file.damage_distance_m,
        more_than(0.0).up_to(LONGEST_DAMAGE_DISTANCE_M),
        "m",
        "write it in metres; the unit's height is usual",
    );
    if !file.series.iter().any(|series| series.role == SeriesRole::Measured) {
        let count = format!("{} series", file.series.len());
        check.reject("series", count, "a list with a measured series", "add an entry with \"role\": \"measured\"");
    }
    for (index, series) in file.series.iter().enumerate() {
        let key = format!("series[{index}]");
        if file.series[..index].iter().any(|other| other.name == series.name) {
            check.reject(
                &format!("{key}.name"),
                format!("{:?}", series.name),
                "different from the other names",
                "rename one of them",
            );
        }
        if let Some(dp) = series.dp_m {
            let advice = "the spacing is in metres and smaller than the damage distance; leave it out for measurements";
            check.number(&format!("{key}.dp_m"), dp, more_than(0.0).up_to(file.damage_distance_m), "m", advice);
        }
    }
    if file.waves.is_empty() {
        check.reject("waves", "[]", "a list with at least one wave", "add the waves of the experiment");
    }
    for (index, wave) in file.waves.iter().enumerate() {
        let key = format!("waves[{index}]");
        let advice = "a wave height of this size does not fit the damage distance; write both in metres";
        check.number(&format!("{key}.height_m"), wave.height_m, heights(file), "m", advice);
        if let Some(period) = wave.period_s {
            check.number(
                &format!("{key}.period_s"),
                period,
                more_than(0.0).up_to(1e4),
                "s",
                "leave it out for a solitary wave",
            );
        }
        let same = |other: &&ReferenceWaveFile| {
            (other.kind, other.height_m, other.period_s) == (wave.kind, wave.height_m, wave.period_s)
        };
        if file.waves[..index].iter().any(|other| same(&other)) {
            let words = format!("{} {} m", wave.kind.name(), wave.height_m);
            check.reject(&key, words, "different from the other waves", "give the period, or remove one wave");
        }
    }
}

/// Returns the wave heights that fit the damage distance.
fn heights(file: &ReferenceFile) -> Range {
    at_least(file.damage_distance_m / LARGEST_RATIO).up_to(LARGEST_RATIO * file.damage_distance_m)
}

fn read_wave(
    file: &ReferenceFile,
    index: usize,
    folder: &Path,
    files: &mut Vec<(String, Vec<u8>)>,
    check: &mut Checker,
) -> Option<ReferenceWave> {
    let wave = &file.waves[index];
    let key = format!("waves[{index}].displacements");
    let table = read_table(&wave.displacements, &key, folder, files, check)?;
    let before = check.count();
    if table.rows.len() != file.units as usize {
        let value = format!("{:?} with {} rows", wave.displacements, table.rows.len());
        let advice = "`units` must be the number of rows";
        check.reject(&key, value, format!("a table with {} rows, one per unit", file.units), advice);
    }
    let mut column = |name: &str, range| {
        let values = table.column(name, &key, check)?;
        let advice = "a displacement is a horizontal distance in metres, like the damage distance";
        let is_sound = values.iter().all(|value| check.number(&format!("{key}: {name}"), *value, range, "m", advice));
        is_sound.then_some(values)
    };
    let series: Vec<Series> = (file.series.iter())
        .filter_map(|series| {
            let (name, role, dp_m) = (series.name.clone(), series.role, series.dp_m);
            let displacement_m = column(&name, at_least(0.0).up_to(LARGEST_RATIO * file.damage_distance_m))?;
            Some(Series { name, role, dp_m, displacement_m })
        })
        .collect();
    let convergence = match &wave.convergence {
        None => Vec::new(),
        Some(name) => {
            let spacings = more_than(0.0).up_to(file.damage_distance_m);
            read_convergence(name, &format!("waves[{index}].convergence"), spacings, folder, files, check)?
        }
    };
    let inner = file.inner_units.unwrap_or([1, file.units]).map(|unit| unit as usize);
    (check.count() == before).then_some(ReferenceWave {
        kind: wave.kind,
        height_m: wave.height_m,
        period_s: wave.period_s,
        damage_distance_m: file.damage_distance_m,
        inner: inner[0].saturating_sub(1)..inner[1],
        series,
        convergence,
    })
}

fn read_convergence(
    name: &str,
    key: &str,
    spacings: Range,
    folder: &Path,
    files: &mut Vec<(String, Vec<u8>)>,
    check: &mut Checker,
) -> Option<Vec<Resolution>> {
    let table = read_table(name, key, folder, files, check)?;
    let (dp, deviation) = (table.column("dp_m", key, check)?, table.column("deviation_percent", key, check)?);
    let optional = |name: &str, row: usize| {
        let column = table.names.iter().position(|column| column == name)?;
        Some(table.rows[row][column]).filter(|value| value.is_finite())
    };
    let resolution = |row: usize| {
        let advice = "particle spacings are in metres and smaller than the damage distance";
        let is_sound = check.number(&format!("{key}: dp_m"), dp[row], spacings, "m", advice)
            && check.number(
                &format!("{key}: deviation_percent"),
                deviation[row],
                at_least(-100.0),
                "%",
                "write a number",
            );
        is_sound.then(|| Resolution {
            dp_m: dp[row],
            deviation_percent: deviation[row],
            particles: optional("particles", row),
            runtime_h: optional("runtime_h", row),
        })
    };
    (0..dp.len()).map(resolution).collect()
}

/// Contents of a CSV file: column names and rows of numbers. An empty field becomes NaN.
struct Table {
    file: String,
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    fn column(&self, name: &str, key: &str, check: &mut Checker) -> Option<Vec<f64>> {
        let Some(index) = self.names.iter().position(|column| column == name) else {
            let allowed = format!("a table with a column {name:?}; it has {}", self.names.join(", "));
            check.reject(key, format!("{:?}", self.file), allowed, "add the column, or correct its name");
            return None;
        };
        Some(self.rows.iter().map(|row| row[index]).collect())
    }
}

/// Reads a CSV file of the reference folder and adds its content to `files`. Lines that begin with `#` are comments.
fn read_table(
    name: &str,
    key: &str,
    folder: &Path,
    files: &mut Vec<(String, Vec<u8>)>,
    check: &mut Checker,
) -> Option<Table> {
    let mut refuse = |allowed: String, advice: &str| {
        check.reject(key, format!("{name:?}"), allowed, advice);
        None
    };
    // A run copies all files into one folder; therefore names must not contain folders.
    if Path::new(name).file_name().is_none_or(|file| file != name) || !name.ends_with(".csv") {
        return refuse("the name of a .csv file, without folders".to_owned(), "put it in the folder of reference.json");
    }
    let text = match std::fs::read_to_string(folder.join(name)) {
        Ok(text) => text,
        Err(reason) => {
            return refuse(format!("a file that can be read ({reason})"), "put it in the folder of reference.json");
        }
    };
    let fields = |line: &str| line.split(',').map(|field| field.trim().to_owned()).collect::<Vec<String>>();
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let names = lines.next().map(|(_, line)| fields(line)).unwrap_or_default();
    let mut rows = Vec::new();
    for (number, line) in lines {
        let number_of = |field: &String| if field.is_empty() { Ok(f64::NAN) } else { field.parse::<f64>() };
        match fields(line).iter().map(number_of).collect::<Result<Vec<f64>, _>>() {
            Ok(row) if row.len() == names.len() => rows.push(row),
            _ => {
                let allowed = format!("a table of numbers: line {} is not {} numbers", number + 1, names.len());
                return refuse(allowed, "separate the numbers by commas and write decimals with a point: 0.5, 1.2");
            }
        }
    }
    if files.iter().all(|(other, _)| other != name) {
        files.push((name.to_owned(), text.clone().into_bytes()));
    }
    Some(Table { file: name.to_owned(), names, rows })
}
