//! `breakwater run` and `breakwater resume`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{
    AnyCase, Trouble, devices::DeviceArgument, dry_report, fracture, fresh_folder, hand_over, is_fracture, load_any,
    stem,
};
use crate::{
    case::{Case, Reference},
    output::{Summary, progress::readable},
    simulation::{
        dry_test::{self, recorder::DryRecorder},
        flume::{
            branch::Start,
            checkpoint::{Checkpoint, device_of},
            run::{RunError, RunOptions, resume, run},
        },
    },
    sph::device::DeviceChoice,
};

/// Run a case: wave, water, units, contact; tables, ParaView files, summary and report come into one folder.
#[derive(Args)]
pub struct RunArguments {
    /// The case file.
    case: PathBuf,
    /// Folder of the results; without it, runs/<name of the case>.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace what the folder holds.
    #[arg(long)]
    overwrite: bool,
    /// Begin at the last checkpoint of the run in this folder, whose case is the same but for friction and the rule of
    /// rest, and whose units have not moved yet: the wave up to there is not computed again.
    #[arg(long, value_name = "DIR")]
    from: Option<PathBuf>,
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    device: DeviceArgument,
}

/// Go on with an interrupted run from its last checkpoint; the end has the same bits as that of an unbroken run.
#[derive(Args)]
pub struct ResumeArguments {
    /// Folder of the run.
    dir: PathBuf,
    #[command(flatten)]
    machine: MachineArguments,
    /// What computes the water, as for run; without it, what has computed it so far.
    #[arg(long, value_name = "DEVICE")]
    device: Option<DeviceChoice>,
}

/// What a run takes of the machine.
#[derive(Args)]
pub(super) struct MachineArguments {
    /// Threads; without it, one a core. The results do not depend on it.
    #[arg(long)]
    pub(super) threads: Option<usize>,
    /// No progress.
    #[arg(long)]
    pub(super) quiet: bool,
}

impl RunArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let case = load_any(&self.case)?;
        let dir = self.out.unwrap_or_else(|| Path::new("runs").join(stem(&self.case)));
        let mut options = self.machine.prepare()?;
        if let AnyCase::Wet(case) = &case {
            options.device = self.device.open(case, options.quiet)?;
        }
        let start = match &self.from {
            Some(from) => Some(start_at(&case, from, &dir, &options)?),
            None => None,
        };
        fresh_folder(&dir, self.overwrite)?;
        match case {
            AnyCase::Wet(case) => {
                introduce(&case, &dir, &options);
                let ended = match start {
                    Some(start) => start.run(&dir, &options),
                    None => run(case.clone(), &dir, &options),
                };
                let summary = finish(ended, &dir)?;
                hand_over::of_run(&case, &summary, &dir, options.quiet)
            }
            AnyCase::Dry(case) => {
                self.device.refuse_card()?;
                dry_report::introduce(&case, &dir, options.quiet);
                let summary = dry_report::finish(dry_test::run::run(case.clone(), &dir, options.quiet), &dir)?;
                hand_over::of_dry_run(&case, &summary, &dir, options.quiet)
            }
        }
    }
}

impl ResumeArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let file = self.dir.join("case.json");
        if is_fracture(&file) {
            return fracture::resume_run(&self.dir, &self.machine);
        }
        let case = load_any(&file)?;
        let checkpoint = self.dir.join(match &case {
            AnyCase::Wet(_) => Checkpoint::FILE,
            AnyCase::Dry(_) => DryRecorder::CHECKPOINT,
        });
        if !checkpoint.exists() {
            return Err(Trouble::refused(format!(
                "{}: there is no checkpoint; the run ended before its first one, start it again with breakwater run",
                checkpoint.display()
            )));
        }
        let mut options = self.machine.prepare()?;
        match case {
            AnyCase::Wet(case) => {
                let before = || device_of(&self.dir).map_or(DeviceChoice::Auto, |name| DeviceChoice::named(&name));
                let device = DeviceArgument { device: self.device.unwrap_or_else(before) };
                options.device = device.open(&case, options.quiet)?;
                introduce(&case, &self.dir, &options);
                let summary = finish(resume(case.clone(), &self.dir, &options), &self.dir)?;
                hand_over::of_run(&case, &summary, &self.dir, options.quiet)
            }
            AnyCase::Dry(case) => {
                DeviceArgument { device: self.device.unwrap_or_default() }.refuse_card()?;
                dry_report::introduce(&case, &self.dir, options.quiet);
                let summary =
                    dry_report::finish(dry_test::run::resume(case.clone(), &self.dir, options.quiet), &self.dir)?;
                hand_over::of_dry_run(&case, &summary, &self.dir, options.quiet)
            }
        }
    }
}

impl MachineArguments {
    /// Size the thread pool.
    pub(super) fn prepare(&self) -> Result<RunOptions, Trouble> {
        let threads = self.threads.unwrap_or(0);
        if self.threads == Some(0) || threads > 1024 {
            return Err(Trouble::refused(format!("--threads {threads}: must be between 1 and 1024")));
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(Trouble::failed)?;
        Ok(RunOptions { quiet: self.quiet, ..RunOptions::default() })
    }
}

/// A case with water where the run in another folder stands.
fn start_at<'a>(case: &AnyCase, from: &'a Path, dir: &Path, options: &RunOptions) -> Result<Start<'a>, Trouble> {
    let refused = |what: &str| Trouble::refused(format!("--from {}: {what}", from.display()));
    let AnyCase::Wet(case) = case else { return Err(refused("only runs with water can begin at another")) };
    if from.canonicalize().is_ok_and(|from| dir.canonicalize().is_ok_and(|dir| dir == from)) {
        return Err(refused("is the folder of the results; give another one with --out"));
    }
    Start::at(case.clone(), from, options).map_err(Trouble::refused)
}

fn introduce(case: &Case, dir: &Path, options: &RunOptions) {
    if options.quiet {
        return;
    }
    let estimate = case.estimate();
    eprintln!("{}", case.title);
    eprintln!(
        "  about {:.0} thousand particles, dp = {} m, {} s in about {:.0} steps on {}, {} threads",
        estimate.particles() / 1e3,
        case.domain.dp,
        case.stop.duration,
        estimate.steps,
        options.device.name(),
        rayon::current_num_threads()
    );
    for assumption in &case.assumptions {
        eprintln!("  assumed: {assumption}");
    }
    eprintln!("  results in {}", dir.display());
}

/// Say how a run ended.
pub(super) fn finish(ended: Result<Summary, RunError>, dir: &Path) -> Result<Summary, Trouble> {
    let summary = match ended {
        Ok(summary) => summary,
        Err(error @ RunError::Setup(_)) => return Err(Trouble::refused(error)),
        Err(error) => return Err(Trouble::failed(error)),
    };
    println!(
        "{:.2} s simulated in {} steps and {} ({})",
        summary.simulated_s,
        summary.steps,
        readable(summary.execution.wall_s),
        summary.stopped
    );
    for unit in &summary.units {
        let damaged = if unit.damaged { ", damaged" } else { "" };
        println!("  unit {:2}: moved {:.3} m{damaged}", unit.unit, unit.displacement_m);
    }
    if let (Some(mean), Some(ratio)) = (summary.mean_displacement_m, summary.damage_ratio) {
        println!("  mean displacement {mean:.3} m, damage ratio {:.0} %", 100.0 * ratio);
    }
    println!("report: {}", dir.join("report.html").display());
    if Reference::folder_of_run(dir).is_some() {
        println!("compare with the measurements: breakwater compare {}", dir.display());
    }
    Ok(summary)
}
