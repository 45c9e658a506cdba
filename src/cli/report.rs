//! `breakwater report`: writes the report of a run again.

use std::path::PathBuf;

use clap::Args;

use super::{Trouble, input::is_fracture};
use crate::report::{fracture::write_fracture_report, run::write_report};

/// Write the report of a finished run again.
#[derive(Args)]
pub struct ReportArguments {
    /// Folder of the run.
    dir: PathBuf,
}

impl ReportArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let write = if is_fracture(&self.dir.join("case.json")) { write_fracture_report } else { write_report };
        let path = write(&self.dir).map_err(Trouble::refused)?;
        println!("{}", path.display());
        Ok(())
    }
}
