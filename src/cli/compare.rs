//! `breakwater compare`: compares runs with published measurements.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::Trouble;
use crate::report::compare::{Fudo, compare};

/// Compare finished runs with published measurements: displacement of each unit, mean, damage ratio.
#[derive(Args)]
pub struct CompareArguments {
    /// Folders of the runs.
    #[arg(required = true)]
    dirs: Vec<PathBuf>,
    /// The measurements.
    #[arg(long, value_enum, default_value = "fudo")]
    reference: Reference,
    /// Folder for compare.html and compare.csv; default: the folder of the first run.
    #[arg(long)]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Reference {
    /// Mitsui et al. 2023: one row of Tetrapods in solitary waves of 2.6, 4.5 and 6.4 cm.
    Fudo,
}

impl CompareArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let reference = match self.reference {
            Reference::Fudo => Fudo::published().map_err(Trouble::failed)?,
        };
        let comparison = compare(&self.dirs, &reference).map_err(Trouble::refused)?;
        println!("{comparison}");
        let out = self.out.as_ref().unwrap_or(&self.dirs[0]);
        for path in comparison.write(out).map_err(Trouble::failed)? {
            println!("{}", path.display());
        }
        Ok(())
    }
}
