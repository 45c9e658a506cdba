//! `breakwater report`: writes the report of a run again, or that of a run in progress.

use std::{
    path::{Path, PathBuf},
    thread::sleep,
    time::{Duration, Instant, SystemTime},
};

use clap::Args;

use super::{CommandError, input::finished_run, input::read_run};
use crate::{
    case::InputKind,
    output::Summary,
    report::{
        fracture::{write_fracture_glb, write_fracture_report},
        run::{write_glb, write_live_report, write_report},
    },
};

/// Time after which the page of a run in progress loads itself again, and pause between two looks at the folder [s].
const RELOAD_S: u64 = 10;
const LOOK: Duration = Duration::from_secs(1);
/// Time without news from the run after which a message says so.
const QUIET: Duration = Duration::from_secs(300);
/// Largest number of looks in a row at which the report cannot be written.
const MOST_FAILURES: usize = 30;
const REPORT: &str = "report.html";

/// Write the report of a finished run again, from the files in its folder.
///
/// With --live, write the report of a flume run in progress whenever the run has written a snapshot, until the run ends.
/// The page loads itself again every 10 s and keeps the view of its film.
#[derive(Args)]
pub struct ReportArguments {
    /// Folder of the run.
    dir: PathBuf,
    /// Follow a run in progress.
    #[arg(long)]
    live: bool,
    /// Also write the film as a GLB file, for Blender, PowerPoint and other programs. It shows bed, units and, if the
    /// run recorded it, the surface of the water.
    #[arg(long, value_name = "FILE", conflicts_with = "live")]
    glb: Option<PathBuf>,
}

impl ReportArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        if self.live {
            follow(&self.dir)?;
            println!("{}", self.dir.join(REPORT).display());
            return Ok(());
        }
        let kind = finished_run(&self.dir)?;
        let (write, write_film): (Write, WriteFilm) = match kind {
            InputKind::Fracture => (write_fracture_report, write_fracture_glb),
            InputKind::DryTest => return Err(without_report(&self.dir)),
            _ => (write_report, write_glb),
        };
        let path = write(&self.dir).map_err(CommandError::refused)?;
        println!("{}", path.display());
        if let Some(glb) = &self.glb {
            if !write_film(&self.dir, glb).map_err(CommandError::refused)? {
                let what = "there is no film, because the run recorded no water, units or surfaces";
                return Err(CommandError::refused(format!("{}: {what}", self.dir.display())));
            }
            println!("{}", glb.display());
        }
        Ok(())
    }
}

type Write = fn(&Path) -> Result<PathBuf, crate::output::OutputError>;
type WriteFilm = fn(&Path, &Path) -> Result<bool, crate::output::OutputError>;

fn without_report(dir: &Path) -> CommandError {
    let what = "the run is a dry test, which has no report; see summary.json and units.csv";
    CommandError::refused(format!("{}: {what}", dir.display()))
}

/// Writes the report of a run in progress until the run ends.
fn follow(dir: &Path) -> Result<(), CommandError> {
    match read_run(dir, &[InputKind::Flume, InputKind::DryTest, InputKind::Fracture])?.kind() {
        InputKind::Flume => {}
        InputKind::DryTest => return Err(without_report(dir)),
        _ => {
            let what = "--live follows flume runs only; the report of a fracture run is written at its end";
            return Err(CommandError::refused(format!("{}: {what}", dir.display())));
        }
    }
    let changed = |file: &str| std::fs::metadata(dir.join(file)).and_then(|data| data.modified()).ok();
    // A finished run that continues still has the summary of its earlier end.
    let has_ended = || {
        let (summary, progress) = (changed(Summary::FILE), changed(Summary::PROGRESS_FILE));
        summary.is_some() && progress.is_none_or(|progress| summary > Some(progress))
    };
    let (mut shown, mut failures): (Option<SystemTime>, usize) = (None, 0);
    let mut quiet_since = Instant::now();
    eprintln!("following {}; Ctrl-C ends this command, not the run", dir.display());
    while !has_ended() {
        sleep(LOOK);
        let progress = changed(Summary::PROGRESS_FILE);
        if progress.is_none() || progress == shown {
            if quiet_since.elapsed() > QUIET {
                eprintln!("the run has written nothing for {} minutes", QUIET.as_secs() / 60);
                quiet_since = Instant::now();
            }
            continue;
        }
        match write_live_report(dir, RELOAD_S) {
            Ok(path) => {
                if shown.is_none() {
                    eprintln!("open {} in a browser; the page loads itself again every {RELOAD_S} s", path.display());
                }
                (shown, failures, quiet_since) = (progress, 0, Instant::now());
            }
            // If the run was just writing a file, a later look succeeds.
            Err(_) if failures < MOST_FAILURES => failures += 1,
            Err(error) => return Err(CommandError::failed(error)),
        }
    }
    // The run writes its report after its summary. A report of the run in progress that was just being written may have
    // replaced it.
    write_report(dir).map_err(CommandError::failed)?;
    Ok(())
}
