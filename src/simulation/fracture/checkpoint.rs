//! Writes the state of a fracture run to HDF5 and reads it back bit for bit.
//!
//! Arrays are datasets. One JSON text contains the rest of the state. Each number in this text has the fewest digits
//! that read back to the same bits.

use std::path::Path;

use hdf5_metno::File;
use serde::{Deserialize, Serialize};

use super::run_state::RunState;
use crate::{
    case::{CaseIdentity, FractureCase},
    femdem::{
        contact::pairs::snapshot::ContactSnapshot,
        world::{
            World,
            snapshot::{Scalars, Snapshot},
        },
    },
    output::{
        OutputError,
        state_file::{
            Hdf5Result, read_rows, read_state, read_vectors, write_column, write_rows, write_state, write_vectors,
        },
    },
};

/// File name of the checkpoint in the run folder.
pub const FILE: &str = "checkpoint.h5";

/// File name of the state that is saved when a run fails.
pub const FAILED_FILE: &str = "failed.h5";

/// Version of the file layout; increased when the layout changes.
const VERSION: u32 = 5;

/// The state of a run without the arrays.
#[derive(Serialize, Deserialize)]
struct Header {
    version: u32,
    case: CaseIdentity,
    run: RunState,
    world: Scalars,
}

/// Writes the state of a run of the case to a file.
///
/// # Errors
/// If the file cannot be written; an existing file is then unchanged.
pub fn write(case: &FractureCase, world: &World, run: &RunState, path: &Path) -> Result<(), OutputError> {
    let state = world.snapshot();
    let header = Header { version: VERSION, case: case.identity.clone(), run: run.clone(), world: state.scalars };
    let text = serde_json::to_string(&header).map_err(OutputError::json(path))?;
    write_state(path, &text, |file| write_arrays(file, &state))
}

/// Restores `world`, the solver at the start of the case, from a checkpoint of this case. Returns the other state.
///
/// # Errors
/// If the checkpoint is missing, damaged or of another case.
pub fn read(case: &FractureCase, world: &mut World, path: &Path) -> Result<RunState, OutputError> {
    let (text, mut state) = read_state(path, read_arrays)?;
    let Header { version, case: written, run, world: scalars } =
        serde_json::from_str(&text).map_err(OutputError::json(path))?;
    if version != VERSION {
        let what = format!("was written by another version of breakwater (layout {version}); rerun the case");
        return Err(OutputError::content(path, what));
    }
    written.check(&case.identity).map_err(|reason| OutputError::content(path, reason))?;
    state.scalars = scalars;
    let damaged = |what| OutputError::content(path, format!("is damaged: {what}; rerun the case"));
    world.restore(state).map_err(damaged)?;
    Ok(run)
}

fn write_arrays(file: &File, state: &Snapshot) -> Hdf5Result<()> {
    let group = file.create_group("nodes")?;
    write_vectors(&group, "place_m", &state.position)?;
    write_vectors(&group, "velocity_m_s", &state.velocity)?;
    write_rows(&file.create_group("tets")?, "nodes", &state.vertices)?;
    let group = file.create_group("joints")?;
    write_column(&group, "bond", &state.bonds)?;
    write_column(&group, "worn", &state.damaged)?;
    write_rows(&group, "memory", &state.joint_states)?;
    let group = file.create_group("failures")?;
    write_column(&group, "joint", &state.failed)?;
    write_column(&group, "time_s", &state.failed_at)?;
    write_column(&group, "by_sliding", &state.failed_by_sliding)?;
    write_rows(&group, "energy_j", &state.failed_energy)?;
    write_rows(&file.create_group("rigid_bodies")?, "motion", &state.rigid)?;
    let (group, contacts) = (file.create_group("contacts")?, &state.contacts);
    write_rows(&group, "tets", &contacts.tets)?;
    write_column(&group, "born_m3", &contacts.initial_overlap)?;
    write_column(&group, "sprung", &contacts.pairs_with_spring)?;
    write_rows(&group, "spring", &contacts.springs)?;
    write_rows(&group, "opened_tets", &contacts.opened)?;
    write_column(&group, "opened_left_j", &contacts.inherited_energy)
}

fn read_arrays(file: &File) -> Hdf5Result<Snapshot> {
    let [nodes, tets, joints] = [file.group("nodes")?, file.group("tets")?, file.group("joints")?];
    let [failures, contacts] = [file.group("failures")?, file.group("contacts")?];
    Ok(Snapshot {
        position: read_vectors(&nodes, "place_m")?,
        velocity: read_vectors(&nodes, "velocity_m_s")?,
        vertices: read_rows(&tets, "nodes")?,
        bonds: joints.dataset("bond")?.read_raw()?,
        damaged: joints.dataset("worn")?.read_raw()?,
        joint_states: read_rows(&joints, "memory")?,
        failed: failures.dataset("joint")?.read_raw()?,
        failed_at: failures.dataset("time_s")?.read_raw()?,
        failed_by_sliding: failures.dataset("by_sliding")?.read_raw()?,
        failed_energy: read_rows(&failures, "energy_j")?,
        rigid: read_rows(&file.group("rigid_bodies")?, "motion")?,
        contacts: ContactSnapshot {
            tets: read_rows(&contacts, "tets")?,
            initial_overlap: contacts.dataset("born_m3")?.read_raw()?,
            pairs_with_spring: contacts.dataset("sprung")?.read_raw()?,
            springs: read_rows(&contacts, "spring")?,
            opened: read_rows(&contacts, "opened_tets")?,
            inherited_energy: contacts.dataset("opened_left_j")?.read_raw()?,
        },
        ..Snapshot::default()
    })
}
