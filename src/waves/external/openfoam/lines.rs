//! Sampled lines: `postProcessing/<name>/<t>/<line>_U.xy`, one row per point with coordinates and vector components.
//!
//! The function object `sets` writes these files with `setFormat raw; fields (U alpha.water);` and a line with `axis z`
//! (or y, the vertical axis) or `axis xyz`. Do not use `axis distance`, because it does not write the level z. Up to
//! v2112 each type of field has its own file, `<line>_U.xy` and `<line>_alpha.water.xy`. Later versions write
//! `<line>_alpha.water_U.xy`, with the volume fraction of water first.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::table::{Place, VelocityTable};
use super::super::text_file::TextFile;
use super::frame::Frame;
use super::samples::{Sample, SampledSurface, Vertical, in_water};
use super::starts::time_folders;

/// Reads the velocities on the sampled line `line` at all times and leaves out points in air.
///
/// # Errors
/// If a file cannot be read, a row is wrong, or the values fail the checks of [`VelocityTable::checked`].
pub fn read(vertical: &Vertical, line: &str, place: &Place) -> Result<VelocityTable, ExternalError> {
    let (mut times_s, mut heights_m, mut velocities_m_s) = (Vec::new(), Vec::new(), Vec::new());
    let mut sampled = SampledSurface::default();
    for (time, folder) in time_folders(vertical.folder)? {
        let samples = read_time(vertical, line, &folder)?;
        sampled.add(&samples);
        let (heights, velocities) = in_water(&samples);
        times_s.push(time);
        heights_m.push(heights);
        velocities_m_s.push(velocities);
    }
    sampled.check(vertical.folder, place)?;
    let surface_z_m = vertical.surface.map(|surface| surface.at_times(&times_s)).transpose()?;
    VelocityTable { times_s, surface_z_m, heights_m, velocities_m_s }.checked(vertical.folder, place)
}

/// Reads the samples in the folder of one time.
fn read_time(vertical: &Vertical, line: &str, folder: &Path) -> Result<Vec<Sample>, ExternalError> {
    let path = |fields: &str| folder.join(format!("{line}_{fields}.xy"));
    let Some(water) = vertical.water else {
        let points = read_points(vertical.frame, &path(vertical.velocity), 3)?;
        return Ok(points.iter().map(|p| Sample { z_m: p.z_m, u_m_s: p.values[0], water: 1.0 }).collect());
    };
    let both = path(&format!("{water}_{}", vertical.velocity));
    if both.is_file() {
        let points = read_points(vertical.frame, &both, 4)?;
        return Ok(points.iter().map(|p| Sample { z_m: p.z_m, u_m_s: p.values[1], water: p.values[0] }).collect());
    }
    let velocity = read_points(vertical.frame, &path(vertical.velocity), 3)?;
    let shares = read_points(vertical.frame, &path(water), 1)?;
    if velocity.len() != shares.len() {
        let problem = format!("{} volume fraction(s), but {} velocities", shares.len(), velocity.len());
        return Err(ExternalError::file(&path(water), problem, "sample both fields in one function object"));
    }
    let pair = |(u, share): (&Point, &Point)| Sample { z_m: u.z_m, u_m_s: u.values[0], water: share.values[0] };
    Ok(velocity.iter().zip(&shares).map(pair).collect())
}

/// A point of a sampled line: level z [m] and field values.
struct Point {
    z_m: f64,
    values: Vec<f64>,
}

/// Reads the points of a file with `values` field values per point. Some types of line list a point on a cell face
/// twice; only the first entry is kept.
fn read_points(frame: Frame, path: &Path, values: usize) -> Result<Vec<Point>, ExternalError> {
    let text =
        TextFile::read(path, "sample `fields (U alpha.water)` with `setFormat raw`, and check the name of the line")?;
    let mut points: Vec<Point> = Vec::new();
    for (line, words) in text.lines().filter(|(_, words)| !words.starts_with('#')) {
        let mut numbers = text.numbers_in_brackets(line, words)?;
        // A row has one coordinate along the axis, or all three coordinates.
        let coordinates = numbers.len().checked_sub(values).filter(|c| [1, 3].contains(c));
        let Some(coordinates) = coordinates else {
            let problem = format!("{} numbers, expected {} or {}", numbers.len(), values + 1, values + 3);
            return Err(text.line_error(
                line,
                problem,
                "write one or three coordinates, then the values of the fields that the file name lists",
            ));
        };
        let values = numbers.split_off(coordinates);
        let point = <[f64; 3]>::try_from(numbers.as_slice()).unwrap_or([numbers[0]; 3]);
        let z_m = frame.z(point);
        if points.last().is_none_or(|last| last.z_m != z_m) {
            points.push(Point { z_m, values });
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::Up;
    use super::*;
    use crate::waves::external::table::Layers;

    const PLACE: Place = Place { bed_z_m: 0.0, still_water_z_m: 0.7, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };

    /// Creates a folder with the same files at 0 s, 0.5 s and 1 s.
    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for time in ["0", "0.5", "1"] {
            fs::create_dir(folder.path().join(time)).unwrap();
            for (name, text) in files {
                fs::write(folder.path().join(time).join(name), text).unwrap();
            }
        }
        folder
    }

    fn lines(folder: &Path, water: Option<&'static str>) -> Result<VelocityTable, ExternalError> {
        let frame = Frame { up: Up::Z, origin_z_m: 0.0 };
        read(&Vertical { folder, velocity: "U", water, frame, surface: None }, "gauge", &PLACE)
    }

    #[test]
    fn both_layouts_and_both_kinds_of_coordinates_are_read() {
        let u = "0.25 \t1 \t0 \t0\n0.5 \t2 \t0 \t0\n0.5 \t2 \t0 \t0\n0.75 \t6 \t0 \t0\n";
        let alpha = "0.25 \t1\n0.5 \t0.8\n0.5 \t0.8\n0.75 \t0.3\n";
        let separate = folder(&[("gauge_U.xy", u), ("gauge_alpha.water.xy", alpha)]);
        let table = lines(separate.path(), Some("alpha.water")).unwrap();
        assert_eq!(table.times_s, [0.0, 0.5, 1.0]);
        assert_eq!((&table.heights_m[2], &table.velocities_m_s[2]), (&vec![0.25, 0.5], &vec![1.0, 2.0]));
        assert_eq!(lines(separate.path(), None).unwrap().heights_m[0], [0.25, 0.5, 0.75]);
        let joined = "3 0 0.25 1 1 0 0\n3 0 0.5 0.8 2 0 0\n3 0 0.75 0.3 6 0 0\n";
        let joined = folder(&[("gauge_alpha.water_U.xy", joined)]);
        assert_eq!(lines(joined.path(), Some("alpha.water")).unwrap(), table);
        let spreadsheet = "\u{feff}0,25\t1\t1D0\t0\t0\r\n0,5\t0,8\t2\t0\t0\r\n0,75\t0,3\t6\t0\t0\r\n\r\n";
        let joined = folder(&[("gauge_alpha.water_U.xy", spreadsheet)]);
        assert_eq!(lines(joined.path(), Some("alpha.water")).unwrap(), table);
    }

    #[test]
    fn errors_name_the_file_and_the_problem() {
        let message = |files: &[(&str, &str)], water| lines(folder(files).path(), water).unwrap_err().to_string();
        let missing = message(&[], None);
        assert!(
            missing.contains("0/gauge_U.xy: cannot be read: ") && missing.contains("; sample `fields"),
            "{missing}"
        );
        let ragged = message(&[("gauge_U.xy", "0.25 1 0 0\n0.5 2 0\n")], None);
        assert!(ragged.contains("0/gauge_U.xy: line 2: 3 numbers, expected 4 or 6; write one or three"), "{ragged}");
        let files = [("gauge_U.xy", "0.25 1 0 0\n0.5 2 0 0\n"), ("gauge_alpha.water.xy", "0.25 1\n")];
        assert!(message(&files, Some("alpha.water")).contains("1 volume fraction(s), but 2 velocities; sample both"));
    }
}
