//! The breakage analysis: writes the hardest impacts of a finished run as fracture cases, and runs these cases.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use thiserror::Error;

use super::blow::ScaledImpact;
use super::fracture_case::{self, ImpactScene};
use super::model::Model;
use super::selection::select;
use super::{load_history, reenact};
use crate::case::{BreakageSettings, FractureCase, RerunMethod};
use crate::output::{Impacts, OutputError, driver::Control, progress::print_line};
use crate::simulation::breakage::results::{Breakage, Moved, Outcome};
use crate::simulation::fracture::run::{run, world};
use crate::simulation::fracture::summary::FractureSummary;

/// Subfolder of a run folder for the fracture cases and their results.
pub const FOLDER: &str = "impacts";

/// Reason why a breakage analysis ended without a result.
#[derive(Debug, Error)]
pub enum BreakageError {
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The user stopped the analysis.
    #[error("stopped by the user; continue with: breakwater breakage {}", dir.display())]
    Interrupted {
        /// Folder of the run.
        dir: PathBuf,
    },
    /// The threads cannot be started.
    #[error("cannot start threads for the fracture runs: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// One impact to re-run.
struct Job<'a> {
    blow: ScaledImpact<'a>,
    way: RerunMethod,
    name: String,
}

/// Re-runs the hardest impacts of the run in `dir` at prototype scale. Writes cases and results into the subfolder
/// `impacts`, and the summary into `breakage.json` and `breakage.csv`. If a fracture case has not changed since an
/// earlier analysis, its existing results are used. `moved` is the displacement of each unit in the run.
///
/// # Errors
/// If a file cannot be read or written, or the user stops the analysis. If a fracture run fails, the analysis
/// continues, and the results contain the reason.
pub fn analyse_breakage(
    model: &Model,
    settings: &BreakageSettings,
    moved: &[Moved],
    dir: &Path,
    control: &Control,
) -> Result<Breakage, BreakageError> {
    let file = dir.join(Impacts::FILE);
    let mut impacts = Impacts::read(&file)?;
    model.keep_own(&mut impacts);
    if moved.len() != model.count {
        let what = format!("lists {} units, but the case has {}; rerun the case", moved.len(), model.count);
        return Err(OutputError::content(&dir.join("summary.json"), what).into());
    }
    if !impacts.impacts.iter().all(|impact| model.is_plausible(impact)) {
        let what = "has impacts that do not fit the units of this case; rerun the case";
        return Err(OutputError::content(&file, what).into());
    }
    let folder = dir.join(FOLDER);
    fs::create_dir_all(&folder).map_err(OutputError::io(&folder))?;
    let jobs = jobs(model, settings, &impacts);
    for job in &jobs {
        fracture_case::write(&job.blow, &job.scene(&impacts), job.title(), &folder, &job.name)?;
    }
    let threads = rayon::current_num_threads();
    let at_once = settings.cores.unwrap_or(threads).min(jobs.len()).max(1);
    let outcomes = compute(&jobs, &folder, at_once, (threads / at_once).max(1), control)?;
    let breakage = Breakage::of(model, settings, &impacts, moved, outcomes);
    breakage.write(dir)?;
    Ok(breakage)
}

fn jobs<'a>(model: &'a Model, settings: &'a BreakageSettings, impacts: &'a Impacts) -> Vec<Job<'a>> {
    let ways: &[RerunMethod] = match settings.way {
        RerunMethod::Both => &[RerunMethod::ReEnact, RerunMethod::LoadHistory],
        RerunMethod::ReEnact => &[RerunMethod::ReEnact],
        RerunMethod::LoadHistory => &[RerunMethod::LoadHistory],
    };
    let chosen = select(impacts, &settings.select);
    let jobs_of_impact = |(rank, index): (usize, usize)| {
        let blow = ScaledImpact::new(model, settings, &impacts.impacts[index]);
        let unit = blow.impact.event.body + 1;
        ways.iter().map(move |way| {
            let by_loads = if *way == RerunMethod::LoadHistory { "-loads" } else { "" };
            Job { blow, way: *way, name: format!("impact-{:02}-unit-{unit:02}{by_loads}", rank + 1) }
        })
    };
    chosen.into_iter().enumerate().flat_map(jobs_of_impact).collect()
}

impl Job<'_> {
    fn scene(&self, impacts: &Impacts) -> ImpactScene {
        match self.way {
            RerunMethod::LoadHistory => load_history::scene(&self.blow, impacts),
            RerunMethod::ReEnact | RerunMethod::Both => reenact::scene(&self.blow),
        }
    }

    fn title(&self) -> String {
        let event = &self.blow.impact.event;
        let on = match event.partner_unit() {
            Some(unit) => format!("unit {}", unit + 1),
            None => "the bed or a wall".to_owned(),
        };
        let way = match self.way {
            RerunMethod::LoadHistory => ", recorded forces",
            RerunMethod::ReEnact | RerunMethod::Both => "",
        };
        format!(
            "Unit {} on {on} at {:.3} s, {:.2} m/s, scale {}{way}",
            event.body + 1,
            event.start,
            event.approach_normal,
            self.blow.froude.scale
        )
    }

    /// Runs the fracture case, or reads the results of an earlier run of the same case.
    fn outcome(&self, folder: &Path, threads: usize, control: &Control) -> Result<Outcome, BreakageError> {
        let file = folder.join(format!("{}.json", self.name));
        let out = folder.join(&self.name);
        let outcome_of = |ended: Result<FractureSummary, String>| {
            let (mover, _) = self.blow.movers();
            Outcome::of(&self.name, self.way, &self.blow, self.blow.balance(&mover), ended)
        };
        let case = match FractureCase::load(&file) {
            Ok(case) => case,
            Err(errors) => return Ok(outcome_of(Err(errors.to_string()))),
        };
        if let Ok(summary) = FractureSummary::read(&out)
            && summary.case_hash == case.hash
        {
            return Ok(outcome_of(Ok(summary)));
        }
        make_empty_folder(&out)?;
        let silent = Control { quiet: true, ..control.clone() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let ended = pool.install(|| {
            let world = world(&case).map_err(|error| error.to_string())?;
            run(&case, world, &out, &silent).map_err(|error| error.to_string())
        });
        if control.stop.load(Ordering::Relaxed) {
            return Err(BreakageError::Interrupted { dir: folder.parent().unwrap_or(folder).to_owned() });
        }
        Ok(outcome_of(ended))
    }
}

/// Creates an empty folder; first deletes an existing folder of this name with its content.
fn make_empty_folder(dir: &Path) -> Result<(), OutputError> {
    if dir.exists() {
        fs::remove_dir_all(dir).map_err(OutputError::io(dir))?;
    }
    fs::create_dir_all(dir).map_err(OutputError::io(dir))
}

/// Computes all jobs, `at_once` of them at a time and each with `threads` threads. Returns the results in the order of
/// the jobs.
fn compute(
    jobs: &[Job],
    folder: &Path,
    at_once: usize,
    threads: usize,
    control: &Control,
) -> Result<Vec<Outcome>, BreakageError> {
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Option<Result<Outcome, BreakageError>>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    std::thread::scope(|scope| {
        for _ in 0..at_once {
            scope.spawn(|| {
                while let Some((job, slot)) = {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    jobs.get(index).zip(results.get(index))
                } {
                    let outcome = job.outcome(folder, threads, control);
                    if let (false, Ok(outcome)) = (control.quiet, &outcome) {
                        print_line(&format!("  {}: {}", job.title(), outcome.in_words()));
                    }
                    if let Ok(mut slot) = slot.lock() {
                        *slot = Some(outcome);
                    }
                }
            });
        }
    });
    let outcomes = results.into_iter().filter_map(|slot| slot.into_inner().ok().flatten());
    outcomes.collect()
}
