//! Reads input files and recognises their kind.

use std::path::Path;

use super::CommandError;
use crate::{
    case::{Document, InputFile, InputKind, Reference},
    output::Summary,
    simulation::{dry_test::recorder::DryTestRecorder, flume::outputs::checkpoint::Checkpoint},
};

/// Reads an input file. A file whose kind is not in `accepted` is refused before validation.
pub(super) fn read(path: &Path, accepted: &[InputKind]) -> Result<Document, CommandError> {
    if path.is_dir() {
        let what = "is a folder, but must be an input file";
        return Err(CommandError::refused(format!("{}: {what}", path.display())));
    }
    let document = Document::read(path).map_err(CommandError::refused)?;
    if !accepted.contains(&document.kind()) {
        return Err(other_kind(path, document.kind()));
    }
    announce_decomposition(&document);
    Ok(document)
}

/// Size of an STL file above which its decomposition can take longer than about a second [bytes].
const LARGE_STL: u64 = 100_000;

/// Prints a line if the program has to divide a unit with a fine mesh into convex parts, because that takes seconds. The
/// document is a case, or a sweep of a case.
fn announce_decomposition(document: &Document) {
    let case: serde_json::Value = serde_json::from_str(&document.text).unwrap_or_default();
    if let (InputKind::Sweep, Some(path)) = (document.kind(), case["case"].as_str()) {
        if let Ok(document) = Document::read(&Path::new(&document.name).with_file_name(path))
            && document.kind() != InputKind::Sweep
        {
            announce_decomposition(&document);
        }
        return;
    }
    let stl = &case["units"]["stl"];
    let Some(path) = stl["path"].as_str().filter(|_| stl["parts"][0].is_null()) else { return };
    let path = Path::new(&document.name).with_file_name(path);
    if std::fs::metadata(&path).is_ok_and(|file| file.len() > LARGE_STL) {
        eprintln!("dividing {} into convex parts ...", path.display());
    }
}

/// Reads and validates an input file, and prints its warnings.
pub(super) fn load(path: &Path, accepted: &[InputKind]) -> Result<InputFile, CommandError> {
    validate(&read(path, accepted)?)
}

fn validate(document: &Document) -> Result<InputFile, CommandError> {
    let file = InputFile::from_document(document).map_err(CommandError::refused)?;
    show_warnings(file.warnings());
    Ok(file)
}

/// Reads the case of a run from the run folder `dir`.
pub(super) fn read_run(dir: &Path, accepted: &[InputKind]) -> Result<Document, CommandError> {
    if dir.is_file() {
        let kind = Document::read(dir).map_err(CommandError::refused)?.kind();
        let what = format!("is {}, but must be the folder of a run; {}", kind.name(), advice(kind));
        return Err(CommandError::refused(format!("{}: {what}", dir.display())));
    }
    let file = dir.join("case.json");
    if !file.exists() {
        return Err(CommandError::refused(format!("{}: {}", dir.display(), without_case(dir))));
    }
    read(&file, accepted)
}

/// Describes a folder without case.json, and names the command that fits.
fn without_case(dir: &Path) -> &'static str {
    let has = |name: &str| dir.join(name).exists();
    match () {
        () if !dir.exists() => "there is no such folder; breakwater run writes its results into runs/NAME by default",
        () if has("sweep.csv") => "is the folder of a sweep; give one of its subfolders, each the folder of a run",
        () if has("wave.html") => "has the results of breakwater wave, see wave.html; breakwater run computes the case",
        () if has(Reference::FILE) => {
            "is a folder with measurements; compare a run with it: breakwater compare RUN --reference DIR"
        }
        () => "is not the folder of a run, because case.json is missing",
    }
}

/// Returns the kind of the run in the folder `dir`. Refuses a run that has not finished, and names the command that
/// continues it.
pub(super) fn finished_run(dir: &Path) -> Result<InputKind, CommandError> {
    let kind = read_run(dir, &[InputKind::Flume, InputKind::DryTest, InputKind::Fracture])?.kind();
    if dir.join(Summary::FILE).exists() {
        return Ok(kind);
    }
    let checkpoint = match kind {
        InputKind::DryTest => DryTestRecorder::CHECKPOINT,
        _ => Checkpoint::FILE,
    };
    let what = if dir.join(checkpoint).exists() {
        format!("the run has not finished; continue it with: breakwater resume {}", dir.display())
    } else {
        "the run has not finished and has no checkpoint; start it again".to_owned()
    };
    Err(CommandError::refused(format!("{}: {what}", dir.display())))
}

/// Reads and validates the case of a run, and prints its warnings.
pub(super) fn load_run(dir: &Path, accepted: &[InputKind]) -> Result<InputFile, CommandError> {
    validate(&read_run(dir, accepted)?)
}

/// Returns the error for an input file of the wrong kind; the message names the kind and the right command.
pub(super) fn other_kind(path: &Path, kind: InputKind) -> CommandError {
    CommandError::refused(format!("{}: is {}; {}", path.display(), kind.name(), advice(kind)))
}

fn advice(kind: InputKind) -> &'static str {
    match kind {
        InputKind::Flume | InputKind::DryTest => "run it with breakwater run",
        InputKind::Fracture => "run it with breakwater fracture",
        InputKind::Sweep => "run it with breakwater sweep",
        InputKind::Reference => "compare a run with it: breakwater compare RUN --reference DIR",
        InputKind::Placement => "run the case that names it as `units.placement_file`",
    }
}

pub(super) fn show_warnings(warnings: &[String]) {
    warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
}
