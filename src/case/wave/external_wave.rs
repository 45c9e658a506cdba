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
    swash::{self, Column, TableFile, Tables},
    table::{Layers, Place, VelocityTable},
    velx,
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
        bed_z_m: flume.profile.z(x0),
        still_water_z_m: flume.still_water_level,
        gravity_m_s2: gravity,
        layers: Layers::AtLeastTwo,
    };
    // Other checks report dry ground and invalid gravity.
    if place.depth_m() <= 0.0 || gravity.is_nan() || gravity <= 0.0 {
        return None;
    }
    let base = Path::new(case_name).parent().unwrap_or(Path::new(""));
    match read(&file.source, base, &place, check)? {
        Ok(table) => {
            let rows = table.velx([x0, 0.0], &domain.wavemaker_rows(flume));
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
        WaveSourceFile::Dualsphysics(VelxFile { path }) => Some(velx::read(&base.join(path), place)),
        WaveSourceFile::Swash(file) => read_swash(file, base, place, check),
        WaveSourceFile::Openfoam(file) => Some(read_openfoam(file, base, place)),
    }
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
    let (level, velocity) = (level?, velocity?);
    let [level_path, velocity_path] = [&file.level, &file.velocity].map(|table| base.join(&table.path));
    let tables = Tables {
        level: TableFile { path: &level_path, columns: &level },
        velocity: TableFile { path: &velocity_path, columns: &velocity },
        layer_shares: &file.layer_shares,
    };
    Some(swash::read(&tables, place))
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
