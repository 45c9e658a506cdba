//! Checks and runs of cases.

use std::{
    path::Path,
    sync::{Arc, atomic::Ordering},
    thread,
    time::Duration,
};

use breakwater::{
    case::{CaseErrors, Document, InputFile, InputKind},
    cli::{CommandError, run as command},
    output::driver::Control,
    sph::device::DeviceChoice,
    sweep::{key, plan::Sweep},
};
use pyo3::{exceptions::PyValueError, prelude::*};
use serde_json::{Map, Value, json};

use crate::errors::{of_case, of_run};

/// Interval between two looks for Ctrl-C, and between two calls of the progress display.
const LOOK: Duration = Duration::from_millis(50);

/// Reads an input file and returns its text, which is a JSON object.
#[pyfunction]
pub fn read(path: &str) -> PyResult<String> {
    let document = Document::read(Path::new(path)).map_err(|error| of_case(&error.into()))?;
    document.parse::<Map<String, Value>>().map_err(|error| of_case(&error.into()))?;
    // Some editors write a byte order mark, which the parser of Python refuses.
    Ok(document.text.trim_start_matches('\u{feff}').to_owned())
}

/// Sets a key of a case, both as JSON; `key` is a path as in `friction[1].coefficient`.
#[pyfunction]
pub fn set_key(text: &str, key: &str, value: &str) -> PyResult<String> {
    let parsed =
        |text: &str| serde_json::from_str::<Value>(text).map_err(|error| PyValueError::new_err(error.to_string()));
    let mut root = parsed(text)?;
    key::set(&mut root, key, parsed(value)?).map_err(|what| PyValueError::new_err(format!("{key}: {what}")))?;
    Ok(root.to_string())
}

/// Validates an input file. Returns its kind, its warnings and the estimate of its cost as JSON.
#[pyfunction]
pub fn check(py: Python<'_>, text: &str, name: &str) -> PyResult<String> {
    py.detach(|| {
        let file = validated(text, name)?;
        let mut result = json!({ "kind": kind(file.kind()), "warnings": file.warnings() });
        match file {
            InputFile::Flume(case) => {
                let estimate = case.estimate();
                result["particles"] = json!(estimate.particles());
                result["steps"] = json!(estimate.steps);
                result["time_step_s"] = json!(estimate.dt);
                result["memory_bytes"] = json!(estimate.bytes);
            }
            InputFile::Sweep(file) => {
                Sweep::new(file, Path::new(name)).map_err(of_run)?;
            }
            _ => {}
        }
        Ok(result.to_string())
    })
}

/// Runs a case into the folder `out`. `threads` is 0 for one thread per core. `show` is called with the simulated time
/// and the end of the run [s].
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one call from Python with named arguments")]
pub fn run(
    py: Python<'_>,
    text: &str,
    name: &str,
    out: &str,
    overwrite: bool,
    threads: usize,
    device: &str,
    show: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let file = validated(text, name)?;
    let device = device_of(device)?;
    let (path, out) = (Path::new(name).to_owned(), Path::new(out).to_owned());
    supervised(py, threads, show, move |control| command::run_for(file, &path, &out, overwrite, device, control))
}

/// Continues the run in a folder. `device` is none for the device of the interrupted run.
#[pyfunction]
pub fn resume(
    py: Python<'_>,
    path: &str,
    threads: usize,
    device: Option<&str>,
    show: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let device = device.map(device_of).transpose()?;
    let path = Path::new(path).to_owned();
    supervised(py, threads, show, move |control| command::resume_for(&path, device, control))
}

/// Start of the message of a run that the user has stopped.
const STOPPED: &str = "stopped by the user";

fn validated(text: &str, name: &str) -> PyResult<InputFile> {
    let document = Document::new(text, name).map_err(CaseErrors::from);
    document.and_then(|document| InputFile::from_document(&document)).map_err(|errors| of_case(&errors))
}

fn kind(kind: InputKind) -> &'static str {
    match kind {
        InputKind::Flume => "flume",
        InputKind::DryTest => "dry_test",
        InputKind::Fracture => "fracture",
        InputKind::Sweep => "sweep",
        InputKind::Placement => "placement",
        InputKind::Reference => "reference",
    }
}

fn device_of(name: &str) -> PyResult<DeviceChoice> {
    name.parse().map_err(|what| PyValueError::new_err(format!("device = {name:?}: {what}")))
}

/// Does a job on a thread of its own with a pool of `threads` threads, without the lock of the interpreter. Ctrl-C stops
/// the job with a checkpoint.
fn supervised(
    py: Python<'_>,
    threads: usize,
    show: &Bound<'_, PyAny>,
    job: impl FnOnce(Control) -> Result<(), CommandError> + Send + 'static,
) -> PyResult<()> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(of_run)?;
    let control = Control { quiet: true, silent: true, ..Control::default() };
    let (stop, seen) = (Arc::clone(&control.stop), Arc::clone(&control.seen));
    let worker = thread::Builder::new().name("run".to_owned()).spawn(move || pool.install(|| job(control)));
    let worker = worker.map_err(of_run)?;
    let mut interrupted = None;
    while !worker.is_finished() {
        py.detach(|| thread::sleep(LOOK));
        let [time, end] = seen.times_s();
        let looked =
            py.check_signals().and_then(|()| if end > 0.0 { show.call1((time, end)).map(drop) } else { Ok(()) });
        match (looked, &interrupted) {
            (Ok(()), _) => {}
            (Err(error), None) => {
                stop.store(true, Ordering::Relaxed);
                interrupted = Some(error);
            }
            // The second Ctrl-C does not wait for the checkpoint.
            (Err(error), Some(_)) => return Err(error),
        }
    }
    let ended = worker.join();
    match (interrupted, ended) {
        (Some(error), Ok(Err(other))) if !other.to_string().starts_with(STOPPED) => {
            error.set_cause(py, Some(of_run(other)));
            Err(error)
        }
        (Some(error), _) => Err(error),
        (None, Ok(Ok(()))) => Ok(()),
        (None, Ok(Err(error))) => Err(of_run(error)),
        (None, Err(_)) => Err(of_run("the run ended by an error of the program; please report it with its case")),
    }
}
