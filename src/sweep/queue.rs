//! The runs of a sweep side by side on this machine.

use std::{
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

/// Tries of a run that fails.
const TRIES: usize = 2;

/// What a run is told besides its case.
#[derive(Debug, Clone)]
pub struct Work<'a> {
    /// The sweep file.
    pub sweep_file: &'a Path,
    /// The folder of the sweep.
    pub dir: &'a Path,
    /// Threads of each run.
    pub threads: usize,
    /// Device of each run, as `--device` has it.
    pub device: &'a str,
}

impl Work<'_> {
    /// The command that makes one run, or goes on with it.
    pub fn command(&self, program: &Path, member: usize) -> Command {
        let mut command = Command::new(program);
        command.arg("sweep").arg(self.sweep_file).arg("--out").arg(self.dir);
        command.args(["--member", &member.to_string(), "--threads", &self.threads.to_string()]);
        command.args(["--device", self.device]);
        command
    }

    /// Make a run, at most twice; its words go to its log.
    fn make(&self, program: &Path, member: &Member) -> io::Result<Outcome> {
        for attempt in 1..=TRIES {
            let log = File::options().create(true).append(true).open(member.log(self.dir))?;
            let mut command = self.command(program, member.number);
            command.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log.try_clone()?);
            let status = command.status()?;
            if status.success() && matches!(member.outcome(self.dir), Outcome::Finished(_)) {
                break;
            }
            writeln!(&log, "{}try {attempt} of {TRIES}, {status}", Member::FAILED)?;
            // Refused input is refused again.
            if status.code() == Some(2) {
                break;
            }
        }
        Ok(member.outcome(self.dir))
    }

    /// Make all runs that are not finished, `jobs` at a time; `tell` hears of each that has ended and of how many are
    /// left.
    ///
    /// # Errors
    /// If a process cannot be started or a log not be written.
    pub fn make_all(
        &self,
        program: &Path,
        members: &[Member],
        jobs: usize,
        tell: impl Fn(&Member, &Outcome, usize) + Sync,
    ) -> io::Result<()> {
        let finished = |member: &&Member| matches!(member.outcome(self.dir), Outcome::Finished(_));
        let waiting: Vec<&Member> = members.iter().filter(|member| !finished(member)).collect();
        let (next, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let trouble = Mutex::new(None);
        std::thread::scope(|scope| {
            for _ in 0..jobs.min(waiting.len()) {
                scope.spawn(|| {
                    while let Some(member) = waiting.get(next.fetch_add(1, Ordering::Relaxed)) {
                        match self.make(program, member) {
                            Ok(outcome) => {
                                let left = waiting.len() - 1 - ended.fetch_add(1, Ordering::Relaxed);
                                tell(member, &outcome, left);
                            }
                            Err(error) => {
                                trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                                return;
                            }
                        }
                    }
                });
            }
        });
        trouble.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
    }
}
