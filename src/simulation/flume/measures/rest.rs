//! The rest criterion: units are at rest if they stay near their reference poses for some time.
//!
//! [`Rest`] checks displacements. Speeds alone are misleading: after the wave, low-viscosity water still shakes the
//! units at a few millimetres per second, but moves them by only hundredths of a millimetre.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::rigid::BodyState;

/// Reference poses of the units, and the time when they were set; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Time at which the reference poses were set [s].
    since: f64,
    /// Reference pose of each unit: centre [m] and rotation; empty before the first check.
    places: Vec<([f64; 3], [f64; 4])>,
}

impl Rest {
    /// Returns how long all units have stayed within `reach` [m] of their reference poses [s]. The displacement of a
    /// unit is that of its centre plus that of its tips by rotation; the tips are `tips` [m] from the centre. If a unit
    /// moves further than `reach`, the current poses of all units become the reference poses.
    pub fn look(&mut self, time: f64, states: &[BodyState], tips: f64, reach: f64) -> f64 {
        let stays = |((centre, rotation), state): (&([f64; 3], [f64; 4]), &BodyState)| {
            let turned = DQuat::from_array(*rotation).angle_between(state.rotation);
            state.position.distance(DVec3::from_array(*centre)) + tips * turned <= reach
        };
        if self.places.len() != states.len() || !self.places.iter().zip(states).all(stays) {
            self.since = time;
            self.places = states.iter().map(|s| (s.position.to_array(), s.rotation.to_array())).collect();
        }
        time - self.since
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks units with the given motion for one second. Returns how long they have stayed within 1 mm [s].
    fn stayed(motion: impl Fn(f64) -> (DVec3, DQuat)) -> f64 {
        let mut rest = Rest::default();
        let stay_after = |i: u32| {
            let time = f64::from(i) * 1e-3;
            let (position, rotation) = motion(time);
            let states = [BodyState::at_rest(position, rotation), BodyState::at_rest(DVec3::ONE, DQuat::IDENTITY)];
            rest.look(time, &states, 0.04, 1e-3)
        };
        (0..=1000).map(stay_after).last().unwrap()
    }

    #[test]
    fn trembling_units_are_at_rest_and_creeping_units_are_not() {
        let still = stayed(|_| (DVec3::ZERO, DQuat::IDENTITY));
        // The centre oscillates with an amplitude of 0.1 mm, at up to 7 mm/s.
        let trembles =
            stayed(|t| (1e-4 * (70.0 * t).sin() * DVec3::X, DQuat::from_rotation_y(1e-3 * (50.0 * t).cos())));
        assert_eq!([still, trembles], [1.0; 2]);
        // At 3 mm/s, a unit moves by 1 mm in 0.33 s. The criterion then starts again, so it never returns more.
        assert!(stayed(|t| (3e-3 * t * DVec3::Y, DQuat::IDENTITY)) < 0.34);
        // The tips are 4 cm from the centre: at 0.1 rad/s they move at 4 mm/s, which is 1 mm in 0.25 s.
        assert!(stayed(|t| (DVec3::ZERO, DQuat::from_rotation_z(0.1 * t))) < 0.26);
    }

    #[test]
    fn serialization_keeps_the_state_of_the_rest_criterion() {
        let mut rest = Rest::default();
        let states = [BodyState::at_rest(DVec3::new(0.1, 0.2, 1.0 / 3.0), DQuat::from_rotation_x(0.7))];
        rest.look(0.1, &states, 0.04, 1e-3);
        assert_eq!(serde_json::from_str::<Rest>(&serde_json::to_string(&rest).unwrap()).unwrap(), rest);
    }
}
