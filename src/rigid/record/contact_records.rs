//! Records of all contacts. When a contact ends, its event is kept, and for a hard impact also the force history.

use glam::DVec3;

use super::event::{ContactEvent, EventLog};
use super::force_history::ForceHistory;
use super::impact_log::{ImpactLog, RecordedContact};
use super::running_record::RunningRecord;
use crate::rigid::contact::{Contact, ContactPoint, Substep};
use crate::rigid::motion::BodyState;

/// Records of all contacts of a world.
#[derive(Debug, Clone, Default)]
pub struct ContactRecords {
    /// Records of the active contacts, in the order of `RigidWorld::contacts`.
    pub running: Vec<RunningRecord>,
    /// Ended contacts that the caller has not taken yet.
    pub ended: EventLog,
    /// The hardest ended contacts.
    pub impacts: ImpactLog,
    /// Number of contacts started so far.
    pub begun: u64,
}

/// State of the bodies at the start of a contact.
#[derive(Debug, Clone, Copy)]
pub struct ContactStart {
    /// Time [s].
    pub time: f64,
    /// State of the first body.
    pub body: BodyState,
    /// State of the partner, at the periodic image that the first body touches; `None` for ground and walls.
    pub partner: Option<BodyState>,
    /// Normal velocity [m/s], negative when approaching.
    pub v_n: f64,
    /// Tangential velocity [m/s].
    pub v_t: DVec3,
    /// Effective mass of the contact [kg].
    pub mass: f64,
}

impl ContactRecords {
    /// Creates the record of a contact that starts.
    pub fn begin(&mut self, point: &ContactPoint, at: ContactStart) -> RunningRecord {
        let number = self.begun;
        self.begun += 1;
        let arm = point.position - at.body.position;
        let event = ContactEvent {
            number,
            start: at.time,
            end: at.time,
            body: point.key.body,
            partner: point.key.feature,
            point: point.position.to_array(),
            point_in_body: (at.body.rotation.inverse() * arm).to_array(),
            normal: point.normal.to_array(),
            before: at.body,
            partner_before: at.partner,
            approach_normal: -at.v_n,
            approach_tangential: at.v_t.length(),
            approach_energy: 0.5 * at.mass * (-at.v_n).max(0.0).powi(2),
            rebound: at.v_n,
            peak_force: 0.0,
            peak: [0.0; 3],
            peak_time: at.time,
            impulse: [0.0; 3],
        };
        RunningRecord::new(RecordedContact { event, history: ForceHistory::default() })
    }

    /// Stores a contact that has ended in a substep; `before` is its force [N] at the start of the substep.
    pub fn end(&mut self, mut contact: RunningRecord, before: DVec3, substep: Substep) {
        contact.add_force(before, DVec3::ZERO, substep);
        let contact = contact.finish();
        self.ended.push(contact.event);
        self.impacts.add(contact);
    }

    /// Adds the time at rest that the records do not contain yet, up to `time` [s], and completes the records.
    pub fn complete(&mut self, contacts: &mut [Contact], time: f64) {
        for (contact, running) in contacts.iter_mut().zip(&mut self.running) {
            running.add_rest(contact, time);
            contact.unrecorded = 0.0;
            running.store();
        }
    }

    /// Returns the impact log including the active contacts.
    pub fn impacts_so_far(&self) -> ImpactLog {
        let mut log = self.impacts.clone();
        self.running.iter().for_each(|contact| log.add(contact.record().clone()));
        log
    }
}
