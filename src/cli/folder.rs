//! Preparation of result folders.

use std::path::Path;

use super::CommandError;
use crate::simulation::breakage::run::FOLDER;

/// Returns the name of a case file without folder and extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "case".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Files that a run or the flume model writes. --overwrite deletes only these files and the subfolder `impacts`.
const RESULT_FILES: [&str; 37] = [
    "bodies.csv",
    "breakage.csv",
    "breakage.json",
    "case.json",
    "checkpoint.h5",
    "checkpoint.json",
    "compare.csv",
    "compare.html",
    "contacts.csv",
    "cracks.csv",
    "cracks.vtkhdf",
    "diagnostics.csv",
    "energy.csv",
    "failed.h5",
    "failed.json",
    "fluid.vtkhdf",
    "flume_gauges.csv",
    "flume_piston.csv",
    "fragments.csv",
    "gauges.csv",
    "impacts.h5",
    "mesh.msh",
    "ml_piston_velx.csv",
    "picture.svg",
    "profile.csv",
    "progress.json",
    "report.html",
    "section.vtkhdf",
    "summary.json",
    "surface.vtkhdf",
    "surfaces.vtkhdf",
    "tets.vtkhdf",
    "unit_mesh.msh",
    "unit_surface.json",
    "units.csv",
    "units.vtkhdf",
    "wave.html",
];

/// Creates a folder for results, or checks that an existing folder is empty. With `overwrite`, deletes the result files
/// of an earlier run in the folder instead.
pub(super) fn fresh_folder(dir: &Path, overwrite: bool) -> Result<(), CommandError> {
    let cannot = |error: std::io::Error| CommandError::refused(format!("{}: {error}", dir.display()));
    let occupied = std::fs::read_dir(dir).is_ok_and(|mut entries| entries.next().is_some());
    if occupied && !overwrite {
        return Err(CommandError::refused(format!(
            "{}: the folder is not empty; choose another one with --out DIR, or add --overwrite to replace its results \
             (to continue an interrupted run: breakwater resume {})",
            dir.display(),
            dir.display()
        )));
    }
    std::fs::create_dir_all(dir).map_err(cannot)?;
    for file in RESULT_FILES.map(|name| dir.join(name)).iter().filter(|file| file.exists()) {
        std::fs::remove_file(file).map_err(cannot)?;
    }
    let impacts = dir.join(FOLDER);
    if impacts.exists() {
        std::fs::remove_dir_all(&impacts).map_err(cannot)?;
    }
    Ok(())
}
