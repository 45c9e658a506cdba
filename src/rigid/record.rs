//! Records of active contacts, and what is kept of them when they end.

use glam::DVec3;

use super::contact::Touch;
use super::event::{ContactEvent, EventLog};
use super::forces::Step;
use super::history::ForceHistory;
use super::impact_log::{ImpactLog, RecordedContact};
use super::motion::BodyState;

/// Records of all contacts of a world.
#[derive(Debug, Clone, Default)]
pub struct ContactBook {
    /// Records of the active contacts, in the order of the contacts.
    #[allow(clippy::vec_box, reason = "records move between lists in every substep; boxed, only a pointer moves")]
    pub running: Vec<Box<RecordedContact>>,
    /// Ended contacts that have not been taken yet.
    pub ended: EventLog,
    /// The hardest ended contacts.
    pub impacts: ImpactLog,
    /// Number of contacts started so far.
    pub begun: u64,
}

/// State of the bodies at the start of a contact.
#[derive(Debug, Clone, Copy)]
pub struct Beginning {
    /// Time [s].
    pub time: f64,
    /// First body.
    pub body: BodyState,
    /// Partner, at the periodic image that the body touches.
    pub partner: Option<BodyState>,
    /// Normal velocity [m/s], negative when approaching.
    pub v_n: f64,
    /// Tangential velocity [m/s].
    pub v_t: DVec3,
    /// Effective mass of the contact [kg].
    pub mass: f64,
}

/// Contact force over a substep.
#[derive(Debug, Clone, Copy)]
pub struct Push {
    /// The substep.
    pub step: Step,
    /// Force at the start of the substep [N].
    pub before: DVec3,
    /// Force at the end of the substep [N].
    pub now: DVec3,
    /// Normal velocity at the end of the substep [m/s].
    pub v_n: f64,
}

impl ContactBook {
    /// Creates the record of a contact that starts.
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

    /// Stores a contact that has ended in a substep; `before` is its force [N] at the start of the substep.
    pub fn end(&mut self, mut contact: Box<RecordedContact>, before: DVec3, step: Step) {
        contact.add_force(before, DVec3::ZERO, step);
        self.ended.push(contact.event);
        self.impacts.take(*contact);
    }

    /// Returns the impact log including the active contacts.
    pub fn impacts_so_far(&self) -> ImpactLog {
        let mut log = self.impacts.clone();
        self.running.iter().for_each(|contact| log.take((**contact).clone()));
        log
    }
}

impl RecordedContact {
    /// Adds a substep at whose end the contact is still active.
    pub fn add(&mut self, push: Push) {
        let Push { step, before, now, v_n } = push;
        self.add_force(before, now, step);
        let event = &mut self.event;
        if now.length_squared() > event.peak_force * event.peak_force {
            event.peak_force = now.length();
            event.peak = now.to_array();
            event.peak_time = step.time;
        }
        event.end = step.time;
        event.rebound = v_n;
    }

    /// Adds the mean of the forces at both ends of a substep to impulse and history.
    fn add_force(&mut self, before: DVec3, now: DVec3, step: Step) {
        let Step { dt, time, .. } = step;
        let force = 0.5 * (before + now);
        self.event.impulse = (DVec3::from_array(self.event.impulse) + force * dt).to_array();
        self.history.add(time - dt, dt, force);
    }
}
