//! The record of an active contact.
//!
//! A substep changes few numbers of a record. They are copied from it, so that the numbers of all contacts are next to
//! each other in memory: with a thousand units, the records themselves do not fit into the cache of a processor.

use glam::DVec3;

use super::force_history::GrowingBin;
use super::impact_log::RecordedContact;
use crate::rigid::contact::{Contact, Substep};

/// Contact force over a substep.
#[derive(Debug, Clone, Copy)]
pub struct ForceStep {
    /// The substep.
    pub substep: Substep,
    /// Force at the start of the substep [N].
    pub before: DVec3,
    /// Force at the end of the substep [N].
    pub now: DVec3,
    /// Normal velocity at the end of the substep [m/s].
    pub v_n: f64,
}

/// The record of an active contact. The copied numbers are newer than those of the record, until [`Self::store`].
#[derive(Debug, Clone)]
pub struct RunningRecord {
    record: Box<RecordedContact>,
    // Copies of `event`.
    peak_force: f64,
    impulse: DVec3,
    end: f64,
    rebound: f64,
    /// Copy of the end of `history`.
    bin: GrowingBin,
}

impl RunningRecord {
    /// Goes on with a record.
    pub fn new(record: RecordedContact) -> Self {
        let event = &record.event;
        Self {
            peak_force: event.peak_force,
            impulse: DVec3::from_array(event.impulse),
            end: event.end,
            rebound: event.rebound,
            bin: record.history.growing(),
            record: Box::new(record),
        }
    }

    /// The record as of the last [`Self::store`].
    pub fn record(&self) -> &RecordedContact {
        &self.record
    }

    /// Adds a substep to the record of a contact that is still active.
    pub fn add(&mut self, force_step: ForceStep) {
        let ForceStep { substep, before, now, v_n } = force_step;
        self.add_force(before, now, substep);
        if now.length_squared() > self.peak_force * self.peak_force {
            let event = &mut self.record.event;
            self.peak_force = now.length();
            (event.peak, event.peak_time) = (now.to_array(), substep.time);
        }
        self.end = substep.time;
        self.rebound = v_n;
    }

    /// Adds the time at rest that the record does not contain yet, up to `time` [s].
    pub fn add_rest(&mut self, &Contact { unrecorded, force, .. }: &Contact, time: f64) {
        if unrecorded > 0.0 {
            self.add(ForceStep { substep: Substep { dt: unrecorded, time }, before: force, now: force, v_n: 0.0 });
        }
    }

    /// Adds the mean of the forces at the start and the end of a substep to the impulse and the force history.
    pub fn add_force(&mut self, before: DVec3, now: DVec3, substep: Substep) {
        let force = 0.5 * (before + now);
        self.impulse += force * substep.dt;
        if !self.bin.add(substep.start(), substep.dt, force) {
            let history = &mut self.record.history;
            history.store(&self.bin);
            history.add(substep.start(), substep.dt, force);
            self.bin = history.growing();
        }
    }

    /// Writes the copied numbers into the record.
    pub fn store(&mut self) {
        let RecordedContact { event, history } = self.record.as_mut();
        event.peak_force = self.peak_force;
        event.impulse = self.impulse.to_array();
        event.end = self.end;
        event.rebound = self.rebound;
        history.store(&self.bin);
    }

    /// Returns the complete record.
    pub fn finish(mut self) -> RecordedContact {
        self.store();
        *self.record
    }
}
