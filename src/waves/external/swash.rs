//! SWASH tables: water level and layer velocities at one point over time.
//!
//! Example commands are `TABLE 'P' NOHEADER 'level.tbl' TSEC WATL OUTPUT 0 0.1 SEC` and
//! `TABLE 'P' HEADER 'velocity.tbl' TSEC VELK OUTPUT 0 0.1 SEC`. The point set `'P'` must have exactly one point. The
//! format follows the SWASH user manual (11.01A, sections 4.6.2 and 5.1) and source code:
//!
//! | item | format |
//! | --- | --- |
//! | columns | in the order of the command, separated by blanks; one row per time and point |
//! | `HEADER` | lines that begin with `%`; one line has the short names of the columns, the next line their units |
//! | `NOHEADER` | rows only |
//! | short names | `Tsec`, `Watlev`; `Vksi` and `X-vel` are depth-averaged, `Vksi_k` and `X-vel_k` are per layer |
//! | `VELK` | x components of all layers, then y components of all layers |
//! | `VKSIK` | velocity of every layer along the x direction of the grid, without y components |
//! | layers | from the surface downwards; thicknesses relative to the depth (fixed thicknesses are not supported) |
//! | `WATL` | water level [m]; 0 is still water, unless `SET LEVEL` or an input grid shifts the datum of the run |
//!
//! The number in a column name gives the layer; without numbers, the order of the columns gives the layer. The third
//! format, `TABLE ... SWASH`, is not supported. Velocities are in m/s along x of SWASH.

mod columns;
mod write;

use std::path::Path;

use super::error::ExternalError;
use super::surface::SurfaceSeries;
use super::table::{Place, VelocityTable};
use columns::Table;

pub use columns::{Column, velk_columns};
pub use write::{Heading, write_level, write_velocities};

/// A table file and its columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableFile<'a> {
    /// The file.
    pub path: &'a Path,
    /// Columns in file order; needed only if the file has no header with their names.
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
}

/// Reads the tables of one point; each velocity applies at mid-height of its layer.
///
/// `WATL` = 0 must be the still water level in the run of SWASH.
///
/// # Errors
/// If a file cannot be read, a column is missing, a line is wrong, or the values fail the checks of
/// [`VelocityTable::checked`].
pub fn read(tables: &Tables, place: &Place) -> Result<VelocityTable, ExternalError> {
    let level = Table::read(&tables.level)?;
    let levels = level.column(Column::Watl)?.into_iter().map(|watl| place.still_water_z_m + watl).collect();
    let surface = SurfaceSeries::new(tables.level.path, level.column(Column::Tsec)?, levels)?;

    let table = Table::read(&tables.velocity)?;
    let times_s = table.column(Column::Tsec)?;
    let layers = table.layers()?;
    let shares = shares(tables, layers.len())?;
    let surface_z_m = surface.at_times(&times_s)?;
    let heights_m = surface_z_m.iter().map(|&z| layer_middles(place.bed_z_m, z, &shares)).collect();
    // SWASH counts layers from the surface downwards; a velocity table counts levels from the bed upwards.
    let velocities_m_s = (0..times_s.len()).map(|i| layers.iter().rev().map(|layer| layer[i]).collect()).collect();
    VelocityTable { times_s, surface_z_m: Some(surface_z_m), heights_m, velocities_m_s }
        .checked(tables.velocity.path, place)
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
        format!("{layers} layers, but {given} layer shares that add up to {sum}"),
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
            &Tables { level, velocity: TableFile { path: velocity, columns: columns[1] }, layer_shares: &SHARES },
            &PLACE,
        )
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
        let (_keep, level, velocity) = folder(Heading::None);
        assert!(message(&level, &velocity).ends_with(
            "level.tbl: line 1: no header with the column names; list the columns in file order, or write with HEADER"
        ));
    }

    #[test]
    fn shares_must_match_the_layers() {
        let (_keep, level, velocity) = folder(Heading::Names);
        let file = |path| TableFile { path, columns: &[] };
        let tables = Tables { level: file(&level), velocity: file(&velocity), layer_shares: &[0.5, 0.4] };
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
        let tables = Tables { level: file, velocity: file, layer_shares: &[] };
        let error = read(&tables, &PLACE).unwrap_err();
        assert_eq!(error, ExternalError::TooFewLayers { file: path.clone(), time_s: 0.0, layers: 1 });
        let back = read(&tables, &Place { layers: Layers::DepthAveraged, ..PLACE }).unwrap();
        assert!((back.velocity_m_s(0.2, 1.5) - 0.25).abs() < 1e-12);
    }
}
