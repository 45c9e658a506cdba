//! The loop that every run shares: steps, progress, the last outputs, a failed or interrupted run.
//!
//! A run of any kind implements [`Run`]; [`drive`] takes it to its end.

use std::{
    error::Error,
    io,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use thiserror::Error;

use super::{OutputError, progress::Progress};

/// Why a run of any kind ended early.
#[derive(Debug, Error)]
pub enum RunError {
    /// The case cannot be set up: the input is at fault.
    #[error(transparent)]
    Setup(Box<dyn Error + Send + Sync>),
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The state has become impossible; the state before the failing time step is kept.
    #[error("{failure}\nThe state is kept in {kept}; the last regular checkpoint is unchanged.")]
    Failed {
        /// What happened.
        failure: Box<dyn Error + Send + Sync>,
        /// File with the state.
        kept: String,
    },
    /// The user stopped the run.
    #[error("stopped by the user at {time:.4} s; continue with: breakwater resume {}", dir.display())]
    Interrupted {
        /// Simulated time [s].
        time: f64,
        /// Folder of the run.
        dir: PathBuf,
    },
}

impl RunError {
    /// For `map_err`: the case cannot be set up.
    pub fn setup(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Setup(error.into())
    }
}

/// Why a time step could not be made.
#[derive(Debug)]
pub enum StepFailure {
    /// A file cannot be written.
    Output(OutputError),
    /// The state has become impossible.
    Failure(Box<dyn Error + Send + Sync>),
}

impl StepFailure {
    /// For `map_err`: the state has become impossible.
    pub fn failure(failure: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Failure(failure.into())
    }
}

impl From<OutputError> for StepFailure {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

/// How the user accompanies a run.
#[derive(Debug, Clone, Default)]
pub struct Control {
    /// No progress.
    pub quiet: bool,
    /// Once this is true, the run writes a checkpoint and ends.
    pub stop: Arc<AtomicBool>,
}

impl Control {
    /// No progress, and nothing that stops the run.
    pub fn quiet() -> Self {
        Self { quiet: true, ..Self::default() }
    }

    /// Let Ctrl-C and SIGTERM stop the run with a checkpoint; a second signal ends the process at once.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn catch_signals(&self) -> io::Result<()> {
        for signal in signal_hook::consts::TERM_SIGNALS {
            signal_hook::flag::register_conditional_shutdown(*signal, 1, self.stop.clone())?;
            signal_hook::flag::register(*signal, self.stop.clone())?;
        }
        Ok(())
    }
}

/// Where a run stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// Simulated time at which the run ends at the latest [s].
    pub end: f64,
    /// Steps made, in all sessions.
    pub steps: u64,
}

/// What the driver tells a run before each step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Session {
    /// Wall clock since this session began [s].
    pub wall: f64,
    /// Whether the user wants the run to stop with a checkpoint.
    pub stop: bool,
}

/// What a step came to.
#[derive(Debug, Clone, PartialEq)]
pub enum Step<Summary> {
    /// The run continues.
    Made,
    /// The run is over, and all its files are written.
    Ended(Summary),
    /// The user has stopped the run, and its checkpoint is written.
    Stopped,
}

/// A run as the driver sees it.
pub trait Run {
    /// The run in a few numbers.
    type Summary;

    /// Where the run stands.
    fn clock(&self) -> Clock;

    /// Evaluates the present state. Then it writes the outputs that are due and makes one time step, or writes the last
    /// outputs and the summary, or writes a checkpoint because the user stops the run.
    ///
    /// # Errors
    /// If a file cannot be written or the state has become impossible.
    fn step(&mut self, session: Session) -> Result<Step<Self::Summary>, StepFailure>;

    /// Writes the state before a failing step to a file of its own, whose path it returns.
    ///
    /// # Errors
    /// If the file cannot be written.
    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError>;

    /// What the progress line shows besides the time.
    fn details(&self) -> String;

    /// All warnings so far.
    fn warnings(&self) -> &[String] {
        &[]
    }
}

/// Take a run whose files lie in `dir` to its end.
///
/// # Errors
/// If a file cannot be written, the state becomes impossible, or the user stops the run.
pub fn drive<R: Run>(mut run: R, dir: &Path, control: &Control) -> Result<R::Summary, RunError> {
    let clock = run.clock();
    let mut progress = Progress::new(clock.end, clock.time, clock.steps, control.quiet);
    let mut warnings_shown = run.warnings().len();
    loop {
        let session = Session { wall: progress.wall(), stop: control.stop.load(Ordering::Relaxed) };
        let step = run.step(session).map_err(|error| keep_failed(&mut run, error))?;
        run.warnings()[warnings_shown..].iter().for_each(|warning| progress.warn(warning));
        warnings_shown = run.warnings().len();
        let clock = run.clock();
        match step {
            Step::Made => progress.update(clock.time, clock.steps, || run.details()),
            Step::Ended(summary) => {
                progress.finish();
                return Ok(summary);
            }
            Step::Stopped => {
                progress.finish();
                return Err(RunError::Interrupted { time: clock.time, dir: dir.to_owned() });
            }
        }
    }
}

/// Keeps the state of a failed run next to its last good checkpoint.
fn keep_failed<R: Run>(run: &mut R, error: StepFailure) -> RunError {
    match error {
        StepFailure::Output(error) => RunError::Output(error),
        StepFailure::Failure(failure) => {
            let kept = match run.keep_failed_state() {
                Ok(path) => path.display().to_string(),
                Err(error) => format!("no file ({error})"),
            };
            RunError::Failed { failure, kept }
        }
    }
}
