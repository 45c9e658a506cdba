//! SWASH tables: water level and layer velocities at one point over time.
//!
//! Example commands are `TABLE 'P' NOHEADER 'level.tbl' TSEC WATL OUTPUT 0 0.1 SEC` and
//! `TABLE 'P' HEADER 'velocity.tbl' TSEC VELK OUTPUT 0 0.1 SEC`. The point set `'P'` must have exactly one point. The
//! format follows the SWASH user manual (11.01A, sections 4.6.2 and 5.1) and source code:
//!
//! | item | format |
//! | --- | --- |
//! | columns | in the order of the command; one row per time and point |
//! | `HEADER` | seven lines that begin with `%`; the fifth has the short names of the columns, the sixth their units |
//! | | numbers in fixed format, 13 characters wide; asterisks replace a number that is too wide |
//! | `NOHEADER` | rows only, in floating point format |
//! | short names | `Tsec`, `Watlev`; `Vksi` and `X-vel` are depth-averaged, `Vksi_k` and `X-vel_k` are per layer |
//! | `VELK` | x components of all layers, then y components of all layers |
//! | `VKSIK` | velocity of every layer along the x direction of the grid, without y components |
//! | layers | from the surface downwards; thicknesses relative to the depth (fixed thicknesses are not supported) |
//! | `WATL` | water level [m] above the datum of the run, see below |
//! | exception value | -99 for `WATL` and 0 for velocities at a dry point; `QUANTITY ... excv=` changes them |
//!
//! `WATL` is 0 in still water, with or without `SET LEVEL`: this command adds its level to the still water depth
//! (manual, section 4.5.2, `READINP WLEVEL`; in the source code, routine `SwashCheckPrep`). Only a run with water levels
//! on an input grid (`INPGRID WLEVEL`) counts `WATL` from the datum of the bottom levels. [`Tables::origin_z_m`] is then
//! the level z of this datum.
//!
//! The number in a column name gives the layer; without numbers, the order of the columns gives the layer. The third
//! format, `TABLE ... SWASH`, is not supported. Velocities are in m/s along x of SWASH. Tables that went through a
//! spreadsheet are read too: semicolons, tabs or commas between the columns, decimal commas, names without `%`.

mod columns;
mod write;

use std::path::Path;

use super::error::ExternalError;
use super::numbers::as_text;
use super::surface::SurfaceSeries;
use super::table::{Layers, Place, VelocityTable};
use columns::Table;

pub use columns::{Column, RowTimes, velk_columns};
pub use write::{Heading, write_level, write_velocities};

/// Usual exception values of SWASH, written where a quantity has no value.
const EXCEPTIONS: [f64; 6] = [-9.0, -99.0, -999.0, -9999.0, -99_999.0, -1e10];

/// A table file and its columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableFile<'a> {
    /// The file.
    pub path: &'a Path,
    /// Columns in file order. If empty, the header of the file names the columns.
    pub columns: &'a [Column],
}

/// The SWASH tables of one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tables<'a> {
    /// Table with `TSEC` and `WATL`.
    pub level: TableFile<'a>,
    /// Table with `TSEC` and `VELK` or `VKSIK`; can be the same file as `level`.
    pub velocity: TableFile<'a>,
    /// Layer thicknesses relative to the depth, from the surface downwards, as in `VERT`; empty if all are equal.
    pub layer_shares: &'a [f64],
    /// Times of the rows of tables without `TSEC`.
    pub row_times: Option<RowTimes>,
    /// Level z at which `WATL` is 0 [m]; normally the still water level.
    pub origin_z_m: f64,
}

/// Reads the tables of one point; each velocity applies at mid-height of its layer. If `place` allows depth-averaged
/// velocities, they are read, and layer velocities are not.
///
/// # Errors
/// If a file cannot be read, a column is missing, a line is wrong, the levels do not fit the still water level, or the
/// values fail the checks of [`VelocityTable::checked`].
pub fn read(tables: &Tables, place: &Place) -> Result<VelocityTable, ExternalError> {
    let level = Table::read(&tables.level)?;
    let table = Table::read(&tables.velocity)?;
    refuse_second_times(tables, &level, &table)?;
    let surface = read_surface(tables, &level, place)?;
    let times_s = table.times_s(tables.row_times)?;
    let layers = match place.layers {
        Layers::DepthAveraged => vec![table.depth_averaged()?],
        Layers::AtLeastTwo => table.layers()?,
    };
    refuse_exceptions(tables, &times_s, &layers, place)?;
    let shares = shares(tables, layers.len())?;
    let surface_z_m = surface.at_times(&times_s)?;
    let heights_m = surface_z_m.iter().map(|&z| layer_middles(place.bed_z_m, z, &shares)).collect();
    // SWASH counts layers from the surface downwards; a velocity table counts levels from the bed upwards.
    let velocities_m_s = (0..times_s.len()).map(|i| layers.iter().rev().map(|layer| layer[i]).collect()).collect();
    VelocityTable { times_s, surface_z_m: Some(surface_z_m), heights_m, velocities_m_s }
        .checked(tables.velocity.path, place)
}

/// Refuses times of the rows if both tables already have a column with times.
fn refuse_second_times(tables: &Tables, level: &Table, velocity: &Table) -> Result<(), ExternalError> {
    if tables.row_times.is_some() && level.has(Column::Tsec) && velocity.has(Column::Tsec) {
        let problem = "the tables have a column with times, so `row_interval_s` has no effect";
        return Err(ExternalError::file(tables.velocity.path, problem, "remove `row_interval_s` and `first_row_s`"));
    }
    Ok(())
}

/// Reads the surface level, and checks that it fits the still water level.
fn read_surface(tables: &Tables, level: &Table, place: &Place) -> Result<SurfaceSeries, ExternalError> {
    let (path, times_s) = (tables.level.path, level.times_s(tables.row_times)?);
    let watl = level.column(Column::Watl)?;
    let is_dry = |&watl: &f64| EXCEPTIONS.contains(&watl) && tables.origin_z_m + watl <= place.bed_z_m;
    if let Some(i) = watl.iter().position(is_dry) {
        let problem =
            format!("the water level {} m is an exception value of SWASH: the point is dry", as_text(watl[i]));
        let advice = "choose a point that stays wet, or end the file before this time";
        return Err(ExternalError::moment(path, times_s[i], problem, advice));
    }
    let surface = SurfaceSeries::new(path, times_s, watl.iter().map(|watl| tables.origin_z_m + watl).collect())?;
    let advice = "correct `origin_z_m`, the level z at which `WATL` is 0 (default: the still water level), or \
                  `flume.still_water_level_m`";
    surface.check_datum(place, advice)?;
    Ok(surface)
}

/// Refuses exception values in the velocities.
fn refuse_exceptions(
    tables: &Tables,
    times_s: &[f64],
    layers: &[Vec<f64>],
    place: &Place,
) -> Result<(), ExternalError> {
    let is_exception = |u: &f64| EXCEPTIONS.contains(u) && u.abs() > place.fastest_m_s();
    for layer in layers {
        if let Some(i) = layer.iter().position(is_exception) {
            let problem = format!("the velocity {} m/s is an exception value of SWASH", as_text(layer[i]));
            let advice = "choose a point in the grid that stays wet, or end the file before this time";
            return Err(ExternalError::moment(tables.velocity.path, times_s[i], problem, advice));
        }
    }
    Ok(())
}

/// Layer thicknesses relative to the depth [-], from `tables`; equal thicknesses if `tables` has none.
fn shares(tables: &Tables, layers: usize) -> Result<Vec<f64>, ExternalError> {
    if tables.layer_shares.is_empty() {
        return Ok(vec![1.0 / layers as f64; layers]);
    }
    let (given, sum) = (tables.layer_shares.len(), tables.layer_shares.iter().sum::<f64>());
    // Rounded percentages, as in `VERT 3 33.3% 33.3% 33.3%`, do not add up to exactly 1.
    if given == layers && (sum - 1.0).abs() < 0.01 && tables.layer_shares.iter().all(|&share| share > 0.0) {
        return Ok(tables.layer_shares.iter().map(|share| share / sum).collect());
    }
    Err(ExternalError::file(
        tables.velocity.path,
        format!("{layers} layers, but {given} layer shares that add up to {}", as_text(sum)),
        "give one positive share of the depth per layer, from the surface downwards; they must add up to 1",
    ))
}

/// Levels z at mid-height of the layers [m], from the bed upwards.
fn layer_middles(bed_z_m: f64, surface_z_m: f64, shares: &[f64]) -> Vec<f64> {
    let mut below = 0.0;
    let middle = |share: &f64| {
        below += share;
        bed_z_m + (below - 0.5 * share) * (surface_z_m - bed_z_m)
    };
    shares.iter().rev().map(middle).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;

    use super::*;
    use crate::waves::external::table::Layers;

    const PLACE: Place = Place { bed_z_m: -0.5, still_water_z_m: 0.5, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
    const SHARES: [f64; 3] = [0.2, 0.3, 0.5];

    /// Three layers under a surface that rises and falls by 0.1 m.
    fn table() -> VelocityTable {
        let times_s: Vec<f64> = (0..20).map(|i| 0.1 * f64::from(i)).collect();
        let surface: Vec<f64> = times_s.iter().map(|t| 0.5 + 0.1 * t.sin()).collect();
        let heights_m = surface.iter().map(|&z| layer_middles(-0.5, z, &SHARES)).collect();
        let velocities_m_s = times_s.iter().map(|t| vec![0.1 * t.sin(), 0.2 * t.sin(), 0.3 * t.cos()]).collect();
        VelocityTable { times_s, surface_z_m: Some(surface), heights_m, velocities_m_s }
    }

    /// A folder with `level.tbl` and `velocity.tbl`.
    fn folder(heading: Heading) -> (tempfile::TempDir, PathBuf, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let (level, velocity) = (folder.path().join("level.tbl"), folder.path().join("velocity.tbl"));
        write_level(&table(), &PLACE, heading, fs::File::create(&level).unwrap()).unwrap();
        write_velocities(&table(), &PLACE, &SHARES, heading, fs::File::create(&velocity).unwrap()).unwrap();
        (folder, level, velocity)
    }

    fn read_both(level: &Path, velocity: &Path, columns: [&[Column]; 2]) -> Result<VelocityTable, ExternalError> {
        let level = TableFile { path: level, columns: columns[0] };
        read(
            &Tables { layer_shares: &SHARES, ..tables(level, TableFile { path: velocity, columns: columns[1] }) },
            &PLACE,
        )
    }

    fn tables<'a>(level: TableFile<'a>, velocity: TableFile<'a>) -> Tables<'a> {
        Tables { level, velocity, layer_shares: &[], row_times: None, origin_z_m: PLACE.still_water_z_m }
    }

    /// Reads one file with levels and depth-averaged velocities.
    fn averaged(text: &str, columns: &[Column], row_times: Option<RowTimes>) -> Result<VelocityTable, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("all.tbl");
        fs::write(&path, text).unwrap();
        let file = TableFile { path: &path, columns };
        read(&Tables { row_times, ..tables(file, file) }, &Place { layers: Layers::DepthAveraged, ..PLACE })
            .map_err(|error| error.to_string().rsplit_once("all.tbl: ").unwrap().1.to_owned())
    }

    fn assert_same(back: &VelocityTable) {
        let table = table();
        assert_eq!((&back.times_s, &back.velocities_m_s), (&table.times_s, &table.velocities_m_s));
        for (a, b) in back.heights_m.iter().zip(&table.heights_m) {
            // Converting to elevations above still water at z = 0.5 m and back rounds the levels.
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15));
        }
    }

    #[test]
    fn tables_with_and_without_header_are_read_back() {
        let (_keep, level, velocity) = folder(Heading::Names);
        assert_same(&read_both(&level, &velocity, [&[], &[]]).unwrap());
        let (_keep, level, velocity) = folder(Heading::None);
        let columns = velk_columns(3);
        assert_same(&read_both(&level, &velocity, [&[Column::Tsec, Column::Watl], &columns]).unwrap());
    }

    #[test]
    fn layers_are_counted_from_the_surface_downwards() {
        assert_eq!(layer_middles(-1.0, 1.0, &[0.5, 0.25, 0.25]), [-0.75, -0.25, 0.5]);
        let (_keep, level, velocity) = folder(Heading::Names);
        let back = read_both(&level, &velocity, [&[], &[]]).unwrap();
        // The first column after the time is the layer at the surface, with 0.3 m/s at t = 0.
        let text = fs::read_to_string(velocity).unwrap();
        assert!(text.lines().nth(7).unwrap().trim().starts_with("0e0 3e-1"));
        assert_eq!(back.velocity_m_s(0.5, 0.0), 0.3);
    }

    #[test]
    fn error_names_the_missing_column() {
        let (_keep, level, velocity) = folder(Heading::Names);
        let message = |level: &Path, velocity: &Path| read_both(level, velocity, [&[], &[]]).unwrap_err().to_string();
        assert!(message(&velocity, &velocity).ends_with("no column `Watlev`; add WATL to the TABLE command"));
        assert!(message(&level, &level).ends_with("no velocities; add VELK or VKSIK to the TABLE command"));
        let missing = averaged("% Tsec Watlev\n0 0\n1 0\n", &[], None).unwrap_err();
        assert_eq!(missing, "no depth-averaged velocity; add VEL or VKSI to the TABLE command");
        let (_keep, level, velocity) = folder(Heading::None);
        assert!(message(&level, &velocity).ends_with(
            "level.tbl: line 1: no header with the column names; list the columns in file order, or write with HEADER"
        ));
    }

    #[test]
    fn shares_must_match_the_layers() {
        let (_keep, level, velocity) = folder(Heading::Names);
        let file = |path| TableFile { path, columns: &[] };
        let tables = Tables { layer_shares: &[0.5, 0.4], ..tables(file(&level), file(&velocity)) };
        let message = read(&tables, &PLACE).unwrap_err().to_string();
        assert!(message.contains("3 layers, but 2 layer shares that add up to 0.9; give one positive share"));
    }

    #[test]
    fn depth_averaged_velocity_must_be_allowed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("all.tbl");
        fs::write(&path, "% Tsec Watlev X-vel Y-vel\n% [sec] [m] [m/s] [m/s]\n0 0 0.1 0\n1 0 0.2 0\n2 0 0.3 0\n")
            .unwrap();
        let file = TableFile { path: &path, columns: &[] };
        let tables = tables(file, file);
        assert_eq!(
            read(&tables, &PLACE).unwrap_err(),
            ExternalError::file(
                &path,
                "the velocities are depth-averaged",
                "write VELK of at least 2 layers; for long waves, allow depth-averaged velocities with \
                 `\"depth_averaged\": true` in `wave.source`"
            )
        );
        let back = read(&tables, &Place { layers: Layers::DepthAveraged, ..PLACE }).unwrap();
        assert!((back.velocity_m_s(0.2, 1.5) - 0.25).abs() < 1e-12);
        // A run of SWASH with one layer has the same velocity in the columns of VEL and VELK.
        let one = averaged("% Tsec Watlev Vksi_k01\n0 0 0.1\n1 0 0.2\n", &[], None).unwrap();
        assert_eq!(one.velocity_m_s(-0.4, 1.0), 0.2);
        let layers = averaged("% Tsec Watlev Vksi_k01 Vksi_k02\n0 0 0.1 0\n1 0 0.2 0\n", &[], None).unwrap_err();
        assert_eq!(layers, "no depth-averaged velocity; add VEL or VKSI to the TABLE command");
    }

    /// The file has the format of SWASH 10.01, routine SWTABP: `TABLE 'WG1' HEADER 'wg1.tbl' TSEC WATL VEL`.
    #[test]
    fn table_in_the_format_of_swash_is_read() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/waves/swash.tbl");
        let file = TableFile { path: &path, columns: &[] };
        let place = Place { bed_z_m: 0.0, layers: Layers::DepthAveraged, ..PLACE };
        let table = read(&tables(file, file), &place).unwrap();
        assert_eq!(table.times_s.len(), 101);
        assert_eq!((table.times_s[1], table.times_s[100]), (0.1, 10.0));
        // The crest at 5 s has the elevation 0.05 m and the velocity c H / (d + H) = sqrt(9.81 0.55) 0.05 / 0.55.
        assert!((table.surface_at_m(5.0).unwrap() - 0.55).abs() < 1e-4, "the file has 4 decimals");
        assert!((table.velocity_m_s(0.2, 5.0) - 0.211_166).abs() < 1e-6, "the file has 6 decimals");
    }

    #[test]
    fn tables_without_times_need_the_interval_of_their_rows() {
        let columns = [Column::Watl, Column::VelX, Column::Ignored];
        let rows = "0 0.1 0\n0.01 0.2 0\n0 0.3 0\n";
        assert_eq!(
            averaged(rows, &columns, None).unwrap_err(),
            "no column `Tsec`; add TSEC to the TABLE command, or write `row_interval_s` in `wave.source`, the time in \
             seconds between two rows"
        );
        let times = RowTimes { first_s: 2.0, interval_s: 0.25 };
        let table = averaged(rows, &columns, Some(times)).unwrap();
        assert_eq!((table.times_s.as_slice(), table.velocity_m_s(0.0, 2.25)), (&[2.0, 2.25, 2.5][..], 0.2));
        let message = averaged("% Tsec Watlev X-vel\n0 0 0.1\n1 0 0.2\n", &[], Some(times)).unwrap_err();
        assert!(message.starts_with("the tables have a column with times, so `row_interval_s` has no effect; remove"));
    }

    #[test]
    fn levels_of_another_datum_and_exception_values_are_refused() {
        let rows = |watl: [&str; 3], u: &str| {
            let rows: String = watl.iter().enumerate().map(|(t, watl)| format!("{t} {watl} {u}\n")).collect();
            averaged(&format!("% Tsec Watlev X-vel\n{rows}"), &[], None)
        };
        assert!(rows(["0", "0.04", "0"], "0").is_ok());
        for (watl, side) in [(["0.2", "0.2", "0.3"], "above"), (["-0.3", "-0.2", "-0.2"], "below")] {
            let message = rows(watl, "0").unwrap_err();
            assert!(message.contains(&format!("0.2 m {side} the still water level z = 0.5 m")), "{message}");
            assert!(message.contains("correct `origin_z_m`, the level z at which `WATL` is 0"), "{message}");
        }
        for value in ["-9", "-99.0000", "-0.99900000E+03"] {
            let message = rows(["0", value, "0"], "0").unwrap_err();
            assert!(
                message.contains("at t = 1 s: the water level") && message.contains("the point is dry"),
                "{message}"
            );
        }
        let message = rows(["0", "0", "0"], "-99").unwrap_err();
        assert!(message.contains("at t = 0 s: the velocity -99 m/s is an exception value of SWASH"), "{message}");
    }

    #[test]
    fn tables_from_other_systems_are_read_or_refused_with_their_line() {
        let plain = averaged("% Tsec Watlev X-vel\n0 0 0.1\n0.5 0.01 0.2\n", &[], None).unwrap();
        for text in [
            "\u{feff}% Tsec Watlev X-vel\r\n0 0 0.1\r\n0.5 0.01 0.2\r\n\r\n",
            "%\tTsec\tWatlev\tX-vel\n0\t0\t0.1\n0.5\t0.01\t0.2\t\n \n",
            "# Tsec Watlev X-vel\n0 0 1D-1\n5d-1 1.0D-02 0.2\n",
            "% Tsec Watlev X-vel\n0,0 0 0,1\n0,5 0,01 2,0E-1\n",
            "Tsec;Watlev;X-vel\n0;0;0,1;\n0,5;0,01;0,2;;\n",
            "Tsec,Watlev,X-vel\n0,0,0.1\n0.5,0.01,0.2,\n",
        ] {
            assert_eq!(averaged(text, &[], None).as_ref(), Ok(&plain), "{text}");
        }
        let named = [Column::Tsec, Column::Watl, Column::VelX];
        for (row, problem) in [
            ("0.5 0,01 0.2", "line 2: `0.5` has a decimal point, but `0,01` a comma; write decimal points only"),
            ("0.5 0.01", "line 2: 2 values, expected 3, one per column; correct the line, or list the columns"),
            ("0.5;;0.2", "line 2: a value is missing; correct or delete the line"),
            ("1,234.5 0 0", "line 2: `1,234.5` is not a number; write decimal points, and no separators of thousands"),
            ("0.5 0.01 fast", "line 2: `fast` is not a number; correct or delete the line"),
        ] {
            let message = averaged(&format!("0 0 0.1\n{row}\n"), &named, None).unwrap_err();
            assert!(message.starts_with(problem), "{message}");
        }
    }

    #[test]
    fn letters_of_other_encodings_may_occur_in_comments_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("all.tbl");
        let read_bytes = |bytes: &[u8]| {
            fs::write(&path, bytes).unwrap();
            let file = TableFile { path: &path, columns: &[] };
            read(&tables(file, file), &Place { layers: Layers::DepthAveraged, ..PLACE })
        };
        // 0xb0 is the degree sign in Windows-1252.
        assert!(read_bytes(b"% Lauf 3\xb0\n% Tsec Watlev X-vel\n0 0 0.1\n1 0 0.1\n").is_ok());
        let message = read_bytes(b"% Tsec Watlev X-vel\n0 0 0.1\n1 0 \xb0\n").unwrap_err().to_string();
        assert!(message.contains("line 3: `\u{fffd}` is not a number"), "{message}");
    }
}
