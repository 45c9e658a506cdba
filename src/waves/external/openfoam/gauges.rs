//! Surface level at gauges from OpenFOAM's function objects.
//!
//! The function object `interfaceHeight` writes all gauges to one file. If it is not available (as in Debian's OpenFOAM
//! 1912), use `probes` of the volume fraction of water on a vertical line per gauge. The depth of water between the
//! lowest and the highest probe then gives the surface level.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::surface::SurfaceSeries;
use super::frame::Frame;
use super::{interface_height, probes};

/// Reads the surface level at the gauges `names`. If `folder` has a subfolder with the name of a gauge, every gauge
/// must have a subfolder, with probes of `water` on a vertical line. Otherwise `folder` must be the output of
/// `interfaceHeight`, whose locations are the gauges in the same order.
///
/// # Errors
/// If a folder or file cannot be read, or its contents are wrong.
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
    fn probes_and_interface_height_give_the_same_surface() {
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
    fn error_names_the_missing_folder() {
        let folder = tempfile::tempdir().unwrap();
        let error = read(&folder.path().join("none"), &["front"], "alpha.water", FRAME).unwrap_err().to_string();
        assert!(error.contains("none"), "{error}");
    }
}
