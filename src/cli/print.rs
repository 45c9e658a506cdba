//! `println!`, `print!` and `eprintln!` of the command line. The macros of the standard library with these names panic
//! if the text cannot be written, for example because the disk is full.

use std::fmt::Arguments;
use std::io::{self, Write};

macro_rules! println {
    () => { $crate::cli::print::to_output(format_args!("\n")) };
    ($($text:tt)*) => { $crate::cli::print::to_output(format_args!("{}\n", format_args!($($text)*))) };
}

macro_rules! print {
    ($($text:tt)*) => { $crate::cli::print::to_output(format_args!($($text)*)) };
}

macro_rules! eprintln {
    ($($text:tt)*) => { $crate::cli::print::to_errors(format_args!("{}\n", format_args!($($text)*))) };
}

/// Writes text to the standard output. If that fails, ends the process with one line of explanation and exit code 1.
pub(super) fn to_output(text: Arguments) {
    if let Err(error) = io::stdout().lock().write_fmt(text) {
        to_errors(format_args!("cannot write to the standard output: {error}\n"));
        std::process::exit(1);
    }
}

/// Writes text to the standard error. A failure is ignored, because there is no place left to report it.
pub(super) fn to_errors(text: Arguments) {
    let _ = io::stderr().lock().write_fmt(text);
}
