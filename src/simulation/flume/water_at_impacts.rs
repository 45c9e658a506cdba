//! The water at the units in the steps in which the forces of their impacts had their peaks.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    output::{FluidAtPeak, PressurePlace},
    rigid::{Load, RigidWorld},
    sph::{particles::boundary::Boundary, terms::equation_of_state::Tait},
};

/// The water at the peak so far of each contact that is among the hardest of a unit, by the number of the contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WaterAtImpacts(pub BTreeMap<u64, FluidAtPeak>);

impl WaterAtImpacts {
    /// Note the water of a step under the given loads, which began at `since` [s] on the clock of the contacts; let go of
    /// that of contacts which are no longer among the hardest.
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

/// Where the pressures are known.
pub fn pressure_places(boundary: &Boundary) -> Vec<PressurePlace> {
    let place = |(particle, to_surface)| PressurePlace { particle, to_surface };
    boundary.positions_in_unit().map(place).collect()
}
