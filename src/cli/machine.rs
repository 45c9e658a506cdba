//! Threads, progress output and signals of a run.

use clap::Args;

use super::CommandError;
use crate::output::driver::Control;

#[derive(Args)]
pub(super) struct MachineArguments {
    /// Number of threads; default: one per core. The results do not depend on the number of threads.
    #[arg(long)]
    pub(super) threads: Option<usize>,
    /// Show no progress; default: progress is shown.
    #[arg(long)]
    pub(super) quiet: bool,
}

impl MachineArguments {
    /// Sets up the thread pool. Ctrl-C and SIGTERM then stop the run with a checkpoint.
    pub(super) fn prepare(&self) -> Result<Control, CommandError> {
        let threads = self.threads.unwrap_or(0);
        if self.threads == Some(0) || threads > 1024 {
            return Err(CommandError::refused(format!("--threads {threads}: must be between 1 and 1024")));
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(CommandError::failed)?;
        let control = Control { quiet: self.quiet, ..Control::default() };
        control.catch_signals().map_err(CommandError::failed)?;
        Ok(control)
    }
}
