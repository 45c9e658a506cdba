//! The loop of a fracture run.

use std::{path::Path, time::Instant};

use thiserror::Error;

use super::{
    fragments::{pieces, write_fragments},
    recorder::FractureRecorder,
    summary::{FractureSummary, Watched},
};
use crate::{
    case::FractureCase,
    femdem::world::{StepError, World},
    output::OutputError,
    simulation::progress::Progress,
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
    /// A tetrahedron was turned inside out.
    #[error(
        "tetrahedron {tag} of the mesh was turned inside out after {time:.6} s: the impact is too hard for the mesh; refine it \
         there, or shorten the step with fracture.step_share"
    )]
    Inverted {
        /// Its number in the mesh file.
        tag: u64,
        /// When [s].
        time: f64,
    },
    /// A file cannot be written.
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

/// Run a fracture case into an existing, empty folder.
///
/// # Errors
/// If the step is not stable, a tetrahedron is turned inside out, or a file cannot be written.
pub fn run(case: &FractureCase, dir: &Path, quiet: bool) -> Result<FractureSummary, FractureError> {
    let mut world = world(case)?;
    let mut recorder = FractureRecorder::create(case, dir)?;
    let begun = Instant::now();
    let mut progress = Progress::new(case.duration, 0.0, 0, quiet);
    let mut watched = Watched::default();
    let mut start = None;
    let (mut rows, mut frames) = (0u64, 0u64);
    loop {
        let over = world.time >= case.duration;
        let row_due = over || world.time >= rows as f64 * case.energy_interval;
        let frame_due = case.surfaces_interval.is_some_and(|interval| over || world.time >= frames as f64 * interval);
        if frame_due {
            recorder.record_surfaces(case, &world)?;
            frames += 1;
        }
        recorder.detail.record_tets_if_due(&world, over)?;
        if row_due {
            let time = world.time;
            let book = world.step_with_ledger().map_err(|error| told(case, error))?;
            let total = *start.get_or_insert(book.total());
            let residual = book.total() - total;
            if watched.steps == 0 {
                watched.kinetic[0] = book.kinetic;
            }
            watched.kinetic[1] = watched.kinetic[1].max(book.kinetic);
            watched.residual = watched.residual.max(residual.abs());
            recorder.record_energy(&world, time, &book, residual)?;
            rows += 1;
            if over {
                watched.wall = begun.elapsed().as_secs_f64();
                progress.finish();
                let fragments = pieces(&world).fragments;
                write_fragments(&fragments, dir)?;
                let summary = FractureSummary::of(case, &world, &book, watched, &fragments);
                summary.write(dir)?;
                return Ok(summary);
            }
        } else {
            world.step().map_err(|error| told(case, error))?;
        }
        watched.steps += 1;
        if watched.impact.is_none() && world.contacts.between_bodies(&world.tets) {
            watched.impact = Some(world.time - world.dt);
        }
        let (failed, touching) = (world.failures.len(), world.contacts.touching);
        progress.update(world.time, watched.steps, || format!("{failed} faces failed, {touching} pairs touch"));
    }
}

fn told(case: &FractureCase, error: StepError) -> FractureError {
    let StepError::Inverted { tet, time } = error;
    FractureError::Inverted { tag: case.mesh.mesh.tet_tags[tet], time }
}
