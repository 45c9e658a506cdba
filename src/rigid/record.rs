//! What is recorded of contacts while they last, and what is kept when they end.

use glam::DVec3;

use super::contact::Touch;
use super::event::{ContactEvent, EventLog};
use super::forces::Step;
use super::history::ForceHistory;
use super::impact_log::{ImpactLog, RecordedContact};
use super::motion::BodyState;

/// The record of all contacts of a world.
#[derive(Debug, Clone, Default)]
pub struct ContactBook {
    /// Of the contacts that exist, in their order.
    #[allow(clippy::vec_box, reason = "records go from list to list in every substep; a pointer is all that moves")]
    pub running: Vec<Box<RecordedContact>>,
    /// Those that have ended and were not taken yet.
    pub ended: EventLog,
    /// The hardest of them.
    pub impacts: ImpactLog,
    /// How many have begun.
    pub begun: u64,
}

/// The bodies of a contact at its start.
#[derive(Debug, Clone, Copy)]
pub struct Beginning {
    /// Time [s].
    pub time: f64,
    /// The body.
    pub body: BodyState,
    /// Its partner, in the image that it touches.
    pub partner: Option<BodyState>,
    /// Normal velocity [m/s], negative when approaching.
    pub v_n: f64,
    /// Tangential velocity [m/s].
    pub v_t: DVec3,
    /// Mass that the contact feels [kg].
    pub mass: f64,
}

/// Force of a contact over a step.
#[derive(Debug, Clone, Copy)]
pub struct Push {
    /// The step.
    pub step: Step,
    /// Force at its start [N].
    pub before: DVec3,
    /// Force at its end [N].
    pub now: DVec3,
    /// Normal velocity at its end [m/s].
    pub v_n: f64,
}

impl ContactBook {
    /// A record for a contact that begins.
    pub fn begin(&mut self, touch: &Touch, at: Beginning) -> Box<RecordedContact> {
        let number = self.begun;
        self.begun += 1;
        let arm = touch.point - at.body.position;
        let event = ContactEvent {
            number,
            start: at.time,
            end: at.time,
            body: touch.key.body,
            partner: touch.key.feature,
            point: touch.point.to_array(),
            point_in_body: (at.body.rotation.inverse() * arm).to_array(),
            normal: touch.normal.to_array(),
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
        Box::new(RecordedContact { event, history: ForceHistory::default() })
    }

    /// Takes in a contact that has ended in a step; `before` is the force [N] that it had at the step's start.
    pub fn end(&mut self, mut contact: Box<RecordedContact>, before: DVec3, step: Step) {
        contact.push(before, DVec3::ZERO, step);
        self.ended.push(contact.event);
        self.impacts.take(*contact);
    }

    /// The log with the contacts that still exist.
    pub fn impacts_so_far(&self) -> ImpactLog {
        let mut log = self.impacts.clone();
        self.running.iter().for_each(|contact| log.take((**contact).clone()));
        log
    }
}

impl RecordedContact {
    /// Adds a step at whose end the contact exists.
    pub fn add(&mut self, push: Push) {
        let Push { step, before, now, v_n } = push;
        self.push(before, now, step);
        let event = &mut self.event;
        if now.length_squared() > event.peak_force * event.peak_force {
            event.peak_force = now.length();
            event.peak = now.to_array();
            event.peak_time = step.time;
        }
        event.end = step.time;
        event.rebound = v_n;
    }

    /// The body felt the mean of the forces at both ends of the step.
    fn push(&mut self, before: DVec3, now: DVec3, step: Step) {
        let Step { dt, time, .. } = step;
        let force = 0.5 * (before + now);
        self.event.impulse = (DVec3::from_array(self.event.impulse) + force * dt).to_array();
        self.history.add(time - dt, dt, force);
    }
}
