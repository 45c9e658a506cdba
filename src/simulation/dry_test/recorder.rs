//! Tables, surfaces and checkpoints of a dry test.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{DryTest, Measured};
use crate::{
    case::{BreakageSettings, CaseIdentity, Part, SiteTerrain, group},
    output::{
        Cells, CsvSeries, Impact, Impacts, OutputError, PolyDataSeries, Schedule, UnitSurface, checksum::checksum,
        columns, state_file::DAMAGED, write_atomically,
    },
    rigid::{ContactEvent, RigidSnapshot},
    simulation::flume::outputs::snapshots::{Frame, UNIT_FIELDS, rest_of},
};

/// How often each output was written, and the lengths of the tables.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Counts {
    series: Schedule,
    surfaces: Schedule,
    checkpoints: Schedule,
    /// Lengths of the tables [bytes].
    bytes: [u64; 3],
}

/// State from which a dry test can resume.
#[derive(Debug, Serialize, Deserialize)]
struct Checkpoint {
    version: u32,
    case: CaseIdentity,
    world: RigidSnapshot,
    measured: Measured,
    counts: Counts,
}

/// Version of the checkpoint layout; increased when the layout changes.
const VERSION: u32 = 5;

/// A checkpoint as it is stored. A damaged number can be valid JSON, so that only the checksum reveals the damage.
#[derive(Debug, Serialize, Deserialize)]
struct Stored {
    checksum: String,
    state: Checkpoint,
}

impl Stored {
    /// Returns the checksum of the state as JSON text. This text is the same after writing and reading.
    fn checksum(state: &Checkpoint) -> serde_json::Result<String> {
        let sum = checksum(serde_json::to_vec(state)?.as_slice()).map_err(serde_json::Error::io)?;
        Ok(format!("{sum:016x}"))
    }
}

const UNITS_FILE: &str = "units.csv";
const CONTACTS_FILE: &str = "contacts.csv";
const ENERGY_FILE: &str = "energy.csv";
const SURFACES_FILE: &str = "units.vtkhdf";

/// Open output files of a dry test.
pub struct DryTestRecorder {
    dir: PathBuf,
    counts: Counts,
    units: CsvSeries,
    contacts: CsvSeries,
    energy: CsvSeries,
    surfaces: Option<PolyDataSeries>,
}

impl DryTestRecorder {
    /// File name of the checkpoint in the run folder.
    pub const CHECKPOINT: &str = "checkpoint.json";

    /// File name of the state that is saved when a run fails.
    pub const FAILED: &str = "failed.json";

    /// Creates the output files in the run folder, and writes the files that do not change during the run.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(run: &DryTest, dir: &Path) -> Result<Self, OutputError> {
        let case = &run.case;
        write_atomically(&dir.join("case.json"), case.text.as_bytes())?;
        for (name, content) in case.units.files() {
            write_atomically(&dir.join(name), content)?;
        }
        for (name, content) in case.site.parts.iter().filter_map(Part::file) {
            write_atomically(&dir.join(name), content)?;
        }
        if let Some(settings) = &case.breakage {
            write_atomically(&dir.join(BreakageSettings::MESH), &settings.mesh_file)?;
        }
        if let Some(terrain) = &case.site.terrain {
            write_atomically(&dir.join(SiteTerrain::FILE), &terrain.content)?;
        }
        CsvSeries::create(&dir.join("profile.csv"), &columns::PROFILE)?.append_rows(case.site.profile.points())?;
        UnitSurface::write_models(group::models(&case.units.groups).map(|(_, model)| model.shape.unit().solid()), dir)?;
        let surfaces = |_| -> Result<PolyDataSeries, OutputError> {
            let series = PolyDataSeries::create(&dir.join(SURFACES_FILE), Cells::Triangles, &UNIT_FIELDS)?;
            Ok(series.skipping_rest(rest_of(&case.units.groups)))
        };
        let mut recorder = Self {
            dir: dir.to_owned(),
            counts: Counts {
                series: Schedule::every(Some(case.output.series_interval)),
                surfaces: Schedule::every(case.output.units_interval),
                checkpoints: Schedule::after_every(case.output.checkpoint_interval),
                bytes: [0; 3],
            },
            units: CsvSeries::create(&dir.join(UNITS_FILE), &columns::UNITS)?,
            contacts: CsvSeries::create(&dir.join(CONTACTS_FILE), &columns::CONTACTS)?,
            energy: CsvSeries::create(&dir.join(ENERGY_FILE), &columns::DRY_ENERGY)?,
            surfaces: case.output.units_interval.map(surfaces).transpose()?,
        };
        recorder.note_lengths();
        Ok(recorder)
    }

    /// Restores a run from its checkpoint, and truncates its output files to their lengths at the checkpoint.
    ///
    /// # Errors
    /// If the checkpoint is missing, damaged or of another case, or if an output file is missing or shorter than at the
    /// checkpoint.
    pub fn reopen(run: &mut DryTest, dir: &Path) -> Result<Self, OutputError> {
        let path = dir.join(Self::CHECKPOINT);
        let bytes = std::fs::read(&path).map_err(OutputError::io(&path))?;
        let Stored { checksum: written, state } = serde_json::from_slice(&bytes).map_err(OutputError::json(&path))?;
        if state.version != VERSION {
            let what = format!(
                "was written by another version of breakwater (layout {} instead of {VERSION}); rerun the case",
                state.version
            );
            return Err(OutputError::content(&path, what));
        }
        if written != Stored::checksum(&state).map_err(OutputError::json(&path))? {
            return Err(OutputError::content(&path, DAMAGED));
        }
        state.case.check(&run.case.identity).map_err(|reason| OutputError::content(&path, reason))?;
        run.world.restore(&state.world).map_err(|error| OutputError::content(&path, error.to_string()))?;
        run.measured = state.measured;
        let table =
            |file: &str, columns: &[&str], bytes: u64| CsvSeries::open_truncated(&dir.join(file), columns, bytes);
        let mut counts = state.counts;
        let (output, time) = (run.case.output, run.time());
        counts.series.set_interval(Some(output.series_interval), time);
        counts.surfaces.set_interval(output.units_interval, time);
        counts.checkpoints.set_interval(output.checkpoint_interval, time);
        let surfaces = |_| -> Result<PolyDataSeries, OutputError> {
            let steps = counts.surfaces.count as usize;
            let series = PolyDataSeries::reopen(&dir.join(SURFACES_FILE), Cells::Triangles, &UNIT_FIELDS, steps)?;
            Ok(series.skipping_rest(rest_of(&run.case.units.groups)))
        };
        Ok(Self {
            dir: dir.to_owned(),
            units: table(UNITS_FILE, &columns::UNITS, counts.bytes[0])?,
            contacts: table(CONTACTS_FILE, &columns::CONTACTS, counts.bytes[1])?,
            energy: table(ENERGY_FILE, &columns::DRY_ENERGY, counts.bytes[2])?,
            surfaces: run.case.output.units_interval.map(surfaces).transpose()?,
            counts,
        })
    }

    /// Returns the folder of the run.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Writes the outputs that are due at the current time.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn record_due(&mut self, run: &mut DryTest) -> Result<(), OutputError> {
        let time = run.time();
        if self.counts.series.is_due(time) {
            self.record_series(run)?;
            self.counts.series.count += 1;
        }
        if self.counts.surfaces.is_due(time) {
            self.record_surfaces(run)?;
            self.counts.surfaces.count += 1;
        }
        self.note_lengths();
        if self.counts.checkpoints.is_due(time) {
            self.counts.checkpoints.count += 1;
            self.record_state(run, Self::CHECKPOINT)?;
        }
        Ok(())
    }

    /// Writes all outputs at the end of the run.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn record_end(&mut self, run: &mut DryTest) -> Result<(), OutputError> {
        // Write the checkpoint before the last rows. A run with a longer duration can then resume from it.
        self.record_state(run, Self::CHECKPOINT)?;
        self.record_series(run)?;
        if self.surfaces.is_some() {
            self.record_surfaces(run)?;
        }
        let running: Vec<ContactEvent> = run.world.running_events().copied().collect();
        self.record_contacts(run, &running)?;
        let impacts = run.world.impacts().iter().map(|contact| Impact::new(contact, 0.0, None)).collect();
        Impacts { places: Vec::new(), impacts }.write(&self.dir.join(Impacts::FILE))
    }

    /// Writes the state of the run to the file `file` in the run folder.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record_state(&self, run: &DryTest, file: &str) -> Result<(), OutputError> {
        let path = self.dir.join(file);
        let state = Checkpoint {
            version: VERSION,
            case: run.case.identity.clone(),
            world: run.world.snapshot(),
            measured: run.measured.clone(),
            counts: self.counts.clone(),
        };
        let checksum = Stored::checksum(&state).map_err(OutputError::json(&path))?;
        let bytes = serde_json::to_vec(&Stored { checksum, state }).map_err(OutputError::json(&path))?;
        write_atomically(&path, &bytes)
    }

    fn note_lengths(&mut self) {
        self.counts.bytes = [&self.units, &self.contacts, &self.energy].map(CsvSeries::bytes);
    }

    fn record_series(&mut self, run: &mut DryTest) -> Result<(), OutputError> {
        let time = run.time();
        let rows =
            run.world.states().iter().zip(run.world.contact_loads()).enumerate().map(|(number, (state, load))| {
                let mut row = vec![time, (number + 1) as f64];
                row.extend(state.position.to_array());
                row.extend(state.rotation.to_array());
                let still = glam::DVec3::ZERO;
                let vectors = [state.velocity, state.angular_velocity, still, still, load.force, load.torque];
                row.extend(vectors.iter().flat_map(|v| v.to_array()));
                row
            });
        self.units.append_rows(rows)?;
        let energy = run.world.energy();
        self.energy.append(&[
            time,
            run.slope().to_degrees(),
            energy.kinetic,
            energy.potential,
            energy.elastic,
            energy.friction,
            energy.damping,
        ])?;
        let ended = run.world.take_events();
        self.record_contacts(run, &ended)
    }

    fn record_contacts(&mut self, run: &mut DryTest, events: &[ContactEvent]) -> Result<(), OutputError> {
        for event in events {
            let between = usize::from(event.partner_unit().is_some());
            run.measured.contacts[between] += 1;
            run.measured.peak_force = run.measured.peak_force.max(event.peak_force);
        }
        self.contacts.append_rows(events.iter().map(|event| columns::contact_row(event, 0.0)))
    }

    fn record_surfaces(&mut self, run: &DryTest) -> Result<(), OutputError> {
        let Some(series) = &mut self.surfaces else { return Ok(()) };
        Frame::of_surfaces(&run.case.units.groups, run.world.states(), run.world.time()).append_to(series)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::case::DryTestCase;

    const CASE: &str = r#"{
        "title": "A cube on level ground", "dry_test": { "kind": "settle" },
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "material": "mortar" },
        "domain": { "x_m": [0.0, 1.0], "width_m": 1.0, "sides": "walls", "top_z_m": 1.0 },
        "units": { "shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3, "material": "mortar",
            "poses": [{ "centre_m": [0.5, 0.5, 0.125] }] },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.65 }],
        "stop": { "duration_s": 1.0 }
    }"#;

    #[test]
    fn a_checkpoint_with_a_changed_number_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let case = Arc::new(DryTestCase::from_str(CASE, "cube.json").unwrap());
        let mut run = DryTest::new(case).unwrap();
        let recorder = DryTestRecorder::create(&run, folder.path()).unwrap();
        recorder.record_state(&run, DryTestRecorder::CHECKPOINT).unwrap();
        assert!(DryTestRecorder::reopen(&mut run, folder.path()).is_ok());
        let path = folder.path().join(DryTestRecorder::CHECKPOINT);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replacen("0.125", "0.126", 1)).unwrap();
        let message = DryTestRecorder::reopen(&mut run, folder.path()).err().unwrap().to_string();
        assert!(message.contains("checkpoint.json: is damaged or incomplete"), "{message}");
    }
}
