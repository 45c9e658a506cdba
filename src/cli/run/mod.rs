//! `breakwater run` and `breakwater resume`, and one file per kind of run for its terminal output.

pub(super) mod breakage;
mod dry_test;
pub(super) mod flume;
pub(super) mod fracture;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::Args;

use super::{
    Trouble,
    devices::DeviceArgument,
    folder::{fresh_folder, stem},
    input::{load, load_run, other_kind},
    machine::MachineArguments,
};
use crate::{
    case::{InputFile, InputKind},
    output::driver::RunError,
    simulation::{
        dry_test::recorder::DryTestRecorder,
        flume::{
            branch::Start,
            checkpoint::{Checkpoint, device_of},
            run::RunOptions,
        },
    },
    sph::device::DeviceChoice,
};

/// Run a flume case or dry test; write tables, ParaView files, summary and report to one folder.
#[derive(Args)]
pub struct RunArguments {
    /// The case file.
    case: PathBuf,
    /// Folder of the results; default: runs/NAME, with the name of the case file.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace the results in the folder; default: a folder with files is refused.
    #[arg(long)]
    overwrite: bool,
    /// Begin at the last checkpoint of the run in this folder; default: begin at the start of the case. The two cases
    /// may differ only in friction and the rest criterion, and the units must not have moved yet.
    #[arg(long, value_name = "DIR")]
    from: Option<PathBuf>,
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    device: DeviceArgument,
}

/// Continue an interrupted run from its last checkpoint; the results are bitwise those of an uninterrupted run.
#[derive(Args)]
pub struct ResumeArguments {
    /// Folder of the run.
    dir: PathBuf,
    #[command(flatten)]
    machine: MachineArguments,
    /// What computes the water, as for `run`; default: the device that has computed it so far.
    #[arg(long, value_name = "DEVICE")]
    device: Option<DeviceChoice>,
}

impl RunArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let case = load(&self.case, &[InputKind::Flume, InputKind::DryTest])?;
        let dir = self.out.unwrap_or_else(|| Path::new("runs").join(stem(&self.case)));
        let control = self.machine.prepare()?;
        match case {
            InputFile::Flume(case) => {
                let case = Arc::from(case);
                let device = self.device.open(&case, control.quiet)?;
                let options = RunOptions { device, control, until: None };
                let start = match &self.from {
                    Some(from) if is_same_folder(from, &dir) => {
                        let what = "is the folder of the results; give another one with --out";
                        return Err(Trouble::refused(format!("--from {}: {what}", from.display())));
                    }
                    Some(from) => Some(Start::at(Arc::clone(&case), from, &options).map_err(Trouble::refused)?),
                    None => None,
                };
                fresh_folder(&dir, self.overwrite)?;
                flume::run_case(&case, start, &dir, &options)
            }
            InputFile::DryTest(case) => {
                self.device.refuse_card()?;
                if let Some(from) = &self.from {
                    let what = "only flume cases can begin at the checkpoint of another run";
                    return Err(Trouble::refused(format!("--from {}: {what}", from.display())));
                }
                fresh_folder(&dir, self.overwrite)?;
                dry_test::run_case(&Arc::from(case), &dir, &control)
            }
            other => Err(other_kind(&self.case, other.kind())),
        }
    }
}

impl ResumeArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        match load_run(&self.dir, &[InputKind::Flume, InputKind::DryTest, InputKind::Fracture])? {
            InputFile::Flume(case) => {
                require_checkpoint(&self.dir.join(Checkpoint::FILE))?;
                let (case, control) = (Arc::from(case), self.machine.prepare()?);
                let before = || device_of(&self.dir).map_or(DeviceChoice::Auto, |name| DeviceChoice::named(&name));
                let device = DeviceArgument { device: self.device.unwrap_or_else(before) };
                let device = device.open(&case, control.quiet)?;
                flume::resume_case(&case, &self.dir, &RunOptions { device, control, until: None })
            }
            InputFile::DryTest(case) => {
                require_checkpoint(&self.dir.join(DryTestRecorder::CHECKPOINT))?;
                let control = self.machine.prepare()?;
                DeviceArgument { device: self.device.unwrap_or_default() }.refuse_card()?;
                dry_test::resume_case(&Arc::from(case), &self.dir, &control)
            }
            InputFile::Fracture(case) => fracture::resume_run(&case, &self.dir, &self.machine),
            other => Err(other_kind(&self.dir, other.kind())),
        }
    }
}

/// Refuses to resume a run without a checkpoint.
fn require_checkpoint(path: &Path) -> Result<(), Trouble> {
    if path.exists() {
        return Ok(());
    }
    Err(Trouble::refused(format!(
        "{}: there is no checkpoint to resume from; start again with breakwater run or breakwater fracture",
        path.display()
    )))
}

fn is_same_folder(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// A case that cannot be set up is refused input; every other error is a failure of the work.
fn trouble(error: RunError) -> Trouble {
    match error {
        RunError::Setup(_) => Trouble::refused(error),
        _ => Trouble::failed(error),
    }
}
