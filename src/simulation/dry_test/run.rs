//! A dry test from its case, or from a checkpoint, to its summary.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{DryRun, recorder::DryRecorder, summary::DrySummary};
use crate::{
    case::{DryCase, DryTest},
    output::{
        OutputError, Stopped,
        driver::{Clock, Control, Run, RunError, Session, Step, StepFailure, drive},
    },
};

/// Runs a dry test into an existing, empty folder.
///
/// # Errors
/// If the units overlap too much at the start or later, a file cannot be written, or the user stops the run.
pub fn run(case: Arc<DryCase>, dir: &Path, control: &Control) -> Result<DrySummary, RunError> {
    let run = DryRun::new(case).map_err(RunError::setup)?;
    let recorder = DryRecorder::create(&run, dir)?;
    drive(RecordedRun { run, recorder }, dir, control)
}

/// Continues a dry test from its last checkpoint.
///
/// # Errors
/// As [`run`], and if the checkpoint does not belong to the case.
pub fn resume(case: Arc<DryCase>, dir: &Path, control: &Control) -> Result<DrySummary, RunError> {
    let mut run = DryRun::new(case).map_err(RunError::setup)?;
    let recorder = DryRecorder::reopen(&mut run, dir)?;
    drive(RecordedRun { run, recorder }, dir, control)
}

/// A dry test with its open files.
struct RecordedRun {
    run: DryRun,
    recorder: DryRecorder,
}

impl Run for RecordedRun {
    type Summary = DrySummary;

    fn clock(&self) -> Clock {
        Clock { time: self.run.time(), end: self.run.case.stop.duration, steps: self.run.world.substeps() }
    }

    fn step(&mut self, session: Session) -> Result<Step<DrySummary>, StepFailure> {
        if let Some(stopped) = stop_rule(&self.run) {
            self.recorder.record_end(&mut self.run)?;
            let summary = DrySummary::of(&self.run, stopped, session.wall);
            summary.write(self.recorder.dir())?;
            return Ok(Step::Ended(summary));
        }
        if session.stop {
            self.recorder.record_state(&self.run, DryRecorder::CHECKPOINT)?;
            return Ok(Step::Stopped);
        }
        self.recorder.record_due(&mut self.run)?;
        self.run.advance(self.run.case.stop.duration).map_err(StepFailure::failure)?;
        Ok(Step::Made)
    }

    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError> {
        self.recorder.record_state(&self.run, DryRecorder::FAILED)?;
        Ok(self.recorder.dir().join(DryRecorder::FAILED))
    }

    fn details(&self) -> String {
        let (contacts, fastest) = (self.run.world.contact_count(), self.run.fastest());
        format!("{contacts} contacts, fastest unit {fastest:.4} m/s")
    }
}

/// Returns why the run is over, if it is.
fn stop_rule(run: &DryRun) -> Option<Stopped> {
    let (stop, time) = (&run.case.stop, run.time());
    // The sum of the steps may fall short of the duration by rounding.
    if time >= stop.duration - 1e-9 {
        return Some(Stopped::Duration);
    }
    if let DryTest::Tilt { to, .. } = run.case.test
        && (run.slope() >= to || run.measured.slides_at.iter().all(Option::is_some))
    {
        return Some(Stopped::TestOver);
    }
    let (rule, since) = (stop.at_rest.as_ref()?, run.measured.at_rest_since?);
    (time >= rule.not_before && time - since >= rule.hold).then_some(Stopped::AtRest)
}
