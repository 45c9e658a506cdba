//! The report of a run: one page that can be printed, mailed and signed.
//!
//! Everything is in the one file `report.html`: style sheet and charts are inline, there are no scripts.

mod charts;
mod folder;
mod motion;
mod sections;
mod views;

use std::path::{Path, PathBuf};

use super::plot::escape;
use super::{OutputError, write_atomically};
use folder::RunFolder;

/// Writes `report.html` into the run folder from the files that are there; only `summary.json` must be.
///
/// # Errors
/// If the summary is missing, a file cannot be understood, or the report cannot be written.
pub fn write_report(run_dir: &Path) -> Result<PathBuf, OutputError> {
    let run = RunFolder::read(run_dir)?;
    let path = run_dir.join("report.html");
    write_atomically(&path, page(&run.summary.title, &sections::body(&run)).as_bytes())?;
    Ok(path)
}

/// A whole page with the style sheet in it.
pub(in crate::output) fn page(title: &str, body: &str) -> String {
    let title = escape(title);
    let style = include_str!("style.css");
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
         <style>\n{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n"
    )
}
