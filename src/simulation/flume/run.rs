//! Runs a flume case: starts from the case or a checkpoint, and ends with the summary.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

use super::{
    Simulation,
    failure::Failure,
    outputs::{checkpoint::Checkpoint, recorder::Recorder, summary::summarise},
    setup::SetupError,
};
use crate::{
    case::{Case, Way},
    output::{
        OutputError, Stopped, Summary,
        driver::{Clock, Control, Run, RunError, Session, Step, StepFailure, drive},
    },
    rigid::BodyState,
    sph::device::Device,
};

/// Options of a run.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// Progress output, and how the user stops the run.
    pub control: Control,
    /// Device that computes the water.
    pub device: Device,
    /// Simulated time at which the run ends before the end of the case [s], so that other runs can start from its last
    /// state; `None` for a run to the end of the case.
    pub until: Option<f64>,
}

/// Runs a case into an existing, empty folder.
///
/// # Errors
/// If the case cannot be set up, a file cannot be written, the run becomes unstable, or the user stops it.
pub fn run(case: Arc<Case>, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
    let simulation = Simulation::on(&options.device, case).map_err(RunError::setup)?;
    let recorder = Recorder::create(&simulation, dir)?;
    drive(FlumeRun::new(simulation, recorder, dir, options.until), dir, &options.control)
}

/// Continues a run from its last checkpoint.
///
/// # Errors
/// As for [`run`], and if the checkpoint does not belong to the case. Title, stop rules and output intervals may differ.
pub fn resume(case: Arc<Case>, dir: &Path, options: &RunOptions) -> Result<Summary, RunError> {
    let checkpoint = Checkpoint::read(dir, &case.identity)?;
    let mut simulation = checkpoint.set_up(&options.device, case).map_err(RunError::setup)?;
    let state = checkpoint.restore(&mut simulation, dir)?;
    simulation.load().map_err(|error| RunError::setup(SetupError::Device(error)))?;
    let recorder = Recorder::reopen(&simulation, dir, state)?;
    drive(FlumeRun::new(simulation, recorder, dir, options.until), dir, &options.control)
}

/// A simulation with its open output files.
pub(super) struct FlumeRun {
    simulation: Simulation,
    recorder: Recorder,
    dir: PathBuf,
    /// Simulated time at which the run ends [s].
    end: f64,
    /// Wall time of earlier sessions [s].
    wall_before: f64,
    /// Length of the last time step [s].
    dt: f64,
    /// Wall time of this session at the last summary of the run in progress [s].
    reported: Option<f64>,
}

/// Shortest wall time between two summaries of a run in progress [s].
const REPORT_INTERVAL: f64 = 10.0;

impl FlumeRun {
    /// Returns a run that ends at the end of its case, or at the simulated time `until` [s] if this time is earlier.
    pub(super) fn new(mut simulation: Simulation, recorder: Recorder, dir: &Path, until: Option<f64>) -> Self {
        let energy_start = simulation.statistics.energy_start.unwrap_or_else(|| simulation.energy().total());
        simulation.statistics.energy_start = Some(energy_start);
        Self {
            end: until.unwrap_or(f64::INFINITY).min(simulation.case.stop.duration),
            wall_before: simulation.statistics.wall_s,
            dir: dir.to_owned(),
            dt: 0.0,
            reported: None,
            simulation,
            recorder,
        }
    }
}

impl Run for FlumeRun {
    type Summary = Summary;

    fn clock(&self) -> Clock {
        Clock { time: self.simulation.time, end: self.end, steps: self.simulation.steps }
    }

    fn step(&mut self, session: Session) -> Result<Step<Summary>, StepFailure> {
        let mut now = self.simulation.begin_step().map_err(StepFailure::failure)?;
        now.statistics.wall_s = self.wall_before + session.wall;
        if let Some(stopped) = stop_rule(&mut now, self.end) {
            self.recorder.record_end(&mut now)?;
            let summary = summarise(&now, stopped, &self.dir)?;
            summary.write(&self.dir)?;
            return Ok(Step::Ended(summary));
        }
        if session.stop {
            self.recorder.record_interruption(&mut now)?;
            return Ok(Step::Stopped);
        }
        let before = self.recorder.state().clone();
        let begun = Instant::now();
        self.recorder.record_due(&mut now)?;
        let has_news = self.recorder.state().snapshots() != before.snapshots();
        if has_news && self.reported.is_none_or(|wall| session.wall - wall >= REPORT_INTERVAL) {
            // For a report of the run in progress.
            summarise(&now, Stopped::Running, &self.dir)?.write(&self.dir)?;
            self.reported = Some(session.wall);
        }
        now.statistics.outputs_s += begun.elapsed().as_secs_f64();
        if now.is_on_gpu() && self.recorder.state().checkpoints.count > before.checkpoints.count {
            // The positions in the checkpoint differ slightly from those on the graphics card. Load the positions of
            // the checkpoint onto the card, as a resumed run does. Both runs then give the same results.
            now.load().map_err(|error| StepFailure::failure(Failure::from(error)))?;
            now = self.simulation.begin_step().map_err(StepFailure::failure)?;
        }
        self.dt = now.dt();
        now.finish().map_err(StepFailure::failure)?;
        Ok(Step::Continues)
    }

    fn keep_failed_state(&mut self) -> Result<PathBuf, OutputError> {
        self.simulation.fetch()?;
        self.recorder.drain()?;
        Checkpoint::of(&self.simulation, self.recorder.state()).write(&self.dir, Checkpoint::FAILED_FILE)?;
        Ok(self.dir.join(Checkpoint::FAILED_FILE))
    }

    fn details(&self) -> String {
        let units = &self.simulation.units;
        let particles: usize = self.simulation.regions().map(|region| region.water.len() + region.boundary.len()).sum();
        let water = format!("dt {:.2e} s, {particles} particles", self.dt);
        let Some(units) = units else { return water };
        let displacements = units.displacements();
        let mean = displacements.iter().sum::<f64>() / displacements.len().max(1) as f64;
        format!("{water}, units moved {:.1} mm on average", 1e3 * mean)
    }

    fn warnings(&self) -> &[String] {
        &self.simulation.statistics.warnings
    }
}

/// Returns the reason to end the run, or `None` if the run continues. The run ends at `end` [s] at the latest.
fn stop_rule(simulation: &mut Simulation, end: f64) -> Option<Stopped> {
    if simulation.time >= end {
        return Some(Stopped::Duration);
    }
    let (rule, units) = (simulation.case.stop.at_rest.as_ref()?, simulation.units.as_ref()?);
    let case_units = simulation.case.units.as_ref()?;
    // The tips of a unit are about half a unit height from its centre.
    let tips = 0.5 * case_units.tallest();
    let speed = |state: &BodyState| state.velocity.length() + tips * state.angular_velocity.length();
    // Check the speed as well as the displacement: a unit that begins to move has no displacement yet.
    let slow = units.states().iter().all(|state| speed(state) < rule.speed);
    let stayed = simulation.statistics.rest.look(simulation.time, units.states(), tips, rule.speed * rule.hold);
    // Units are also at rest before the wave reaches them, and during a pause on their path: do not stop then.
    let ways = units.groups.iter().filter_map(|group| group.way.as_ref());
    let arrived = ways.map(Way::end).fold(simulation.passing_time, f64::max);
    let may_stop = simulation.time >= rule.not_before.max(arrived);
    (may_stop && slow && stayed >= rule.hold).then_some(Stopped::AtRest)
}
