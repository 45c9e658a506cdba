//! The command line: one file a subcommand.
//!
//! Exit codes: 0 done, 1 the run went wrong, 2 the input is refused (nothing was written).

mod bench;
mod check;
mod compare;
mod init;
mod report;
mod run;
mod schema;
mod wave;

use std::{fmt::Display, path::PathBuf, process::ExitCode, sync::Arc};

use clap::{Parser, Subcommand};

use crate::case::Case;

/// Will this wave move the armour units?
///
/// A case file (JSON) describes a flume, a wave and a row of armour units. `check` tells what it will cost, `run` sends
/// the wave over the units, `compare` sets the result beside published measurements.
#[derive(Parser)]
#[command(name = "breakwater", version, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  breakwater check cases/fudo/quick-look.json      what a case holds and what it costs
  breakwater run cases/fudo/quick-look.json        run it; look at runs/quick-look/report.html
  breakwater resume runs/quick-look                go on after an interruption
  breakwater compare runs/quick-look               beside the Fudo experiment
  breakwater wave cases/fudo/H4.5-slice.json       the wave alone, in seconds
  breakwater init my-case.json                     a case to start from";

#[derive(Subcommand)]
enum Command {
    Run(run::RunArguments),
    Resume(run::ResumeArguments),
    Check(check::CheckArguments),
    Wave(wave::WaveArguments),
    Compare(compare::CompareArguments),
    Report(report::ReportArguments),
    Init(init::InitArguments),
    Schema(schema::SchemaArguments),
    Bench(bench::BenchArguments),
}

/// Why a command ended without its result.
enum Trouble {
    /// The input is refused: exit code 2.
    Refused(String),
    /// The work went wrong: exit code 1.
    Failed(String),
}

impl Trouble {
    fn refused(reason: impl Display) -> Self {
        Self::Refused(reason.to_string())
    }

    fn failed(reason: impl Display) -> Self {
        Self::Failed(reason.to_string())
    }
}

/// Run the program on the process arguments.
pub fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Run(arguments) => arguments.execute(),
        Command::Resume(arguments) => arguments.execute(),
        Command::Check(arguments) => arguments.execute(),
        Command::Wave(arguments) => arguments.execute(),
        Command::Compare(arguments) => arguments.execute(),
        Command::Report(arguments) => arguments.execute(),
        Command::Init(arguments) => arguments.execute(),
        Command::Schema(arguments) => arguments.execute(),
        Command::Bench(arguments) => arguments.execute(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Trouble::Refused(reason)) => {
            eprintln!("{reason}");
            ExitCode::from(2)
        }
        Err(Trouble::Failed(reason)) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

/// Read a case and show its warnings.
fn load(path: &PathBuf) -> Result<Arc<Case>, Trouble> {
    let case = Case::load(path).map_err(Trouble::refused)?;
    for warning in &case.warnings {
        eprintln!("warning: {warning}");
    }
    Ok(Arc::new(case))
}

/// Name of the case file without folder and ending.
fn stem(path: &std::path::Path) -> String {
    path.file_stem().map_or_else(|| "case".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Files that a run or the flume model leaves in its folder; --overwrite takes these away and nothing else.
const RESULT_FILES: [&str; 21] = [
    "case.json",
    "checkpoint.h5",
    "compare.csv",
    "compare.html",
    "contacts.csv",
    "diagnostics.csv",
    "energy.csv",
    "failed.h5",
    "fluid.vtkhdf",
    "flume_gauges.csv",
    "flume_piston.csv",
    "gauges.csv",
    "ml_piston_velx.csv",
    "picture.svg",
    "profile.csv",
    "report.html",
    "summary.json",
    "unit_surface.json",
    "units.csv",
    "units.vtkhdf",
    "wave.html",
];

/// Make a folder for results: new, or empty, or cleared of an earlier run's files if the user says so.
fn fresh_folder(dir: &PathBuf, overwrite: bool) -> Result<(), Trouble> {
    let cannot = |error: std::io::Error| Trouble::refused(format!("{}: {error}", dir.display()));
    let occupied = std::fs::read_dir(dir).is_ok_and(|mut entries| entries.next().is_some());
    if occupied && !overwrite {
        return Err(Trouble::refused(format!(
            "{}: the folder holds files already; choose another with --out DIR, or add --overwrite to replace them \
             (breakwater resume {} goes on with an interrupted run)",
            dir.display(),
            dir.display()
        )));
    }
    std::fs::create_dir_all(dir).map_err(cannot)?;
    for file in RESULT_FILES.map(|name| dir.join(name)).iter().filter(|file| file.exists()) {
        std::fs::remove_file(file).map_err(cannot)?;
    }
    Ok(())
}
