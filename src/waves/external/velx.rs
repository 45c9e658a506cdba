//! Conversion from and to DualSPHysics' `_velx` files ([`crate::waves::generation::velx`]).
//!
//! Line 1 is `px:;x;py:;y`, line 2 is `time;pz_0;...;vel_0;...`. Each further line has a time, the levels and the
//! velocities. Semicolons separate the values, or commas (option `-csvsep:1` of DualSPHysics' tools). The levels rise
//! or fall in the whole file. They can count from different levels:
//!
//! | file | level 0 |
//! | --- | --- |
//! | of breakwater | z = 0 |
//! | for a case of DualSPHysics | z = 0, plus the offset `incz` of the case |
//! | of SWASH, through DualSPHysics' `ReadSwash` | the datum of SWASH, normally the still water |
//! | of pydsphtools (`mlpistons1d_from_dsph`) | the surface at the same time; the levels fall |

use std::path::Path;

use super::error::ExternalError;
use super::numbers::as_text;
use super::table::{Place, VelocityTable, median};
use super::text_file::{TextFile, split};
use crate::waves::generation::velx::Velx;

/// Level from which the levels of a `_velx` file count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LevelsFrom {
    /// The given origin, or z = 0 if none is given.
    Origin,
    /// z = 0; but the levels would also be in the water if they counted from the still water level.
    OriginRatherThanStillWater,
    /// The still water level, because no level is in the water if the levels are z.
    StillWater,
    /// The surface at the same time, which is the still water level at rest.
    Surface,
}

/// Reads a `_velx` file. `origin_z_m` is the level z at the level 0 of the file [m]; if it is not given, the levels
/// decide.
///
/// # Errors
/// If the file cannot be read, a line is wrong, the levels are not in the water, or the values fail the checks of
/// [`VelocityTable::checked`].
pub fn read(path: &Path, origin_z_m: Option<f64>, place: &Place) -> Result<(VelocityTable, LevelsFrom), ExternalError> {
    let mut velx = parse(&TextFile::read(path, "give the path of a `_velx` file")?)?;
    order_upwards(&mut velx, path)?;
    let (from, origins_m) = match origin_z_m {
        Some(origin) => (LevelsFrom::Origin, vec![origin; velx.times_s.len()]),
        None => find_origins(&velx, path, place)?,
    };
    for (levels, origin) in velx.heights_m.iter_mut().zip(origins_m) {
        levels.iter_mut().for_each(|level| *level += origin);
    }
    let Velx { times_s, heights_m, velocities_m_s, .. } = velx;
    let table = VelocityTable { times_s, surface_z_m: None, heights_m, velocities_m_s }.checked(path, place)?;
    Ok((table, from))
}

/// Parses a file.
fn parse(text: &TextFile) -> Result<Velx, ExternalError> {
    let advice = "give a `_velx` file of DualSPHysics' multi-layer piston, without changes to its first two lines";
    let mut lines = text.lines();
    let (line, first) = lines.next().unwrap_or((1, ""));
    let separator = [';', ','].into_iter().find(|&separator| first.contains(separator)).unwrap_or('\t');
    let position_m = match split(first, separator)[..] {
        ["px:", x, "py:", y] => [text.number(line, x)?, text.number(line, y)?],
        _ => return Err(text.line_error(line, "expected `px:;<x>;py:;<y>`", advice)),
    };
    let (line, names) = lines.next().unwrap_or((line + 1, ""));
    let names = split(names, separator);
    let rows = names.iter().filter(|name| name.starts_with("pz")).count();
    let is_velocity = |name: &&str| name.starts_with("vel");
    let are_in_order = names.len() == 1 + 2 * rows
        && names[1..=rows].iter().all(|name| name.starts_with("pz"))
        && names[rows + 1..].iter().all(is_velocity);
    if rows == 0 || !are_in_order {
        return Err(text.line_error(line, "expected `time;pz_0;pz_1;...;vel_0;vel_1;...`", advice));
    }
    let mut velx = Velx { position_m, times_s: vec![], heights_m: vec![], velocities_m_s: vec![] };
    for (line, row) in lines {
        let words = split(row, separator);
        if words.len() != 1 + 2 * rows {
            let problem = format!(
                "{} fields, expected {}: time, {rows} height(s) `pz`, {rows} velocity value(s) `vel`",
                words.len(),
                1 + 2 * rows
            );
            return Err(text.line_error(line, problem, "correct or delete the line"));
        }
        let values = text.numbers(line, &words)?;
        velx.times_s.push(values[0]);
        velx.heights_m.push(values[1..=rows].to_vec());
        velx.velocities_m_s.push(values[rows + 1..].to_vec());
    }
    Ok(velx)
}

/// Reverses the levels if they fall in the first row; an error if they are not in the same order in all rows.
fn order_upwards(velx: &mut Velx, path: &Path) -> Result<(), ExternalError> {
    let falls = velx.heights_m.first().is_some_and(|levels| levels[0] > levels[levels.len() - 1]);
    for ((&t, levels), velocities) in velx.times_s.iter().zip(&mut velx.heights_m).zip(&mut velx.velocities_m_s) {
        let is_in_order = |pair: &&[f64]| if falls { pair[1] < pair[0] } else { pair[1] > pair[0] };
        if let Some(pair) = levels.windows(2).find(|pair| !is_in_order(pair)) {
            let problem = format!(
                "the level {} m follows the level {} m, but the levels of the file {}",
                as_text(pair[1]),
                as_text(pair[0]),
                if falls { "fall" } else { "rise" }
            );
            return Err(ExternalError::moment(
                path,
                t,
                problem,
                "list every level once, in the same order at every time",
            ));
        }
        if falls {
            levels.reverse();
            velocities.reverse();
        }
    }
    Ok(())
}

/// Finds the level z at the level 0 of the file [m], one per time.
fn find_origins(velx: &Velx, path: &Path, place: &Place) -> Result<(LevelsFrom, Vec<f64>), ExternalError> {
    let ends: Vec<[f64; 2]> = velx.heights_m.iter().map(|levels| [levels[0], levels[levels.len() - 1]]).collect();
    let lowest = ends.iter().map(|end| end[0]).fold(f64::INFINITY, f64::min);
    let highest = ends.iter().map(|end| end[1]).fold(f64::NEG_INFINITY, f64::max);
    let still = place.still_water_z_m;
    let fits = |origins: &[f64]| {
        let is_water =
            |(end, z): (&[f64; 2], &f64)| place.is_water([end[0] + z, end[1] + z], place.highest_surface_m());
        ends.iter().zip(origins).all(is_water)
    };
    let from_z = vec![0.0; ends.len()];
    let from_still_water = vec![still; ends.len()];
    if fits(&from_z) && (highest > place.bed_z_m || ends.is_empty()) {
        let is_below_water = highest <= 0.0 && still != 0.0 && fits(&from_still_water);
        let from = if is_below_water { LevelsFrom::OriginRatherThanStillWater } else { LevelsFrom::Origin };
        return Ok((from, from_z));
    }
    let from_surface = surface_levels_m(&ends, place);
    if let Some(levels) = from_surface.filter(|levels| fits(levels)) {
        return Ok((LevelsFrom::Surface, levels));
    }
    if fits(&from_still_water) {
        return Ok((LevelsFrom::StillWater, from_still_water));
    }
    let [lowest, highest, bed, still] = [lowest, highest, place.bed_z_m, still].map(as_text);
    Err(ExternalError::file(
        path,
        format!(
            "the levels, {lowest} to {highest} m, are neither in the water, z = {bed} to {still} m, nor would they be \
             if they counted from the still water level"
        ),
        "write `origin_z_m`, the level z of the case at the level 0 of the file, in `wave.source`; check the unit",
    ))
}

/// Surface level z at each time [m], if the levels count from the surface: the highest level is then constant, and the
/// lowest level, at a fixed z, moves against the surface. `ends` are the lowest and the highest level at each time.
fn surface_levels_m(ends: &[[f64; 2]], place: &Place) -> Option<Vec<f64>> {
    // The files have at least six decimals.
    let rounding = 1e-5 * place.depth_m();
    let lowest: Vec<f64> = ends.iter().map(|end| end[0]).collect();
    let first = ends.first()?;
    let highest_is_constant = ends.iter().all(|end| (end[1] - first[1]).abs() <= rounding);
    let lowest_moves = lowest.iter().any(|level| (level - first[0]).abs() > rounding);
    let at_rest = median(&lowest);
    (highest_is_constant && lowest_moves && first[1] <= 0.0)
        .then(|| lowest.iter().map(|level| place.still_water_z_m + at_rest - level).collect())
}

impl VelocityTable {
    /// Returns the velocities of piston rows at levels z [m]; `position_m` is the position x, y of the piston [m].
    pub fn velx(&self, position_m: [f64; 2], row_heights_m: &[f64]) -> Velx {
        let rows = |&t: &f64| row_heights_m.iter().map(|&z| self.velocity_m_s(z, t)).collect();
        Velx {
            position_m,
            times_s: self.times_s.clone(),
            heights_m: vec![row_heights_m.to_vec(); self.times_s.len()],
            velocities_m_s: self.times_s.iter().map(rows).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::external::table::Layers;

    const PLACE: Place = Place { bed_z_m: 0.0, still_water_z_m: 1.0, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
    const HEAD: &str = "px:;3;py:;0\ntime;pz_0;pz_1;vel_0;vel_1\n";

    fn read_at(text: &str, origin: Option<f64>, place: &Place) -> Result<(VelocityTable, LevelsFrom), String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a_velx.csv");
        std::fs::write(&path, text).unwrap();
        read(&path, origin, place).map_err(|error| error.to_string().rsplit_once("a_velx.csv: ").unwrap().1.to_owned())
    }

    /// Reads rows with two levels; the name of the levels' origin and the levels at the first time.
    fn levels(rows: &str, origin: Option<f64>, place: &Place) -> Result<(LevelsFrom, Vec<f64>), String> {
        let (table, from) = read_at(&format!("{HEAD}{rows}"), origin, place)?;
        Ok((from, table.heights_m[0].clone()))
    }

    #[test]
    fn file_is_written_back_unchanged() {
        let text = format!("{HEAD}0;0.2;0.8;0.1;0.2\n0.5;0.2;0.8;0.3;0.4\n");
        let (table, from) = read_at(&text, None, &PLACE).unwrap();
        assert_eq!((table.velocity_m_s(0.8, 0.5), from), (0.4, LevelsFrom::Origin));
        let mut back = Vec::new();
        table.velx([3.0, 0.0], &[0.2, 0.8]).write(&mut back).unwrap();
        assert_eq!(String::from_utf8(back).unwrap(), text);
    }

    #[test]
    fn falling_levels_are_the_same_table_as_rising_levels() {
        let rising = read_at(&format!("{HEAD}0;0.2;0.8;0.1;0.2\n1;0.3;0.9;0.3;0.4\n"), None, &PLACE).unwrap();
        let falling = read_at(&format!("{HEAD}0;0.8;0.2;0.2;0.1\n1;0.9;0.3;0.4;0.3\n"), None, &PLACE).unwrap();
        assert_eq!(rising, falling);
        let message = levels("0;0.8;0.2;0.2;0.1\n1;0.3;0.9;0.4;0.3\n", None, &PLACE).unwrap_err();
        assert_eq!(
            message,
            "at t = 1 s: the level 0.9 m follows the level 0.3 m, but the levels of the file fall; list every level \
             once, in the same order at every time"
        );
        let message = levels("0;0.2;0.8;0;0\n1;0.5;0.5;0;0\n", None, &PLACE).unwrap_err();
        assert!(
            message.starts_with("at t = 1 s: the level 0.5 m follows the level 0.5 m, but the levels of the file rise")
        );
    }

    #[test]
    fn levels_decide_what_they_count_from() {
        let from_still_water = "0;-0.75;-0.25;0;0\n1;-0.75;-0.25;0;0\n";
        assert_eq!(levels(from_still_water, None, &PLACE), Ok((LevelsFrom::StillWater, vec![0.25, 0.75])));
        // If the bed is below z = 0, the levels can be z.
        let deep = Place { bed_z_m: -1.0, ..PLACE };
        let z = Ok((LevelsFrom::OriginRatherThanStillWater, vec![-0.75, -0.25]));
        assert_eq!(levels(from_still_water, None, &deep), z);
        let at_zero = Place { still_water_z_m: 0.0, ..deep };
        assert_eq!(levels(from_still_water, None, &at_zero), Ok((LevelsFrom::Origin, vec![-0.75, -0.25])));
        // The lowest level is at most 0.1 d below the bed, as before, if another level is in the water.
        let low = levels("0;-0.05;0.5;0;0\n1;-0.05;0.5;0;0\n", None, &PLACE);
        assert_eq!(low, Ok((LevelsFrom::Origin, vec![-0.05, 0.5])));
        let message = levels("0;-3;-2;0;0\n1;-3;-2;0;0\n", None, &PLACE).unwrap_err();
        assert!(
            message.starts_with("the levels, -3 to -2 m, are neither in the water, z = 0 to 1 m, nor would they be")
        );
        assert!(message.contains("; write `origin_z_m`, the level z of the case at the level 0 of the file"));
    }

    #[test]
    fn given_origin_decides_and_is_checked() {
        let rows = "0;-0.75;-0.25;0;0\n1;-0.75;-0.25;0;0\n";
        assert_eq!(levels(rows, Some(0.875), &PLACE), Ok((LevelsFrom::Origin, vec![0.125, 0.625])));
        let message = levels(rows, Some(3.0), &PLACE).unwrap_err();
        assert!(
            message
                .contains("the level z = 2.25 m is not in the water, 0 to 2 m; check the origin of z (`origin_z_m`)")
        );
    }

    #[test]
    fn levels_that_count_from_the_moving_surface_follow_it() {
        // A crest of 0.5 m: the lowest level stays at z = 0.1 m, and the highest level is 0.1 m below the surface.
        let rows = "0;-0.1;-0.9;0.2;0.1\n1;-0.1;-1.4;0.4;0.3\n2;-0.1;-0.9;0.2;0.1\n";
        let (table, from) = read_at(&format!("{HEAD}{rows}"), None, &PLACE).unwrap();
        assert_eq!(from, LevelsFrom::Surface);
        for (levels, expected) in table.heights_m.iter().zip([[0.1, 0.9], [0.1, 1.4], [0.1, 0.9]]) {
            // Adding and subtracting the levels rounds them.
            assert!(levels.iter().zip(expected).all(|(z, expected)| (z - expected).abs() < 1e-12), "{levels:?}");
        }
        assert_eq!(table.velocities_m_s[1], [0.3, 0.4]);
    }

    #[test]
    fn files_from_other_systems_are_read_or_refused_with_their_line() {
        let plain = read_at(&format!("{HEAD}0;0.2;0.8;0.1;0.2\n0.5;0.2;0.8;0.3;0.4\n"), None, &PLACE).unwrap();
        for text in [
            "\u{feff}px:;3;py:;0\r\ntime;pz_0;pz_1;vel_0;vel_1\r\n0;0.2;0.8;0.1;0.2\r\n0.5;0.2;0.8;0.3;0.4\r\n\r\n",
            "px:;3,0;py:;0;;\ntime;pz_0;pz_1;vel_0;vel_1\n0;0,2;0,8;0,1;0,2;\n0,5;0,2;0,8;0,3;0,4;\n;;;\n",
            "px:,3,py:,0\ntime,pz_0,pz_1,vel_0,vel_1\n0,0.2,0.8,0.1,0.2,\n0.5,0.2,0.8,0.3,0.4\n",
            "px:\t3\tpy:\t0\ntime\tpz_0\tpz_1\tvel_0\tvel_1\n0\t2D-1\t8.0d-01\t1E-1\t0.2\n0.5\t0.2\t0.8\t0.3\t0.4\n",
        ] {
            assert_eq!(read_at(text, None, &PLACE), Ok(plain.clone()), "{text}");
        }
        let order = "px:;3;py:;0\ntime;pz_0;vel_0;pz_1;vel_1\n0;0.2;0.1;0.8;0.2\n";
        assert!(read_at(order, None, &PLACE).unwrap_err().starts_with("line 2: expected `time;pz_0;pz_1;...;vel_0;"));
        assert!(read_at("x;1", None, &PLACE).unwrap_err().starts_with("line 1: expected `px:;<x>;py:;<y>`; give a"));
        for (row, problem) in [
            ("0;0.2", "line 3: 2 fields, expected 5: time, 2 height(s) `pz`, 2 velocity value(s) `vel`; correct"),
            ("0;0.2;0.8;0.1;fast", "line 3: `fast` is not a number; correct or delete the line"),
            ("0;0.2;;0.1;0.2", "line 3: a value is missing; correct or delete the line"),
            ("0;0.2;0,8;0.1;0.2", "line 3: `0.2` has a decimal point, but `0,8` a comma; write decimal points only"),
        ] {
            let message = levels(row, None, &PLACE).unwrap_err();
            assert!(message.starts_with(problem), "{message}");
        }
    }

    #[test]
    fn error_names_the_missing_file() {
        let message = read(Path::new("no/such_velx.csv"), None, &PLACE).unwrap_err().to_string();
        assert!(message.starts_with("no/such_velx.csv: cannot be read: "));
        assert!(message.ends_with("; give the path of a `_velx` file"));
    }
}
