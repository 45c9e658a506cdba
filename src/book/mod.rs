//! The validation book: what stays of finished runs, and the pages that are written from it.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `entry` | a run in the book: its case, its summary and one short table of series |
//! | `variation` | in what a run differs from the case as it is given |
//! | `assumed` | runs that do: what hangs on what is assumed |
//! | `overview` | how near the runs are to the experiment, and what they cost |
//! | `markdown` | tables and figures of a page |
//! | `friction` | what the friction of the mound does under one wave |
//! | `standing` | forces of the water on units before they move |
//! | `fudo` | the page beside the experiment of Mitsui et al. (2023) |
//! | `wave` | its section on one wave height |
//!
//! Everything on a page comes from the folder `runs` beside it, and nothing there is typed: another computer with the same
//! book makes the same pages.

mod assumed;
pub mod entry;
mod friction;
mod fudo;
mod markdown;
mod overview;
mod standing;
mod variation;
mod wave;

use std::path::{Path, PathBuf};

use crate::{
    output::{OutputError, write_atomically},
    report::compare::{Fudo, compare},
};
use entry::Entry;

/// Takes finished runs into the book and writes its pages; returns the files written, the page last.
///
/// # Errors
/// If a run does not belong to the experiment, is not finished, or has the name of another one: nothing is taken in then.
/// If a file of the book cannot be read or written.
pub fn write(book: &Path, runs: &[PathBuf], reference: &Fudo) -> Result<Vec<PathBuf>, OutputError> {
    compare(runs, reference)?;
    let taken = runs.iter().map(|run| Entry::of_run(run)).collect::<Result<Vec<_>, _>>()?;
    let mut known = Entry::all(book)?;
    for entry in taken.iter().cloned() {
        let other = known.iter().find(|other| other.name == entry.name);
        if other.is_some_and(|other| other.summary.case_hash != entry.summary.case_hash) {
            let what = "is the name of a run of another case in the book; rename one of the two folders";
            return Err(OutputError::content(&entry.folder(book), what));
        }
        known.push(entry);
    }
    for entry in &taken {
        entry.keep(book)?;
    }
    let entries = Entry::all(book)?;
    if entries.is_empty() {
        return Err(OutputError::content(
            &book.join(Entry::RUNS),
            "holds no run yet; name the folders of finished ones",
        ));
    }
    let folders: Vec<PathBuf> = entries.iter().map(|entry| entry.folder(book)).collect();
    let page = fudo::page(&compare(&folders, reference)?, &entries);
    let figures = page.figures().iter().map(|(name, svg)| (name.as_str(), svg.as_str()));
    let write = |(name, content): (&str, &str)| {
        let path = book.join(name);
        write_atomically(&path, content.as_bytes()).map(|()| path)
    };
    figures.chain([(fudo::FILE, page.text())]).map(write).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Summary, UnitSummary, WaveSummary};
    use serde_json::{Value, json};
    use std::fs;

    /// Folder of a finished run of two units that moved so far [m] on a crest of 0.32 m.
    fn run(folder: &Path, name: &str, height_m: f64, friction: f64, moved: [f64; 2]) -> PathBuf {
        run_on(0.32, folder, name, height_m, friction, moved)
    }

    /// The same on a crest of a width [m].
    fn run_on(crest_m: f64, folder: &Path, name: &str, height_m: f64, friction: f64, moved: [f64; 2]) -> PathBuf {
        let dir = folder.join(name);
        fs::create_dir(&dir).unwrap();
        let wave = WaveSummary { kind: "solitary".to_owned(), theory: "rayleigh".to_owned(), height_m, period_s: None };
        let mut summary = Summary { wave: Some(wave), dp_m: 0.009, particles: 170_000, ..Summary::default() };
        summary.assumptions.push("crest width 0.32 m".to_owned());
        let unit = |(k, d): (usize, &f64)| {
            UnitSummary::moved(k as u32 + 1, [39.0, 0.0, 0.0], [39.0 + d, 0.0, 0.0], 0.0, 0.077)
        };
        summary.set_units(moved.iter().enumerate().map(unit).collect(), 0.077);
        summary.write(&dir).unwrap();
        let mut case: Value = serde_json::from_str(include_str!("../../cases/fudo/H4.5-slice.json")).unwrap();
        case["friction"][1]["coefficient"] = json!(friction);
        case["flume"]["mound"]["crest_width_m"] = json!(crest_m);
        fs::write(dir.join("case.json"), case.to_string()).unwrap();
        let rows = (0..4).flat_map(|row| [0, 1].map(|k| (row, k)));
        let row = |(row, k): (u32, usize)| {
            let share = f64::from(row) / 3.0;
            format!("{},{},{},0,{},0\n", 16.0 + share, k + 1, 39.0 + share * moved[k], 0.5 * share)
        };
        let rows: String = rows.map(row).collect();
        fs::write(dir.join("units.csv"), format!("time_s,unit,x_m,y_m,fluid_fx_n,fluid_fz_n\n{rows}")).unwrap();
        fs::write(dir.join("gauges.csv"), "time_s,front_eta_m\n16,0\n17,0.01\n").unwrap();
        dir
    }

    #[test]
    fn a_book_grows_and_writes_itself_from_what_it_keeps() {
        let folder = tempfile::tempdir().unwrap();
        let (book, fudo) = (folder.path().join("book"), Fudo::published().unwrap());
        let rubbed = [(0.1, 0.3), (0.32, 0.1), (0.54, 0.0)].map(|(friction, moved)| {
            run(folder.path(), &format!("mu_{friction}"), 0.045, friction, [moved, 1.2 * moved])
        });
        let narrowed = [0.28, 0.36]
            .map(|crest| run_on(crest, folder.path(), &format!("crest_{crest}"), 0.045, 0.32, [crest - 0.1, crest]));
        let runs = [&rubbed[..], &narrowed[..]].concat();
        write(&book, &runs[..2], &fudo).unwrap();
        let files = write(&book, &runs[2..], &fudo).unwrap();
        assert!(files.iter().all(|file| file.exists()));
        let page = fs::read_to_string(book.join("fudo.md")).unwrap();
        for words in [
            "\n| 4.5 | 9 | 2 | 0.242 | 0.110 | \u{2212}54.6 | \u{2212}32.5 | 100 | 100 | 0 s | 6.78 h |\n",
            "![Mean displacement under each wave](fudo-means.svg)",
            "## Solitary wave of 4.5 cm",
            "| EXP, mean of the three | 15 |  | 0.242 | 100 |  |  |",
            "| mu_0.32 | 2 | 9 | 0.110 | 100 | \u{2212}54.6 | \u{2212}54.0 |",
            "| slice 2 |  |  |  |  |  | 0.120 |",
            "| crest_0.36 | `flume.mound.crest_width_m` 0.36 for 0.32 | 9 | 0.310 | +27.9 | +181.8 | 100 |",
            "![How much the mean displacement hangs on what is assumed](fudo-4.5-assumed.svg)",
            "\n    for run in mu_0.32 crest_0.28 crest_0.36; do breakwater run",
            "case as given [%]",
            "![Mean displacement against the friction of the mound](fudo-4.5-friction.svg)",
            "| mu_0.1 | 0.1 | 0.330 | 100 |",
            "\nParticles every 9 mm:\n",
            "* A unit or more moves with every friction up to 0.32.\n* All stand still with 0.54 and more.\n",
            "\nPublished, with particles of 5 mm: 0.37 m with a friction of 0.1; with more than 0.54 no unit moves.\n",
            "\n    breakwater run runs/mu_0.32/case.json --out again/mu_0.32; breakwater book again/* --out .\n",
            "\n    for run in mu_0.1 mu_0.32 mu_0.54; do breakwater run",
            "* crest width 0.32 m\n",
        ] {
            assert!(page.contains(words), "{words} in\n{page}");
        }
        // Neither another crest among the frictions, nor either of them beside the experiment.
        assert!(
            ["| crest_0.28 | 0.32 |", "| crest_0.28 | 2 |", "| mu_0.1 | 2 |"].iter().all(|row| !page.contains(row))
        );
        // The same pages from the book alone.
        for run in &runs {
            fs::remove_dir_all(run).unwrap();
        }
        assert_eq!(write(&book, &[], &fudo).unwrap(), files);
        assert_eq!(fs::read_to_string(book.join("fudo.md")).unwrap(), page);
    }

    /// Where it is not: `breakwater book` writes it anew.
    #[test]
    fn the_book_in_docs_is_what_its_runs_give() {
        let (kept, folder) =
            (Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/validation"), tempfile::tempdir().unwrap());
        for entry in Entry::all(&kept).unwrap() {
            entry.keep(folder.path()).unwrap();
        }
        for file in write(folder.path(), &[], &Fudo::published().unwrap()).unwrap() {
            let name = file.file_name().unwrap();
            let same = fs::read(kept.join(name)).unwrap() == fs::read(&file).unwrap();
            assert!(same, "docs/validation/{} is not what `breakwater book` writes", name.display());
        }
    }

    #[test]
    fn what_does_not_belong_into_the_book_leaves_it_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let (book, fudo) = (folder.path().join("book"), Fudo::published().unwrap());
        assert!(write(&book, &[], &fudo).unwrap_err().to_string().contains("holds no run yet"));
        let good = run(folder.path(), "good", 0.045, 0.32, [0.2, 0.2]);
        let other = run(folder.path(), "other", 0.05, 0.32, [0.2, 0.2]);
        let message = write(&book, &[good.clone(), other], &fudo).unwrap_err().to_string();
        assert!(message.contains("5.00 cm high") && !book.exists(), "{message}");
        fs::remove_file(good.join("units.csv")).unwrap();
        let refuse = |run: PathBuf| write(&book, &[run], &fudo).unwrap_err().to_string();
        assert!(refuse(good.clone()).contains("units.csv") && !book.exists());
        fs::write(good.join("units.csv"), "time_s,unit,x_m,y_m,fluid_fx_n,fluid_fz_n\n16,1,39,0,0,0\n").unwrap();
        let message = refuse(good);
        assert!(message.contains("rows of 2 units in turn") && !book.exists(), "{message}");
    }

    #[test]
    fn a_name_that_another_case_has_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (book, fudo) = (folder.path().join("book"), Fudo::published().unwrap());
        let run = run(folder.path(), "twice", 0.045, 0.32, [0.2, 0.2]);
        // Once more, and by another path, is the same run.
        write(&book, &[run.clone(), run.join("../twice/.")], &fudo).unwrap();
        write(&book, std::slice::from_ref(&run), &fudo).unwrap();
        let mut summary = Summary::read(&run).unwrap();
        summary.case_hash = "another".to_owned();
        summary.write(&run).unwrap();
        let message = write(&book, &[run], &fudo).unwrap_err().to_string();
        assert!(message.contains("rename one of the two"), "{message}");
    }
}
