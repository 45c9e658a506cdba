//! Whether the units have come to rest.
//!
//! What counts is how far a unit gets and not how fast it is at a moment: after the wave, particles of thin water still
//! push units to and fro with some millimetres a second, by hundredths of a millimetre.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::rigid::BodyState;

/// Since when the units have stayed where they are; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Time from which on they are watched [s].
    since: f64,
    /// Centre [m] and rotation of each unit at that time; empty before the first look.
    places: Vec<([f64; 3], [f64; 4])>,
}

impl Rest {
    /// Look at the units at a time [s]. Returns how long none of them has got further than `reach` [m] from where it
    /// was when one last had, neither its centre nor its tips, `tips` [m] from it.
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

    /// How long units whose motion is given have stayed within 1 mm after a second of looks.
    fn stayed(motion: impl Fn(f64) -> (DVec3, DQuat)) -> f64 {
        let mut rest = Rest::default();
        let look = |i: u32| {
            let time = f64::from(i) * 1e-3;
            let (position, rotation) = motion(time);
            let states = [BodyState::at_rest(position, rotation), BodyState::at_rest(DVec3::ONE, DQuat::IDENTITY)];
            rest.look(time, &states, 0.04, 1e-3)
        };
        (0..=1000).map(look).last().unwrap()
    }

    #[test]
    fn units_that_tremble_are_at_rest_and_those_that_creep_are_not() {
        let still = stayed(|_| (DVec3::ZERO, DQuat::IDENTITY));
        // 7 mm/s, a tenth of a millimetre to and fro.
        let trembles =
            stayed(|t| (1e-4 * (70.0 * t).sin() * DVec3::X, DQuat::from_rotation_y(1e-3 * (50.0 * t).cos())));
        assert_eq!([still, trembles], [1.0; 2]);
        // At 3 mm/s a millimetre lasts for a third of a second.
        assert!(stayed(|t| (3e-3 * t * DVec3::Y, DQuat::IDENTITY)) < 0.34);
        // Tips 4 cm from the centre: a tenth of a radian a second is 4 mm/s.
        assert!(stayed(|t| (DVec3::ZERO, DQuat::from_rotation_z(0.1 * t))) < 0.26);
    }

    #[test]
    fn a_rest_survives_being_written_and_read() {
        let mut rest = Rest::default();
        let states = [BodyState::at_rest(DVec3::new(0.1, 0.2, 1.0 / 3.0), DQuat::from_rotation_x(0.7))];
        rest.look(0.1, &states, 0.04, 1e-3);
        assert_eq!(serde_json::from_str::<Rest>(&serde_json::to_string(&rest).unwrap()).unwrap(), rest);
    }
}
