//! The command line: one file a subcommand.
//!
//! Exit codes: 0 done, 1 the run went wrong, 2 the input is refused (nothing was written).

mod bench;
mod check;
mod compare;
mod devices;
mod folder;
mod init;
mod input;
mod machine;
mod place;
mod report;
mod run;
mod schema;
mod sweep;
mod unit;
mod wave;

use std::{fmt::Display, process::ExitCode};

use clap::{Parser, Subcommand};

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
    Fracture(run::fracture::FractureArguments),
    #[command(alias = "hand-over")]
    Breakage(run::breakage::BreakageArguments),
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
        Command::Breakage(arguments) => arguments.execute(),
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
