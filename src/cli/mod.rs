//! The command line: one file per subcommand.
//!
//! Exit codes: 0 success, 1 the work failed, 2 the input was refused (nothing was written).

#[macro_use]
mod print;

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
pub mod run;
mod savings;
mod schema;
mod sweep;
mod unit;
mod wave;

use std::{
    ffi::OsString,
    fmt::{self, Display},
    process::ExitCode,
    sync::OnceLock,
};

use clap::{Parser, Subcommand};

/// Will this wave move the armour units, and will the units break?
///
/// A case file (JSON) describes a flume, a wave and armour units, or units on a bed without water. `check` estimates
/// the cost of a run, `run` computes the case, and `compare` compares the result with measurements.
#[derive(Parser)]
#[command(name = "breakwater", version, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  breakwater check cases/fudo/quick-look.json      check a case and estimate the cost of its run
  breakwater run cases/fudo/quick-look.json        run the case; then open runs/quick-look/report.html
  breakwater resume runs/quick-look                continue after an interruption
  breakwater compare runs/quick-look               compare with measurements
  breakwater sweep cases/fudo/friction-sweep.json  run a case with nine friction coefficients, results in one table
  breakwater wave cases/fudo/H4.5-slice.json       compute only the wave, in seconds
  breakwater run cases/contact/tilt-tetrapod.json  units without water: a tilt test
  breakwater fracture cases/fracture/dolos-drop.json  a Dolos dropped on concrete: where does it crack?
  breakwater run cases/breakage/tetrapod-drop.json  a dropped model unit: does the prototype unit break?
  breakwater init my-case.json                     write a template of a case";

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

/// Reason why a command failed, with its message.
#[derive(Debug)]
pub enum CommandError {
    /// The input was refused, and the exit code is 2.
    Refused(String),
    /// The work failed, and the exit code is 1.
    Failed(String),
}

impl Display for CommandError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Refused(reason) | Self::Failed(reason)) = self;
        out.write_str(reason)
    }
}

impl CommandError {
    fn refused(reason: impl Display) -> Self {
        Self::Refused(reason.to_string())
    }

    fn failed(reason: impl Display) -> Self {
        Self::Failed(reason.to_string())
    }
}

/// How to start this program again, if not by the executable file of the process: the words before the command.
static STARTED_BY: OnceLock<Vec<OsString>> = OnceLock::new();

/// Runs the command that the arguments select, and returns the exit code, for a program that another program contains.
/// `started_by` are the words that start the program, to which a sweep adds the command of one run.
pub fn run_command_of<A: Into<OsString> + Clone>(
    started_by: Vec<OsString>,
    arguments: impl IntoIterator<Item = A>,
) -> u8 {
    STARTED_BY.get_or_init(|| started_by);
    code_of(arguments)
}

/// Runs the command that the arguments select, and returns the exit code. The first argument is the program name.
pub fn run_command<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> ExitCode {
    ExitCode::from(code_of(arguments))
}

fn code_of<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> u8 {
    let command = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments.command,
        Err(message) => return print_message(&message),
    };
    let done = match command {
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
        Ok(()) => 0,
        Err(error) => {
            eprintln!("{error}");
            if matches!(error, CommandError::Refused(_)) { 2 } else { 1 }
        }
    }
}

/// Prints the help, the version or an error of the command line, and returns the exit code.
fn print_message(message: &clap::Error) -> u8 {
    match message.print() {
        Ok(()) => u8::try_from(message.exit_code()).unwrap_or(2),
        Err(error) => {
            eprintln!("cannot write the help: {error}");
            1
        }
    }
}

/// Formats a number of things: "1 unit", "2 units".
fn counted(number: usize, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}
