//! Checkpoints: the bitwise state of a flume run in an HDF5 file.
//!
//! Arrays are datasets. One JSON text contains the rest of the state: time, bodies with their contacts, statistics,
//! progress of the outputs. Every number in this text has the fewest digits that read back to the same bits.

use std::{path::Path, sync::Arc};

use glam::DVec3;
use hdf5_metno::{File, Group};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::recorder_state::RecorderState;
use crate::simulation::flume::{
    Simulation,
    measures::{mean_loads::MeanLoads, statistics::Statistics, water_at_impacts::WaterAtImpacts},
    regions::buffer::BufferState,
    setup::SetupError,
    wave::ends::EndState,
};
use crate::{
    case::{Case, CaseIdentity},
    output::{
        FluidAtPeak, OutputError,
        state_file::{Hdf5Result, read_state, read_vectors, write_column, write_state, write_vectors},
    },
    rigid::{BodyState, Load, RigidSnapshot},
    sph::{device::Device, particles::water::Water},
};

/// Version of the file layout; increased when the layout changes.
const VERSION: u32 = 24;

/// The state of a run without the arrays.
#[derive(Serialize, Deserialize)]
struct Scalars {
    version: u32,
    case: CaseIdentity,
    /// Name of the device that computed the water.
    device: String,
    /// Flume time at which the particles started [s].
    start: f64,
    time: f64,
    steps: u64,
    statistics: Statistics,
    recorder: RecorderState,
    rigid: Option<RigidSnapshot>,
    /// Poses of the units from which displacements count.
    unit_start: Vec<BodyState>,
    fluid_loads: Vec<Load>,
    mean_loads: MeanLoads,
    /// How far the ends of the finest region have moved [m].
    moved: [f64; 2],
    /// The regions, the finest first.
    regions: Vec<RegionScalars>,
}

/// The state of a region without the arrays.
#[derive(Serialize, Deserialize)]
struct RegionScalars {
    ends: Vec<EndState>,
    buffers: Vec<BufferState>,
    next_id: u32,
}

/// The arrays of a region.
struct RegionArrays {
    water: Water,
    boundary_density: Vec<f64>,
}

impl RegionArrays {
    fn write(&self, group: &Group) -> Hdf5Result<()> {
        write_vectors(group, "position_m", &self.water.position)?;
        write_vectors(group, "velocity_m_s", &self.water.velocity)?;
        write_column(group, "density_kg_m3", &self.water.density)?;
        write_column(group, "mass_kg", &self.water.mass)?;
        write_column(group, "id", &self.water.id)?;
        write_column(group, "boundary_density_kg_m3", &self.boundary_density)
    }

    fn read(group: &Group) -> Hdf5Result<Self> {
        let water = Water {
            position: read_vectors(group, "position_m")?,
            velocity: read_vectors(group, "velocity_m_s")?,
            density: group.dataset("density_kg_m3")?.read_raw()?,
            mass: group.dataset("mass_kg")?.read_raw()?,
            id: group.dataset("id")?.read_raw()?,
        };
        Ok(Self { water, boundary_density: group.dataset("boundary_density_kg_m3")?.read_raw()? })
    }
}

/// A copy of the state of a run, which can be written while the run continues.
pub struct Checkpoint {
    scalars: Scalars,
    regions: Vec<RegionArrays>,
    water_at_impacts: WaterAtImpacts,
}

impl Checkpoint {
    /// File name of the checkpoint in the run folder.
    pub const FILE: &str = "checkpoint.h5";

    /// File name of the state that is saved when a run fails.
    pub const FAILED_FILE: &str = "failed.h5";

    /// Copies the current state of a run, with the progress of its outputs.
    pub fn of(simulation: &Simulation, recorder: &RecorderState) -> Self {
        let units = simulation.units.as_ref();
        let scalars = Scalars {
            version: VERSION,
            case: simulation.case.identity.clone(),
            device: simulation.solver.name().to_owned(),
            start: simulation.start,
            time: simulation.time,
            steps: simulation.steps,
            statistics: simulation.statistics.clone(),
            recorder: recorder.clone(),
            rigid: units.map(|units| units.world.snapshot()),
            unit_start: units.map_or_else(Vec::new, |units| units.start.clone()),
            fluid_loads: units.map_or_else(Vec::new, |units| units.fluid_loads.clone()),
            mean_loads: units.map_or_else(MeanLoads::default, |units| units.mean_loads.clone()),
            moved: simulation.moved,
            regions: simulation.regions().map(scalars_of).collect(),
        };
        let arrays = |region: &Simulation| RegionArrays {
            water: region.water.clone(),
            boundary_density: region.boundary.density.clone(),
        };
        Self {
            scalars,
            regions: simulation.regions().map(arrays).collect(),
            water_at_impacts: units.map_or_else(WaterAtImpacts::default, |units| units.water_at_impacts.clone()),
        }
    }

    /// Writes the state to `file` in the run folder. The file is written under a temporary name, synced, and then
    /// renamed.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, dir: &Path, file: &str) -> Result<(), OutputError> {
        let path = dir.join(file);
        let text = serde_json::to_string(&self.scalars).map_err(OutputError::json(&path))?;
        write_state(&path, &text, |file| {
            for (number, region) in self.regions.iter().enumerate() {
                region.write(&file.create_group(&group_of(number))?)?;
            }
            write_impacts(&file.create_group("impacts")?, &self.water_at_impacts)
        })
    }
}

/// Returns the name of the device that computed the run in `dir`; `None` if the checkpoint cannot be read.
pub fn device_of(dir: &Path) -> Option<String> {
    let path = dir.join(Checkpoint::FILE);
    let (text, ()) = read_state(&path, |_| Ok(())).ok()?;
    parse::<Scalars>(&text, &path).ok().map(|scalars| scalars.device)
}

impl Checkpoint {
    /// Reads the checkpoint in `dir` of a run with the case `identity`.
    ///
    /// # Errors
    /// If the checkpoint is missing, damaged or of another case.
    pub fn read(dir: &Path, identity: &CaseIdentity) -> Result<Self, OutputError> {
        let path = dir.join(Self::FILE);
        let (text, (regions, water_at_impacts)) = read_state(&path, read_arrays)?;
        let scalars: Scalars = parse(&text, &path)?;
        if scalars.version != VERSION {
            let what = format!(
                "was written by another version of breakwater (layout {} instead of {VERSION}); rerun the case",
                scalars.version
            );
            return Err(OutputError::content(&path, what));
        }
        scalars.case.check(identity).map_err(|reason| OutputError::content(&path, reason))?;
        Ok(Self { scalars, regions, water_at_impacts })
    }

    /// Sets up the simulation of the case. Its particles start at the same flume time as those of the checkpoint, also
    /// if the case has another duration.
    ///
    /// # Errors
    /// As for [`Simulation::on`].
    pub fn set_up(&self, device: &Device, case: Arc<Case>) -> Result<Simulation, SetupError> {
        Simulation::starting_at(device, case, self.scalars.start, self.scalars.moved)
    }

    /// Restores the state of a simulation with the same particles and units; returns the progress of the outputs. `dir`
    /// is the folder of the checkpoint.
    ///
    /// # Errors
    /// If the checkpoint does not match the simulation.
    pub fn restore(self, simulation: &mut Simulation, dir: &Path) -> Result<RecorderState, OutputError> {
        let Self { scalars, regions, water_at_impacts } = self;
        let path = dir.join(Self::FILE);
        let count = simulation.regions().count();
        if regions.len() != count || scalars.regions.len() != count {
            return Err(OutputError::content(&path, "does not match the regions of the domain".to_owned()));
        }
        let mut regions = scalars.regions.into_iter().zip(regions);
        let mut mismatch = None;
        simulation.for_each_region(|_, region| {
            let Some((of_region, arrays)) = regions.next() else { return };
            mismatch = mismatch.or(restore_region(region, of_region, arrays).err());
            region.time = scalars.time;
            region.statistics.largest_mach = scalars.statistics.largest_mach;
        });
        if let Some(what) = mismatch {
            return Err(OutputError::content(&path, format!("does not match {what}")));
        }
        simulation.steps = scalars.steps;
        simulation.statistics = scalars.statistics;
        let now = simulation.solver.name();
        if scalars.device != now {
            simulation.statistics.warnings.push(format!(
                "resumed at {:.3} s on another device ({now} instead of {}): results equally accurate, not identical",
                simulation.flume_time(),
                scalars.device
            ));
        }
        if let (Some(units), Some(snapshot)) = (&mut simulation.units, &scalars.rigid) {
            units.world.restore(snapshot).map_err(|error| OutputError::content(&path, error.to_string()))?;
            units.start = scalars.unit_start;
            units.fluid_loads = scalars.fluid_loads;
            units.mean_loads = scalars.mean_loads;
            let points = simulation.boundary.positions_in_unit(units.recorded.start).count();
            if water_at_impacts.0.values().any(|water| water.pressure.len() != points) {
                return Err(OutputError::content(&path, "does not match the particles of the units".to_owned()));
            }
            units.water_at_impacts = water_at_impacts;
        }
        simulation.for_each_region(|_, region| region.place_boundary());
        Ok(scalars.recorder)
    }
}

fn scalars_of(region: &Simulation) -> RegionScalars {
    RegionScalars {
        ends: region.ends.iter().map(|end| end.state.clone()).collect(),
        buffers: region.buffers.iter().map(|buffer| buffer.state.clone()).collect(),
        next_id: region.next_id,
    }
}

/// Returns the name of the group with the arrays of a region.
fn group_of(region: usize) -> String {
    if region == 0 { "water".to_owned() } else { format!("water_{}", region + 1) }
}

/// Restores the state of a region; returns what does not match if the checkpoint is of other particles.
fn restore_region(region: &mut Simulation, scalars: RegionScalars, arrays: RegionArrays) -> Result<(), &'static str> {
    let RegionScalars { ends, buffers, next_id } = scalars;
    if arrays.boundary_density.len() != region.boundary.len() {
        return Err("the particles of the case");
    }
    if ends.len() != region.ends.len() {
        return Err("the ends of the domain");
    }
    if buffers.len() != region.buffers.len() {
        return Err("the regions of the domain");
    }
    for (end, state) in region.ends.iter_mut().zip(ends) {
        let rows = end.state.released.len();
        if [state.released.len(), state.layers_due.len()] != [rows; 2] {
            return Err("the rows of the open ends");
        }
        end.state = state;
    }
    for (buffer, state) in region.buffers.iter_mut().zip(buffers) {
        if buffer.state.advance.len() != state.advance.len() {
            return Err("the buffers of the regions");
        }
        buffer.state = state;
    }
    region.water = arrays.water;
    region.boundary.density = arrays.boundary_density;
    region.next_id = next_id;
    Ok(())
}

fn parse<T: DeserializeOwned>(text: &str, path: &Path) -> Result<T, OutputError> {
    serde_json::from_str(text).map_err(OutputError::json(path))
}

fn write_impacts(group: &Group, water: &WaterAtImpacts) -> Hdf5Result<()> {
    let vectors = |load: fn(&FluidAtPeak) -> DVec3| water.0.values().map(load).collect::<Vec<_>>();
    let pressures: Vec<f32> = water.0.values().flat_map(|water| &water.pressure).copied().collect();
    write_column(group, "contact", &water.0.keys().copied().collect::<Vec<u64>>())?;
    write_vectors(group, "force_n", &vectors(|water| water.load.force))?;
    write_vectors(group, "torque_n_m", &vectors(|water| water.load.torque))?;
    write_column(group, "pressure_pa", &pressures)
}

fn read_impacts(group: &Group) -> Hdf5Result<WaterAtImpacts> {
    let contacts: Vec<u64> = group.dataset("contact")?.read_raw()?;
    let (forces, torques) = (read_vectors(group, "force_n")?, read_vectors(group, "torque_n_m")?);
    let pressures: Vec<f32> = group.dataset("pressure_pa")?.read_raw()?;
    let points = pressures.len() / contacts.len().max(1);
    let loads = forces.into_iter().zip(torques).map(|(force, torque)| Load { force, torque });
    // If the units have no particles, there are no pressures.
    let pressures = pressures.chunks(points.max(1)).map(<[f32]>::to_vec).chain(std::iter::repeat(Vec::new()));
    let water = loads.zip(pressures).map(|(load, pressure)| FluidAtPeak { load, pressure });
    Ok(WaterAtImpacts(contacts.into_iter().zip(water).collect()))
}

/// Reads the arrays of all regions, and the water loads at the impacts.
fn read_arrays(file: &File) -> Hdf5Result<(Vec<RegionArrays>, WaterAtImpacts)> {
    let mut regions = Vec::new();
    while file.link_exists(&group_of(regions.len())) {
        regions.push(RegionArrays::read(&file.group(&group_of(regions.len()))?)?);
    }
    Ok((regions, read_impacts(&file.group("impacts")?)?))
}
