//! Water loads on the units at the force peaks of their impacts.

use std::{
    collections::{BTreeMap, BTreeSet},
    ops::Range,
};

use crate::{
    output::{FluidAtPeak, PressurePoint},
    rigid::{Load, RigidWorld},
    sph::{particles::boundary::Boundary, terms::equation_of_state::Tait},
};

/// Water loads at the force peaks of the hardest contacts of each unit; the key is the number of the contact. Pressures
/// are recorded for units with the same boundary particles; those of others are NaN.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WaterAtImpacts(pub BTreeMap<u64, FluidAtPeak>);

/// The units of a time step.
pub struct RecordedUnits<'a> {
    /// Their solver.
    pub world: &'a RigidWorld,
    /// Water load on each unit.
    pub loads: &'a [Load],
    /// Indices of the units whose pressures are recorded.
    pub recorded: Range<usize>,
}

impl WaterAtImpacts {
    /// Records the water loads of a time step for each of the hardest contacts whose force peak is in this time step.
    /// The time step began at `since` [s], in the time of the rigid-body solver. Removes contacts that are neither
    /// active nor among the hardest of their unit.
    pub fn note(&mut self, units: &RecordedUnits, since: f64, boundary: &Boundary, tait: &Tait) {
        let RecordedUnits { world, loads, recorded } = units;
        let mut noted = false;
        for event in world.impacts_with_peak_after(since) {
            let unit = event.body as usize;
            let pressure = if recorded.contains(&unit) {
                let densities = &boundary.density[boundary.units()[unit].clone()];
                densities.iter().map(|density| tait.pressure(*density) as f32).collect()
            } else {
                vec![f32::NAN; boundary.units()[recorded.start].len()]
            };
            self.0.insert(event.number, FluidAtPeak { load: loads[unit], pressure });
            noted = true;
        }
        if noted {
            let remembered: BTreeSet<u64> = world.remembered_contacts().collect();
            self.0.retain(|number, _| remembered.contains(number));
        }
    }
}

/// Returns the boundary particles of a unit at which water pressures are recorded. All recorded units have the same ones.
pub fn pressure_places(boundary: &Boundary, unit: usize) -> Vec<PressurePoint> {
    let place = |(particle, to_surface)| PressurePoint { particle, to_surface };
    boundary.positions_in_unit(unit).map(place).collect()
}
