//! Executes the runs of a sweep as a job array of the Slurm workload manager.

use std::{ffi::OsString, io, path::Path, process::Command, time::Duration};

use super::{member::Outcome, plan::Member, queue::Work};
use crate::output::{OutputError, write_atomically};

/// Name of the script in the folder of the sweep.
pub const SCRIPT: &str = "sweep.sbatch";

/// Time between two queries of the Slurm queue.
const POLL_INTERVAL: Duration = Duration::from_secs(5);

/// Writes the script of a job array with one task per run that is not finished; `options` are added as `#SBATCH` lines.
/// If a node fails, Slurm queues its task again, and the run resumes from its checkpoint. Returns `None` if all runs
/// are finished.
///
/// # Errors
/// If the script cannot be written.
pub fn write_script(
    work: &Work,
    program: &[OsString],
    members: &[Member],
    options: &[String],
) -> Result<Option<std::path::PathBuf>, OutputError> {
    let waiting: Vec<String> = members
        .iter()
        .filter(|member| !matches!(member.outcome(work.dir), Outcome::Finished(_)))
        .map(|member| member.number.to_string())
        .collect();
    if waiting.is_empty() {
        return Ok(None);
    }
    let command = work.command(program, 0);
    let words: Vec<String> = std::iter::once(command.get_program())
        .chain(command.get_args())
        .map(|word| quoted(&word.to_string_lossy()))
        .collect();
    // Slurm sets this variable to the number of the run.
    let line = words.join(" ").replacen("--member 0", "--member \"$SLURM_ARRAY_TASK_ID\"", 1);
    let options: String = options.iter().map(|option| format!("#SBATCH {option}\n")).collect();
    let script = format!(
        "#!/bin/sh\n#SBATCH --job-name=breakwater\n#SBATCH --array={}\n#SBATCH --cpus-per-task={}\n\
         #SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output={}/slurm-%a.log\n{options}exec {line}\n",
        waiting.join(","),
        work.threads,
        work.dir.display(),
    );
    let path = work.dir.join(SCRIPT);
    write_atomically(&path, script.as_bytes())?;
    Ok(Some(path))
}

/// Quotes a word for the shell.
fn quoted(word: &str) -> String {
    let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./:=".contains(c));
    if plain { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

/// Submits the script to Slurm; returns the job number.
///
/// # Errors
/// If `sbatch` is missing or fails.
pub fn submit(script: &Path) -> io::Result<String> {
    let output = Command::new("sbatch").arg("--parsable").arg(script).output()?;
    if !output.status.success() {
        return Err(io::Error::other(format!("sbatch: {}", String::from_utf8_lossy(&output.stderr).trim())));
    }
    let number = String::from_utf8_lossy(&output.stdout);
    Ok(number.trim().split(';').next().unwrap_or_default().to_owned())
}

/// Waits until all tasks of the job have ended; `report` receives the number of remaining tasks.
///
/// # Errors
/// If `squeue` is missing.
pub fn wait(job: &str, mut report: impl FnMut(usize)) -> io::Result<()> {
    loop {
        let output = Command::new("squeue").args(["--noheader", "--array", "--job", job]).output()?;
        // After a job has ended, `squeue` can print an error message and no tasks; this counts as no tasks.
        let tasks = String::from_utf8_lossy(&output.stdout).lines().filter(|line| !line.trim().is_empty()).count();
        if tasks == 0 {
            return Ok(());
        }
        report(tasks);
        std::thread::sleep(POLL_INTERVAL);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_characters_are_quoted_for_the_shell() {
        assert_eq!(quoted("cases/fudo/sweep.json"), "cases/fudo/sweep.json");
        assert_eq!(quoted("a b'c"), "'a b'\\''c'");
    }
}
