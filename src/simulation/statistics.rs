//! What is kept of a run besides its series.

use serde::{Deserialize, Serialize};

use crate::rigid::Load;

/// Extremes and counts of a run so far; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Steps counted.
    pub steps: u64,
    /// Shortest step [s].
    pub shortest_step: f64,
    /// Longest step [s].
    pub longest_step: f64,
    /// Largest force of the water on each unit, buoyancy included [N].
    pub peak_fluid_force: Vec<f64>,
    /// Largest force of bed and neighbours on each unit [N].
    pub peak_contact_force: Vec<f64>,
    /// Contacts of each unit with the bed and with other units.
    pub contacts: Vec<[u64; 2]>,
    /// Hardest contact [N].
    pub peak_contact: f64,
    /// Fastest approach at the start of a contact [m/s].
    pub fastest_contact: f64,
    /// Time since which all units have been at rest [s].
    pub at_rest_since: Option<f64>,
    /// Energy of water and units at the start [J].
    pub energy_start: Option<f64>,
    /// Wall clock of all sessions of the run [s].
    pub wall_s: f64,
}

impl Statistics {
    /// Statistics of a run with `units` units.
    pub fn new(units: usize) -> Self {
        Self {
            peak_fluid_force: vec![0.0; units],
            peak_contact_force: vec![0.0; units],
            contacts: vec![[0; 2]; units],
            ..Self::default()
        }
    }

    /// Count a step of length `dt` [s].
    pub fn count_step(&mut self, dt: f64) {
        self.shortest_step = if self.steps == 0 { dt } else { self.shortest_step.min(dt) };
        self.longest_step = self.longest_step.max(dt);
        self.steps += 1;
    }

    /// Count the loads of a step.
    pub fn count_loads(&mut self, fluid: &[Load], contact: &[Load]) {
        let keep = |peaks: &mut [f64], loads: &[Load]| {
            peaks.iter_mut().zip(loads).for_each(|(peak, load)| *peak = peak.max(load.force.length()));
        };
        keep(&mut self.peak_fluid_force, fluid);
        keep(&mut self.peak_contact_force, contact);
    }
}
