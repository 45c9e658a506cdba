//! The loop of a fracture run.

use std::{path::Path, time::Instant};

use thiserror::Error;

use super::{
    checkpoint::{self, RunState},
    failure::Failure,
    fragments::{pieces, write_fragments},
    peak_stress::{carry_on, largest_stresses},
    recorder::FractureRecorder,
    summary::FractureSummary,
};
use crate::{
    case::FractureCase,
    femdem::{watch::StepError, world::World},
    output::{OutputError, progress::Progress},
    simulation::flume::recorder::is_due,
};

/// Why a fracture run ended early.
#[derive(Debug, Error)]
pub enum FractureError {
    /// The time step of the case is not stable.
    #[error(
        "fracture.dt_s = {given:.3e}: must be at most {longest:.3e} s, the longest stable step of this mesh; leave it out"
    )]
    Step {
        /// As given [s].
        given: f64,
        /// The longest one [s].
        longest: f64,
    },
    /// The computation went astray.
    #[error("{failure}\nThe state is kept in {kept}; the last regular checkpoint is not touched.")]
    Failed {
        /// What happened.
        failure: Box<Failure>,
        /// Where the state lies.
        kept: String,
    },
    /// A file cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// The world of a case at its start.
///
/// # Errors
/// If the time step of the case is not stable.
pub fn world(case: &FractureCase) -> Result<World, FractureError> {
    let mut world = World::new(case.setup.clone(), case.step_share);
    if let Some(given) = case.dt {
        let longest = world.dt / case.step_share;
        if given > longest {
            return Err(FractureError::Step { given, longest });
        }
        world.dt = given;
    }
    Ok(world)
}

/// Steps between two looks at places and contacts: these cost as much as a tenth of a step.
const LOOK: u64 = 100;

/// Run a fracture case, whose world is at its start, into an existing, empty folder.
///
/// # Errors
/// If the computation goes astray or a file cannot be written.
pub fn run(case: &FractureCase, world: World, dir: &Path, quiet: bool) -> Result<FractureSummary, FractureError> {
    let recorder = FractureRecorder::create(case, dir)?;
    drive(case, world, recorder, RunState::default(), dir, quiet)
}

/// Go on with a fracture run from its last checkpoint; `world` is that of its case at the start.
///
/// # Errors
/// As [`run`], and if the checkpoint is damaged or not one of the case.
pub fn resume(
    case: &FractureCase,
    mut world: World,
    dir: &Path,
    quiet: bool,
) -> Result<FractureSummary, FractureError> {
    let state = checkpoint::read(case, &mut world, &dir.join(checkpoint::FILE))?;
    let recorder = FractureRecorder::reopen(case, dir, &state)?;
    drive(case, world, recorder, state, dir, quiet)
}

fn drive(
    case: &FractureCase,
    mut world: World,
    mut recorder: FractureRecorder,
    mut state: RunState,
    dir: &Path,
    quiet: bool,
) -> Result<FractureSummary, FractureError> {
    let (begun, wall_before) = (Instant::now(), state.watched.wall);
    let mut progress = Progress::new(case.duration, world.time, state.watched.steps, quiet);
    loop {
        state.watched.wall = wall_before + begun.elapsed().as_secs_f64();
        let over = world.time >= case.duration;
        let row_due = over || world.time >= state.rows as f64 * case.energy_interval;
        let frame_due =
            case.surfaces_interval.is_some_and(|interval| over || world.time >= state.frames as f64 * interval);
        if frame_due {
            recorder.record_surfaces(case, &world)?;
            state.frames += 1;
        }
        recorder.detail.record_tets_if_due(&world, over)?;
        let time = world.time;
        let stepped = if row_due { world.step_with_books().map(Some) } else { world.step().map(|()| None) };
        let book = stepped.map_err(|error| failed(case, &world, &state, dir, error))?;
        if let Some((book, bodies)) = book {
            let residual = state.note(&book);
            recorder.record_energy(&world, time, &book, residual)?;
            let stresses = largest_stresses(&world);
            carry_on(&mut state.watched.peaks, &world, &stresses, time);
            recorder.record_bodies(time, &bodies, &stresses)?;
            (state.rows, state.bytes) = (state.rows + 1, recorder.bytes());
            if over {
                progress.finish();
                let fragments = pieces(&world).fragments;
                write_fragments(&fragments, dir)?;
                let summary = FractureSummary::of(case, &world, &book, &state.watched, &fragments);
                summary.write(dir)?;
                return Ok(summary);
            }
        }
        state.watched.steps += 1;
        if state.watched.impact.is_none() && world.contacts.between_bodies(&world.tets) {
            state.watched.impact = Some(world.time - world.dt);
        }
        // The first one is due at the first interval: the start can be made anew from the case.
        let checkpoint_due = is_due(state.checkpoints + 1, case.checkpoint_interval, world.time);
        if checkpoint_due || state.watched.steps.is_multiple_of(LOOK) {
            world.watch().map_err(|error| failed(case, &world, &state, dir, error))?;
        }
        if checkpoint_due {
            state.checkpoints += 1;
            state.detail = recorder.detail.lengths();
            checkpoint::write(case, &world, &state, &dir.join(checkpoint::FILE))?;
        }
        let (failed, touching) = (world.failures.len(), world.contacts.touching);
        progress.update(world.time, state.watched.steps, || format!("{failed} faces failed, {touching} pairs touch"));
    }
}

/// Keeps the state of a run that has gone astray.
fn failed(case: &FractureCase, world: &World, state: &RunState, dir: &Path, error: StepError) -> FractureError {
    let path = dir.join(checkpoint::FAILED_FILE);
    let kept = match checkpoint::write(case, world, state, &path) {
        Ok(()) => path.display().to_string(),
        Err(error) => format!("no file ({error})"),
    };
    FractureError::Failed { failure: Box::new(Failure::of(case, world, state.watched.steps, error)), kept }
}
