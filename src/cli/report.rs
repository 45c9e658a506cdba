//! `breakwater report`: the report of a run, made anew.

use std::path::PathBuf;

use clap::Args;

use super::Trouble;
use crate::output::write_report;

/// Make the report of a finished run anew.
#[derive(Args)]
pub struct ReportArguments {
    /// Folder of the run.
    dir: PathBuf,
}

impl ReportArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let path = write_report(&self.dir).map_err(Trouble::refused)?;
        println!("{}", path.display());
        Ok(())
    }
}
