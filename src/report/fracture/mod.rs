//! The report of a fracture run: one page in words, tables, charts and pictures, made from the files of the run folder.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `folder` | what is read |
//! | `moments` | which moments are shown |
//! | `unit_picture` | units half transparent, with the crack faces in them |
//! | `stress_picture` | the first principal stress in the cut plane |
//! | `pictures` | the section with both |
//! | `charts` | energy book and crack area against time |
//! | `tables` | cracks, pieces, bodies |
//! | `sections` | the page in order |

mod charts;
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
    report::page::page,
};

use folder::FractureFolder;

/// Write `report.html` into the folder of a fracture run.
///
/// # Errors
/// If case, mesh or summary are missing, a file cannot be understood, or the report cannot be written.
pub fn write_fracture_report(dir: &Path) -> Result<PathBuf, OutputError> {
    let run = FractureFolder::read(dir)?;
    let path = dir.join("report.html");
    write_atomically(&path, page(&run.summary.title, &sections::body(&run)?).as_bytes())?;
    Ok(path)
}

/// Pictures of the impact and of the end of the fracture run in a folder, for a page about many impacts; none where the
/// run wrote no surfaces.
///
/// # Errors
/// If case, mesh or summary are missing, or a file cannot be understood.
pub(crate) fn pictures_of_impact_and_end(dir: &Path) -> Result<Option<String>, OutputError> {
    pictures::of_impact_and_end(&FractureFolder::read(dir)?)
}
