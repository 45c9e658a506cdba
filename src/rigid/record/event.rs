//! Contact events: start, end, approach velocity and peak force of each contact.

use serde::{Deserialize, Serialize};

use crate::rigid::contact::Feature;
use crate::rigid::motion::BodyState;

/// Record of a contact that has ended, or of an active contact up to now.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactEvent {
    /// Number of the contact from 0, in the order in which contacts start.
    pub number: u64,
    /// Time of the first overlap [s].
    pub start: f64,
    /// Time of the end of the overlap [s].
    pub end: f64,
    /// Number of the body from 0.
    pub body: u32,
    /// Contact partner.
    pub partner: Feature,
    /// Contact point at the start [m].
    pub point: [f64; 3],
    /// Contact point at the start in the body's axes, relative to its centre of mass [m].
    pub point_in_body: [f64; 3],
    /// Contact normal at the start, from the partner into the body: the direction of the normal force on the body.
    pub normal: [f64; 3],
    /// State of the body at the start, before any force of this contact.
    pub before: BodyState,
    /// State of the partner at the start, at the periodic image that the body touched; none for the ground and walls.
    pub partner_before: Option<BodyState>,
    /// Normal velocity at the start [m/s], positive when approaching.
    pub approach_normal: f64,
    /// Tangential velocity at the start [m/s].
    pub approach_tangential: f64,
    /// Kinetic energy of the approach [J]: (1/2) m approach_normal^2; 0 if `approach_normal` is negative. m is the mass
    /// of the unit; in a contact of two units, it is m_a m_b / (m_a + m_b).
    pub approach_energy: f64,
    /// Normal velocity at the end of the contact [m/s], positive when separating.
    pub rebound: f64,
    /// Magnitude of the largest force [N].
    pub peak_force: f64,
    /// Force vector on the body at `peak_time` [N].
    pub peak: [f64; 3],
    /// Time of the largest force [s].
    pub peak_time: f64,
    /// Integral of the force on the body over time [N s].
    pub impulse: [f64; 3],
}

impl ContactEvent {
    /// Number of the other body from 0; `None` for the ground and walls.
    pub fn partner_unit(&self) -> Option<u32> {
        match self.partner {
            Feature::Unit { body, .. } => Some(body),
            Feature::Ground { .. } | Feature::Terrain { .. } | Feature::Wall { .. } => None,
        }
    }

    /// Returns the event with all times shifted by `offset` [s].
    pub fn shifted_in_time(&self, offset: f64) -> Self {
        let Self { start, end, peak_time, .. } = *self;
        Self { start: start + offset, end: end + offset, peak_time: peak_time + offset, ..*self }
    }
}

/// Largest number of ended contacts that are stored until the caller takes them.
pub const MAX_EVENTS: usize = 20_000;

/// Ended contacts that the caller has not taken yet.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EventLog {
    /// Ended contacts, ordered by end time.
    pub ended: Vec<ContactEvent>,
}

impl EventLog {
    /// Adds an ended contact; when the log is full, drops the half with the smaller peak forces.
    pub fn push(&mut self, event: ContactEvent) {
        self.ended.push(event);
        if self.ended.len() > MAX_EVENTS {
            let mut peaks: Vec<f64> = self.ended.iter().map(|e| e.peak_force).collect();
            peaks.sort_unstable_by(f64::total_cmp);
            let middle = peaks[peaks.len() / 2];
            self.ended.retain(|e| e.peak_force > middle);
        }
    }
}

/// A contact of unit 0 with the wall at y = 0.
#[cfg(test)]
pub(super) fn event_for_tests() -> ContactEvent {
    let before = BodyState::at_rest(glam::DVec3::new(1.0, 2.0, 3.0), glam::DQuat::from_rotation_z(1.0));
    ContactEvent {
        number: 0,
        start: 0.0,
        end: 0.1,
        body: 0,
        partner: Feature::Wall { wall: 0, end: 0 },
        point: [1.0, 0.0, 3.0],
        point_in_body: [0.0, -0.5, 0.25],
        normal: [0.0, 1.0, 0.0],
        before,
        partner_before: None,
        approach_normal: 1.0,
        approach_tangential: 0.5,
        approach_energy: 0.25,
        rebound: 0.75,
        peak_force: 0.0,
        peak: [0.0; 3],
        peak_time: 0.05,
        impulse: [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn event_log_stays_bounded_and_keeps_the_hardest_contacts() {
        let mut log = EventLog::default();
        for i in 0..3 * MAX_EVENTS {
            log.push(ContactEvent { peak_force: (i % 1000) as f64, ..event_for_tests() });
            assert!(log.ended.len() <= MAX_EVENTS);
        }
        assert!(log.ended.iter().any(|e| e.peak_force == 999.0));
    }
}
