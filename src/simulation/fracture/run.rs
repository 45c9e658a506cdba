//! Runs a fracture case: starts from the case or a checkpoint, and ends with the summary.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{
    checkpoint,
    failure::Failure,
    fragments::{pieces, write_fragments},
    peak_stress::{largest_stresses, update_peaks},
    recorder::FractureRecorder,
    run_state::RunState,
    summary::FractureSummary,
};
use crate::{
    case::FractureCase,
    femdem::world::{World, energy_balance::EnergyBalance, limits::StepError},
    output::{
        OutputError,
        driver::{Clock, Control, Run, RunError, Session, Step, StepFailure, drive},
    },
};

/// The time step of the case is longer than the mesh allows.
#[derive(Debug, Error)]
#[error(
    "fracture.dt_s = {given:.3e}: must be at most {longest:.3e} s, the longest stable time step of this mesh; use a \
     shorter time step, or leave the key out"
)]
pub struct UnstableStep {
    /// Time step of the case [s].
    pub given: f64,
    /// Longest stable time step [s].
    pub longest: f64,
}

/// Sets up the FEMDEM solver of a case at its start.
///
/// # Errors
/// If the time step of the case is not stable.
pub fn world(case: &FractureCase) -> Result<World, UnstableStep> {
    let mut world = World::new(case.setup.clone(), case.step_share);
    if let Some(given) = case.dt {
        let longest = world.dt / case.step_share;
        if given > longest {
            return Err(UnstableStep { given, longest });
        }
        world.dt = given;
    }
    Ok(world)
}

/// Number of time steps between two checks of positions and contacts. One check takes a tenth of the computing time of
/// one time step.
const STEPS_BETWEEN_CHECKS: u64 = 100;

/// Runs a fracture case into an existing, empty folder; `world` is the solver at its start.
///
/// # Errors
/// If a file cannot be written, the run becomes unstable, or the user stops it.
pub fn run(case: &FractureCase, world: World, dir: &Path, control: &Control) -> Result<FractureSummary, RunError> {
    let recorder = FractureRecorder::create(case, dir)?;
    drive(FractureRun::new(case, world, recorder, RunState::new(case), dir), dir, control)
}

/// Continues a fracture run from its last checkpoint; `world` is the solver at the start of the case.
///
/// # Errors
/// As for [`run`], and if the checkpoint is damaged or does not belong to the case. Title, duration and output intervals
/// may differ.
pub fn resume(
    case: &FractureCase,
    mut world: World,
    dir: &Path,
    control: &Control,
) -> Result<FractureSummary, RunError> {
    let mut state = checkpoint::read(case, &mut world, &dir.join(checkpoint::FILE))?;
    state.set_intervals(case, world.time);
    let recorder = FractureRecorder::reopen(case, dir, &state)?;
    drive(FractureRun::new(case, world, recorder, state, dir), dir, control)
}

/// A solver with the open output files of its run.
struct FractureRun<'a> {
    case: &'a FractureCase,
    world: World,
    recorder: FractureRecorder,
    state: RunState,
    dir: &'a Path,
    /// Wall time of earlier sessions [s].
    wall_before: f64,
}

impl<'a> FractureRun<'a> {
    fn new(case: &'a FractureCase, world: World, recorder: FractureRecorder, state: RunState, dir: &'a Path) -> Self {
        let wall_before = state.watched.wall;
        Self { case, world, recorder, state, dir, wall_before }
    }

    fn failure(&self, error: StepError) -> StepFailure {
        StepFailure::failure(Box::new(Failure::of(self.case, &self.world, self.state.watched.steps, error)))
    }

    /// Makes a time step and computes the energies; appends rows to `energy.csv` and `bodies.csv`.
    fn step_with_row(&mut self) -> Result<EnergyBalance, StepFailure> {
        let time = self.world.time;
        let (energies, bodies) = self.world.step_with_body_energies().map_err(|error| self.failure(error))?;
        let residual = self.state.note(&energies);
        self.recorder.record_energy(&self.world, time, &energies, residual)?;
        let stresses = largest_stresses(&self.world);
        update_peaks(&mut self.state.watched.peaks, &self.world, &stresses, time);
        self.recorder.record_bodies(time, &bodies, &stresses)?;
        self.state.rows.count += 1;
        self.state.bytes = self.recorder.bytes();
        Ok(energies)
    }

    fn record_surfaces(&mut self) -> Result<(), OutputError> {
        self.recorder.record_surfaces(self.case, &self.world)?;
        self.state.frames.count += 1;
        Ok(())
    }

    fn record_tets(&mut self) -> Result<(), OutputError> {
        self.recorder.detail.record_tets(&self.world)?;
        self.state.tets.count += 1;
        Ok(())
    }

    /// Writes the outputs that are due and makes one time step.
    fn advance(&mut self) -> Result<(), StepFailure> {
        let time = self.world.time;
        if self.state.frames.is_due(time) {
            self.record_surfaces()?;
        }
        if self.state.tets.is_due(time) {
            self.record_tets()?;
        }
        if self.state.rows.is_due(time) {
            self.step_with_row()?;
        } else {
            self.world.step().map_err(|error| self.failure(error))?;
        }
        self.state.watched.steps += 1;
        if self.state.watched.impact.is_none() && self.world.contacts.touches_other_body(&self.world.tets) {
            self.state.watched.impact = Some(self.world.time - self.world.dt);
        }
        let checkpoint_due = self.state.checkpoints.is_due(self.world.time);
        if checkpoint_due || self.state.watched.steps.is_multiple_of(STEPS_BETWEEN_CHECKS) {
            self.world.check_limits().map_err(|error| self.failure(error))?;
        }
        if checkpoint_due {
            self.state.checkpoints.count += 1;
            self.write_checkpoint()?;
        }
        Ok(())
    }

    /// Writes a checkpoint, the last outputs and the summary. A run with a longer duration can resume from the
    /// checkpoint. Makes one more time step, because a time step computes the energies.
    fn finish(&mut self) -> Result<FractureSummary, StepFailure> {
        self.write_checkpoint()?;
        if self.case.surfaces_interval.is_some() {
            self.record_surfaces()?;
        }
        if self.case.tets_interval.is_some() {
            self.record_tets()?;
        }
        let energies = self.step_with_row()?;
        let fragments = pieces(&self.world).fragments;
        write_fragments(&fragments, self.dir)?;
        let summary = FractureSummary::of(self.case, &self.world, &energies, &self.state.watched, &fragments);
        summary.write(self.dir)?;
        Ok(summary)
    }

    fn write_checkpoint(&mut self) -> Result<(), OutputError> {
        self.state.detail = self.recorder.detail.lengths();
        checkpoint::write(self.case, &self.world, &self.state, &self.dir.join(checkpoint::FILE))
    }
}

impl Run for FractureRun<'_> {
    type Summary = FractureSummary;

    fn clock(&self) -> Clock {
        Clock { time: self.world.time, end: self.case.duration, steps: self.state.watched.steps }
    }

    fn step(&mut self, session: Session) -> Result<Step<FractureSummary>, StepFailure> {
        self.state.watched.wall = self.wall_before + session.wall;
        if self.world.time >= self.case.duration {
            return self.finish().map(Step::Ended);
        }
        if session.stop {
            self.write_checkpoint()?;
            return Ok(Step::Stopped);
        }
        self.advance()?;
        Ok(Step::Continues)
    }

    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError> {
        let path = self.dir.join(checkpoint::FAILED_FILE);
        checkpoint::write(self.case, &self.world, &self.state, &path)?;
        Ok(path)
    }

    fn details(&self) -> String {
        let (failed, pairs) = (self.world.failures.len(), self.world.contacts.scalars.touching);
        format!("{failed} faces failed, {pairs} pairs of tetrahedra touch")
    }
}
