//! `breakwater run` and `breakwater resume`. One file per kind of run prints to the terminal.

pub(super) mod breakage;
mod dry_test;
pub(super) mod flume;
pub(super) mod fracture;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::Args;
use serde_json::{Map, Value};

use super::{
    CommandError,
    devices::DeviceArgument,
    folder::{fresh_folder, stem},
    input::{load, load_run, other_kind, read_run},
    machine::MachineArguments,
};
use crate::{
    case::{Document, InputFile, InputKind},
    output::{
        OutputError, Summary,
        driver::{Control, RunError},
        write_atomically,
    },
    simulation::{
        dry_test::recorder::DryTestRecorder,
        flume::{
            branch::Start,
            outputs::checkpoint::{Checkpoint, device_of},
            run::RunOptions,
        },
        fracture::checkpoint as fracture_checkpoint,
    },
    sph::device::DeviceChoice,
};

/// Largest number of units whose results are printed to the terminal.
const MOST_LINES: usize = 20;

/// Run a flume case or dry test; write tables, ParaView files, summary and, for flume cases, a report to one folder.
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
    /// Begin at the last checkpoint of the run in this folder; default: begin at the start of the case. The cases of
    /// both runs may differ only in the keys `friction`, `stop.at_rest`, `title`, `assumptions` and `reference`. No
    /// unit may have moved before the checkpoint.
    #[arg(long, value_name = "DIR")]
    from: Option<PathBuf>,
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    device: DeviceArgument,
}

/// Continue a run from its last checkpoint; the results are bitwise identical to an uninterrupted run.
///
/// A finished run continues if its duration grows: with --until, or by a larger `stop.duration_s` in the case.json of its
/// folder. In this file, title, assumptions, reference, stop rules and output intervals may also change.
#[derive(Args)]
pub struct ResumeArguments {
    /// Folder of the run.
    dir: PathBuf,
    /// Continue until this simulated time [s]; replaces `stop.duration_s` in the case.json of the folder.
    #[arg(long, value_name = "SECONDS")]
    until: Option<f64>,
    #[command(flatten)]
    machine: MachineArguments,
    /// Device that computes the water, as for `run`; default: the device of the interrupted run.
    #[arg(long, value_name = "DEVICE")]
    device: Option<DeviceChoice>,
}

impl RunArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let case = load(&self.case, &[InputKind::Flume, InputKind::DryTest])?;
        let dir = self.out.unwrap_or_else(|| Path::new("runs").join(stem(&self.case)));
        let control = self.machine.prepare()?;
        let job = Job { path: &self.case, dir: &dir, overwrite: self.overwrite, device: self.device, control };
        job.run(case, self.from.as_deref())
    }
}

/// A run from the start of its case: everything except the case.
struct Job<'a> {
    /// Path of the case file, for messages.
    path: &'a Path,
    /// Folder of the results.
    dir: &'a Path,
    /// True if the results of an earlier run in the folder are deleted.
    overwrite: bool,
    device: DeviceArgument,
    control: Control,
}

impl Job<'_> {
    /// Runs a case of any kind, from its start or from the last checkpoint of the flume run in the folder `from`.
    fn run(self, case: InputFile, from: Option<&Path>) -> Result<(), CommandError> {
        let Self { path, dir, overwrite, device, control } = self;
        if let (Some(from), false) = (from, matches!(case, InputFile::Flume(_))) {
            let what = "only flume cases can begin at the checkpoint of another run";
            return Err(CommandError::refused(format!("--from {}: {what}", from.display())));
        }
        match case {
            InputFile::Flume(case) => {
                let case = Arc::from(case);
                let device = device.open(&case, control.quiet)?;
                let options = RunOptions { device, control, until: None };
                let start = match from {
                    Some(from) if is_same_folder(from, dir) => {
                        let what = "is the folder of the results; choose another folder with --out DIR";
                        return Err(CommandError::refused(format!("--from {}: {what}", from.display())));
                    }
                    Some(from) => Some(Start::at(Arc::clone(&case), from, &options).map_err(CommandError::refused)?),
                    None => None,
                };
                fresh_folder(dir, overwrite)?;
                flume::run_case(&case, start, dir, &options)
            }
            InputFile::DryTest(case) => {
                device.refuse_card()?;
                fresh_folder(dir, overwrite)?;
                dry_test::run_case(&Arc::from(case), dir, &control)
            }
            InputFile::Fracture(case) => {
                device.refuse_card()?;
                fracture::run_case(&case, path, dir, overwrite, &control)
            }
            other => Err(other_kind(path, other.kind())),
        }
    }
}

/// Runs a case of any kind for another program, into the folder `dir`.
///
/// # Errors
/// If the case cannot be set up, the folder is not empty, or the run fails.
pub fn run_for(
    case: InputFile,
    path: &Path,
    dir: &Path,
    overwrite: bool,
    device: DeviceChoice,
    control: Control,
) -> Result<(), CommandError> {
    Job { path, dir, overwrite, device: DeviceArgument { device }, control }.run(case, None)
}

/// Continues the run in the folder `dir` for another program.
///
/// # Errors
/// If the folder has no checkpoint, or the run fails.
pub fn resume_for(dir: &Path, device: Option<DeviceChoice>, control: Control) -> Result<(), CommandError> {
    continue_run(dir, device, || Ok(control))
}

impl ResumeArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        if let Some(until) = self.until {
            set_duration(&self.dir, until)?;
        }
        continue_run(&self.dir, self.device, || self.machine.prepare())
    }
}

/// Kinds of input whose runs can continue.
const KINDS: [InputKind; 3] = [InputKind::Flume, InputKind::DryTest, InputKind::Fracture];

/// Continues the run in a folder. `prepare` is called after the case and its checkpoint have been found.
fn continue_run(
    dir: &Path,
    device: Option<DeviceChoice>,
    prepare: impl FnOnce() -> Result<Control, CommandError>,
) -> Result<(), CommandError> {
    match load_run(dir, &KINDS)? {
        InputFile::Flume(case) => {
            require_checkpoint(dir, Checkpoint::FILE)?;
            let (case, control) = (Arc::from(case), prepare()?);
            let before = || device_of(dir).map_or(DeviceChoice::Auto, |name| DeviceChoice::named(&name));
            let device = DeviceArgument { device: device.unwrap_or_else(before) };
            let device = device.open(&case, control.quiet)?;
            flume::resume_case(&case, dir, &RunOptions { device, control, until: None })
        }
        InputFile::DryTest(case) => {
            require_checkpoint(dir, DryTestRecorder::CHECKPOINT)?;
            let control = prepare()?;
            DeviceArgument { device: device.unwrap_or_default() }.refuse_card()?;
            dry_test::resume_case(&Arc::from(case), dir, &control)
        }
        InputFile::Fracture(case) => {
            require_checkpoint(dir, fracture_checkpoint::FILE)?;
            fracture::resume_case(&case, dir, &prepare()?)
        }
        other => Err(other_kind(dir, other.kind())),
    }
}

/// Returns an error if the run folder `dir` has no checkpoint of the name `file`.
fn require_checkpoint(dir: &Path, file: &str) -> Result<(), CommandError> {
    let path = dir.join(file);
    if path.exists() {
        return Ok(());
    }
    let reason = if dir.join(Summary::FILE).exists() {
        "the run has finished without a checkpoint; its results are in summary.json"
    } else {
        "there is no checkpoint to resume from; start again with breakwater run or breakwater fracture"
    };
    Err(CommandError::refused(format!("{}: {reason}", path.display())))
}

/// Writes `stop.duration_s` into the case.json of a run folder. Refuses a value with which the case is not valid.
fn set_duration(dir: &Path, until: f64) -> Result<(), CommandError> {
    let refused = |error: &dyn std::fmt::Display| CommandError::refused(format!("--until {until}: {error}"));
    let document = read_run(dir, &KINDS)?;
    let mut keys: Map<String, Value> = document.parse().map_err(CommandError::refused)?;
    if let Some(stop) = keys.get_mut("stop").and_then(Value::as_object_mut) {
        stop.insert("duration_s".to_owned(), until.into());
    }
    let text = serde_json::to_string_pretty(&keys).map_err(|error| refused(&error))?;
    let changed = Document::new(text.clone(), &document.name).map_err(CommandError::refused)?;
    InputFile::from_document(&changed).map_err(|errors| refused(&errors))?;
    write_atomically(&dir.join("case.json"), text.as_bytes()).map_err(CommandError::failed)
}

fn is_same_folder(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// Converts a set-up error to refused input (exit code 2) and every other error to a failure (exit code 1). `dir` is the
/// run folder.
fn command_error(error: RunError, dir: &Path) -> CommandError {
    match error {
        RunError::Setup(_) => CommandError::refused(error),
        RunError::Output(error) => {
            let mut checkpoints = [Checkpoint::FILE, DryTestRecorder::CHECKPOINT].into_iter();
            let dir_name = dir.display();
            let next = if checkpoints.any(|file| dir.join(file).exists()) {
                format!("the last checkpoint is complete; free some space, then: breakwater resume {dir_name}")
            } else {
                "there is no checkpoint yet; free some space, then start again with --overwrite".to_owned()
            };
            output_error(error, &next)
        }
        _ => CommandError::failed(error),
    }
}

/// Converts an error of the report of the run in the folder `dir` to a failure.
fn report_error(error: OutputError, dir: &Path) -> CommandError {
    let dir_name = dir.display();
    output_error(error, &format!("the run is complete; free some space, then: breakwater report {dir_name}"))
}

/// Converts an error to a failure. For a full disk, the message ends with `next`: the state of the run, and what to do.
fn output_error(error: OutputError, next: &str) -> CommandError {
    if error.is_full_disk() { CommandError::failed(format!("{error}; {next}")) } else { CommandError::failed(error) }
}
