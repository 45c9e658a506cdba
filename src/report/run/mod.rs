//! Report of a flume run.
//!
//! `report.html` is self-contained: style sheet, charts, film and the program that shows the film are inline.
//! `picture.svg` is a separate picture of one recorded time of the run.

mod breakage;
mod charts;
mod cover;
mod facts;
mod film;
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
use crate::report::{film::glb, page::page_reloading};
use folder::RunFolder;
use moments::Moments;

/// Writes `report.html` into the run folder, and `picture.svg` if the folder contains the water particles.
/// Only `summary.json` is required. Sections whose files are missing are left out.
///
/// # Errors
/// If the summary is missing, a file is invalid, or the report cannot be written.
pub fn write_report(run_dir: &Path) -> Result<PathBuf, OutputError> {
    write(&RunFolder::read(run_dir)?, None)
}

/// Writes the report of a run in progress. The page loads itself again after `reload_s` [s].
///
/// # Errors
/// As for [`write_report`]; also if the run is just writing a file, so that a second attempt succeeds.
pub fn write_live_report(run_dir: &Path, reload_s: u64) -> Result<PathBuf, OutputError> {
    write(&RunFolder::read_running(run_dir)?, Some(reload_s))
}

/// Writes the film of a run as a GLB file. Returns false if the run recorded neither water nor units.
///
/// # Errors
/// If the summary is missing, a file is invalid, or the film cannot be written.
pub fn write_glb(run_dir: &Path, path: &Path) -> Result<bool, OutputError> {
    let run = RunFolder::read(run_dir)?;
    match film::film(&run, None)? {
        Some(scene) => write_atomically(path, &glb(&scene)).map(|()| true),
        None => Ok(false),
    }
}

fn write(run: &RunFolder, reload_s: Option<u64>) -> Result<PathBuf, OutputError> {
    let moments = Moments::read(run)?;
    if let Some(picture) = moments.as_ref().and_then(Moments::picture) {
        write_atomically(&run.dir.join(RunFolder::PICTURE), picture.as_bytes())?;
    }
    let path = run.dir.join("report.html");
    let film = film::film(run, moments.as_ref().and_then(Moments::pictured_s))?;
    let body = sections::body(run, moments.as_ref(), film.as_ref());
    write_atomically(&path, page_reloading(&run.summary.title, &body, reload_s).as_bytes())?;
    Ok(path)
}
