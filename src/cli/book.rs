//! `breakwater book`: the validation book.

use std::path::PathBuf;

use clap::Args;

use super::Trouble;
use crate::{book, report::compare::Fudo};

/// Take finished runs into the validation book and write its pages: tables and figures beside the published experiment.
///
/// The book keeps a run's case, its summary and a short table of its series, some 100 kB, and writes its pages from what it
/// keeps. Without folders it writes the pages anew.
#[derive(Args)]
pub struct BookArguments {
    /// Folders of finished runs under a wave of the Fudo experiment: 2.6, 4.5 or 6.4 cm.
    runs: Vec<PathBuf>,
    /// Folder of the book.
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
