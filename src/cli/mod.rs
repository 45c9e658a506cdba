//! The command line: one file a subcommand.

/// Run the program on the process arguments.
pub fn main() -> std::process::ExitCode {
    std::process::ExitCode::SUCCESS
}
