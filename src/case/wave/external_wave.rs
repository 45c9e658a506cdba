//! Reads and validates a wave from another program.

use std::path::Path;
use std::sync::Arc;

use crate::case::file::{ExternalWaveFile, OpenfoamFile, SwashFile, SwashTableFile, UpFile, VelxFile, WaveSourceFile};
use crate::case::flume::bed::Flume;
use crate::case::flume::domain::Domain;
use crate::case::reading::check::{Checker, as_text, more_than};
use crate::waves::external::{
    error::ExternalError,
    openfoam::{Frame, Up, Vertical, lines, probes},
    swash::{self, Column, RowTimes, TableFile, Tables},
    table::{Layers, Place, VelocityTable},
    velx::{self, LevelsFrom},
};
use crate::waves::generation::velx::Velx;

/// Name of the file in a run folder that contains the velocities of the wavemaker's rows.
pub const ROWS_FILE: &str = "wave_velx.csv";

/// A wave from another program: velocities of the wavemaker's rows; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct ExternalWave {
    /// Velocities as a function of time at the levels of the wavemaker's rows.
    pub rows: Arc<Velx>,
    /// Celerity of the wave [m/s]. If given, each row moves with the water velocity at the row's current position.
    pub celerity: Option<f64>,
}

impl ExternalWave {
    /// Returns the velocities as the text of a `_velx` file.
    pub fn rows_text(&self) -> Vec<u8> {
        let mut text = Vec::new();
        // Writing to memory cannot fail.
        let _ = self.rows.write(&mut text);
        text
    }

    /// Returns the first and the last time of the velocities [s].
    pub fn times(&self) -> [f64; 2] {
        [self.rows.times_s[0], self.rows.times_s[self.rows.times_s.len() - 1]]
    }
}

/// Reads the files of the other program and validates the velocities at the position of the wavemaker. Paths are
/// relative to the folder of the case file `case_name`.
pub fn validate(
    file: &ExternalWaveFile,
    case_name: &str,
    flume: &Flume,
    domain: &Domain,
    gravity: f64,
    check: &mut Checker,
) -> Option<ExternalWave> {
    if let Some(celerity) = file.celerity_m_s {
        // The fastest wave is a breaking solitary wave of height 0.8 d in the depth d, with the celerity sqrt(1.8 g d).
        // The factor 2 in the limit allows for currents.
        let fastest = 2.0 * (1.8 * gravity * flume.still_depth(domain.x[0])).sqrt();
        let advice = "a solitary wave of height H in the depth d has the celerity sqrt(g (d + H))";
        check.number("wave.celerity_m_s", celerity, more_than(0.0).up_to(fastest), "m/s", advice);
    }
    let x0 = domain.x[0];
    let place = Place {
        bed_z_m: flume.section().z(x0),
        still_water_z_m: flume.still_water_level,
        gravity_m_s2: gravity,
        layers: match &file.source {
            WaveSourceFile::Swash(SwashFile { depth_averaged: true, .. }) => Layers::DepthAveraged,
            _ => Layers::AtLeastTwo,
        },
    };
    // Other checks report dry ground and invalid gravity.
    if place.depth_m() <= 0.0 || gravity.is_nan() || gravity <= 0.0 {
        return None;
    }
    let base = Path::new(case_name).parent().unwrap_or(Path::new(""));
    match read(&file.source, base, &place, check)? {
        Ok(table) => {
            let rows = table.velx([x0, 0.0], &domain.wavemaker_rows(flume, x0));
            Some(ExternalWave { rows: Arc::new(rows), celerity: file.celerity_m_s })
        }
        Err(error) => {
            check.reject(
                "wave.source",
                "the files",
                "files with the velocity of the wave at the wavemaker",
                error.to_string(),
            );
            None
        }
    }
}

type Read = Result<VelocityTable, ExternalError>;

fn read(source: &WaveSourceFile, base: &Path, place: &Place, check: &mut Checker) -> Option<Read> {
    match source {
        WaveSourceFile::Dualsphysics(file) => Some(read_velx(file, base, place, check)),
        WaveSourceFile::Swash(file) => read_swash(file, base, place, check),
        WaveSourceFile::Openfoam(file) => Some(read_openfoam(file, base, place)),
    }
}

fn read_velx(file: &VelxFile, base: &Path, place: &Place, check: &mut Checker) -> Read {
    let path = base.join(&file.path);
    let (table, from) = velx::read(&path, file.origin_z_m, place)?;
    let (path, still) = (path.display(), as_text(place.still_water_z_m));
    match from {
        LevelsFrom::Origin => {}
        LevelsFrom::OriginRatherThanStillWater => check.warn(format!(
            "wave.source.origin_z_m is missing: the levels in {path} are used as z, but they would also be in the water if \
             they counted from the still water; write 0 for z, or {still} for the still water level"
        )),
        LevelsFrom::StillWater => check.warn(format!(
            "wave.source.origin_z_m is missing: the levels in {path} count from the still water, z = {still} m, because \
             they are not in the water as z; write {still} to confirm this"
        )),
        LevelsFrom::Surface => check.warn(format!(
            "wave.source.origin_z_m is missing: the levels in {path} count from the surface, which is at the still water, \
             z = {still} m, at rest, because they are not in the water as z and the lowest level moves against the surface"
        )),
    }
    Ok(table)
}

fn read_openfoam(file: &OpenfoamFile, base: &Path, place: &Place) -> Read {
    let up = match file.up {
        UpFile::Y => Up::Y,
        UpFile::Z => Up::Z,
    };
    let vertical = Vertical {
        folder: &base.join(&file.folder),
        velocity: &file.velocity,
        water: file.water.as_deref(),
        frame: Frame { up, origin_z_m: file.origin_z_m },
        surface: None,
    };
    match &file.line {
        Some(line) => lines::read(&vertical, line, place),
        None => probes::read(&vertical, place),
    }
}

fn read_swash(file: &SwashFile, base: &Path, place: &Place, check: &mut Checker) -> Option<Read> {
    let level = parse_columns("wave.source.level", &file.level, check);
    let velocity = parse_columns("wave.source.velocity", &file.velocity, check);
    let before = check.count();
    let row_times = row_times(file, check);
    let (level, velocity) = (level?, velocity?);
    if check.count() > before {
        return None;
    }
    let [level_path, velocity_path] = [&file.level, &file.velocity].map(|table| base.join(&table.path));
    let tables = Tables {
        level: TableFile { path: &level_path, columns: &level },
        velocity: TableFile { path: &velocity_path, columns: &velocity },
        layer_shares: &file.layer_shares,
        row_times,
        origin_z_m: file.origin_z_m.unwrap_or(place.still_water_z_m),
    };
    Some(swash::read(&tables, place))
}

/// Returns the times of the rows of tables without a column of times.
fn row_times(file: &SwashFile, check: &mut Checker) -> Option<RowTimes> {
    let first = file.first_row_s.unwrap_or(0.0);
    let Some(interval) = file.row_interval_s else {
        if file.first_row_s.is_some() {
            let advice = "write `row_interval_s`, the time in seconds between two rows, or remove `first_row_s`";
            check.reject("wave.source.first_row_s", as_text(first), "left out without `row_interval_s`", advice);
        }
        return None;
    };
    let advice = "write the output interval of the TABLE command in seconds";
    let valid = check.number("wave.source.row_interval_s", interval, more_than(0.0).up_to(3600.0), "s", advice);
    valid.then_some(RowTimes { first_s: first, interval_s: interval })
}

/// Returns the columns of a SWASH table from their names in the case file.
fn parse_columns(path: &str, table: &SwashTableFile, check: &mut Checker) -> Option<Vec<Column>> {
    let mut columns = Vec::with_capacity(table.columns.len());
    for (index, name) in table.columns.iter().enumerate() {
        let layer = name.strip_prefix("velk").and_then(|layer| layer.parse().ok()).filter(|&layer: &usize| layer > 0);
        columns.push(match (name.as_str(), layer) {
            ("tsec", _) => Column::Tsec,
            ("watl", _) => Column::Watl,
            ("velx", _) => Column::VelX,
            ("-", _) => Column::Ignored,
            (_, Some(layer)) => Column::VelkX(layer),
            _ => {
                check.reject(
                    &format!("{path}.columns[{index}]"),
                    format!("{name:?}"),
                    "\"tsec\", \"watl\", \"velk1\", \"velk2\" and so on, \"velx\" or \"-\"",
                    "list the columns in order; write \"-\" for a column that is not needed",
                );
                return None;
            }
        });
    }
    Some(columns)
}

/// Refuses a `start_s` outside the time range of the files.
pub fn refuse_late_start(wave: &ExternalWave, start: f64, check: &mut Checker) {
    let [first, last] = wave.times();
    if !(first..last).contains(&start) {
        check.reject(
            "domain.start_s",
            as_text(start),
            format!("within the times of the files, {} to {} s", as_text(first), as_text(last)),
            "write a time in the time range of the files",
        );
    }
}
