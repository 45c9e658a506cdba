//! State of a run to and from HDF5, to the last bit.
//!
//! Arrays are datasets; bodies with their contacts, statistics and the state of the outputs are JSON texts, in which
//! every number is the shortest text that reads back to the same bits.

use std::path::{Path, PathBuf};

use glam::DVec3;
use hdf5_metno::{File, Group, types::VarLenUnicode};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::{Simulation, mean_loads::MeanLoads, recorder::RecorderState, statistics::Statistics};
use crate::{output::OutputError, particles::water::Water, rigid::RigidSnapshot, waves::absorption::AbsorptionState};

/// Layout of the file; raised when it changes.
const VERSION: u32 = 8;

type Hdf5Result<T> = hdf5_metno::Result<T>;

/// Everything but the arrays.
#[derive(Serialize, Deserialize)]
struct Scalars {
    version: u32,
    case_hash: String,
    time: f64,
    steps: u64,
    statistics: Statistics,
    recorder: RecorderState,
    rigid: Option<RigidSnapshot>,
    fluid_loads: Vec<[[f64; 3]; 2]>,
    mean_loads: MeanLoads,
    absorbed: AbsorptionState,
}

/// A copy of the state of a run, to be written while the run goes on.
pub struct Checkpoint {
    scalars: Scalars,
    water: Water,
    boundary_density: Vec<f64>,
}

impl Checkpoint {
    /// Name of the checkpoint in a run folder.
    pub const FILE: &str = "checkpoint.h5";

    /// Name of the state at which a run failed.
    pub const FAILED_FILE: &str = "failed.h5";

    /// The state of now, with that of the outputs.
    pub fn of(simulation: &Simulation, recorder: &RecorderState) -> Self {
        let units = simulation.units.as_ref();
        let scalars = Scalars {
            version: VERSION,
            case_hash: simulation.case.hash.clone(),
            time: simulation.time,
            steps: simulation.steps,
            statistics: simulation.statistics.clone(),
            recorder: recorder.clone(),
            rigid: units.map(|units| units.world.snapshot()),
            fluid_loads: units.map_or_else(Vec::new, |units| {
                units.fluid_loads.iter().map(|load| [load.force.to_array(), load.torque.to_array()]).collect()
            }),
            mean_loads: units.map_or_else(MeanLoads::default, |units| units.mean_loads.clone()),
            absorbed: simulation.absorbed,
        };
        Self { scalars, water: simulation.water.clone(), boundary_density: simulation.boundary.density.clone() }
    }

    /// Write the state to `file` in the run folder: to a temporary name first, synced, then renamed.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, dir: &Path, file: &str) -> Result<(), OutputError> {
        let (path, temporary) = (dir.join(file), dir.join(format!("{file}.part")));
        let text = serde_json::to_string(&self.scalars).map_err(OutputError::json(&path))?;
        self.write_arrays(&text, &temporary).map_err(OutputError::hdf5(&temporary))?;
        let publish = || {
            std::fs::File::open(&temporary)?.sync_all()?;
            std::fs::rename(&temporary, &path)
        };
        publish().map_err(OutputError::io(&path))
    }

    fn write_arrays(&self, text: &str, path: &Path) -> Hdf5Result<()> {
        let file = File::create(path)?;
        let text: VarLenUnicode =
            text.parse().map_err(|_| hdf5_metno::Error::from("the state holds a NUL character"))?;
        file.new_attr::<VarLenUnicode>().create("state")?.write_scalar(&text)?;
        let group = file.create_group("water")?;
        write_vectors(&group, "position_m", &self.water.position)?;
        write_vectors(&group, "velocity_m_s", &self.water.velocity)?;
        group.new_dataset_builder().with_data(&self.water.density[..]).create("density_kg_m3")?;
        group.new_dataset_builder().with_data(&self.water.mass[..]).create("mass_kg")?;
        group.new_dataset_builder().with_data(&self.water.id[..]).create("id")?;
        let group = file.create_group("boundary")?;
        group.new_dataset_builder().with_data(&self.boundary_density[..]).create("density_kg_m3")?;
        file.close()
    }
}

/// Put a simulation of the same case into the state of the checkpoint; returns the state of the outputs.
///
/// # Errors
/// If there is no checkpoint, it is damaged, or it is one of another case.
pub fn read(simulation: &mut Simulation, dir: &Path) -> Result<RecorderState, OutputError> {
    let path = dir.join(Checkpoint::FILE);
    let (text, arrays) = read_arrays(&path).map_err(OutputError::hdf5(&path))?;
    let scalars: Scalars = parse(&text, &path)?;
    if scalars.version != VERSION {
        let what = format!("was written by another version of breakwater (layout {})", scalars.version);
        return Err(OutputError::content(&path, what));
    }
    if scalars.case_hash != simulation.case.hash {
        return Err(OutputError::content(&path, "belongs to another case than case.json beside it".to_owned()));
    }
    if arrays.boundary_density.len() != simulation.boundary.len() {
        return Err(OutputError::content(&path, "does not match the particles of the case".to_owned()));
    }
    simulation.water.position = arrays.position;
    simulation.water.velocity = arrays.velocity;
    simulation.water.density = arrays.density;
    simulation.water.mass = arrays.mass;
    simulation.water.id = arrays.id;
    simulation.boundary.density = arrays.boundary_density;
    simulation.time = scalars.time;
    simulation.steps = scalars.steps;
    simulation.statistics = scalars.statistics;
    simulation.absorbed = scalars.absorbed;
    if let (Some(units), Some(snapshot)) = (&mut simulation.units, &scalars.rigid) {
        units.world.restore(snapshot).map_err(|error| OutputError::content(&path, error.to_string()))?;
        for (load, [force, torque]) in units.fluid_loads.iter_mut().zip(scalars.fluid_loads) {
            load.force = DVec3::from_array(force);
            load.torque = DVec3::from_array(torque);
        }
        units.mean_loads = scalars.mean_loads;
    }
    simulation.place_boundary();
    Ok(scalars.recorder)
}

fn parse<T: DeserializeOwned>(text: &str, path: &Path) -> Result<T, OutputError> {
    serde_json::from_str(text).map_err(OutputError::json(path))
}

/// The arrays of a checkpoint.
struct Arrays {
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    density: Vec<f64>,
    mass: Vec<f64>,
    id: Vec<u32>,
    boundary_density: Vec<f64>,
}

fn read_arrays(path: &PathBuf) -> Hdf5Result<(String, Arrays)> {
    let file = File::open(path)?;
    let text = file.attr("state")?.read_scalar::<VarLenUnicode>()?;
    let water = file.group("water")?;
    let arrays = Arrays {
        position: read_vectors(&water, "position_m")?,
        velocity: read_vectors(&water, "velocity_m_s")?,
        density: water.dataset("density_kg_m3")?.read_raw()?,
        mass: water.dataset("mass_kg")?.read_raw()?,
        id: water.dataset("id")?.read_raw()?,
        boundary_density: file.dataset("boundary/density_kg_m3")?.read_raw()?,
    };
    Ok((text.to_string(), arrays))
}

/// A dataset of three columns a particle.
fn write_vectors(group: &Group, name: &str, values: &[DVec3]) -> Hdf5Result<()> {
    let dataset = group.new_dataset::<f64>().shape((values.len(), 3)).create(name)?;
    let flat: Vec<f64> = values.iter().flat_map(|v| v.to_array()).collect();
    dataset.write_raw(&flat)
}

fn read_vectors(group: &Group, name: &str) -> Hdf5Result<Vec<DVec3>> {
    let flat: Vec<f64> = group.dataset(name)?.read_raw()?;
    Ok(flat.chunks_exact(3).map(DVec3::from_slice).collect())
}
