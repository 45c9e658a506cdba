//! `breakwater report`: writes the report of a run again.

use std::path::PathBuf;

use clap::Args;

use super::{CommandError, input::finished_run};
use crate::{
    case::InputKind,
    report::{fracture::write_fracture_report, run::write_report},
};

/// Write the report of a finished run again, from the files in its folder.
#[derive(Args)]
pub struct ReportArguments {
    /// Folder of the run.
    dir: PathBuf,
}

impl ReportArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let write = match finished_run(&self.dir)? {
            InputKind::Fracture => write_fracture_report,
            InputKind::DryTest => {
                let what = "the run is a dry test, which has no report; see summary.json and units.csv";
                return Err(CommandError::refused(format!("{}: {what}", self.dir.display())));
            }
            _ => write_report,
        };
        let path = write(&self.dir).map_err(CommandError::refused)?;
        println!("{}", path.display());
        Ok(())
    }
}
