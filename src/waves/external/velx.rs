//! Conversion from and to DualSPHysics' `_velx` files ([`crate::waves::generation::velx`]). Heights in these files are
//! levels z.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use super::error::ExternalError;
use super::table::{Place, VelocityTable};
use crate::waves::generation::velx::{Velx, VelxError};

/// Reads a `_velx` file.
///
/// # Errors
/// If the file cannot be read, a line is wrong, or the values fail the checks of [`VelocityTable::checked`].
pub fn read(path: &Path, place: &Place) -> Result<VelocityTable, ExternalError> {
    let unreadable = |reason: std::io::Error| ExternalError::Read {
        file: path.to_owned(),
        reason: reason.to_string(),
        advice: "give the path of a `_velx` file".to_owned(),
    };
    let file = File::open(path).map_err(unreadable)?;
    let velx = Velx::read(BufReader::new(file)).map_err(|error| match error {
        VelxError::Io(reason) => unreadable(reason),
        VelxError::Line { line, problem } => ExternalError::Line {
            file: path.to_owned(),
            line,
            problem,
            advice: "correct or delete the line".to_owned(),
        },
    })?;
    VelocityTable::from_velx(velx, path, place)
}

impl VelocityTable {
    /// Creates the table from the `_velx` data read from `file`; the format has no surface level.
    ///
    /// # Errors
    /// If the values fail the checks of [`VelocityTable::checked`].
    pub fn from_velx(velx: Velx, file: &Path, place: &Place) -> Result<Self, ExternalError> {
        let Velx { times_s, heights_m, velocities_m_s, .. } = velx;
        Self { times_s, surface_z_m: None, heights_m, velocities_m_s }.checked(file, place)
    }

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

    #[test]
    fn file_is_written_back_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a_velx.csv");
        let text = "px:;3;py:;0\ntime;pz_0;pz_1;vel_0;vel_1\n0;0.2;0.8;0.1;0.2\n0.5;0.2;0.8;0.3;0.4\n";
        std::fs::write(&path, text).unwrap();
        let table = read(&path, &PLACE).unwrap();
        assert_eq!(table.velocity_m_s(0.8, 0.5), 0.4);
        let mut back = Vec::new();
        table.velx([3.0, 0.0], &[0.2, 0.8]).write(&mut back).unwrap();
        assert_eq!(String::from_utf8(back).unwrap(), text);
    }

    #[test]
    fn errors_name_the_missing_file_and_the_wrong_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a_velx.csv");
        let message = |path: &Path| read(path, &PLACE).unwrap_err().to_string();
        assert!(message(&path).ends_with("; give the path of a `_velx` file"));
        std::fs::write(&path, "px:;3;py:;0\ntime;pz_0;vel_0\n0;0.2\n").unwrap();
        assert!(message(&path).contains("line 3: 2 fields, expected 3: time, 1 height(s) `pz`"));
        assert!(message(&path).ends_with("; correct or delete the line"));
    }
}
