//! Extremes and counts of a flume run that its tables do not contain.

use super::{balance::Balance, gauge_means::GaugeMeans, rest::Rest, rocking::Rocking};
use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::rigid::{BodyState, Load};

/// Extremes and counts since the start of a run; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Number of time steps.
    pub steps: u64,
    /// Shortest time step [s].
    pub shortest_step: f64,
    /// Longest time step [s].
    pub longest_step: f64,
    /// Sum of the water forces on each unit [N], and number of time steps in the sum. The sum covers the second half of
    /// the time before the release of the units.
    still_force: (Vec<[f64; 3]>, u64),
    /// Largest water force on each unit [N]: the mean force between two rows of `units.csv`, minus the mean force of
    /// the still water.
    pub peak_fluid_force: Vec<f64>,
    /// Largest contact force on each unit [N], as a mean over the time between two rows of `units.csv`.
    pub peak_contact_force: Vec<f64>,
    /// Number of contacts of each unit: first with bed and walls, then with other units. A contact of two units counts
    /// only for the unit that is the first body of the contact.
    pub contacts: Vec<[u64; 2]>,
    /// Largest force of a single contact [N].
    pub peak_contact: f64,
    /// Largest approach velocity at the start of a contact [m/s].
    pub fastest_contact: f64,
    /// Rocking of each unit.
    // The default lets older checkpoints reach the message about their version.
    #[serde(default)]
    pub rocking: Vec<Rocking>,
    /// State of the rest criterion.
    pub rest: Rest,
    /// Energy of water and units at the start [J].
    pub energy_start: Option<f64>,
    /// Energy that the water has received from boundaries, viscosity, density diffusion and zones.
    pub balance: Balance,
    /// Volume [m3] and number of particles of the water at the first row of `diagnostics.csv`.
    pub water_start: Option<(f64, u64)>,
    /// Means of gauges since the last row of `gauges.csv`.
    pub gauge_means: GaugeMeans,
    /// Number of water particles that open ends have released and taken.
    pub exchanged: [u64; 2],
    /// Largest Mach number: speed of the water divided by its speed of sound c0 [-].
    pub largest_mach: f64,
    /// Largest Mach number [-], lowest and highest density [kg/m3] since the last row of `diagnostics.csv`.
    water_since_row: Option<[f64; 3]>,
    /// Warnings since the start of the run.
    pub warnings: Vec<String>,
    /// Wall time of all sessions of the run [s].
    pub wall_s: f64,
    /// Part of `wall_s` that the outputs took [s].
    pub outputs_s: f64,
}

impl Statistics {
    /// Returns the statistics of a run before its first time step. `starts` lists the units at the start.
    pub fn new(starts: &[BodyState]) -> Self {
        let units = starts.len();
        Self {
            still_force: (vec![[0.0; 3]; units], 0),
            peak_fluid_force: vec![0.0; units],
            peak_contact_force: vec![0.0; units],
            contacts: vec![[0; 2]; units],
            rocking: starts.iter().map(|start| Rocking::new(start.rotation)).collect(),
            ..Self::default()
        }
    }

    /// Counts a time step of length `dt` [s].
    pub fn count_step(&mut self, dt: f64) {
        self.shortest_step = if self.steps == 0 { dt } else { self.shortest_step.min(dt) };
        self.longest_step = self.longest_step.max(dt);
        self.steps += 1;
    }

    /// Adds the extremes of the water at the end of a time step: largest Mach number [-], lowest and highest density
    /// [kg/m3].
    pub fn count_water(&mut self, mach: f64, lowest_density: f64, highest_density: f64) {
        self.largest_mach = self.largest_mach.max(mach);
        let [m, low, high] = self.water_since_row.unwrap_or([mach, lowest_density, highest_density]);
        self.water_since_row = Some([m.max(mach), low.min(lowest_density), high.max(highest_density)]);
    }

    /// Adds what a coarser region has counted since the last call: extremes of its water, energy received in zones and
    /// from friction, water exchanged by open ends, and warnings.
    pub fn add_region(&mut self, region: &mut Self) {
        if let Some([mach, lowest, highest]) = region.take_water_since_row() {
            self.count_water(mach, lowest, highest);
        }
        self.balance.zones += std::mem::take(&mut region.balance.zones);
        self.balance.friction += std::mem::take(&mut region.balance.friction);
        for (all, of_region) in self.exchanged.iter_mut().zip(std::mem::take(&mut region.exchanged)) {
            *all += of_region;
        }
        self.warnings.append(&mut region.warnings);
        // A later warning in another region would not tell anything new.
        region.largest_mach = self.largest_mach;
    }

    /// Returns the largest Mach number [-], lowest and highest density [kg/m3] since the last call; `None` if no time
    /// step was counted since then.
    pub fn take_water_since_row(&mut self) -> Option<[f64; 3]> {
        self.water_since_row.take()
    }

    /// Adds the water loads of a time step before the release of the units.
    pub fn count_still_loads(&mut self, fluid: &[Load]) {
        let (sums, count) = &mut self.still_force;
        sums.iter_mut().zip(fluid).for_each(|(sum, load)| *sum = (DVec3::from(*sum) + load.force).to_array());
        *count += 1;
    }

    /// Returns the time-averaged force of the still water on a unit [N]; zero if the units were free from the start.
    pub fn still_force(&self, unit: usize) -> DVec3 {
        let (sums, count) = &self.still_force;
        DVec3::from(sums[unit]) / (*count).max(1) as f64
    }

    /// Updates the largest forces on a unit with its mean loads of water and contact between two rows of `units.csv`.
    pub fn count_mean_loads(&mut self, unit: usize, [fluid, contact]: [Load; 2]) {
        let beyond_still = (fluid.force - self.still_force(unit)).length();
        self.peak_fluid_force[unit] = self.peak_fluid_force[unit].max(beyond_still);
        self.peak_contact_force[unit] = self.peak_contact_force[unit].max(contact.force.length());
    }
}
