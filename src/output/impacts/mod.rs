//! File `impacts.h5` with the hardest impacts of a run, the input of the breakage analysis.
//!
//! | group | content, one row per impact |
//! | --- | --- |
//! | `impacts` | bodies, position, velocities, forces, body states before the impact, water load; NaN if absent |
//! | `history` | force samples of all impacts, concatenated; impact k has the rows `offset[k]..offset[k + 1]` |
//! | `pressure` | water pressure at the boundary particles of the unit; NaN if unknown |
//!
//! Units count from 1 as in the tables. `partner_kind` is 0 for a unit, 1 for the bed profile, 2 for the terrain
//! surface, 3 for a wall. `partner_number` is the number of the unit; for the bed, 2 k for segment k of the profile or
//! 2 k + 1 for the convex corner after segment k; for the terrain, the number of the triangle, ridge or corner; for a
//! wall, 0 at y = 0, 1 at y = width, 2 seaward, 3 shoreward. All these numbers except those of units count from 0.

mod columns;

use std::path::Path;

use glam::{DQuat, DVec3};
use hdf5_metno::Group;
use serde::{Deserialize, Serialize};

use super::OutputError;
use super::state_file::{Hdf5Result, read_state, write_column, write_rows, write_state, write_vectors};
use crate::rigid::{BodyState, ContactEvent, Feature, ForceSample, Load, RecordedContact};
use columns::Columns;

/// Version of the layout of `impacts.h5`, increased with every change of the layout.
const VERSION: u32 = 1;

/// A boundary particle whose water pressure is recorded, in body axes with the origin at the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressurePoint {
    /// Position of the boundary particle, inside the unit [m].
    pub particle: DVec3,
    /// Vector from the particle to the nearest point of the unit surface [m].
    pub to_surface: DVec3,
}

/// Water load on the unit `event.body` of an [`Impact`] in the time step with the peak force.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidAtPeak {
    /// Force [N] and torque about the centre of mass [N m] in flume axes, averaged over the time step.
    pub load: Load,
    /// Pressure at each point of [`Impacts::places`] [Pa].
    pub pressure: Vec<f32>,
}

/// An impact of a unit on another unit, the bed or a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// Bodies, position, velocities, peak force and impulse; times are flume times [s].
    pub event: ContactEvent,
    /// Contact force on the unit `event.body`: samples in order of flume time, without gaps between them. The opposite
    /// force acts on the partner.
    pub history: Vec<ForceSample>,
    /// Water load in the time step with the peak force; `None` in dry tests.
    pub fluid: Option<FluidAtPeak>,
}

/// The hardest impacts of a run: the content of `impacts.h5`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Impacts {
    /// Boundary particles whose pressure is recorded, the same for all units; empty in dry tests.
    pub places: Vec<PressurePoint>,
    /// The impacts, the hardest first.
    pub impacts: Vec<Impact>,
}

/// JSON text in the file: the data that are not arrays.
#[derive(Serialize, Deserialize)]
struct Header {
    version: u32,
}

type Scalar = (&'static str, fn(&mut ContactEvent) -> &mut f64);
type Vector = (&'static str, fn(&mut ContactEvent) -> &mut [f64; 3]);

const SCALARS: [Scalar; 8] = [
    ("start_s", |event| &mut event.start),
    ("end_s", |event| &mut event.end),
    ("approach_normal_m_s", |event| &mut event.approach_normal),
    ("approach_tangential_m_s", |event| &mut event.approach_tangential),
    ("approach_energy_j", |event| &mut event.approach_energy),
    ("rebound_m_s", |event| &mut event.rebound),
    ("peak_force_n", |event| &mut event.peak_force),
    ("peak_time_s", |event| &mut event.peak_time),
];

const VECTORS: [Vector; 5] = [
    ("point_m", |event| &mut event.point),
    ("point_in_body_m", |event| &mut event.point_in_body),
    ("normal", |event| &mut event.normal),
    ("peak_force_vector_n", |event| &mut event.peak),
    ("impulse_n_s", |event| &mut event.impulse),
];

impl Impact {
    /// Creates an impact from a contact and the water load at its peak force. `offset` [s] is added to the times of the
    /// contact to give flume times.
    pub fn new(contact: &RecordedContact, offset: f64, fluid: Option<FluidAtPeak>) -> Self {
        let in_flume_time = |sample: &ForceSample| ForceSample { start: sample.start + offset, ..*sample };
        let history = contact.history.samples().iter().map(in_flume_time).collect();
        Self { event: contact.event.shifted_in_time(offset), history, fluid }
    }
}

impl Impacts {
    /// Name of the impact file in a run folder.
    pub const FILE: &str = "impacts.h5";

    /// Writes the impacts to the file `path` atomically.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let text = serde_json::to_string(&Header { version: VERSION }).map_err(OutputError::json(path))?;
        write_state(path, &text, |file| {
            self.write_events(&file.create_group("impacts")?)?;
            self.write_histories(&file.create_group("history")?)?;
            self.write_pressures(&file.create_group("pressure")?)
        })
    }

    /// Reads the impacts from the file `path`.
    ///
    /// # Errors
    /// If the file is missing or damaged, or is not an impact file.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let (text, columns) = read_state(path, Columns::read)?;
        let header: Header = serde_json::from_str(&text).map_err(OutputError::json(path))?;
        if header.version != VERSION {
            let what = format!(
                "has layout {}, written by another version of breakwater; rerun the case with this version",
                header.version
            );
            return Err(OutputError::content(path, what));
        }
        let damaged = |name: &str| {
            let what = format!("is damaged: `{name}` does not match the number of impacts; rerun the case");
            OutputError::content(path, what)
        };
        columns.into_impacts().map_err(damaged)
    }

    fn events(&self) -> impl Iterator<Item = ContactEvent> {
        self.impacts.iter().map(|impact| impact.event)
    }

    fn write_events(&self, group: &Group) -> Hdf5Result<()> {
        let numbers: Vec<u64> = self.events().map(|event| event.number).collect();
        write_column(group, "number", &numbers)?;
        let units: Vec<u32> = self.events().map(|event| event.body + 1).collect();
        write_column(group, "unit", &units)?;
        let partners: Vec<PartnerNumbers> = self.events().map(|event| partner_numbers(event.partner)).collect();
        for (k, name) in PARTNER.into_iter().enumerate() {
            write_column(group, name, &partners.iter().map(|numbers| numbers[k]).collect::<Vec<i64>>())?;
        }
        for (name, field) in SCALARS {
            write_column(group, name, &self.events().map(|mut event| *field(&mut event)).collect::<Vec<f64>>())?;
        }
        for (name, field) in VECTORS {
            write_rows(group, name, &self.events().map(|mut event| *field(&mut event)).collect::<Vec<_>>())?;
        }
        write_bodies(group, "", self.events().map(|event| event.before))?;
        write_bodies(group, "partner_", self.events().map(|event| event.partner_before.unwrap_or(NO_BODY)))?;
        let loads: Vec<Load> =
            self.impacts.iter().map(|impact| impact.fluid.as_ref().map_or(NO_LOAD, |fluid| fluid.load)).collect();
        write_vectors(group, "fluid_force_n", &loads.iter().map(|load| load.force).collect::<Vec<_>>())?;
        write_vectors(group, "fluid_torque_n_m", &loads.iter().map(|load| load.torque).collect::<Vec<_>>())
    }

    fn write_histories(&self, group: &Group) -> Hdf5Result<()> {
        let mut offsets = vec![0_u64];
        offsets.extend(self.impacts.iter().scan(0, |end, impact| {
            *end += impact.history.len() as u64;
            Some(*end)
        }));
        let samples = || self.impacts.iter().flat_map(|impact| &impact.history);
        write_column(group, "offset", &offsets)?;
        write_column(group, "start_s", &samples().map(|sample| sample.start).collect::<Vec<_>>())?;
        write_column(group, "duration_s", &samples().map(|sample| sample.duration).collect::<Vec<_>>())?;
        write_vectors(group, "impulse_n_s", &samples().map(|sample| sample.impulse).collect::<Vec<_>>())
    }

    fn write_pressures(&self, group: &Group) -> Hdf5Result<()> {
        write_vectors(group, "particle_m", &self.places.iter().map(|place| place.particle).collect::<Vec<_>>())?;
        write_vectors(group, "to_surface_m", &self.places.iter().map(|place| place.to_surface).collect::<Vec<_>>())?;
        let unknown = vec![f32::NAN; self.places.len()];
        let rows = self.impacts.iter().map(|impact| impact.fluid.as_ref().map_or(&unknown, |fluid| &fluid.pressure));
        let flat: Vec<f32> = rows.flatten().copied().collect();
        let shape = (self.impacts.len(), self.places.len());
        group.new_dataset::<f32>().shape(shape).create("pressure_pa")?.write_raw(&flat)
    }
}

const NO_LOAD: Load = Load { force: DVec3::NAN, torque: DVec3::NAN };
const NO_BODY: BodyState = BodyState {
    position: DVec3::NAN,
    rotation: DQuat::from_xyzw(f64::NAN, f64::NAN, f64::NAN, f64::NAN),
    velocity: DVec3::NAN,
    angular_velocity: DVec3::NAN,
};

/// Kind, number, periodic image of the contact partner, and `part` or `end` of its `Feature`; in the order of
/// [`PARTNER`].
type PartnerNumbers = [i64; 4];
const PARTNER: [&str; 4] = ["partner_kind", "partner_number", "partner_image", "partner_part"];

fn partner_numbers(partner: Feature) -> PartnerNumbers {
    match partner {
        Feature::Unit { body, image, part } => [0, i64::from(body) + 1, image.into(), part.into()],
        Feature::Ground { place, end } => [1, place.into(), 0, end.into()],
        Feature::Terrain { place, end } => [2, place.into(), 0, end.into()],
        Feature::Wall { wall, end } => [3, wall.into(), 0, end.into()],
    }
}

fn write_bodies(group: &Group, prefix: &str, bodies: impl Iterator<Item = BodyState>) -> Hdf5Result<()> {
    let bodies: Vec<BodyState> = bodies.collect();
    let vectors = |quantity: fn(&BodyState) -> DVec3| bodies.iter().map(quantity).collect::<Vec<_>>();
    write_vectors(group, &format!("{prefix}position_m"), &vectors(|body| body.position))?;
    let rotations: Vec<[f64; 4]> = bodies.iter().map(|body| body.rotation.to_array()).collect();
    write_rows(group, &format!("{prefix}rotation_xyzw"), &rotations)?;
    write_vectors(group, &format!("{prefix}velocity_m_s"), &vectors(|body| body.velocity))?;
    write_vectors(group, &format!("{prefix}angular_velocity_rad_s"), &vectors(|body| body.angular_velocity))
}

#[cfg(test)]
mod tests {
    use hdf5_metno::File;

    use super::super::checksum::append_checksum;
    use super::columns::NO_EVENT;
    use super::*;

    fn body(x: f64) -> BodyState {
        BodyState {
            position: DVec3::new(x, 0.1, 0.2),
            rotation: DQuat::from_rotation_x(x),
            velocity: DVec3::new(0.0, x, -1.0),
            angular_velocity: DVec3::Y * x,
        }
    }

    fn impact(number: u64, partner: Feature, with_water: bool) -> Impact {
        let x = number as f64 / 3.0;
        let mut event = ContactEvent { number, body: 2, partner, before: body(x), ..NO_EVENT };
        event.partner_before = event.partner_unit().map(|_| body(x + 1.0));
        SCALARS.iter().enumerate().for_each(|(k, (_, field))| *field(&mut event) = x + k as f64);
        VECTORS.iter().enumerate().for_each(|(k, (_, field))| *field(&mut event) = [x, k as f64, -x]);
        let sample = |k| ForceSample { start: f64::from(k), duration: 1.0, impulse: DVec3::new(x, 1.0, f64::from(k)) };
        let load = Load { force: DVec3::X * x, torque: DVec3::Z };
        let fluid = with_water.then(|| FluidAtPeak { load, pressure: vec![1.5, -x as f32] });
        Impact { event, history: (0..number as i32).map(sample).collect(), fluid }
    }

    fn some_impacts() -> Impacts {
        let place = |x| PressurePoint { particle: DVec3::X * x, to_surface: DVec3::Y * x };
        let partners = [
            Feature::Unit { body: 7, image: -1, part: 1023 },
            Feature::Ground { place: 3, end: 1 },
            Feature::Terrain { place: 70_000, end: 2 },
            Feature::Wall { wall: 3, end: 5 },
        ];
        let impacts = partners.into_iter().zip(0..).map(|(partner, k)| impact(k, partner, k != 2)).collect();
        Impacts { places: vec![place(0.1), place(0.2)], impacts }
    }

    #[test]
    fn impacts_read_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(Impacts::FILE);
        let dry = Impacts { places: Vec::new(), impacts: vec![impact(5, Feature::Ground { place: 0, end: 0 }, false)] };
        for impacts in [some_impacts(), dry, Impacts::default()] {
            impacts.write(&path).unwrap();
            assert_eq!(Impacts::read(&path).unwrap(), impacts);
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn missing_and_damaged_files_are_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(Impacts::FILE);
        let refusal = || {
            let message = Impacts::read(&path).unwrap_err().to_string();
            assert!(message.contains(Impacts::FILE), "{message}");
            message
        };
        assert!(refusal().contains("No such file"));
        std::fs::write(&path, b"not an HDF5 file").unwrap();
        refusal();
        some_impacts().write(&path).unwrap();
        let whole = std::fs::read(&path).unwrap();
        std::fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        assert!(refusal().contains("is damaged or incomplete"));
        let change = |damage: &dyn Fn(&File)| {
            some_impacts().write(&path).unwrap();
            let file = File::open_rw(&path).unwrap();
            damage(&file);
            drop(file);
            append_checksum(&path).unwrap();
        };
        for name in ["impacts/unit", "impacts/partner_kind", "impacts/peak_force_n", "impacts/rotation_xyzw"] {
            change(&|file| file.unlink(name).unwrap());
            assert!(refusal().contains("HDF5"));
        }
        for offsets in [[0_u64, 1, 3, 99, 6], [0, 3, 1, 3, 6]] {
            change(&|file| file.dataset("history/offset").unwrap().write_raw(&offsets).unwrap());
            assert!(refusal().contains("offset"));
        }
    }
}
