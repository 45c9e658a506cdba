//! `breakwater compare`: compares runs with measurements.

use std::path::PathBuf;

use clap::Args;

use super::{CommandError, input::finished_run};
use crate::{
    case::{InputKind, Reference},
    report::compare::compare,
};

/// Compare finished runs with measurements: displacement of each unit, mean displacement, damage ratio.
#[derive(Args)]
pub struct CompareArguments {
    /// Folders of the runs.
    #[arg(required = true)]
    dirs: Vec<PathBuf>,
    /// Folder with the measurements: reference.json and its CSV files (`breakwater schema --reference` lists the keys).
    /// Default: the folder that the case of the first run names.
    #[arg(long, value_name = "DIR")]
    reference: Option<PathBuf>,
    /// Folder for compare.html and compare.csv; default: the folder of the first run.
    #[arg(long)]
    out: Option<PathBuf>,
}

impl CompareArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let first = &self.dirs[0];
        for dir in &self.dirs {
            let what = match finished_run(dir)? {
                InputKind::DryTest => "is a dry test, which has no wave; compare runs of flume cases",
                InputKind::Fracture => "is a fracture run; compare runs of flume cases",
                _ => continue,
            };
            return Err(CommandError::refused(format!("{}: {what}", dir.display())));
        }
        let folder = self.reference.clone().or_else(|| Reference::folder_of_run(first)).ok_or_else(|| {
            let what = "has no case.json that names a folder with measurements; give one with --reference DIR";
            CommandError::refused(format!("{}: {what}", first.display()))
        })?;
        let reference = Reference::load(&folder).map_err(CommandError::refused)?;
        let comparison = compare(&self.dirs, &reference).map_err(CommandError::refused)?;
        println!("{comparison}");
        let out = self.out.as_ref().unwrap_or(first);
        for path in comparison.write(out).map_err(CommandError::failed)? {
            println!("{}", path.display());
        }
        Ok(())
    }
}
