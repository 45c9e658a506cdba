//! The rest criterion of the units.
//!
//! It depends on displacements, not on velocities. After the wave, low-viscosity water still shakes units with a few
//! millimetres per second, by hundredths of a millimetre.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::rigid::BodyState;

/// Reference poses of the units and their time; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Time of the reference poses [s].
    since: f64,
    /// Centre [m] and rotation of each unit at that time; empty before the first check.
    places: Vec<([f64; 3], [f64; 4])>,
}

impl Rest {
    /// Checks the units at a time [s]; returns how long all have stayed within `reach` [m] of their reference poses.
    /// The tips count too, `tips` [m] from the centre. If a unit gets further, all reference poses are reset.
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

    /// Returns how long units with the given motion have stayed within 1 mm, after checks for one second.
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
    fn trembling_units_are_at_rest_and_creeping_units_are_not() {
        let still = stayed(|_| (DVec3::ZERO, DQuat::IDENTITY));
        // 7 mm/s, with an amplitude of 0.1 mm.
        let trembles =
            stayed(|t| (1e-4 * (70.0 * t).sin() * DVec3::X, DQuat::from_rotation_y(1e-3 * (50.0 * t).cos())));
        assert_eq!([still, trembles], [1.0; 2]);
        // At 3 mm/s a millimetre takes a third of a second.
        assert!(stayed(|t| (3e-3 * t * DVec3::Y, DQuat::IDENTITY)) < 0.34);
        // Tips 4 cm from the centre: 0.1 rad/s is 4 mm/s.
        assert!(stayed(|t| (DVec3::ZERO, DQuat::from_rotation_z(0.1 * t))) < 0.26);
    }

    #[test]
    fn the_rest_criterion_survives_a_round_trip() {
        let mut rest = Rest::default();
        let states = [BodyState::at_rest(DVec3::new(0.1, 0.2, 1.0 / 3.0), DQuat::from_rotation_x(0.7))];
        rest.look(0.1, &states, 0.04, 1e-3);
        assert_eq!(serde_json::from_str::<Rest>(&serde_json::to_string(&rest).unwrap()).unwrap(), rest);
    }
}
