//! The surface at gauges, as OpenFOAM's function objects leave it.
//!
//! `interfaceHeight` writes it for all gauges together. Where that is not at hand (Debian's OpenFOAM 1912 lacks it),
//! `probes` of the share of water on a vertical tell it: the water between the lowest and the highest of them.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::surface::SurfaceSeries;
use super::frame::Frame;
use super::{interface_height, probes};

/// The surface at gauges of the given names: from the function object interfaceHeight, whose locations are the gauges
/// in their order, if its folder is given, otherwise from a folder of the gauge's name for each, with probes of
/// `water` on a vertical.
///
/// # Errors
/// If a folder or file cannot be read or understood.
pub fn read(folder: &Path, names: &[&str], water: &str, frame: Frame) -> Result<Vec<SurfaceSeries>, ExternalError> {
    if names.iter().any(|name| folder.join(name).is_dir()) {
        return names.iter().map(|name| probes::read_surface(&folder.join(name), water, frame)).collect();
    }
    (0..names.len()).map(|location| interface_height::read_position(folder, frame, location)).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::Up;
    use super::*;

    const FRAME: Frame = Frame { up: Up::Z, origin_z_m: 0.0 };

    #[test]
    fn water_on_a_vertical_and_positions_tell_the_same_surface() {
        let folder = tempfile::tempdir().unwrap();
        let start = folder.path().join("post/front/0");
        fs::create_dir_all(&start).unwrap();
        let heading = "# Probe 0 (3 0 0.1)\n# Probe 1 (3 0 0.2)\n# Probe 2 (3 0 0.3)\n# Probe 3 (3 0 0.4)\n# Time\n";
        fs::write(start.join("alpha.water"), format!("{heading}0 1 1 0 0\n0.5 1 1 0.5 0\n")).unwrap();
        let columns = read(&folder.path().join("post"), &["front"], "alpha.water", FRAME).unwrap();
        let heights = folder.path().join("heights/0");
        fs::create_dir_all(&heights).unwrap();
        fs::write(heights.join("position.dat"), "# Time\n0 (3 0 0.25)\n0.5 (3 0 0.3)\n").unwrap();
        let positions = read(&folder.path().join("heights"), &["front"], "alpha.water", FRAME).unwrap();
        for series in [&columns[0], &positions[0]] {
            let levels = series.at_times(&[0.0, 0.5]).unwrap();
            assert!((levels[0] - 0.25).abs() < 1e-12 && (levels[1] - 0.3).abs() < 1e-12, "{levels:?}");
        }
    }

    #[test]
    fn folders_that_are_not_there_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = read(&folder.path().join("none"), &["front"], "alpha.water", FRAME).unwrap_err().to_string();
        assert!(error.contains("none"), "{error}");
    }
}
