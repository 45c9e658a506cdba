//! Report of a flume run.
//!
//! `report.html` is self-contained: style sheet and charts are inline, and there are no scripts. `picture.svg` is a
//! separate picture of one recorded time of the run.

mod breakage;
mod charts;
mod cover;
mod folder;
mod moments;
mod motion;
mod scene;
mod sections;
mod solids;
mod views;
mod water;
mod window;

use std::path::{Path, PathBuf};

use crate::output::{OutputError, write_atomically};
use crate::report::page::page;
use folder::RunFolder;
use moments::Moments;

/// Writes `report.html` into the run folder, and `picture.svg` if the folder contains the water particles.
/// Only `summary.json` is required. Sections whose files are missing are left out.
///
/// # Errors
/// If the summary is missing, a file is invalid, or the report cannot be written.
pub fn write_report(run_dir: &Path) -> Result<PathBuf, OutputError> {
    let run = RunFolder::read(run_dir)?;
    let moments = Moments::read(&run)?;
    if let Some(picture) = moments.as_ref().and_then(Moments::picture) {
        write_atomically(&run_dir.join(RunFolder::PICTURE), picture.as_bytes())?;
    }
    let path = run_dir.join("report.html");
    write_atomically(&path, page(&run.summary.title, &sections::body(&run, moments.as_ref())).as_bytes())?;
    Ok(path)
}
