//! The loop of a run: steps, outputs, checkpoints, stop rules.

use std::{path::Path, sync::Arc};

use thiserror::Error;

use super::{
    Simulation,
    checkpoint::{self, Checkpoint},
    failure::Failure,
    recorder::Recorder,
    setup::SetupError,
    summary::summarise,
};
use crate::output::progress::Progress;
use crate::{
    case::Case,
    output::{OutputError, Stopped, Summary},
    report::run::write_report,
    rigid::BodyState,
    sph::device::Device,
};

/// Why a run ended early.
#[derive(Debug, Error)]
pub enum RunError {
    /// The case cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The run is to begin where another one stands, and cannot.
    #[error("{from}: the run cannot begin there: {why}")]
    NoStart {
        /// Folder of the other run.
        from: String,
        /// Reason.
        why: String,
    },
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The computation went astray; the state before the failing step is kept.
    #[error("{failure}\nThe state is kept in {kept}; the last regular checkpoint is not touched.")]
    Failed {
        /// What happened.
        failure: Failure,
        /// Where the state lies.
        kept: String,
    },
}

/// How a run is to be made.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// No progress.
    pub quiet: bool,
    /// What computes the water.
    pub device: Device,
    /// End at this simulated time [s] although the case goes on: others will begin there.
    pub until: Option<f64>,
}

/// Run a case into an existing, empty folder.
///
/// # Errors
/// If the case cannot be set up, a file cannot be written, or the computation goes astray.
pub fn run(case: Arc<Case>, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
    let simulation = Simulation::on(&options.device, case)?;
    let recorder = Recorder::create(&simulation, dir)?;
    drive(simulation, recorder, dir, options)
}

/// Go on with a run from its last checkpoint.
///
/// # Errors
/// As [`run`], and if the checkpoint is not one of the case.
pub fn resume(case: Arc<Case>, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
    let mut simulation = Simulation::on(&options.device, case)?;
    let state = checkpoint::read(&mut simulation, dir)?;
    simulation.load().map_err(SetupError::Device)?;
    let recorder = Recorder::reopen(&simulation, dir, state)?;
    drive(simulation, recorder, dir, options)
}

/// Step until a stop rule holds.
pub(super) fn drive(
    mut simulation: Simulation,
    mut recorder: Recorder,
    dir: &Path,
    options: &RunOptions,
) -> Result<Summary, RunError> {
    let end = options.until.map_or(simulation.case.stop.duration, |until| until.min(simulation.case.stop.duration));
    let mut progress = Progress::new(end, simulation.time, simulation.steps, options.quiet);
    let wall_before = simulation.statistics.wall_s;
    let energy_start = simulation.statistics.energy_start.unwrap_or_else(|| simulation.energy().total());
    simulation.statistics.energy_start = Some(energy_start);
    let mut warnings_shown = simulation.statistics.warnings.len();
    loop {
        let mut dt = match simulation.begin_step() {
            Ok(dt) => dt,
            Err(failure) => return Err(keep_failed(&mut simulation, &mut recorder, dir, failure)),
        };
        simulation.statistics.wall_s = wall_before + progress.wall();
        if let Some(stopped) = stop_rule(&mut simulation, end) {
            recorder.record_end(&mut simulation, dt)?;
            progress.finish();
            let summary = summarise(&simulation, stopped, dir)?;
            summary.write(dir)?;
            write_report(dir)?;
            return Ok(summary);
        }
        let checkpoints = recorder.state().checkpoints;
        recorder.record_due(&mut simulation, dt)?;
        if simulation.is_on_card() && recorder.state().checkpoints > checkpoints {
            // Places in double precision are not to the last bit those of the card: go on as a resumed run will.
            let begun = simulation.load().map_err(Failure::from).and_then(|()| simulation.begin_step());
            dt = match begun {
                Ok(dt) => dt,
                Err(failure) => return Err(keep_failed(&mut simulation, &mut recorder, dir, failure)),
            };
        }
        if let Err(failure) = simulation.finish_step(dt) {
            return Err(keep_failed(&mut simulation, &mut recorder, dir, failure));
        }
        simulation.statistics.warnings[warnings_shown..].iter().for_each(|warning| progress.warn(warning));
        warnings_shown = simulation.statistics.warnings.len();
        progress.update(simulation.time, simulation.steps, || details(&simulation, dt));
    }
}

/// What progress tells besides the time.
fn details(simulation: &Simulation, dt: f64) -> String {
    let particles = simulation.water.len() + simulation.boundary.len();
    let water = format!("dt {dt:.2e} s, {particles} particles");
    let Some(units) = &simulation.units else { return water };
    let displacements = units.displacements();
    let mean = displacements.iter().sum::<f64>() / displacements.len().max(1) as f64;
    format!("{water}, units moved {:.1} mm on average", 1e3 * mean)
}

/// Keep the state of a failed run beside the last good checkpoint, and the outputs up to it.
fn keep_failed(simulation: &mut Simulation, recorder: &mut Recorder, dir: &Path, failure: Failure) -> RunError {
    if matches!(failure, Failure::Device(_)) {
        return RunError::Failed { failure, kept: "no file (it was on the device)".to_owned() };
    }
    let mut write = |recorder: &mut Recorder| {
        simulation.fetch()?;
        recorder.drain()?;
        Checkpoint::of(simulation, recorder.state()).write(dir, Checkpoint::FAILED_FILE)
    };
    let kept = match write(recorder) {
        Ok(()) => dir.join(Checkpoint::FAILED_FILE).display().to_string(),
        Err(error) => format!("no file ({error})"),
    };
    RunError::Failed { failure, kept }
}

/// Whether the run, which ends at a simulated time [s] at the latest, is over, and why.
fn stop_rule(simulation: &mut Simulation, end: f64) -> Option<Stopped> {
    if simulation.time >= end {
        return Some(Stopped::Duration);
    }
    let (rule, units) = (simulation.case.stop.at_rest.as_ref()?, simulation.units.as_ref()?);
    // The tips of a unit are about half its height away from its centre.
    let tips = 0.5 * units.shape.height();
    let speed = |state: &BodyState| state.velocity.length() + tips * state.angular_velocity.length();
    // Units that have just begun to move have not got far yet.
    let slow = units.states().iter().all(|state| speed(state) < rule.speed);
    let stayed = simulation.statistics.rest.look(simulation.time, units.states(), tips, rule.speed * rule.hold);
    // Units that the wave has not reached are at rest, too.
    let reached = simulation.time >= rule.not_before.max(simulation.crest);
    (reached && slow && stayed >= rule.hold).then_some(Stopped::AtRest)
}
