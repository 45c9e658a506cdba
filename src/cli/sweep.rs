//! `breakwater sweep`: many runs of one case with varied keys.

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::{Args, ValueEnum};

use super::{
    CommandError, counted,
    devices::DeviceArgument,
    folder::{fresh_folder, stem},
    input::read,
    machine::MachineArguments,
    run::{breakage, flume},
};
use crate::{
    case::{Case, InputKind},
    output::Summary,
    report::sweep::write_sweep_chart,
    simulation::flume::{
        branch::Start,
        outputs::checkpoint::Checkpoint,
        run::{RunOptions, resume, run},
    },
    sweep::{
        ensemble::{ensembles, write_ensembles},
        member::Outcome,
        plan::{Member, Sweep},
        queue::Work,
        slurm,
        table::write_table,
    },
};

/// Largest number of submissions of an unfinished run to Slurm.
const SUBMISSIONS: usize = 2;

/// Run a case with the values that the sweep file lists, and collect the results in one table and chart.
///
/// Finished runs are kept. To continue after an interruption, repeat the command. If a run fails, the command starts it
/// a second time.
#[derive(Args)]
pub struct SweepArguments {
    /// The sweep file, with the keys `title`, `case` and `vary`; `vary` is a list of entries such as
    /// {"key": "friction[1].coefficient", "values": [0.3, 0.6]}, {"key": ..., "from": 0.1, "to": 0.98, "count": 9} or, with
    /// `repetitions`, {"key": ..., "random": {"uniform": [0.3, 0.4]}}.
    sweep: PathBuf,
    /// Folder of the results; default: runs/NAME, with the name of the sweep file.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Number of runs at the same time on this machine; default: number of cores divided by --threads.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1024))]
    jobs: Option<u32>,
    /// Number of threads of each run; several runs with one thread each are faster than one run with several threads.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    #[command(flatten)]
    device: DeviceArgument,
    /// How the runs are started.
    #[arg(long, value_enum, default_value = "local")]
    launcher: Launcher,
    /// Extra option for the Slurm command sbatch, e.g. --slurm-option=--partition=long; may be repeated; default: none.
    #[arg(long = "slurm-option", value_name = "OPTION")]
    slurm_options: Vec<String>,
    /// Compute only the run with this number; 0 is the common start of all runs, if the sweep has one; default: all
    /// runs.
    #[arg(long, value_name = "NUMBER")]
    member: Option<usize>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Launcher {
    /// This command starts the runs on this machine.
    Local,
    /// This command submits a Slurm job array and waits until the array ends.
    Slurm,
}

impl SweepArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let file = read(&self.sweep, &[InputKind::Sweep])?.parse().map_err(CommandError::refused)?;
        let sweep = Sweep::new(file, &self.sweep).map_err(CommandError::refused)?;
        let dir = self.out.clone().unwrap_or_else(|| Path::new("runs").join(stem(&self.sweep)));
        fs::create_dir_all(&dir).map_err(|error| CommandError::refused(format!("{}: {error}", dir.display())))?;
        if let Some(number) = self.member {
            let (first, last) = (usize::from(sweep.start.is_none()), sweep.members.len());
            let member = sweep.member(number).ok_or_else(|| {
                CommandError::refused(format!(
                    "--member {number}: must be the number of a run, between {first} and {last}"
                ))
            })?;
            return self.make(&sweep, member, &dir);
        }
        // The paths are absolute, because the started processes may have other working directories.
        let absolute = |path: &Path| path.canonicalize().map_err(CommandError::failed);
        let (sweep_file, dir, program) = (absolute(&self.sweep)?, absolute(&dir)?, program()?);
        let device = self.device.device.to_string();
        let work = Work { sweep_file: &sweep_file, dir: &dir, threads: self.threads as usize, device: &device };
        println!("{}: {}, results in {}", sweep.title, counted(sweep.members.len(), "run"), dir.display());
        // All runs of the sweep continue from the end of the common start.
        if let Some(start) = &sweep.start {
            self.launch(&work, &program, std::slice::from_ref(start))?;
            finished(start, &dir)?;
        }
        self.launch(&work, &program, &sweep.members)?;
        let outcomes: Vec<Outcome> = sweep.members.iter().map(|member| member.outcome(&dir)).collect();
        println!("{}", write_table(&sweep, &outcomes, &dir).map_err(CommandError::failed)?.display());
        let ensembles = ensembles(&sweep, &outcomes);
        if !ensembles.is_empty() {
            println!("{}", write_ensembles(&sweep, &ensembles, &dir).map_err(CommandError::failed)?.display());
            ensembles.iter().for_each(|ensemble| println!("{}", ensemble.in_words()));
        }
        if let Some(chart) = write_sweep_chart(&sweep, &outcomes, &dir).map_err(CommandError::failed)? {
            println!("{}", chart.display());
        }
        let unfinished = |(_, outcome): &(&Member, &Outcome)| !matches!(outcome, Outcome::Finished(_));
        let missing: Vec<&str> =
            sweep.members.iter().zip(&outcomes).filter(unfinished).map(|(member, _)| member.name.as_str()).collect();
        if missing.is_empty() {
            return Ok(());
        }
        Err(CommandError::failed(format!(
            "{} of {} runs are not finished: {}; see their .log files in {}, then repeat the command",
            missing.len(),
            sweep.members.len(),
            missing.join(", "),
            dir.display()
        )))
    }

    fn launch(&self, work: &Work, program: &[OsString], members: &[Member]) -> Result<(), CommandError> {
        match self.launcher {
            Launcher::Local => self.run_locally(work, program, members),
            Launcher::Slurm => self.run_by_slurm(work, program, members),
        }
    }

    fn run_locally(&self, work: &Work, program: &[OsString], members: &[Member]) -> Result<(), CommandError> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let jobs = self.jobs.map_or_else(|| (cores / work.threads).max(1), |jobs| jobs as usize);
        let tell = |member: &Member, outcome: &Outcome, left: usize| {
            let result = match outcome {
                Outcome::Finished(summary) => in_words(summary),
                Outcome::Missing => "not finished".to_owned(),
                Outcome::Failed(words) => words.clone(),
            };
            println!("{}: {result} ({left} runs left)", member.name);
        };
        work.execute_all(program, members, jobs, tell).map_err(CommandError::failed)
    }

    fn run_by_slurm(&self, work: &Work, program: &[OsString], members: &[Member]) -> Result<(), CommandError> {
        for _ in 0..SUBMISSIONS {
            let script = slurm::write_script(work, program, members, &self.slurm_options);
            let Some(script) = script.map_err(CommandError::failed)? else { break };
            let job = slurm::submit(&script).map_err(CommandError::failed)?;
            println!("Slurm job {job}, script {}", script.display());
            let mut last = usize::MAX;
            let tell = |tasks: usize| {
                if tasks != last {
                    println!("{tasks} runs queued or running");
                    last = tasks;
                }
            };
            slurm::wait(&job, tell).map_err(CommandError::failed)?;
        }
        Ok(())
    }

    /// Computes one run of the sweep, or continues the run from its checkpoint.
    fn make(&self, sweep: &Sweep, member: &Member, sweep_dir: &Path) -> Result<(), CommandError> {
        let dir = member.dir(sweep_dir);
        let name = sweep.case.display().to_string();
        let case = Arc::new(Case::from_str(&member.text, &name).map_err(CommandError::refused)?);
        let machine = MachineArguments { threads: Some(self.threads as usize), quiet: false };
        let control = machine.prepare()?;
        let options = RunOptions { device: self.device.open(&case, control.quiet)?, control, until: member.until };
        let begun = fs::read_to_string(dir.join("case.json")).is_ok_and(|text| text == member.text);
        let ended = if begun && dir.join(Checkpoint::FILE).exists() {
            resume(case.clone(), &dir, &options)
        } else {
            match &sweep.start {
                Some(start) if member.until.is_none() => {
                    let from = finished(start, sweep_dir)?;
                    let start = Start::at(case.clone(), &from, &options).map_err(CommandError::failed)?;
                    fresh_folder(&dir, true)?;
                    start.run(&dir, &options)
                }
                _ => {
                    fresh_folder(&dir, true)?;
                    run(case.clone(), &dir, &options)
                }
            }
        };
        let summary = flume::finish(ended, &dir, &options.control)?;
        if member.until.is_some() {
            return Ok(());
        }
        breakage::after_flume_run(&case, &summary, &dir, &options.control)
    }
}

/// Returns the words that start this program.
fn program() -> Result<Vec<OsString>, CommandError> {
    match super::STARTED_BY.get() {
        Some(words) => Ok(words.clone()),
        None => Ok(vec![std::env::current_exe().map_err(CommandError::failed)?.into_os_string()]),
    }
}

/// Returns the folder of the common start; an error if the common start is not finished.
fn finished(start: &Member, sweep_dir: &Path) -> Result<PathBuf, CommandError> {
    let dir = start.dir(sweep_dir);
    match start.outcome(sweep_dir) {
        Outcome::Finished(_) => Ok(dir),
        _ => Err(CommandError::failed(format!(
            "{}: the common start is not finished, see {}; all other runs need the last checkpoint of the common start",
            dir.display(),
            start.log(sweep_dir).display()
        ))),
    }
}

/// Describes the result of a run in words.
fn in_words(summary: &Summary) -> String {
    match (summary.mean_displacement_m, summary.damage_ratio) {
        (Some(mean), Some(ratio)) => format!("mean displacement {mean:.3} m, damage ratio {:.0} %", 100.0 * ratio),
        _ => "finished".to_owned(),
    }
}
