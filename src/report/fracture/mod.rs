//! Report of a fracture run: text, tables, charts and pictures, made from the files of the run folder.
//!
//! | file | content |
//! | --- | --- |
//! | `folder` | data read from the run folder |
//! | `moments` | choice of the recorded times that are shown |
//! | `unit_picture` | transparent units with crack faces |
//! | `stress_picture` | first principal stress in the section plane |
//! | `pictures` | report section with both kinds of picture |
//! | `film` | film of the units with cracks |
//! | `charts` | energy balance and crack area over time |
//! | `tables` | cracks, pieces, bodies |
//! | `sections` | all report sections in order |

mod charts;
mod film;
mod folder;
mod moments;
mod pictures;
mod sections;
mod stress_picture;
mod tables;
mod unit_picture;

use std::path::{Path, PathBuf};

use crate::{
    output::{OutputError, write_atomically},
    report::{film::glb, page::page},
};

use folder::FractureFolder;

/// Writes `report.html` into the folder of a fracture run.
///
/// # Errors
/// If case, mesh or summary are missing, a file is invalid, or the report cannot be written.
pub fn write_fracture_report(dir: &Path) -> Result<PathBuf, OutputError> {
    let run = FractureFolder::read(dir)?;
    let path = dir.join("report.html");
    write_atomically(&path, page(&run.summary.title, &sections::body(&run)?).as_bytes())?;
    Ok(path)
}

/// Writes the film of a fracture run as a GLB file. Returns false if the run recorded no surfaces.
///
/// # Errors
/// If case, mesh or summary are missing, a file is invalid, or the film cannot be written.
pub fn write_fracture_glb(dir: &Path, path: &Path) -> Result<bool, OutputError> {
    match film::film(&FractureFolder::read(dir)?)? {
        Some(scene) => write_atomically(path, &glb(&scene)).map(|()| true),
        None => Ok(false),
    }
}

/// Returns pictures of a fracture run just after the impact and at the end, as HTML for the report about all impacts of
/// a flume run. `None` if the fracture run wrote no surfaces.
///
/// # Errors
/// If case, mesh or summary are missing, or a file is invalid.
pub(crate) fn pictures_of_impact_and_end(dir: &Path) -> Result<Option<String>, OutputError> {
    pictures::of_impact_and_end(&FractureFolder::read(dir)?)
}
