//! Loads on the units, averaged over the time between two rows of `units.csv`.
//!
//! At an impermeable surface, a water particle acts on a unit for one time step only, and a contact can begin and end
//! between two rows. The loads at the times of the rows could miss both. The mean load times the time between two rows
//! is the exact impulse.

use serde::{Deserialize, Serialize};

use crate::rigid::Load;

/// Impulses on each unit since the last [`take`](Self::take); part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanLoads {
    /// Impulse [N s] and angular impulse [N m s] on each unit: first of the water, then of contact.
    impulses: Vec<[Load; 2]>,
    /// Time over which the impulses are summed [s].
    over: f64,
}

impl MeanLoads {
    /// Returns zero impulses for a number of `units`.
    pub fn new(units: usize) -> Self {
        Self { impulses: vec![[Load::default(); 2]; units], over: 0.0 }
    }

    /// Adds the loads of a time step of length `dt` [s].
    pub fn add(&mut self, dt: f64, fluid: &[Load], contact: &[Load]) {
        for (sums, (fluid, contact)) in self.impulses.iter_mut().zip(fluid.iter().zip(contact)) {
            sums[0] += fluid.map(|load| dt * load);
            sums[1] += contact.map(|load| dt * load);
        }
        self.over += dt;
    }

    /// Returns the mean loads of water and contact on each unit since the last call; `None` if no time step was added
    /// since then.
    pub fn take(&mut self) -> Option<Vec<[Load; 2]>> {
        let gathered = std::mem::replace(self, Self::new(self.impulses.len()));
        let mean = |sums: &[Load; 2]| sums.map(|sum| sum.map(|impulse| impulse / gathered.over));
        (gathered.over > 0.0).then(|| gathered.impulses.iter().map(mean).collect())
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_mean_load_times_its_interval_is_the_impulse() {
        let load = |force: f64| [Load { force: DVec3::X * force, torque: DVec3::Z * force }];
        let mut means = MeanLoads::new(1);
        means.add(0.25, &load(8.0), &load(1.0));
        means.add(0.75, &load(0.0), &load(1.0));
        let [fluid, contact] = means.take().unwrap()[0];
        assert_eq!(fluid, load(2.0)[0]);
        assert_eq!(contact, load(1.0)[0]);
        assert!(means.take().is_none());
    }
}
