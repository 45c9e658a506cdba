//! Run loop shared by all runs: time steps, progress, final outputs, failures and interruptions.
//!
//! Every kind of run implements [`Run`]; [`drive`] runs it to its end.

use std::{
    error::Error,
    io,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use thiserror::Error;

use super::{OutputError, progress::Progress};

/// Reason why a run ended before its regular end.
#[derive(Debug, Error)]
pub enum RunError {
    /// The case cannot be set up because of its input.
    #[error(transparent)]
    Setup(Box<dyn Error + Send + Sync>),
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The state became invalid. The state before the failed time step is saved in a file.
    #[error("{failure}\nThe state before the failure is in {kept}; the last regular checkpoint is unchanged.")]
    Failed {
        /// Cause of the failure.
        failure: Box<dyn Error + Send + Sync>,
        /// File with the state before the failed time step.
        kept: String,
    },
    /// The user stopped the run.
    #[error("stopped by the user at {time:.4} s; resume with: breakwater resume {}", dir.display())]
    Interrupted {
        /// Simulated time [s].
        time: f64,
        /// Folder of the run.
        dir: PathBuf,
    },
}

impl RunError {
    /// Wraps an error of the set-up, for use with `map_err`.
    pub fn setup(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Setup(error.into())
    }
}

/// Reason why a call of [`Run::step`] failed.
#[derive(Debug)]
pub enum StepFailure {
    /// A file cannot be written.
    Output(OutputError),
    /// The state became invalid.
    Failure(Box<dyn Error + Send + Sync>),
}

impl StepFailure {
    /// Wraps the cause of an invalid state, for use with `map_err`.
    pub fn failure(failure: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Failure(failure.into())
    }
}

impl From<OutputError> for StepFailure {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

/// Control of a run by the user.
#[derive(Debug, Clone, Default)]
pub struct Control {
    /// True if progress is hidden.
    pub quiet: bool,
    /// True if the command line prints no results either, because another program shows them.
    pub silent: bool,
    /// Progress for another program that shows it.
    pub seen: Arc<Seen>,
    /// Stop signal: when set to true, the run writes a checkpoint and ends.
    pub stop: Arc<AtomicBool>,
}

/// Simulated time and end of a run in progress; another thread may read them at any time.
#[derive(Debug, Default)]
pub struct Seen {
    /// The bits of the two numbers.
    bits: [AtomicU64; 2],
}

impl Seen {
    /// Returns the simulated time and the time at which the run ends at the latest [s]; both are 0 before the start.
    pub fn times_s(&self) -> [f64; 2] {
        self.bits.each_ref().map(|bits| f64::from_bits(bits.load(Ordering::Relaxed)))
    }

    fn set(&self, clock: &Clock) {
        self.bits[0].store(clock.time.to_bits(), Ordering::Relaxed);
        self.bits[1].store(clock.end.to_bits(), Ordering::Relaxed);
    }
}

impl Control {
    /// Returns a `Control` that hides progress and whose stop signal is false.
    pub fn quiet() -> Self {
        Self { quiet: true, ..Self::default() }
    }

    /// Makes Ctrl-C and SIGTERM stop the run with a checkpoint; a second signal ends the process at once.
    ///
    /// # Errors
    /// If the operating system refuses the signal handlers.
    pub fn catch_signals(&self) -> io::Result<()> {
        for signal in signal_hook::consts::TERM_SIGNALS {
            signal_hook::flag::register_conditional_shutdown(*signal, 1, self.stop.clone())?;
            signal_hook::flag::register(*signal, self.stop.clone())?;
        }
        Ok(())
    }
}

/// Progress of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// Simulated time at which the run ends at the latest [s].
    pub end: f64,
    /// Number of time steps since the start of the run, including the time steps before a resume.
    pub steps: u64,
}

/// Wall-clock time and stop signal, which [`drive`] passes to a run before each time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Session {
    /// Wall-clock time since this process started or resumed the run [s].
    pub wall: f64,
    /// True if the run must write a checkpoint and stop.
    pub stop: bool,
}

/// Result of a call of [`Run::step`].
#[derive(Debug, Clone, PartialEq)]
pub enum Step<Summary> {
    /// One time step is made, and the run continues.
    Continues,
    /// The run has ended, and all its files are written.
    Ended(Summary),
    /// The user stopped the run, and its checkpoint is written.
    Stopped,
}

/// A run that [`drive`] can execute.
pub trait Run {
    /// Summary of the run.
    type Summary;

    /// Returns the progress of the run.
    fn clock(&self) -> Clock;

    /// Evaluates the current state, writes the outputs that are due, and makes one time step. At the end of the run,
    /// writes the final outputs and the summary instead. If the user stops the run, writes a checkpoint instead.
    ///
    /// # Errors
    /// If a file cannot be written or the state became invalid.
    fn step(&mut self, session: Session) -> Result<Step<Self::Summary>, StepFailure>;

    /// Writes the state before a failed time step to a separate file and returns the path of this file.
    ///
    /// # Errors
    /// If the file cannot be written.
    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError>;

    /// Returns the details at the end of the progress line.
    fn details(&self) -> String;

    /// Returns all warnings since the start of the run.
    fn warnings(&self) -> &[String] {
        &[]
    }
}

/// Executes a run to its end and shows the progress. `dir` is the run folder.
///
/// The loop runs on a thread of the rayon pool. On any other thread, each of the parallel loops in a time step would
/// wake the pool and then wait for it, which costs small runs much of their time.
///
/// # Errors
/// If a file cannot be written, the state becomes invalid, or the user stops the run.
pub fn drive<R: Run<Summary: Send> + Send>(run: R, dir: &Path, control: &Control) -> Result<R::Summary, RunError> {
    rayon::scope(|_| run_loop(run, dir, control))
}

fn run_loop<R: Run>(mut run: R, dir: &Path, control: &Control) -> Result<R::Summary, RunError> {
    let clock = run.clock();
    let mut progress = Progress::new(clock.end, clock.time, clock.steps, control.quiet);
    let mut warnings_shown = run.warnings().len();
    loop {
        let session = Session { wall: progress.wall(), stop: control.stop.load(Ordering::Relaxed) };
        let step = run.step(session).map_err(|error| keep_failed(&mut run, error))?;
        run.warnings()[warnings_shown..].iter().for_each(|warning| progress.warn(warning));
        warnings_shown = run.warnings().len();
        let clock = run.clock();
        control.seen.set(&clock);
        match step {
            Step::Continues => progress.update(clock.time, clock.steps, || run.details()),
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

/// Converts the failure of a time step to an error of the run; saves the state if it became invalid.
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
