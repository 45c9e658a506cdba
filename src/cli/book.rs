//! `breakwater book`: the validation pages.

use std::path::PathBuf;

use clap::Args;

use super::Trouble;
use crate::{book, report::compare::Fudo};

/// Add finished runs to the validation pages: tables and figures that compare them with a published experiment.
///
/// The folder of the pages keeps the case, the summary and a short table of the series of each run, some 100 kB. The
/// pages are written from these files. Without run folders, all pages are written again.
#[derive(Args)]
pub struct BookArguments {
    /// Folders of finished runs with a wave of the Fudo experiment: 2.6, 4.5 or 6.4 cm; default: none.
    runs: Vec<PathBuf>,
    /// Folder of the validation pages.
    #[arg(long, default_value = "docs/validation")]
    out: PathBuf,
}

impl BookArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let reference = Fudo::published().map_err(Trouble::failed)?;
        for path in book::write(&self.out, &self.runs, &reference).map_err(Trouble::refused)? {
            println!("{}", path.display());
        }
        Ok(())
    }
}
