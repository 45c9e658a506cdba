//! Output of `probes`: `postProcessing/<name>/<t0>/U` with lines `# Probe 0 (x y z)` and one row `t (ux uy uz) ...` per
//! time.
//!
//! The file `alpha.water` in the same folder has the volume fraction of water, which shows which probes are in air. A
//! probe outside the mesh has `# Not Found` after its position. It has either a value of -1e300 or, with
//! `includeOutOfBounds false`, no value.

use std::io::{self, Write};
use std::path::Path;

use super::super::error::ExternalError;
use super::super::numbers;
use super::super::surface::SurfaceSeries;
use super::super::table::{Place, VelocityTable};
use super::frame::Frame;
use super::samples::{OUTSIDE_MESH, Sample, SampledSurface, Vertical, in_water};
use super::starts::Joined;

/// Largest horizontal distance between probes that count as one vertical line [m].
const ONE_PLACE_M: f64 = 1e-3;

/// Reads the velocities at the probes on a vertical line and leaves out values in air.
///
/// # Errors
/// If a file cannot be read, a line is wrong, or the probes are not on one vertical line. Also if the probes or times
/// of velocity and volume fraction differ, or the values fail the checks of [`VelocityTable::checked`].
pub fn read(probes: &Vertical, place: &Place) -> Result<VelocityTable, ExternalError> {
    let velocity = Joined::read(probes.folder, probes.velocity)?;
    let points = Points::from_comments(&velocity, 3, probes.folder, probes.velocity)?;
    let levels_m = points.levels_m(probes)?;
    let water = probes.water.map(|name| read_water(probes.folder, name, &velocity, &points)).transpose()?;
    let (mut heights_m, mut velocities_m_s, mut sampled) = (Vec::new(), Vec::new(), SampledSurface::default());
    for (i, row) in velocity.rows.iter().enumerate() {
        let share = |probe: usize| water.as_ref().map_or(1.0, |rows| rows[i][probe]);
        let sample = |(probe, &z_m): (usize, &f64)| Sample { z_m, u_m_s: row[3 * probe], water: share(probe) };
        let samples: Vec<Sample> = levels_m.iter().enumerate().map(sample).collect();
        sampled.add(&samples);
        let (heights, velocities) = in_water(&samples);
        heights_m.push(heights);
        velocities_m_s.push(velocities);
    }
    sampled.check(probes.folder, place)?;
    let surface_z_m = probes.surface.map(|surface| surface.at_times(&velocity.times_s)).transpose()?;
    VelocityTable { times_s: velocity.times_s, surface_z_m, heights_m, velocities_m_s }.checked(probes.folder, place)
}

/// Reads the surface level from the volume fraction of water on a vertical line: the level of the lowest probe plus the
/// depth of water between the lowest and the highest probe. There must be only water below the lowest probe.
///
/// # Errors
/// See [`read`].
pub fn read_surface(folder: &Path, water: &str, frame: Frame) -> Result<SurfaceSeries, ExternalError> {
    let joined = Joined::read(folder, water)?;
    let vertical = Vertical { folder, velocity: water, water: None, frame, surface: None };
    let levels_m = Points::from_comments(&joined, 1, folder, water)?.levels_m(&vertical)?;
    let in_mesh = |probe: &usize| joined.rows[0][*probe].abs() < OUTSIDE_MESH;
    let mut upwards: Vec<usize> = (0..levels_m.len()).filter(in_mesh).collect();
    if upwards.is_empty() {
        let problem = format!("no probe of `{water}` is inside the mesh");
        return Err(ExternalError::file(folder, problem, "check the positions of the probes"));
    }
    upwards.sort_by(|&a, &b| levels_m[a].total_cmp(&levels_m[b]));
    let surface = |row: &Vec<f64>| {
        let between = |pair: &[usize]| 0.5 * (row[pair[0]] + row[pair[1]]) * (levels_m[pair[1]] - levels_m[pair[0]]);
        levels_m[upwards[0]] + upwards.windows(2).map(between).sum::<f64>()
    };
    let z_m = joined.rows.iter().map(surface).collect();
    SurfaceSeries::new(folder, joined.times_s, z_m)
}

/// Positions of the probes that have values.
#[derive(PartialEq)]
struct Points(Vec<[f64; 3]>);

impl Points {
    /// Reads the positions of the probes from the comments in the file of a field with `components` components.
    fn from_comments(joined: &Joined, components: usize, folder: &Path, field: &str) -> Result<Self, ExternalError> {
        let probes: Vec<([f64; 3], bool)> = joined.comments.iter().filter_map(|comment| parse_probe(comment)).collect();
        let columns = joined.rows.first().map_or(components * probes.len(), Vec::len);
        let found = |&(point, found): &([f64; 3], bool)| found.then_some(point);
        let points = if columns == components * probes.len() {
            probes.iter().map(|&(point, _)| point).collect()
        } else {
            probes.iter().filter_map(found).collect::<Vec<_>>()
        };
        if columns == components * points.len() && !points.is_empty() {
            return Ok(Self(points));
        }
        Err(ExternalError::file(
            folder,
            format!("`{field}` has {columns} columns for {} probes", probes.len()),
            format!("it must have {components} column(s) per probe, and a line `# Probe 0 (x y z)` per probe"),
        ))
    }

    /// Returns the levels z of the probes [m]; an error if the probes are not on one vertical line.
    fn levels_m(&self, probes: &Vertical) -> Result<Vec<f64>, ExternalError> {
        let first = probes.frame.place(self.0[0]);
        let is_off_vertical = |point: &&[f64; 3]| {
            let position = probes.frame.place(**point);
            (position[0] - first[0]).abs().max((position[1] - first[1]).abs()) > ONE_PLACE_M
        };
        match self.0.iter().find(is_off_vertical) {
            None => Ok(self.0.iter().map(|&point| probes.frame.z(point)).collect()),
            Some(point) => Err(ExternalError::file(
                probes.folder,
                format!("the probes at {} and {} are not on one vertical line", in_words(self.0[0]), in_words(*point)),
                "write one vertical line per function object, and check the vertical axis",
            )),
        }
    }
}

/// Formats a point for messages.
fn in_words(point: [f64; 3]) -> String {
    format!("({})", point.map(numbers::as_text).join(" "))
}

/// Parses the comment line of a probe. Returns its position, and true if it is inside the mesh.
fn parse_probe(comment: &str) -> Option<([f64; 3], bool)> {
    let (position, remark) = comment.strip_prefix("Probe")?.split_once('(')?.1.split_once(')')?;
    let numbers: Vec<f64> = position.split_whitespace().map_while(numbers::parse).collect();
    Some((numbers.try_into().ok()?, !remark.contains("Not Found")))
}

/// Reads the volume fractions of water, which must have the same probes and times as the velocity.
fn read_water(folder: &Path, field: &str, velocity: &Joined, points: &Points) -> Result<Vec<Vec<f64>>, ExternalError> {
    let water = Joined::read(folder, field)?;
    if Points::from_comments(&water, 1, folder, field)? == *points && water.times_s == velocity.times_s {
        return Ok(water.rows);
    }
    let problem = format!("the probes or times of `{field}` differ from those of the velocity");
    Err(ExternalError::file(folder, problem, "sample both fields in one function object"))
}

/// Writes the velocities at the position x [m] and the given levels z [m] in the format of `probes`, with all digits.
///
/// # Errors
/// If writing fails.
pub fn write_velocities(
    table: &VelocityTable,
    levels_m: &[f64],
    x_m: f64,
    frame: Frame,
    out: impl Write,
) -> io::Result<()> {
    let value = |z: f64, t: f64| format!("({} 0 0)", table.velocity_m_s(z, t));
    write_field(&table.times_s, levels_m, x_m, frame, value, out)
}

/// Writes the volume fraction of water at the probes of [`write_velocities`]: 1 up to the surface and 0 above it. If
/// the table has no surface levels, the volume fraction is 1 everywhere.
///
/// # Errors
/// If writing fails.
pub fn write_water(table: &VelocityTable, levels_m: &[f64], x_m: f64, frame: Frame, out: impl Write) -> io::Result<()> {
    let value = |z: f64, t: f64| u8::from(table.surface_at_m(t).is_none_or(|surface| z <= surface)).to_string();
    write_field(&table.times_s, levels_m, x_m, frame, value, out)
}

fn write_field(
    times_s: &[f64],
    levels_m: &[f64],
    x_m: f64,
    frame: Frame,
    value: impl Fn(f64, f64) -> String,
    mut out: impl Write,
) -> io::Result<()> {
    for (probe, &z) in levels_m.iter().enumerate() {
        let [x, y, z] = frame.point(x_m, z);
        writeln!(out, "# Probe {probe} ({x} {y} {z})")?;
    }
    let numbers: String = (0..levels_m.len()).map(|probe| format!(" {probe:>13}")).collect();
    writeln!(out, "#{:>12}{numbers}\n#{:>12}", "Probe", "Time")?;
    for &t in times_s {
        let values: String = levels_m.iter().map(|&z| format!(" {:>13}", value(z, t))).collect();
        writeln!(out, "{t:>13}{values}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::Up;
    use super::*;
    use crate::waves::external::table::Layers;

    const PLACE: Place = Place { bed_z_m: -1.0, still_water_z_m: 0.0, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
    const FRAME: Frame = Frame { up: Up::Y, origin_z_m: -1.0 };
    const LEVELS: [f64; 4] = [-0.75, -0.5, -0.25, 0.125];

    /// Probes under a surface that rises and falls by 0.2 m; the uppermost probe is sometimes in air.
    fn table(first: i32, last: i32, shift: f64) -> VelocityTable {
        let times_s: Vec<f64> = (first..last).map(|i| 0.125 * f64::from(i)).collect();
        let surface: Vec<f64> = times_s.iter().map(|t| 0.2 * (2.0 * t).sin()).collect();
        let velocities = |t: &f64| LEVELS.iter().map(|z| shift + (1.0 + z) * t.sin()).collect();
        VelocityTable {
            surface_z_m: Some(surface),
            heights_m: vec![LEVELS.to_vec(); times_s.len()],
            velocities_m_s: times_s.iter().map(velocities).collect(),
            times_s,
        }
    }

    fn write_start(folder: &Path, start: &str, table: &VelocityTable) {
        let folder = folder.join(start);
        fs::create_dir(&folder).unwrap();
        write_velocities(table, &LEVELS, 2.0, FRAME, fs::File::create(folder.join("U")).unwrap()).unwrap();
        write_water(table, &LEVELS, 2.0, FRAME, fs::File::create(folder.join("alpha.water")).unwrap()).unwrap();
    }

    fn probes(folder: &Path) -> Vertical<'_> {
        Vertical { folder, velocity: "U", water: Some("alpha.water"), frame: FRAME, surface: None }
    }

    #[test]
    fn written_probes_are_read_back_without_air() {
        let folder = tempfile::tempdir().unwrap();
        let table = table(0, 30, 0.0);
        write_start(folder.path(), "0", &table);
        let back = read(&probes(folder.path()), &PLACE).unwrap();
        assert_eq!(back.times_s, table.times_s);
        let mut in_air = 0;
        for (i, &surface) in table.surface_z_m.iter().flatten().enumerate() {
            let wet = if surface < LEVELS[3] { 3 } else { 4 };
            in_air += 4 - wet;
            assert_eq!(back.heights_m[i], LEVELS[..wet]);
            assert_eq!(back.velocities_m_s[i], table.velocities_m_s[i][..wet]);
        }
        assert!(in_air > 5);
        let surface =
            SurfaceSeries::new(folder.path(), table.times_s.clone(), table.surface_z_m.clone().unwrap()).unwrap();
        let below = read(&Vertical { surface: Some(&surface), ..probes(folder.path()) }, &PLACE).unwrap();
        assert_eq!((below.surface_z_m, below.heights_m), (table.surface_z_m, back.heights_m));
        let all =
            read(&Vertical { water: None, ..probes(folder.path()) }, &Place { still_water_z_m: 0.2, ..PLACE }).unwrap();
        assert_eq!(all.heights_m, table.heights_m);
    }

    #[test]
    fn restart_replaces_the_end_of_the_earlier_run() {
        let folder = tempfile::tempdir().unwrap();
        write_start(folder.path(), "0", &table(0, 20, 0.0));
        write_start(folder.path(), "1.5", &table(13, 30, 0.5));
        let back = read(&probes(folder.path()), &PLACE).unwrap();
        assert_eq!(back.times_s, table(0, 30, 0.0).times_s);
        assert_eq!(back.velocity_m_s(-0.5, 1.5), 0.5 * 1.5_f64.sin());
        assert_eq!(back.velocity_m_s(-0.5, 1.625), 0.5 + 0.5 * 1.625_f64.sin());
    }

    #[test]
    fn probes_outside_the_mesh_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("0")).unwrap();
        let head =
            "# Probe 0 (2 0.25 0)\n# Probe 1 (2 9 0)  # Not Found\n# Probe 2 (2 0.5 0)\n#  Probe 0 1 2\n#  Time\n";
        let rows = "0 (1 0 0) (-1e+300 -1e+300 -1e+300) (2 0 0)\n1 (1 0 0) (-1e+300 -1e+300 -1e+300) (2 0 0)\n";
        let read = |rows: &str| {
            fs::write(folder.path().join("0/U"), format!("{head}{rows}")).unwrap();
            read(&Vertical { water: None, ..probes(folder.path()) }, &PLACE).unwrap()
        };
        let with = read(rows);
        assert_eq!((&with.heights_m[1], &with.velocities_m_s[1]), (&vec![-0.75, -0.5], &vec![1.0, 2.0]));
        // OpenFOAM writes the same file without these values if `includeOutOfBounds` is false.
        assert_eq!(read(&rows.replace(" (-1e+300 -1e+300 -1e+300)", "")), with);
    }

    #[test]
    fn error_names_probes_that_do_not_match() {
        let folder = tempfile::tempdir().unwrap();
        write_start(folder.path(), "0", &table(0, 5, 0.0));
        let message = |probes: Vertical| read(&probes, &PLACE).unwrap_err().to_string();
        let up = Vertical { frame: Frame { up: Up::Z, origin_z_m: 0.0 }, ..probes(folder.path()) };
        assert!(message(up).contains("are not on one vertical line; write one vertical line per function object"));
        assert!(
            message(Vertical { velocity: "alpha.water", ..up })
                .contains("`alpha.water` has 4 columns for 4 probes; it must")
        );
        assert!(
            message(Vertical { water: Some("alpha"), ..probes(folder.path()) }).contains("has a file `alpha`; give")
        );
        let path = folder.path().join("0/alpha.water");
        let shorter = fs::read_to_string(&path).unwrap().trim_end().rsplit_once('\n').unwrap().0.to_owned();
        fs::write(path, shorter).unwrap();
        assert!(message(probes(folder.path())).ends_with(
            "the probes or times of `alpha.water` differ from those of the velocity; sample both fields in one \
             function object"
        ));
    }
}
