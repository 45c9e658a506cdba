//! Water loads on the units at the peaks of their impacts.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    output::{FluidAtPeak, PressurePlace},
    rigid::{Load, RigidWorld},
    sph::{equation_of_state::Tait, particles::boundary::Boundary},
};

/// Water loads at the peaks of the hardest contacts of each unit, by the number of the contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WaterAtImpacts(pub BTreeMap<u64, FluidAtPeak>);

impl WaterAtImpacts {
    /// Records the loads of a time step, which began at `since` [s] in the time of the contacts; drops contacts that
    /// are no longer among the hardest.
    pub fn note(&mut self, world: &RigidWorld, since: f64, loads: &[Load], boundary: &Boundary, tait: &Tait) {
        let mut noted = false;
        for event in world.impacts_with_peak_after(since) {
            let unit = event.body as usize;
            let densities = &boundary.density[boundary.units()[unit].clone()];
            let pressure = densities.iter().map(|density| tait.pressure(*density) as f32).collect();
            self.0.insert(event.number, FluidAtPeak { load: loads[unit], pressure });
            noted = true;
        }
        if noted {
            let remembered: BTreeSet<u64> = world.remembered_contacts().collect();
            self.0.retain(|number, _| remembered.contains(number));
        }
    }
}

/// Returns the points of the unit at which pressures are recorded.
pub fn pressure_places(boundary: &Boundary) -> Vec<PressurePlace> {
    let place = |(particle, to_surface)| PressurePlace { particle, to_surface };
    boundary.places_in_unit().map(place).collect()
}
