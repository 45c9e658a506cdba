//! `breakwater sweep`: many runs of one case with varied keys.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::{Args, ValueEnum};

use super::{
    Trouble,
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
        checkpoint::Checkpoint,
        run::{RunOptions, resume, run},
    },
    sweep::{
        member::Outcome,
        plan::{Member, Sweep},
        queue::Work,
        slurm,
        table::write_table,
    },
};

/// How often unfinished runs are submitted to Slurm.
const SUBMISSIONS: usize = 2;

/// Run a case for every combination of the listed values, and collect the results in one table and chart.
///
/// Finished runs are kept: repeat the command to continue after an interruption. A failed run is tried once more.
#[derive(Args)]
pub struct SweepArguments {
    /// The sweep file: title, case and `vary`, a list of {"key": "friction[1].coefficient", "values": [0.3, 0.6]} or
    /// {"key": ..., "from": 0.1, "to": 0.98, "count": 9}.
    sweep: PathBuf,
    /// Folder of the results; default: runs/NAME, with the name of the sweep file.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Number of runs at the same time on this machine; default: number of cores divided by --threads.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1024))]
    jobs: Option<u32>,
    /// Threads of each run; several runs with one thread each are faster than one run with several threads.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    #[command(flatten)]
    device: DeviceArgument,
    /// What starts the runs.
    #[arg(long, value_enum, default_value = "local")]
    launcher: Launcher,
    /// Extra option for sbatch, as in --slurm-option=--partition=long; may be repeated; default: none.
    #[arg(long = "slurm-option", value_name = "OPTION")]
    slurm_options: Vec<String>,
    /// Compute only the run with this number; 0 is the common start, if the sweep has one; default: all runs.
    #[arg(long, value_name = "NUMBER")]
    member: Option<usize>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Launcher {
    /// This command, on this machine.
    Local,
    /// A Slurm job array; this command waits until it ends.
    Slurm,
}

impl SweepArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let file = read(&self.sweep, &[InputKind::Sweep])?.parse().map_err(Trouble::refused)?;
        let sweep = Sweep::new(file, &self.sweep).map_err(Trouble::refused)?;
        let dir = self.out.clone().unwrap_or_else(|| Path::new("runs").join(stem(&self.sweep)));
        fs::create_dir_all(&dir).map_err(|error| Trouble::refused(format!("{}: {error}", dir.display())))?;
        if let Some(number) = self.member {
            let (first, last) = (usize::from(sweep.start.is_none()), sweep.members.len());
            let member = sweep.member(number).ok_or_else(|| {
                Trouble::refused(format!(
                    "--member {number}: must be between {first} and {last}, the numbers of the runs"
                ))
            })?;
            return self.make(&sweep, member, &dir);
        }
        // Absolute paths: the processes and nodes may have other working directories.
        let absolute = |path: &Path| path.canonicalize().map_err(Trouble::failed);
        let (sweep_file, dir, program) =
            (absolute(&self.sweep)?, absolute(&dir)?, std::env::current_exe().map_err(Trouble::failed)?);
        let device = self.device.device.to_string();
        let work = Work { sweep_file: &sweep_file, dir: &dir, threads: self.threads as usize, device: &device };
        println!("{}: {} runs, results in {}", sweep.title, sweep.members.len(), dir.display());
        // The other runs begin at the end of the common start.
        if let Some(start) = &sweep.start {
            self.launch(&work, &program, std::slice::from_ref(start))?;
            finished(start, &dir)?;
        }
        self.launch(&work, &program, &sweep.members)?;
        let outcomes: Vec<Outcome> = sweep.members.iter().map(|member| member.outcome(&dir)).collect();
        println!("{}", write_table(&sweep, &outcomes, &dir).map_err(Trouble::failed)?.display());
        if let Some(chart) = write_sweep_chart(&sweep, &outcomes, &dir).map_err(Trouble::failed)? {
            println!("{}", chart.display());
        }
        let unfinished = |(_, outcome): &(&Member, &Outcome)| !matches!(outcome, Outcome::Finished(_));
        let missing: Vec<&str> =
            sweep.members.iter().zip(&outcomes).filter(unfinished).map(|(member, _)| member.name.as_str()).collect();
        if missing.is_empty() {
            return Ok(());
        }
        Err(Trouble::failed(format!(
            "{} of {} runs are not finished: {}; see their .log files in {}, then repeat the command",
            missing.len(),
            sweep.members.len(),
            missing.join(", "),
            dir.display()
        )))
    }

    fn launch(&self, work: &Work, program: &Path, members: &[Member]) -> Result<(), Trouble> {
        match self.launcher {
            Launcher::Local => self.make_here(work, program, members),
            Launcher::Slurm => self.make_by_slurm(work, program, members),
        }
    }

    fn make_here(&self, work: &Work, program: &Path, members: &[Member]) -> Result<(), Trouble> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let jobs = self.jobs.map_or_else(|| (cores / work.threads).max(1), |jobs| jobs as usize);
        let tell = |member: &Member, outcome: &Outcome, left: usize| {
            let result = match outcome {
                Outcome::Finished(summary) => in_words(summary),
                Outcome::Missing => "not finished".to_owned(),
                Outcome::Failed(words) => words.clone(),
            };
            println!("{}: {result} ({left} left)", member.name);
        };
        work.make_all(program, members, jobs, tell).map_err(Trouble::failed)
    }

    fn make_by_slurm(&self, work: &Work, program: &Path, members: &[Member]) -> Result<(), Trouble> {
        for _ in 0..SUBMISSIONS {
            let script = slurm::write_script(work, program, members, &self.slurm_options);
            let Some(script) = script.map_err(Trouble::failed)? else { break };
            let job = slurm::submit(&script).map_err(Trouble::failed)?;
            println!("job {job} from {}", script.display());
            let mut last = usize::MAX;
            let tell = |tasks: usize| {
                if tasks != last {
                    println!("{tasks} runs queued or running");
                    last = tasks;
                }
            };
            slurm::wait(&job, tell).map_err(Trouble::failed)?;
        }
        Ok(())
    }

    /// Computes one run, or continues it.
    fn make(&self, sweep: &Sweep, member: &Member, sweep_dir: &Path) -> Result<(), Trouble> {
        let dir = member.dir(sweep_dir);
        let name = sweep.case.display().to_string();
        let case = Arc::new(Case::from_str(&member.text, &name).map_err(Trouble::refused)?);
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
                    let start = Start::at(case.clone(), &from, &options).map_err(Trouble::failed)?;
                    fresh_folder(&dir, true)?;
                    start.run(&dir, &options)
                }
                _ => {
                    fresh_folder(&dir, true)?;
                    run(case.clone(), &dir, &options)
                }
            }
        };
        let summary = flume::finish(ended, &dir)?;
        if member.until.is_some() {
            return Ok(());
        }
        breakage::after_flume_run(&case, &summary, &dir, &options.control)
    }
}

/// Returns the folder of the common start, if that run is finished.
fn finished(start: &Member, sweep_dir: &Path) -> Result<PathBuf, Trouble> {
    let dir = start.dir(sweep_dir);
    match start.outcome(sweep_dir) {
        Outcome::Finished(_) => Ok(dir),
        _ => Err(Trouble::failed(format!(
            "{}: the common start is not finished, see {}; the other runs need its last checkpoint",
            dir.display(),
            start.log(sweep_dir).display()
        ))),
    }
}

/// Describes the result of a run.
fn in_words(summary: &Summary) -> String {
    match (summary.mean_displacement_m, summary.damage_ratio) {
        (Some(mean), Some(ratio)) => format!("mean displacement {mean:.3} m, damage ratio {:.0} %", 100.0 * ratio),
        _ => "finished".to_owned(),
    }
}
