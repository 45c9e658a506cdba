//! Output of the function object `interfaceHeight`: the surface level at each location, integrated from the volume
//! fraction of water above the location.
//!
//! `position.dat` has rows `t (x y z) (x y z) ...` with the position of the surface at each location.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::surface::SurfaceSeries;
use super::frame::Frame;
use super::starts::Joined;

const FILE: &str = "position.dat";

/// Reads the surface level from `<folder>/<t0>/position.dat`; `location` is the number of the location, from 0.
///
/// # Errors
/// If a file cannot be read, a line is wrong, the location does not exist, or times have a gap.
pub fn read_position(folder: &Path, frame: Frame, location: usize) -> Result<SurfaceSeries, ExternalError> {
    let joined = Joined::read(folder, FILE)?;
    let locations = joined.rows.first().map_or(0, Vec::len) / 3;
    if location >= locations {
        return Err(ExternalError::file(
            folder,
            format!("no location {location} in `{FILE}`, which has {locations} location(s)"),
            "give the number of a location, counted from 0",
        ));
    }
    let at_location = |row: &Vec<f64>| frame.z([0, 1, 2].map(|k| row[3 * location + k]));
    SurfaceSeries::new(folder, joined.times_s, joined.rows.iter().map(at_location).collect())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::Up;
    use super::*;

    #[test]
    fn position_file_gives_the_level_at_a_location() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("0")).unwrap();
        let position = "# Location 0 : (1 0 0)\n# Location 1 : (5 0 0)\n# p : Interface position\n# Time\n\
                        0 \t(  1  1.5  0) (  5  2  0) \n0.1 \t(  1  1.5  0) (  5  2.5  0) \n";
        fs::write(folder.path().join("0/position.dat"), position).unwrap();
        let frame = Frame { up: Up::Y, origin_z_m: -2.0 };
        let surface = read_position(folder.path(), frame, 1).unwrap();
        assert_eq!(surface.at_times(&[0.0, 0.1]).unwrap(), [0.0, 0.5]);
        assert!(read_position(folder.path(), frame, 2).unwrap_err().to_string().ends_with(
            ": no location 2 in `position.dat`, which has 2 location(s); give the number of a location, counted from 0"
        ));
    }
}
