//! The native part of the Python package `breakwater-sim`: checks and runs cases, and contains the command line.
//!
//! The Python part reads the results from the files of a run folder, so that this part exchanges only texts (JSON).

mod catalogue;
mod errors;
mod runs;

use std::ffi::OsString;

use pyo3::prelude::*;

/// Executes a command line and returns its exit code. `started_by` are the words that start the program, to which a
/// sweep adds the commands of its runs; the first argument is the name of the program.
#[pyfunction]
fn command_line(py: Python<'_>, started_by: Vec<OsString>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| breakwater::cli::run_command_of(started_by, arguments))
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("version", env!("CARGO_PKG_VERSION"))?;
    module.add("CaseProblems", module.py().get_type::<errors::CaseProblems>())?;
    module.add("RunProblem", module.py().get_type::<errors::RunProblem>())?;
    module.add_function(wrap_pyfunction!(command_line, module)?)?;
    module.add_function(wrap_pyfunction!(catalogue::catalogue, module)?)?;
    module.add_function(wrap_pyfunction!(runs::read, module)?)?;
    module.add_function(wrap_pyfunction!(runs::check, module)?)?;
    module.add_function(wrap_pyfunction!(runs::run, module)?)?;
    module.add_function(wrap_pyfunction!(runs::resume, module)?)?;
    module.add_function(wrap_pyfunction!(runs::set_key, module)?)
}
