//! Writes the page that compares breakwater with the experiment of Mitsui et al. (2023), `docs/validation/fudo.md`.
//!
//! | file | content |
//! | --- | --- |
//! | `kept_run` | runs kept in `tools/validation/runs`: case and summary |
//! | `change` | differences between the case of a run and the base case |
//! | `page` | summary, table and order of the sections |
//! | `figures` | means, damage, convergence |
//! | `friction` | friction sweep |
//! | `dependence` | runs with a changed input |
//! | `markdown` | Markdown page with its figure files |
//!
//! Every number on the page comes from the kept runs and `cases/fudo/reference`.

// Descriptions have units in brackets. Without this line, rustdoc would read `[m]` as a broken link.
#![allow(rustdoc::broken_intra_doc_links)]

mod change;
mod compared;
mod dependence;
mod figures;
mod friction;
mod kept_run;
mod markdown;
mod page;

use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::ExitCode,
};

use breakwater::{case::Reference, output::write_atomically, report::compare::compare};
use clap::Parser;
use kept_run::KeptRun;

/// Adds finished runs to the validation page docs/validation/fudo.md and writes the page with its figures.
#[derive(Parser)]
struct Arguments {
    /// Folders of finished runs of cases/fudo. Without folders, the page is rewritten from the runs added earlier.
    runs: Vec<PathBuf>,
}

/// Folders of the page and its sources.
struct Folders {
    /// Folder of the kept runs.
    runs: PathBuf,
    /// Folder of the page and its figures.
    page: PathBuf,
    /// Folder of the measurements.
    reference: PathBuf,
}

impl Folders {
    fn of_repository() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."));
        Self {
            runs: root.join("tools/validation/runs"),
            page: root.join("docs/validation"),
            reference: root.join("cases/fudo/reference"),
        }
    }
}

fn main() -> ExitCode {
    match write(&Folders::of_repository(), &Arguments::parse().runs) {
        Ok(files) => {
            files.iter().for_each(|file| println!("{}", file.display()));
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Adds finished runs and writes the page. Returns the paths of the written files; the page is the last.
///
/// # Errors
/// If a run is not finished, has a wave that was not measured, or has the name of a kept run of another case; then
/// nothing is written. Also if a file cannot be read or written.
fn write(folders: &Folders, new: &[PathBuf]) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let reference = Reference::load(&folders.reference)?;
    compare(new, &reference)?;
    let new = new.iter().map(|run| KeptRun::of_run(run)).collect::<Result<Vec<_>, _>>()?;
    new.iter().try_for_each(|run| run.check_name(&folders.runs))?;
    new.iter().try_for_each(|run| run.keep(&folders.runs))?;
    let runs = KeptRun::all(&folders.runs)?;
    let paths: Vec<PathBuf> = runs.iter().map(|run| folders.runs.join(&run.name)).collect();
    let frictions = friction::published(&folders.reference)?;
    let page = page::page(&compare(&paths, &reference)?, &runs, &frictions);
    let path = folders.page.join(page::FILE);
    let notes = fs::read_to_string(&path).unwrap_or_default();
    let notes = notes.split_once(page::END).map(|(_, notes)| notes).unwrap_or("\n");
    let mut written = Vec::new();
    for (name, svg) in page.figures() {
        written.push(folders.page.join(name));
        write_atomically(&folders.page.join(name), svg.as_bytes())?;
    }
    write_atomically(&path, format!("{}{notes}", page.text().trim_end()).as_bytes())?;
    written.push(path);
    Ok(written)
}

#[cfg(test)]
mod tests {
    use breakwater::output::{Summary, UnitSummary, WaveSummary};
    use serde_json::{Value, json};

    use super::*;

    /// Writes the folder of a finished run of two units that move by `moved` [m]. `change` sets one number of the case.
    /// The run has the default scheme, if its name does not begin with "published".
    fn run(folder: &Path, name: &str, height_m: f64, dp_m: f64, change: (&str, f64), moved: [f64; 2]) -> PathBuf {
        let dir = folder.join(name);
        fs::create_dir_all(&dir).unwrap();
        let wave = WaveSummary { kind: "solitary".to_owned(), theory: "rayleigh".to_owned(), height_m, period_s: None };
        let mut summary = Summary { wave: Some(wave), dp_m, ..Summary::default() };
        let unit = |(k, d): (usize, &f64)| {
            UnitSummary::moved(k as u32 + 1, [39.0, 0.0, 0.0], [39.0 + d, 0.0, 0.0], 0.0, 0.077)
        };
        summary.set_units(moved.iter().enumerate().map(unit).collect(), 0.077);
        summary.write(&dir).unwrap();
        let mut case: Value = serde_json::from_str(include_str!("../../../cases/fudo/H4.5-slice.json")).unwrap();
        // PVC on the whole bed, as in the base case of the page.
        case["flume"]["material"] = json!("pvc");
        *case.pointer_mut(change.0).unwrap() = json!(change.1);
        if !name.starts_with("published") {
            case["numerics"]["scheme"] = json!("low_dissipation");
        }
        fs::write(dir.join("case.json"), case.to_string()).unwrap();
        dir
    }

    fn folders(folder: &Path) -> Folders {
        let page = folder.join("page");
        fs::create_dir(&page).unwrap();
        Folders { runs: folder.join("kept"), page, ..Folders::of_repository() }
    }

    const FRICTION: &str = "/friction/1/coefficient";
    const CREST: &str = "/flume/mound/crest_width_m";

    #[test]
    fn page_is_written_from_the_kept_runs() {
        let folder = tempfile::tempdir().unwrap();
        let folders = folders(folder.path());
        let run = |name: &str, height, dp, change, moved| run(folder.path(), name, height, dp, change, moved);
        let runs = [
            run("weak", 0.026, 0.009, (CREST, 0.32), [0.04, 0.06]),
            run("coarse", 0.045, 0.009, (CREST, 0.32), [0.24, 0.25]),
            run("fine", 0.045, 0.007, (CREST, 0.32), [0.24, 0.26]),
            run("smooth", 0.045, 0.009, (FRICTION, 0.1), [0.3, 0.4]),
            run("published", 0.045, 0.009, (CREST, 0.32), [0.25, 0.27]),
            run("published-narrow", 0.045, 0.009, (CREST, 0.28), [0.2, 0.22]),
        ];
        write(&folders, &runs[..2]).unwrap();
        let files = write(&folders, &runs[2..]).unwrap();
        assert!(files.iter().all(|file| file.exists()) && files.len() == 6);
        let path = folders.page.join(page::FILE);
        let page = fs::read_to_string(&path).unwrap();
        for words in [
            "by \u{2212}53.5 % (9 mm) for the 2.6 cm wave and by +1.1 % (9 mm) and +3.2 % (7 mm) for the 4.5 cm wave (",
            "For the 2.6 cm wave, breakwater is on the unsafe side:",
            "For these waves, each at its finest spacing, 0 and 100 % of the units are damaged in breakwater, and 80 and \
             100 % in the experiment.",
            "| 4.5 | 9 |  | 2 | 0.242 | 0.245 | +1.1 | 0.239 | +2.5 | \u{2212}32.5 | 100 / 100 |",
            "| `mound.crest_width_m` | 0.32 | 0.28 | 9 |  | \u{2212}19.2 |",
            "| 4.5 | 9 |  | 2 | 0.242 | 0.260 | +7.3 | 0.239 | +8.8 | \u{2212}32.5 | 100 / 100 |",
            "(fudo-friction.svg)",
        ] {
            assert!(page.contains(words), "{words} in\n{page}");
        }
        // The page needs only the kept runs. Notes below the last generated line are kept.
        runs.iter().for_each(|run| fs::remove_dir_all(run).unwrap());
        fs::write(&path, page + "A note.\n").unwrap();
        assert_eq!(write(&folders, &[]).unwrap(), files);
        assert!(fs::read_to_string(&path).unwrap().ends_with(&format!("{}\nA note.\n", page::END)));
    }

    /// If this test fails, run `cargo run --release -p validation`.
    #[test]
    fn page_in_docs_is_up_to_date() {
        let folder = tempfile::tempdir().unwrap();
        let repository = Folders::of_repository();
        let folders = Folders { page: folder.path().to_owned(), ..Folders::of_repository() };
        for file in write(&folders, &[]).unwrap() {
            let name = file.file_name().unwrap();
            let [kept, new] =
                [&repository.page, &folders.page].map(|page| fs::read_to_string(page.join(name)).unwrap());
            let is_same = kept.starts_with(new.trim_end());
            assert!(is_same, "docs/validation/{}: run cargo run --release -p validation", name.display());
        }
    }

    #[test]
    fn unsuitable_runs_are_refused_and_change_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let folders = folders(folder.path());
        let refuse = |runs: &[PathBuf]| write(&folders, runs).unwrap_err().to_string();
        assert!(refuse(&[]).contains("no runs are kept"));
        let good = run(folder.path(), "good", 0.045, 0.009, (CREST, 0.32), [0.2, 0.2]);
        let other = run(folder.path(), "other", 0.05, 0.009, (CREST, 0.32), [0.2, 0.2]);
        let message = refuse(&[good.clone(), other]);
        assert!(message.contains("solitary 0.05 m") && !folders.runs.exists(), "{message}");
        write(&folders, &[good.clone(), good.join("../good/.")]).unwrap();
        let mut summary = Summary::read(&good).unwrap();
        summary.case_hash = "another".to_owned();
        summary.write(&good).unwrap();
        assert!(refuse(&[good]).contains("rename the folder"));
    }
}
