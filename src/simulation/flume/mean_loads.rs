//! Mean loads on the units over the interval of the series.
//!
//! Impacts of water on a surface last one time step, and a contact may begin and end between two rows. Single samples
//! would show neither correctly. A mean load times its interval is the momentum exchanged.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::rigid::Load;

/// Impulses on each unit since the last [`take`](Self::take); part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanLoads {
    /// Impulse [N s] and angular impulse [N m s] of the water on each unit, then those of contact.
    impulses: Vec<[[f64; 3]; 4]>,
    /// Time of the sums [s].
    over: f64,
}

impl MeanLoads {
    /// Returns zero sums for `units` units.
    pub fn new(units: usize) -> Self {
        Self { impulses: vec![[[0.0; 3]; 4]; units], over: 0.0 }
    }

    /// Adds the loads of a time step of length `dt` [s].
    pub fn add(&mut self, dt: f64, fluid: &[Load], contact: &[Load]) {
        for (sums, (fluid, contact)) in self.impulses.iter_mut().zip(fluid.iter().zip(contact)) {
            let parts = [fluid.force, fluid.torque, contact.force, contact.torque];
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum = (DVec3::from(*sum) + dt * part).to_array();
            }
        }
        self.over += dt;
    }

    /// Returns the mean loads of water and contact on each unit since the last call; `None` without a time step since.
    pub fn take(&mut self) -> Option<Vec<[Load; 2]>> {
        let gathered = std::mem::replace(self, Self::new(self.impulses.len()));
        let mean = |sums: &[[f64; 3]; 4]| {
            let [force, torque, contact_force, contact_torque] = sums.map(|sum| DVec3::from(sum) / gathered.over);
            [Load { force, torque }, Load { force: contact_force, torque: contact_torque }]
        };
        (gathered.over > 0.0).then(|| gathered.impulses.iter().map(mean).collect())
    }
}

#[cfg(test)]
mod tests {
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
