//! Reads the datasets of `impacts.h5`, and converts them to impacts.

use glam::{DQuat, DVec3};
use hdf5_metno::{File, Group};

use super::{FluidAtPeak, Impact, Impacts, NO_BODY, PARTNER, PartnerNumbers, PressurePoint, SCALARS, VECTORS};
use crate::output::state_file::{Hdf5Result, read_rows, read_vectors};
use crate::rigid::{BodyState, ContactEvent, Feature, ForceSample, Load};

/// The datasets of `impacts.h5` as they are in the file.
pub struct Columns {
    numbers: Vec<u64>,
    units: Vec<u32>,
    partners: [Vec<i64>; 4],
    scalars: Vec<Vec<f64>>,
    vectors: Vec<Vec<[f64; 3]>>,
    bodies: Vec<BodyState>,
    partner_bodies: Vec<BodyState>,
    loads: [Vec<DVec3>; 2],
    offsets: Vec<u64>,
    samples: Vec<ForceSample>,
    places: [Vec<DVec3>; 2],
    pressures: Vec<f32>,
}

impl Columns {
    /// Reads the datasets of an open file.
    pub fn read(file: &File) -> Hdf5Result<Self> {
        let (impacts, history, pressure) = (file.group("impacts")?, file.group("history")?, file.group("pressure")?);
        let mut partners = [const { Vec::new() }; 4];
        for (column, name) in partners.iter_mut().zip(PARTNER) {
            *column = impacts.dataset(name)?.read_raw()?;
        }
        let starts: Vec<f64> = history.dataset("start_s")?.read_raw()?;
        let durations: Vec<f64> = history.dataset("duration_s")?.read_raw()?;
        let samples = starts.into_iter().zip(durations).zip(read_vectors(&history, "impulse_n_s")?);
        Ok(Self {
            numbers: impacts.dataset("number")?.read_raw()?,
            units: impacts.dataset("unit")?.read_raw()?,
            partners,
            scalars: SCALARS.iter().map(|(name, _)| impacts.dataset(name)?.read_raw()).collect::<Hdf5Result<_>>()?,
            vectors: VECTORS.iter().map(|(name, _)| read_rows(&impacts, name)).collect::<Hdf5Result<_>>()?,
            bodies: read_bodies(&impacts, "")?,
            partner_bodies: read_bodies(&impacts, "partner_")?,
            loads: [read_vectors(&impacts, "fluid_force_n")?, read_vectors(&impacts, "fluid_torque_n_m")?],
            offsets: history.dataset("offset")?.read_raw()?,
            samples: samples.map(|((start, duration), impulse)| ForceSample { start, duration, impulse }).collect(),
            places: [read_vectors(&pressure, "particle_m")?, read_vectors(&pressure, "to_surface_m")?],
            pressures: pressure.dataset("pressure_pa")?.read_raw()?,
        })
    }

    /// Converts the datasets to impacts. The error is the name of a dataset whose length does not match the other
    /// datasets.
    pub fn into_impacts(self) -> Result<Impacts, &'static str> {
        let [particles, to_surface] = &self.places;
        if particles.len() != to_surface.len() {
            return Err("to_surface_m");
        }
        let place = |(&particle, &to_surface)| PressurePoint { particle, to_surface };
        let places: Vec<PressurePoint> = particles.iter().zip(to_surface).map(place).collect();
        let count = self.numbers.len();
        if self.pressures.len() != count * places.len() {
            return Err("pressure_pa");
        }
        if self.offsets.len() != count + 1 {
            return Err("offset");
        }
        let impacts = (0..count).map(|row| self.impact(row, places.len())).collect::<Result<_, _>>()?;
        Ok(Impacts { places, impacts })
    }

    fn impact(&self, row: usize, places: usize) -> Result<Impact, &'static str> {
        let mut event = ContactEvent {
            number: self.numbers[row],
            body: self.units.get(row).and_then(|unit| unit.checked_sub(1)).ok_or("unit")?,
            partner: self.partner(row).ok_or("partner_number")?,
            before: *self.bodies.get(row).ok_or("position_m")?,
            partner_before: Some(*self.partner_bodies.get(row).ok_or("partner_position_m")?)
                .filter(|body| !body.position.is_nan()),
            ..NO_EVENT
        };
        for ((name, field), column) in SCALARS.iter().zip(&self.scalars) {
            *field(&mut event) = *column.get(row).ok_or(*name)?;
        }
        for ((name, field), column) in VECTORS.iter().zip(&self.vectors) {
            *field(&mut event) = *column.get(row).ok_or(*name)?;
        }
        let [start, end] = [row, row + 1].map(|row| self.offsets[row] as usize);
        let history = self.samples.get(start..end).ok_or("offset")?.to_vec();
        let [force, torque] = [&self.loads[0], &self.loads[1]];
        let force = *force.get(row).ok_or("fluid_force_n")?;
        let torque = *torque.get(row).ok_or("fluid_torque_n_m")?;
        let fluid = (!force.is_nan()).then(|| FluidAtPeak {
            load: Load { force, torque },
            pressure: self.pressures[row * places..(row + 1) * places].to_vec(),
        });
        Ok(Impact { event, history, fluid })
    }

    fn partner(&self, row: usize) -> Option<Feature> {
        let mut numbers = PartnerNumbers::default();
        for (number, column) in numbers.iter_mut().zip(&self.partners) {
            *number = *column.get(row)?;
        }
        partner(numbers)
    }
}

/// A contact event whose numbers are zero and whose state before the impact is unknown, as a start value.
pub const NO_EVENT: ContactEvent = ContactEvent {
    number: 0,
    start: 0.0,
    end: 0.0,
    body: 0,
    partner: Feature::Ground { place: 0, end: 0 },
    point: [0.0; 3],
    point_in_body: [0.0; 3],
    normal: [0.0; 3],
    before: NO_BODY,
    partner_before: None,
    approach_normal: 0.0,
    approach_tangential: 0.0,
    approach_energy: 0.0,
    rebound: 0.0,
    peak_force: 0.0,
    peak: [0.0; 3],
    peak_time: 0.0,
    impulse: [0.0; 3],
};

/// Converts the numbers from [`super::partner_numbers`] back to the contact partner; `None` if the numbers are invalid.
fn partner([kind, number, image, part]: PartnerNumbers) -> Option<Feature> {
    let end = part.try_into().ok()?;
    Some(match kind {
        0 => Feature::Unit { body: number.checked_sub(1)?.try_into().ok()?, image: image.try_into().ok()?, part: end },
        1 => Feature::Ground { place: number.try_into().ok()?, end },
        2 => Feature::Terrain { place: number.try_into().ok()?, end },
        3 => Feature::Wall { wall: number.try_into().ok()?, end },
        _ => return None,
    })
}

/// Reads the states of the bodies. If the datasets have different lengths, the shortest one gives the number of states.
fn read_bodies(group: &Group, prefix: &str) -> Hdf5Result<Vec<BodyState>> {
    let positions = read_vectors(group, &format!("{prefix}position_m"))?;
    let rotations = read_rows(group, &format!("{prefix}rotation_xyzw"))?.into_iter().map(DQuat::from_array);
    let velocities = read_vectors(group, &format!("{prefix}velocity_m_s"))?;
    let turns = read_vectors(group, &format!("{prefix}angular_velocity_rad_s"))?;
    let bodies = positions.into_iter().zip(rotations).zip(velocities.into_iter().zip(turns));
    let state = |((position, rotation), (velocity, angular_velocity))| BodyState {
        position,
        rotation,
        velocity,
        angular_velocity,
    };
    Ok(bodies.map(state).collect())
}
