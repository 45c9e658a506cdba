//! Outputs of a flume run: tables of gauges, units, contacts, energy and diagnostics; snapshots for ParaView;
//! checkpoints.
//!
//! The rows of the tables are short and are written immediately. Snapshots and checkpoints are large, so a separate
//! thread writes them (see [`Writer`]). The thread keeps their order: when a checkpoint is written, all snapshots that
//! it counts are already in their files.
//!
//! All times in the files are flume times; the flume model starts at the flume time 0.

use std::{
    fs,
    path::{Path, PathBuf},
};

use super::{
    checkpoint::Checkpoint,
    gauge_rows::{gauge_columns, gauge_row},
    recorder_state::RecorderState,
    snapshots::{Frame, SURFACES_FILE, SnapshotFiles, WATER_FILE},
    surface::{SURFACE_FILE, WaterParts},
};
use crate::simulation::flume::{Simulation, Units, measures::water_at_impacts::pressure_places, step::PreparedStep};
use crate::{
    case::{BreakageSettings, ROWS_FILE, Reference, Wave, group},
    output::{
        CsvSeries, Impact, Impacts, OutputError, UnitSurface, Writer, columns, write_atomically, write_flume_gauges,
    },
    rigid::{ContactEvent, Load, RecordedContact},
    sph::solver::power::Powers,
};

/// Open output files of a flume run.
pub struct Recorder {
    dir: PathBuf,
    state: RecorderState,
    gauges: CsvSeries,
    units: CsvSeries,
    contacts: CsvSeries,
    energy: CsvSeries,
    diagnostics: CsvSeries,
    writer: Writer<SnapshotFiles>,
}

const GAUGES_FILE: &str = "gauges.csv";
const UNITS_FILE: &str = "units.csv";
const CONTACTS_FILE: &str = "contacts.csv";
const ENERGY_FILE: &str = "energy.csv";
const DIAGNOSTICS_FILE: &str = "diagnostics.csv";

impl Recorder {
    /// Creates the files in the run folder, and writes the files that do not change during the run: case, bed, unit
    /// shape, flume gauges.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(simulation: &Simulation, dir: &Path) -> Result<Self, OutputError> {
        let case = &simulation.case;
        write_atomically(&dir.join("case.json"), case.text.as_bytes())?;
        if let Some(settings) = &case.breakage {
            write_atomically(&dir.join(BreakageSettings::MESH), &settings.mesh_file)?;
        }
        if let Some(reference) = &case.reference {
            let folder = dir.join(Reference::FOLDER);
            fs::create_dir_all(&folder).map_err(OutputError::io(&folder))?;
            reference.files.iter().try_for_each(|(name, content)| write_atomically(&folder.join(name), content))?;
        }
        if let Wave::External(wave) = &case.wave {
            write_atomically(&dir.join(ROWS_FILE), &wave.rows_text())?;
        }
        let mut profile = CsvSeries::create(&dir.join("profile.csv"), &columns::PROFILE)?;
        profile.append_rows(case.flume.profile.points())?;
        if let Some(units) = &case.units {
            UnitSurface::write_models(group::models(&units.groups).map(|(_, model)| model.shape.unit().solid()), dir)?;
            for (name, content) in units.files() {
                write_atomically(&dir.join(name), content)?;
            }
        }
        for (name, content) in case.flume.files() {
            write_atomically(&dir.join(name), content)?;
        }
        if let Some(record) = &simulation.flume {
            write_flume_gauges(case, record, &dir.join("flume_gauges.csv"))?;
        }
        let mut recorder = Self {
            dir: dir.to_owned(),
            state: RecorderState::new(&case.output),
            gauges: CsvSeries::create(&dir.join(GAUGES_FILE), &gauge_columns(case))?,
            units: CsvSeries::create(&dir.join(UNITS_FILE), &columns::UNITS)?,
            contacts: CsvSeries::create(&dir.join(CONTACTS_FILE), &columns::CONTACTS)?,
            energy: CsvSeries::create(&dir.join(ENERGY_FILE), &columns::ENERGY)?,
            diagnostics: CsvSeries::create(&dir.join(DIAGNOSTICS_FILE), &columns::DIAGNOSTICS)?,
            writer: Writer::spawn(SnapshotFiles::create(simulation, dir)?),
        };
        recorder.note_lengths();
        Ok(recorder)
    }

    /// Opens the files of an interrupted run, and truncates them to their lengths at the checkpoint.
    ///
    /// # Errors
    /// If a file is missing or shorter than at the checkpoint.
    pub fn reopen(simulation: &Simulation, dir: &Path, mut state: RecorderState) -> Result<Self, OutputError> {
        state.set_intervals(&simulation.case.output, simulation.time);
        let table =
            |file: &str, columns: &[&str], bytes: u64| CsvSeries::open_truncated(&dir.join(file), columns, bytes);
        let gauges = dir.join(GAUGES_FILE);
        Ok(Self {
            dir: dir.to_owned(),
            gauges: CsvSeries::open_truncated(&gauges, &gauge_columns(&simulation.case), state.bytes[0])?,
            units: table(UNITS_FILE, &columns::UNITS, state.bytes[1])?,
            contacts: table(CONTACTS_FILE, &columns::CONTACTS, state.bytes[2])?,
            energy: table(ENERGY_FILE, &columns::ENERGY, state.bytes[3])?,
            diagnostics: table(DIAGNOSTICS_FILE, &columns::DIAGNOSTICS, state.bytes[4])?,
            writer: Writer::spawn(SnapshotFiles::reopen(simulation, dir, state.snapshots())?),
            state,
        })
    }

    /// Creates the files of a run that starts from the checkpoint of another run in the folder `from`. Copies the
    /// tables and snapshots of the other run up to this checkpoint.
    ///
    /// # Errors
    /// If a file cannot be read or written.
    pub fn branch(simulation: &Simulation, from: &Path, dir: &Path, state: RecorderState) -> Result<Self, OutputError> {
        drop(Self::create(simulation, dir)?);
        let tables = [GAUGES_FILE, UNITS_FILE, CONTACTS_FILE, ENERGY_FILE, DIAGNOSTICS_FILE];
        for file in tables.into_iter().chain([WATER_FILE, SURFACES_FILE, SURFACE_FILE]) {
            let (from, to) = (from.join(file), dir.join(file));
            // A run of an earlier version has not written all files.
            if to.exists() && from.exists() {
                fs::copy(&from, to).map_err(OutputError::io(&from))?;
            }
        }
        Self::reopen(simulation, dir, state)
    }

    /// Returns how often each output was written, and the lengths of the tables.
    pub fn state(&self) -> &RecorderState {
        &self.state
    }

    /// Writes the outputs that are due at the current time.
    ///
    /// # Errors
    /// If a file, an earlier snapshot or an earlier checkpoint cannot be written, or the device is lost.
    pub fn record_due(&mut self, now: &mut PreparedStep) -> Result<(), OutputError> {
        self.writer.check()?;
        let time = now.time;
        let needs_water = [self.state.series, self.state.water, self.state.water_surface, self.state.checkpoints];
        if needs_water.iter().any(|output| output.is_due(time)) {
            now.fetch()?;
        }
        if self.state.series.is_due(time) {
            self.record_series(now)?;
            self.state.series.count += 1;
        }
        if self.state.surfaces.is_due(time) {
            self.record_surfaces(now)?;
            self.state.surfaces.count += 1;
        }
        if self.state.water.is_due(time) {
            self.record_water(now)?;
            self.state.water.count += 1;
        }
        if self.state.water_surface.is_due(time) {
            self.record_water_surface(now)?;
            self.state.water_surface.count += 1;
        }
        self.note_lengths();
        if self.state.checkpoints.is_due(time) {
            // Count first: the checkpoint includes itself in the number of checkpoints.
            self.state.checkpoints.count += 1;
            self.record_checkpoint(now)?;
        }
        Ok(())
    }

    /// Writes all outputs at the end of the run, and waits until all data are in the files.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn record_end(&mut self, now: &mut PreparedStep) -> Result<(), OutputError> {
        now.fetch()?;
        // Write the checkpoint before the last row, and before active contacts are recorded as ended. A run with a
        // longer duration can then resume from this checkpoint.
        self.record_checkpoint(now)?;
        self.record_series(now)?;
        if now.case.output.units_interval.is_some() {
            self.record_surfaces(now)?;
        }
        if now.case.output.fluid_interval.is_some() {
            self.record_water(now)?;
        }
        if now.case.output.surface_interval.is_some() {
            self.record_water_surface(now)?;
        }
        if let Some(units) = &now.units {
            let offset = contact_clock(now, units);
            let running: Vec<ContactEvent> = units.world.running_events().copied().collect();
            for event in &running {
                self.contacts.append(&columns::contact_row(event, offset))?;
            }
            impacts_of(now, units, offset).write(&self.dir.join(Impacts::FILE))?;
            running.iter().for_each(|event| count_contact(now, event));
        }
        self.writer.drain()
    }

    /// Writes a checkpoint of a run that the user stops, and waits until the checkpoint is in its file.
    ///
    /// # Errors
    /// If a file cannot be written, or the device is lost.
    pub fn record_interruption(&mut self, now: &mut PreparedStep) -> Result<(), OutputError> {
        now.fetch()?;
        self.record_checkpoint(now)?;
        self.drain()
    }

    /// Waits until all snapshots and checkpoints are in their files.
    ///
    /// # Errors
    /// If a snapshot or checkpoint cannot be written.
    pub fn drain(&mut self) -> Result<(), OutputError> {
        self.writer.drain()
    }

    fn note_lengths(&mut self) {
        let tables = [&self.gauges, &self.units, &self.contacts, &self.energy, &self.diagnostics];
        self.state.bytes = tables.map(CsvSeries::bytes);
    }

    fn record_series(&mut self, now: &mut PreparedStep) -> Result<(), OutputError> {
        let (time, dt) = (now.flume_time(), now.dt());
        let (values, mut means) = (now.gauge_values(), now.statistics.gauge_means.take());
        if means.is_empty() && !now.is_on_gpu() {
            // No time step was made since the last row.
            means.clone_from(&values);
        }
        let loads = now.units.as_mut().map_or_else(Vec::new, mean_loads);
        self.gauges.append(&gauge_row(now, [&values, &means], &loads))?;
        let powers = now.powers()?;
        self.energy.append(&energy_row(now, powers))?;
        self.diagnostics.append(&now.diagnostics_row(dt, powers.divergence))?;
        let simulation: &mut Simulation = now;
        let Some(units) = &mut simulation.units else { return Ok(()) };
        let events = units.world.take_events();
        let free = simulation.time > simulation.case.numerics.hold_units;
        for (number, state) in units.states().iter().enumerate() {
            if free {
                simulation.statistics.count_mean_loads(number, loads[number]);
            }
            let [fluid, contact] = loads[number];
            let mut row = vec![time, (number + 1) as f64];
            row.extend(state.position.to_array());
            row.extend(state.rotation.to_array());
            let vectors =
                [state.velocity, state.angular_velocity, fluid.force, fluid.torque, contact.force, contact.torque];
            row.extend(vectors.iter().flat_map(|v| v.to_array()));
            self.units.append(&row)?;
        }
        let offset = simulation.units.as_ref().map_or(0.0, |units| contact_clock(simulation, units));
        for event in &events {
            self.contacts.append(&columns::contact_row(event, offset))?;
            count_contact(simulation, event);
        }
        Ok(())
    }

    fn record_surfaces(&mut self, simulation: &Simulation) -> Result<(), OutputError> {
        let Some(units) = &simulation.units else { return Ok(()) };
        let frame = Frame::of_surfaces(&units.groups, units.states(), simulation.flume_time());
        self.writer.give(move |files| files.append_surfaces(&frame))
    }

    fn record_water(&mut self, simulation: &Simulation) -> Result<(), OutputError> {
        let frame = Frame::of_water(simulation);
        self.writer.give(move |files| files.append_water(&frame))
    }

    fn record_water_surface(&mut self, simulation: &Simulation) -> Result<(), OutputError> {
        let water = WaterParts::of(simulation);
        self.writer.give(move |files| files.append_water_surface(&water))
    }

    fn record_checkpoint(&mut self, simulation: &Simulation) -> Result<(), OutputError> {
        let (checkpoint, dir) = (Checkpoint::of(simulation, &self.state), self.dir.clone());
        self.writer.give(move |_| checkpoint.write(&dir, Checkpoint::FILE))
    }
}

/// Returns the loads of water and contact on each unit, averaged since the last row.
fn mean_loads(units: &mut Units) -> Vec<[Load; 2]> {
    // At the first row, no time step was made yet, so there is no mean load: use the current loads.
    let now = |(fluid, contact): (&Load, &Load)| [*fluid, *contact];
    let means = units.mean_loads.take();
    means.unwrap_or_else(|| units.fluid_loads.iter().zip(units.world.contact_loads()).map(now).collect())
}

fn energy_row(simulation: &mut Simulation, powers: Powers) -> [f64; 11] {
    simulation.statistics.balance.add(simulation.time, powers);
    let balance = simulation.statistics.balance;
    let energy = simulation.energy();
    [
        simulation.flume_time(),
        energy.kinetic,
        energy.potential,
        energy.internal,
        energy.units_kinetic,
        energy.units_potential,
        balance.boundary,
        balance.viscosity + balance.friction,
        balance.diffusion,
        balance.zones,
        balance.pores,
    ]
}

/// Returns the flume time minus the time of the rigid-body solver [s]. This solver starts at the release of the units.
fn contact_clock(simulation: &Simulation, units: &Units) -> f64 {
    simulation.flume_time() - units.world.time()
}

/// Returns the hardest impacts so far; `offset` [s] is added to their times to give flume times.
fn impacts_of(simulation: &Simulation, units: &Units, offset: f64) -> Impacts {
    let (water, places) = (&units.water_at_impacts.0, pressure_places(&simulation.boundary, units.recorded.start));
    let contacts = units.world.impacts();
    let impact = |contact: &RecordedContact| Impact::new(contact, offset, water.get(&contact.event.number).cloned());
    Impacts { places, impacts: contacts.iter().map(impact).collect() }
}

fn count_contact(simulation: &mut Simulation, event: &ContactEvent) {
    let statistics = &mut simulation.statistics;
    let with_unit = usize::from(event.partner_unit().is_some());
    statistics.contacts[event.body as usize][with_unit] += 1;
    statistics.peak_contact = statistics.peak_contact.max(event.peak_force);
    statistics.fastest_contact = statistics.fastest_contact.max(event.approach_normal);
}
