//! Function object `interfaceHeight`: surface level at its locations, integrated from the water above them.
//!
//! `position.dat` has rows `t (x y z) (x y z) ...` with the position of the surface for each location. `height.dat` has
//! `t hB hL hB hL ...` with its height above the boundary below and above the location.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::surface::SurfaceSeries;
use super::frame::Frame;
use super::starts::Joined;

/// Reads the surface level from `<folder>/<t0>/position.dat`, at a location counted from 0.
///
/// # Errors
/// If a file cannot be read, a line is wrong, the location does not exist, or times have a gap.
pub fn read_position(folder: &Path, frame: Frame, location: usize) -> Result<SurfaceSeries, ExternalError> {
    read(folder, "position.dat", 3, location, |point| frame.z([point[0], point[1], point[2]]))
}

/// Reads the surface level from `<folder>/<t0>/height.dat` and the bed level z [m], at a location counted from 0.
///
/// # Errors
/// If a file cannot be read, a line is wrong, the location does not exist, or times have a gap.
pub fn read_height(folder: &Path, bed_z_m: f64, location: usize) -> Result<SurfaceSeries, ExternalError> {
    read(folder, "height.dat", 2, location, |heights| bed_z_m + heights[0])
}

fn read(
    folder: &Path,
    file: &str,
    columns: usize,
    location: usize,
    level: impl Fn(&[f64]) -> f64,
) -> Result<SurfaceSeries, ExternalError> {
    let joined = Joined::read(folder, file)?;
    let locations = joined.rows.first().map_or(0, Vec::len) / columns;
    if location >= locations {
        return Err(ExternalError::file(
            folder,
            format!("no location {location} in `{file}`, which has {locations} location(s)"),
            "give the number of a location, counted from 0",
        ));
    }
    let at_location = |row: &Vec<f64>| level(&row[columns * location..columns * (location + 1)]);
    SurfaceSeries::new(folder, joined.times_s, joined.rows.iter().map(at_location).collect())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::Up;
    use super::*;

    #[test]
    fn positions_and_heights_give_the_same_level() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("0")).unwrap();
        let position = "# Location 0 : (1 0 0)\n# Location 1 : (5 0 0)\n# p : Interface position\n# Time\n\
                        0 \t(  1  1.5  0) (  5  2  0) \n0.1 \t(  1  1.5  0) (  5  2.5  0) \n";
        let height = "# Location 0 : (1 0 0)\n# Time  hB hL hB hL\n0 \t 1.5 1.5 2 2\n0.1 \t 1.5 1.5 2.5 2.5\n";
        fs::write(folder.path().join("0/position.dat"), position).unwrap();
        fs::write(folder.path().join("0/height.dat"), height).unwrap();
        let frame = Frame { up: Up::Y, origin_z_m: -2.0 };
        let surface = read_position(folder.path(), frame, 1).unwrap();
        assert_eq!(surface.at_times(&[0.0, 0.1]).unwrap(), [0.0, 0.5]);
        assert_eq!(read_height(folder.path(), -2.0, 1).unwrap(), surface);
        assert!(read_height(folder.path(), -2.0, 2).unwrap_err().to_string().ends_with(
            ": no location 2 in `height.dat`, which has 2 location(s); give the number of a location, counted from 0"
        ));
    }
}
