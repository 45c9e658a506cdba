//! The command line: one file a subcommand.
//!
//! Exit codes: 0 done, 1 the run went wrong, 2 the input is refused (nothing was written).

mod bench;
mod check;
mod compare;
mod devices;
mod dry_report;
mod fracture;
mod hand_over;
mod init;
mod place;
mod report;
mod run;
mod schema;
mod sweep;
mod unit;
mod wave;

use std::{fmt::Display, path::Path, process::ExitCode, sync::Arc};

use clap::{Parser, Subcommand};

use crate::case::{Case, DryCase, FractureCase, PlacementFile};
use crate::{simulation::breakage, sweep::plan::Sweep};

/// Will this wave move the armour units, and will the units break?
///
/// A case file (JSON) describes a flume, a wave and armour units, or units on a bed without water. `check` tells what it will cost, `run` sends
/// the wave over the units, `compare` compares the result with measurements.
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
  breakwater compare runs/quick-look               compare with measurements
  breakwater sweep cases/fudo/friction-sweep.json  the same with nine coefficients of friction, in one table
  breakwater wave cases/fudo/H4.5-slice.json       the wave alone, in seconds
  breakwater run cases/contact/tilt-tetrapod.json  units without water: a slope test
  breakwater fracture cases/fracture/dolos-drop.json  a Dolos dropped on concrete: where does it crack?
  breakwater run cases/breakage/tetrapod-drop.json  a dropped model: does the prototype break?
  breakwater init my-case.json                     a case to start from";

#[derive(Subcommand)]
enum Command {
    Run(run::RunArguments),
    Resume(run::ResumeArguments),
    Check(check::CheckArguments),
    Fracture(fracture::FractureArguments),
    HandOver(hand_over::HandOverArguments),
    Place(place::PlaceArguments),
    Unit(unit::UnitArguments),
    Wave(wave::WaveArguments),
    Compare(compare::CompareArguments),
    Report(report::ReportArguments),
    Init(init::InitArguments),
    Schema(schema::SchemaArguments),
    Bench(bench::BenchArguments),
    Devices(devices::DevicesArguments),
    Sweep(sweep::SweepArguments),
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
        Command::Fracture(arguments) => arguments.execute(),
        Command::HandOver(arguments) => arguments.execute(),
        Command::Place(arguments) => arguments.execute(),
        Command::Unit(arguments) => arguments.execute(),
        Command::Wave(arguments) => arguments.execute(),
        Command::Compare(arguments) => arguments.execute(),
        Command::Report(arguments) => arguments.execute(),
        Command::Init(arguments) => arguments.execute(),
        Command::Schema(arguments) => arguments.execute(),
        Command::Bench(arguments) => arguments.execute(),
        Command::Devices(arguments) => arguments.execute(),
        Command::Sweep(arguments) => arguments.execute(),
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

/// A case file of either kind.
enum AnyCase {
    /// A flume with water.
    Wet(Arc<Case>),
    /// Units on a bed without water.
    Dry(Arc<DryCase>),
}

/// Read a case of either kind and show its warnings.
fn load_any(path: &Path) -> Result<AnyCase, Trouble> {
    if placement(path).is_some() {
        let what = "is a placement and no case; run the case that names it as `units.placement_file`";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    if is_fracture(path) {
        let what = "is a fracture case; run it with breakwater fracture";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    if is_sweep(path) {
        let what = "is a sweep; run it with breakwater sweep";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    let is_dry = std::fs::read_to_string(path).is_ok_and(|text| DryCase::is_one(&text));
    if !is_dry {
        return load(path).map(AnyCase::Wet);
    }
    let case = DryCase::load(path).map_err(Trouble::refused)?;
    show_warnings(&case.warnings);
    Ok(AnyCase::Dry(Arc::new(case)))
}

/// Whether a file is a sweep.
fn is_sweep(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| Sweep::is_one(&text))
}

/// Whether a file is a fracture case.
fn is_fracture(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| FractureCase::is_one(&text))
}

/// The poses in a file, if it is a placement file.
fn placement(path: &Path) -> Option<PlacementFile> {
    serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()
}

/// Read a case with water and show its warnings.
fn load(path: &Path) -> Result<Arc<Case>, Trouble> {
    let case = Case::load(path).map_err(Trouble::refused)?;
    show_warnings(&case.warnings);
    Ok(Arc::new(case))
}

fn show_warnings(warnings: &[String]) {
    warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
}

/// Name of the case file without folder and ending.
fn stem(path: &std::path::Path) -> String {
    path.file_stem().map_or_else(|| "case".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Files that a run or the flume model leaves in its folder; --overwrite takes these and the folder of impacts away and
/// nothing else.
const RESULT_FILES: [&str; 35] = [
    "bodies.csv",
    "breakage.csv",
    "breakage.json",
    "case.json",
    "checkpoint.h5",
    "checkpoint.json",
    "compare.csv",
    "compare.html",
    "contacts.csv",
    "cracks.csv",
    "cracks.vtkhdf",
    "diagnostics.csv",
    "energy.csv",
    "failed.h5",
    "failed.json",
    "fluid.vtkhdf",
    "flume_gauges.csv",
    "flume_piston.csv",
    "fragments.csv",
    "gauges.csv",
    "impacts.h5",
    "mesh.msh",
    "ml_piston_velx.csv",
    "picture.svg",
    "profile.csv",
    "report.html",
    "section.vtkhdf",
    "summary.json",
    "surfaces.vtkhdf",
    "tets.vtkhdf",
    "unit_mesh.msh",
    "unit_surface.json",
    "units.csv",
    "units.vtkhdf",
    "wave.html",
];

/// Make a folder for results: new, or empty, or cleared of an earlier run's files if the user says so.
fn fresh_folder(dir: &Path, overwrite: bool) -> Result<(), Trouble> {
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
    let impacts = dir.join(breakage::run::FOLDER);
    if impacts.exists() {
        std::fs::remove_dir_all(&impacts).map_err(cannot)?;
    }
    Ok(())
}
