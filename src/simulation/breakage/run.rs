//! Impacts of a finished run written as fracture cases, and computed.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use thiserror::Error;

use super::blow::Blow;
use super::fracture_case::{self, Scene};
use super::model::Model;
use super::selection::select;
use super::{load_history, reenact};
use crate::case::{FractureCase, Handover, HandoverWay};
use crate::output::{Impacts, OutputError, driver::Control};
use crate::simulation::breakage::results::{Breakage, Moved, Outcome};
use crate::simulation::fracture::run::{run, world};
use crate::simulation::fracture::summary::FractureSummary;

/// Folder of cases and results in a run's folder.
pub const FOLDER: &str = "impacts";

/// Why impacts could not be handed over.
#[derive(Debug, Error)]
pub enum HandoverError {
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The user stopped the analysis.
    #[error("stopped by the user; continue with: breakwater breakage {}", dir.display())]
    Interrupted {
        /// Folder of the run.
        dir: PathBuf,
    },
    /// No threads.
    #[error("no threads for the fracture computations: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// One fracture computation.
struct Job<'a> {
    blow: Blow<'a>,
    way: HandoverWay,
    name: String,
}

/// Hand the impacts in a run's folder over: cases and results come into `impacts/` there, `breakage.json` and
/// `breakage.csv` beside them. What has been computed already from the same case is kept. `moved` is how far each unit was
/// displaced.
///
/// # Errors
/// If a file cannot be read or written; a computation that goes astray is told in the result.
pub fn hand_over(
    model: &Model,
    handover: &Handover,
    moved: &[Moved],
    dir: &Path,
    control: &Control,
) -> Result<Breakage, HandoverError> {
    let file = dir.join(Impacts::FILE);
    let impacts = Impacts::read(&file)?;
    if moved.len() != model.count {
        let what = format!("tells of {} units and the case of {}; make the run again", moved.len(), model.count);
        return Err(OutputError::content(&dir.join("summary.json"), what).into());
    }
    if !impacts.impacts.iter().all(|impact| model.can_have(impact)) {
        let what = "has impacts that units of this case cannot have; make the run again";
        return Err(OutputError::content(&file, what).into());
    }
    let folder = dir.join(FOLDER);
    fs::create_dir_all(&folder).map_err(OutputError::io(&folder))?;
    let jobs = jobs(model, handover, &impacts);
    for job in &jobs {
        fracture_case::write(&job.blow, &job.scene(&impacts), job.title(), &folder, &job.name)?;
    }
    let threads = rayon::current_num_threads();
    let at_once = handover.cores.unwrap_or(threads).min(jobs.len()).max(1);
    let outcomes = compute(&jobs, &folder, at_once, (threads / at_once).max(1), control)?;
    let breakage = Breakage::of(model, handover, &impacts, moved, outcomes);
    breakage.write(dir)?;
    Ok(breakage)
}

fn jobs<'a>(model: &'a Model, handover: &'a Handover, impacts: &'a Impacts) -> Vec<Job<'a>> {
    let ways: &[HandoverWay] = match handover.way {
        HandoverWay::Both => &[HandoverWay::ReEnact, HandoverWay::LoadHistory],
        HandoverWay::ReEnact => &[HandoverWay::ReEnact],
        HandoverWay::LoadHistory => &[HandoverWay::LoadHistory],
    };
    let chosen = select(impacts, &handover.select);
    let of = |(rank, index): (usize, usize)| {
        let blow = Blow::new(model, handover, &impacts.impacts[index]);
        let unit = blow.impact.event.body + 1;
        ways.iter().map(move |way| {
            let by_loads = if *way == HandoverWay::LoadHistory { "-loads" } else { "" };
            Job { blow, way: *way, name: format!("impact-{:02}-unit-{unit:02}{by_loads}", rank + 1) }
        })
    };
    chosen.into_iter().enumerate().flat_map(of).collect()
}

impl Job<'_> {
    fn scene(&self, impacts: &Impacts) -> Scene {
        match self.way {
            HandoverWay::LoadHistory => load_history::scene(&self.blow, impacts),
            HandoverWay::ReEnact | HandoverWay::Both => reenact::scene(&self.blow),
        }
    }

    fn title(&self) -> String {
        let event = &self.blow.impact.event;
        let on = match event.partner_unit() {
            Some(unit) => format!("unit {}", unit + 1),
            None => "the bed".to_owned(),
        };
        let way = match self.way {
            HandoverWay::LoadHistory => ", recorded forces",
            HandoverWay::ReEnact | HandoverWay::Both => "",
        };
        format!(
            "Unit {} on {on} at {:.3} s, {:.2} m/s, scale {}{way}",
            event.body + 1,
            event.start,
            event.approach_normal,
            self.blow.froude.scale
        )
    }

    /// Computes the case in the folder, or reads what was computed before.
    fn outcome(&self, folder: &Path, threads: usize, control: &Control) -> Result<Outcome, HandoverError> {
        let file = folder.join(format!("{}.json", self.name));
        let out = folder.join(&self.name);
        let told = |ended: Result<FractureSummary, String>| {
            let (mover, _) = self.blow.movers();
            Outcome::of(&self.name, self.way, &self.blow, self.blow.balance(&mover), ended)
        };
        let case = match FractureCase::load(&file) {
            Ok(case) => case,
            Err(errors) => return Ok(told(Err(errors.to_string()))),
        };
        if let Ok(summary) = FractureSummary::read(&out)
            && summary.case_hash == case.hash
        {
            return Ok(told(Ok(summary)));
        }
        fresh(&out)?;
        let silent = Control { quiet: true, ..control.clone() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let ended = pool.install(|| {
            let world = world(&case).map_err(|error| error.to_string())?;
            run(&case, world, &out, &silent).map_err(|error| error.to_string())
        });
        if control.stop.load(Ordering::Relaxed) {
            return Err(HandoverError::Interrupted { dir: folder.parent().unwrap_or(folder).to_owned() });
        }
        Ok(told(ended))
    }
}

/// An empty folder.
fn fresh(dir: &Path) -> Result<(), OutputError> {
    if dir.exists() {
        fs::remove_dir_all(dir).map_err(OutputError::io(dir))?;
    }
    fs::create_dir_all(dir).map_err(OutputError::io(dir))
}

/// All jobs, so many at once, each on so many threads; results in the order of the jobs.
fn compute(
    jobs: &[Job],
    folder: &Path,
    at_once: usize,
    threads: usize,
    control: &Control,
) -> Result<Vec<Outcome>, HandoverError> {
    let next = AtomicUsize::new(0);
    let found: Vec<Mutex<Option<Result<Outcome, HandoverError>>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    std::thread::scope(|scope| {
        for _ in 0..at_once {
            scope.spawn(|| {
                while let Some((job, slot)) = {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    jobs.get(index).zip(found.get(index))
                } {
                    let outcome = job.outcome(folder, threads, control);
                    if let (false, Ok(outcome)) = (control.quiet, &outcome) {
                        eprintln!("  {}: {}", job.title(), outcome.in_words());
                    }
                    if let Ok(mut slot) = slot.lock() {
                        *slot = Some(outcome);
                    }
                }
            });
        }
    });
    let done = found.into_iter().filter_map(|slot| slot.into_inner().ok().flatten());
    done.collect()
}
