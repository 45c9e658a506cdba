//! The loop of a dry run.

use std::{path::Path, sync::Arc, time::Instant};

use thiserror::Error;

use super::{
    DryRun,
    recorder::DryRecorder,
    summary::{DrySummary, Ended},
};
use crate::{
    case::{DryCase, DryTest},
    output::{OutputError, progress::Progress},
    rigid::RigidError,
};

/// Why a dry run ended early.
#[derive(Debug, Error)]
pub enum DryError {
    /// The units cannot stand where the case puts them.
    #[error(transparent)]
    Setup(RigidError),
    /// The computation went astray.
    #[error("{reason}\nThe state is kept in {kept}; the last regular checkpoint is not touched.")]
    Failed {
        /// What happened.
        reason: RigidError,
        /// Where the state lies.
        kept: String,
    },
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Run a dry case into an existing, empty folder.
///
/// # Errors
/// If the units start too deep in something, go too deep later, or a file cannot be written.
pub fn run(case: Arc<DryCase>, dir: &Path, quiet: bool) -> Result<DrySummary, DryError> {
    let run = DryRun::new(case).map_err(DryError::Setup)?;
    let recorder = DryRecorder::create(&run, dir)?;
    drive(run, recorder, dir, quiet)
}

/// Go on with a dry run from its last checkpoint.
///
/// # Errors
/// As [`run`], and if the checkpoint is not one of the case.
pub fn resume(case: Arc<DryCase>, dir: &Path, quiet: bool) -> Result<DrySummary, DryError> {
    let mut run = DryRun::new(case).map_err(DryError::Setup)?;
    let recorder = DryRecorder::reopen(&mut run, dir)?;
    drive(run, recorder, dir, quiet)
}

fn drive(mut run: DryRun, mut recorder: DryRecorder, dir: &Path, quiet: bool) -> Result<DrySummary, DryError> {
    let begun = Instant::now();
    let mut progress = Progress::new(run.case.stop.duration, run.time(), run.world.substeps(), quiet);
    loop {
        if let Some(stopped) = stop_rule(&run) {
            recorder.record_end(&mut run)?;
            progress.finish();
            let summary = DrySummary::of(&run, stopped, begun.elapsed().as_secs_f64());
            summary.write(dir)?;
            return Ok(summary);
        }
        recorder.record_due(&mut run)?;
        if let Err(reason) = run.advance(run.case.stop.duration) {
            let kept = match recorder.record_state(&run, DryRecorder::FAILED) {
                Ok(()) => dir.join(DryRecorder::FAILED).display().to_string(),
                Err(error) => format!("no file ({error})"),
            };
            return Err(DryError::Failed { reason, kept });
        }
        let fastest = run.fastest();
        progress.update(run.time(), run.world.substeps(), || {
            format!("{} contacts, fastest unit {fastest:.4} m/s", run.world.contact_count())
        });
    }
}

/// Whether the run is over, and why.
fn stop_rule(run: &DryRun) -> Option<Ended> {
    let (stop, time) = (&run.case.stop, run.time());
    // The sum of the steps may fall short of the duration by rounding.
    if time >= stop.duration - 1e-9 {
        return Some(Ended::Duration);
    }
    if let DryTest::Tilt { to, .. } = run.case.test
        && (run.slope() >= to || run.measured.slides_at.iter().all(Option::is_some))
    {
        return Some(Ended::TestOver);
    }
    let (rule, since) = (stop.at_rest.as_ref()?, run.measured.at_rest_since?);
    (time >= rule.not_before && time - since >= rule.hold).then_some(Ended::AtRest)
}
