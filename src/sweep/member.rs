//! Folder, log and state of one run of a sweep.

use std::path::{Path, PathBuf};

use super::plan::Member;
use crate::output::Summary;

/// State of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The run is finished.
    Finished(Box<Summary>),
    /// The run is not finished, and its log does not end with a failure.
    Missing,
    /// The run failed; the text is the last line of its log.
    Failed(String),
}

impl Member {
    /// Returns the folder of the run, inside the folder of the sweep.
    pub fn dir(&self, sweep_dir: &Path) -> PathBuf {
        sweep_dir.join(&self.name)
    }

    /// Returns the path of the log file of the run.
    pub fn log(&self, sweep_dir: &Path) -> PathBuf {
        sweep_dir.join(format!("{}.log", self.name))
    }

    /// Determines the state of the run from its summary and its log. The summary of a different case does not count.
    pub fn outcome(&self, sweep_dir: &Path) -> Outcome {
        match Summary::read(&self.dir(sweep_dir)) {
            Ok(summary) if summary.case_hash == self.hash => return Outcome::Finished(Box::new(summary)),
            _ => {}
        }
        let log = std::fs::read_to_string(self.log(sweep_dir)).unwrap_or_default();
        match log.lines().rfind(|line| !line.trim().is_empty()) {
            Some(line) if line.starts_with(Self::FAILED) => Outcome::Failed(line.to_owned()),
            _ => Outcome::Missing,
        }
    }

    /// Beginning of the last log line of a failed run.
    pub const FAILED: &'static str = "failed: ";
}
