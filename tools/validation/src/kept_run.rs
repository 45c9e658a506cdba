//! Kept runs: copies of the case and summary of finished runs.

use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

use breakwater::{
    case::BreakageSettings,
    output::{Summary, write_atomically},
};
use serde_json::{Value, json};

/// Folder of the measurements, relative to the folder of a kept run.
const REFERENCE: &str = "../../../../cases/fudo/reference";

/// A run whose results are on the page.
pub struct KeptRun {
    /// Name of the run's folder.
    pub name: String,
    /// The case of the run.
    pub case: Value,
    summary: Summary,
    /// Content of the mesh file of a unit, if the run has one.
    mesh: Option<Vec<u8>>,
}

impl KeptRun {
    /// Reads the folder of a finished run or of a kept run.
    ///
    /// # Errors
    /// If the run is not finished or a file cannot be read.
    pub fn of_run(run: &Path) -> Result<Self, Box<dyn Error>> {
        let named = |file: &Path, error: &dyn Error| format!("{}: {error}", file.display());
        // The absolute path ends with the name of the folder, also if `run` is a path such as `runs/a/.`.
        let run = fs::canonicalize(run).map_err(|error| named(run, &error))?;
        let path = run.join("case.json");
        let text = fs::read_to_string(&path).map_err(|error| named(&path, &error))?;
        let case = serde_json::from_str(&text).map_err(|error| named(&path, &error))?;
        let name = run.file_name().unwrap_or(run.as_os_str()).to_string_lossy().into_owned();
        Ok(Self { name, case, summary: Summary::read(&run)?, mesh: fs::read(run.join(BreakageSettings::MESH)).ok() })
    }

    /// All kept runs, by name.
    ///
    /// # Errors
    /// If no runs are kept, or a kept run cannot be read.
    pub fn all(runs: &Path) -> Result<Vec<Self>, Box<dyn Error>> {
        let mut paths: Vec<PathBuf> =
            fs::read_dir(runs).into_iter().flatten().flatten().map(|run| run.path()).collect();
        paths.sort();
        if paths.is_empty() {
            return Err(format!("{}: no runs are kept; give the folders of finished runs", runs.display()).into());
        }
        paths.iter().map(|path| Self::of_run(path)).collect()
    }

    /// Checks that no kept run of another case has the name of this run.
    ///
    /// # Errors
    /// If a kept run of another case has this name.
    pub fn check_name(&self, runs: &Path) -> Result<(), String> {
        let folder = runs.join(&self.name);
        match Summary::read(&folder) {
            Ok(kept) if kept.case_hash != self.summary.case_hash => Err(format!(
                "{}: a run of another case has this name; rename the folder of the new run",
                folder.display()
            )),
            _ => Ok(()),
        }
    }

    /// Copies case, mesh and summary of the run to the folder of kept runs.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn keep(&self, runs: &Path) -> Result<(), Box<dyn Error>> {
        let folder = runs.join(&self.name);
        fs::create_dir_all(&folder)?;
        let mut case = self.case.clone();
        case["reference"] = json!(REFERENCE);
        write_atomically(&folder.join("case.json"), format!("{case:#}\n").as_bytes())?;
        if let Some(mesh) = &self.mesh {
            write_atomically(&folder.join(BreakageSettings::MESH), mesh)?;
        }
        Ok(self.summary.write(&folder)?)
    }
}
