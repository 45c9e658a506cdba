//! Executes the runs of a sweep in parallel on this machine.

use std::{
    ffi::OsString,
    fs::File,
    io::{self, Write},
    path::Path,
    process::{Command, Stdio},
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

use super::{member::Outcome, plan::Member};

/// Largest number of attempts per run.
const TRIES: usize = 2;

/// Arguments that all runs of a sweep have in common.
#[derive(Debug, Clone)]
pub struct Work<'a> {
    /// The sweep file.
    pub sweep_file: &'a Path,
    /// The folder of the sweep.
    pub dir: &'a Path,
    /// Threads per run.
    pub threads: usize,
    /// Device of each run, as in the option `--device`.
    pub device: &'a str,
}

impl Work<'_> {
    /// Returns the command that starts or resumes one run.
    ///
    /// # Panics
    /// If `program`, the words that start the program, is empty.
    pub fn command(&self, program: &[OsString], member: usize) -> Command {
        let mut command = Command::new(&program[0]);
        command.args(&program[1..]);
        command.arg("sweep").arg(self.sweep_file).arg("--out").arg(self.dir);
        command.args(["--member", &member.to_string(), "--threads", &self.threads.to_string()]);
        command.args(["--device", self.device]);
        command
    }

    /// Executes a run with at most [`TRIES`] attempts; appends the output of the run to its log file.
    fn execute(&self, program: &[OsString], member: &Member) -> io::Result<Outcome> {
        for attempt in 1..=TRIES {
            let log = File::options().create(true).append(true).open(member.log(self.dir))?;
            let mut command = self.command(program, member.number);
            command.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log.try_clone()?);
            let status = command.status()?;
            if status.success() && matches!(member.outcome(self.dir), Outcome::Finished(_)) {
                break;
            }
            writeln!(&log, "{}attempt {attempt} of {TRIES}, {status}", Member::FAILED)?;
            // Status 2: the program refused its input, so a second attempt would fail too.
            if status.code() == Some(2) {
                break;
            }
        }
        Ok(member.outcome(self.dir))
    }

    /// Executes all runs that are not finished, at most `jobs` in parallel. When a run ends, `report` receives the run,
    /// its state and the number of remaining runs.
    ///
    /// # Errors
    /// If a process cannot be started or a log cannot be written.
    pub fn execute_all(
        &self,
        program: &[OsString],
        members: &[Member],
        jobs: usize,
        report: impl Fn(&Member, &Outcome, usize) + Sync,
    ) -> io::Result<()> {
        let finished = |member: &&Member| matches!(member.outcome(self.dir), Outcome::Finished(_));
        let waiting: Vec<&Member> = members.iter().filter(|member| !finished(member)).collect();
        let (next, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let first_error = Mutex::new(None);
        std::thread::scope(|scope| {
            for _ in 0..jobs.min(waiting.len()) {
                scope.spawn(|| {
                    while let Some(member) = waiting.get(next.fetch_add(1, Ordering::Relaxed)) {
                        match self.execute(program, member) {
                            Ok(outcome) => {
                                let left = waiting.len() - 1 - ended.fetch_add(1, Ordering::Relaxed);
                                report(member, &outcome, left);
                            }
                            Err(error) => {
                                first_error.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                                return;
                            }
                        }
                    }
                });
            }
        });
        first_error.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
    }
}
