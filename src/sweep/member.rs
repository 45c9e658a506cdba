//! The folder of one run of a sweep, and whether it is finished.

use std::path::{Path, PathBuf};

use super::plan::Member;
use crate::output::Summary;

/// What a run has come to.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It is finished.
    Finished(Box<Summary>),
    /// It is not.
    Missing,
    /// It was tried, and this is the last that it said.
    Failed(String),
}

impl Member {
    /// Its folder in that of the sweep.
    pub fn dir(&self, sweep_dir: &Path) -> PathBuf {
        sweep_dir.join(&self.name)
    }

    /// What its process says.
    pub fn log(&self, sweep_dir: &Path) -> PathBuf {
        sweep_dir.join(format!("{}.log", self.name))
    }

    /// What there is of it: a summary of the same case, or what it said when it failed.
    pub fn outcome(&self, sweep_dir: &Path) -> Outcome {
        match Summary::read(&self.dir(sweep_dir)) {
            Ok(summary) if summary.case_hash == self.hash => return Outcome::Finished(Box::new(summary)),
            _ => {}
        }
        let said = std::fs::read_to_string(self.log(sweep_dir)).unwrap_or_default();
        match said.lines().rfind(|line| !line.trim().is_empty()) {
            Some(line) if line.starts_with(Self::FAILED) => Outcome::Failed(line.to_owned()),
            _ => Outcome::Missing,
        }
    }

    /// How the last line of the log of a failed run begins.
    pub const FAILED: &'static str = "failed: ";
}
