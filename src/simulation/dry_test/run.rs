//! Runs a dry test: starts from the case or a checkpoint, and ends with the summary.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{DryTest, recorder::DryTestRecorder, summary::DryTestSummary};
use crate::{
    case::{DryTestCase, DryTestKind},
    output::{
        OutputError, Stopped,
        driver::{Clock, Control, Run, RunError, Session, Step, StepFailure, drive},
    },
};

/// Runs a dry test into an existing, empty folder.
///
/// # Errors
/// If the units overlap too much at the start or later, a file cannot be written, or the user stops the run.
pub fn run(case: Arc<DryTestCase>, dir: &Path, control: &Control) -> Result<DryTestSummary, RunError> {
    let run = DryTest::new(case).map_err(RunError::setup)?;
    let recorder = DryTestRecorder::create(&run, dir)?;
    drive(RecordedRun { run, recorder, wall_before: 0.0 }, dir, control)
}

/// Continues a dry test from its last checkpoint.
///
/// # Errors
/// As for [`run`], and if the checkpoint does not belong to the case. Title, stop rules and output intervals may differ.
pub fn resume(case: Arc<DryTestCase>, dir: &Path, control: &Control) -> Result<DryTestSummary, RunError> {
    let mut run = DryTest::new(case).map_err(RunError::setup)?;
    let recorder = DryTestRecorder::reopen(&mut run, dir)?;
    drive(RecordedRun { wall_before: run.measured.wall_s, run, recorder }, dir, control)
}

/// A dry test with its open output files.
struct RecordedRun {
    run: DryTest,
    recorder: DryTestRecorder,
    /// Wall time of earlier sessions [s].
    wall_before: f64,
}

impl Run for RecordedRun {
    type Summary = DryTestSummary;

    fn clock(&self) -> Clock {
        Clock { time: self.run.time(), end: self.run.case.stop.duration, steps: self.run.world.substeps() }
    }

    fn step(&mut self, session: Session) -> Result<Step<DryTestSummary>, StepFailure> {
        self.run.measured.wall_s = self.wall_before + session.wall;
        if let Some(stopped) = stop_rule(&self.run) {
            self.recorder.record_end(&mut self.run)?;
            let summary = DryTestSummary::of(&self.run, stopped);
            summary.write(self.recorder.dir())?;
            return Ok(Step::Ended(summary));
        }
        if session.stop {
            self.recorder.record_state(&self.run, DryTestRecorder::CHECKPOINT)?;
            return Ok(Step::Stopped);
        }
        self.recorder.record_due(&mut self.run)?;
        self.run.advance(self.run.case.stop.duration).map_err(StepFailure::failure)?;
        Ok(Step::Continues)
    }

    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError> {
        self.recorder.record_state(&self.run, DryTestRecorder::FAILED)?;
        Ok(self.recorder.dir().join(DryTestRecorder::FAILED))
    }

    fn details(&self) -> String {
        let (contacts, fastest) = (self.run.world.contact_count(), self.run.fastest());
        format!("{contacts} contacts, fastest unit {fastest:.4} m/s")
    }
}

/// Returns the reason to end the run, or `None` if the run continues.
fn stop_rule(run: &DryTest) -> Option<Stopped> {
    let (stop, time) = (&run.case.stop, run.time());
    // Because of rounding errors, the sum of the time steps may be slightly less than the duration.
    if time >= stop.duration - 1e-9 {
        return Some(Stopped::Duration);
    }
    if let DryTestKind::Tilt { to, .. } = run.case.test
        && (run.slope() >= to || run.measured.slides_at.iter().all(Option::is_some))
    {
        return Some(Stopped::TestOver);
    }
    let (rule, since) = (stop.at_rest.as_ref()?, run.measured.at_rest_since?);
    (time >= rule.not_before && time - since >= rule.hold).then_some(Stopped::AtRest)
}
