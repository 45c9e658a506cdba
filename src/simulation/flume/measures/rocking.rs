//! Rocking of a unit: it rotates back and forth without rolling away.
//!
//! The turning points of the orientation are counted with a limit angle, as the load cycles of a fatigue test. A swing
//! is the rotation from a turning point to the next. An orientation is a turning point if it is farther than the limit
//! from the turning point before it, and if the unit has come back towards that point by more than the limit.
//! A rocking movement is two swings, away and back. A unit that rolls on or stays away never comes back, so it has no
//! rocking movement.

use std::f64::consts::FRAC_PI_2;

use glam::DQuat;
use serde::{Deserialize, Serialize};

/// Largest angle of a swing [rad]. If a unit rolls further, its last turning point follows at this angle. Otherwise a
/// unit that rolls beyond 180 degrees would come nearer to its last turning point, as if it came back.
const LARGEST_SWING: f64 = FRAC_PI_2;

/// Rocking of a unit since the start; part of every checkpoint. Orientations are quaternions [x, y, z, w].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rocking {
    /// Orientation at the last turning point; before the first turning point, orientation at the start.
    last: [f64; 4],
    /// Orientation farthest from `last` since then.
    farthest: [f64; 4],
    /// Orientation farthest from `farthest` since then.
    aside: [f64; 4],
    /// Orientation at the turning point before the last.
    before: [f64; 4],
    /// Angle of the swing from there to the last turning point [rad]; 0 before the first turning point.
    swing_before: f64,
    /// Number of turning points.
    turns: u64,
    /// Largest rocking angle [rad]: the smaller angle of two consecutive swings. Of the present swing, only the way
    /// back towards `before` counts, because the unit may roll away to another side.
    pub largest_angle: f64,
}

impl Rocking {
    /// Returns the state of a unit with this orientation at the start.
    pub fn new(start: DQuat) -> Self {
        let [last, farthest, aside, before] = [start.to_array(); 4];
        Self { last, farthest, aside, before, swing_before: 0.0, turns: 0, largest_angle: 0.0 }
    }

    /// Returns the number of rocking movements, of two swings each. The swing after the last turning point counts too:
    /// it is already larger than the limit.
    pub fn movements(&self) -> u64 {
        self.turns.div_ceil(2)
    }

    /// Adds the orientation at the end of a time step; `limit` is the limit angle [rad].
    pub fn add(&mut self, now: DQuat, limit: f64) {
        let [last, farthest, aside] = [self.last, self.farthest, self.aside].map(DQuat::from_array);
        let (swing, distance) = (last.angle_between(farthest), last.angle_between(now));
        if distance > swing {
            if distance > LARGEST_SWING {
                self.last = last.slerp(now, 1.0 - LARGEST_SWING / distance).normalize().to_array();
            }
            (self.farthest, self.aside) = (now.to_array(), now.to_array());
        } else {
            let (aside_by, back_by) = (farthest.angle_between(aside), farthest.angle_between(now));
            if swing - distance > limit {
                let next = if back_by > aside_by { now.to_array() } else { self.aside };
                self.turn([self.last, self.farthest], swing, next, now);
            } else if back_by > aside_by {
                self.aside = now.to_array();
            } else if aside_by - back_by > limit {
                // The unit has moved to another place, and rocks there about another axis. It comes back to `farthest`,
                // but not towards `last`.
                self.turn([self.farthest, self.aside], aside_by, now.to_array(), now);
            }
        }
        if self.turns > 0 {
            let back_by = self.swing_before - DQuat::from_array(self.before).angle_between(now);
            self.largest_angle = self.largest_angle.max(back_by);
        }
    }

    /// Counts a turning point, the end of a swing of the angle `swing` [rad] between two orientations. `farthest` is
    /// the orientation farthest from it since then.
    fn turn(&mut self, [from, at]: [[f64; 4]; 2], swing: f64, farthest: [f64; 4], now: DQuat) {
        self.turns += 1;
        self.largest_angle = self.largest_angle.max(swing.min(self.swing_before));
        (self.before, self.last, self.farthest, self.aside) = (from, at, farthest, now.to_array());
        self.swing_before = swing;
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DVec3;

    use super::*;

    const LIMIT_DEG: f64 = 2.0;

    /// Returns the number of rocking movements and the largest rocking angle [deg] of a series of orientations. It has
    /// 1000 orientations for each unit of time, from time 0 to the time `end`.
    fn counted(end: f64, orientation: impl Fn(f64) -> DQuat) -> (u64, f64) {
        let mut rocking = Rocking::new(orientation(0.0));
        for step in 0..=(1000.0 * end) as u32 {
            rocking.add(orientation(1e-3 * f64::from(step)), LIMIT_DEG.to_radians());
        }
        (rocking.movements(), rocking.largest_angle.to_degrees())
    }

    /// Returns the rotation about x, y and z by the vector `turned` [deg].
    fn about(turned: DVec3) -> DQuat {
        DQuat::from_scaled_axis(turned * 1_f64.to_radians())
    }

    /// Returns a number between -1 and 1 that changes irregularly with the time.
    fn noise(time: f64) -> f64 {
        0.5 * ((1234.5 * time).sin() + (777.7 * time).cos())
    }

    #[test]
    fn a_unit_that_rolls_or_stays_away_does_not_rock() {
        // Three full turns about an inclined axis, and the same with noise of 0.9 degrees to either side.
        assert_eq!(counted(1.0, |t| about(1080.0 * t * DVec3::new(0.6, 0.0, 0.8))), (0, 0.0));
        assert_eq!(counted(1.0, |t| about((1080.0 * t + 0.9 * noise(t)) * DVec3::Y)), (0, 0.0));
        // It rotates by 40 degrees and stays; or it settles there by 3 degrees about another axis, and comes back by 1.
        assert_eq!(counted(3.0, |t| about(40.0 * t.min(1.0) * DVec3::Y)), (0, 0.0));
        let settled = |t: f64| (t - 1.0).clamp(0.0, 1.0);
        let settles = |t: f64| about(3.0 * settled(t) * DVec3::X) * about((40.0 * t.min(1.0) - settled(t)) * DVec3::Y);
        assert_eq!(counted(3.0, settles), (0, 0.0));
    }

    #[test]
    fn a_rotation_away_and_back_is_one_movement() {
        let once = |t: f64| 10.0 * (1.0 - (2.0 * t - 1.0).abs()).max(0.0);
        for axis in [DVec3::X, DVec3::new(0.48, -0.6, 0.64)] {
            let (movements, angle) = counted(2.0, |t| about(once(t) * axis));
            // The limit is the rounding of the cosine of small angles, here and below.
            assert!(movements == 1 && (angle - 10.0).abs() < 1e-5, "{movements} of {angle} degrees");
        }
        // It comes back by 4 of 10 degrees: this is the rocking angle.
        let (movements, angle) = counted(2.0, |t| about(once(t).max(6.0 * f64::from(t > 0.5)) * DVec3::Z));
        assert!(movements == 1 && (angle - 4.0).abs() < 1e-5, "{movements} of {angle} degrees");
        // Then it rolls by 60 degrees to another side, which changes nothing.
        let rolls = |t: f64| about(60.0 * (t - 1.0).max(0.0) * DVec3::X);
        let (movements, angle) = counted(2.0, |t| rolls(t) * about(once(t).max(6.0 * f64::from(t > 0.5)) * DVec3::Z));
        assert!(movements == 1 && (angle - 4.0).abs() < 1e-5, "{movements} of {angle} degrees");
    }

    #[test]
    fn an_oscillation_counts_one_movement_per_period_above_the_limit() {
        // Three periods and a quarter, from the middle to the fourth largest angle. The range is twice the amplitude.
        let periods = |range: f64| counted(3.25, move |t| about(0.5 * range * (TAU * t).sin() * DVec3::Y));
        let (movements, angle) = periods(10.0);
        assert!(movements == 3 && (angle - 10.0).abs() < 1e-5, "{movements} of {angle} degrees");
        assert_eq!(periods(1.01 * LIMIT_DEG).0, 3);
        assert_eq!(periods(0.99 * LIMIT_DEG), (0, 0.0));
    }

    #[test]
    fn noise_on_a_swing_adds_no_movement() {
        // The range of the noise is 1.8 degrees about each axis.
        let shaken = |t: f64| 0.9 * DVec3::new(noise(t) / 3.0, noise(t + 1.0) / 3.0, noise(t + 2.0));
        let (movements, angle) = counted(3.0, |t| about(15.0 * (TAU * t).sin() * DVec3::Z + shaken(t)));
        println!("{movements} movements of {angle:.2} degrees");
        assert!(movements == 3 && (angle - 30.0).abs() < 1.9);
        assert_eq!(counted(3.0, |t| about(shaken(t))).0, 0);
    }

    #[test]
    fn rocking_about_another_axis_counts_after_a_rotation_away() {
        // By 20 degrees about y; then five periods of an oscillation from -3 to 3 degrees about x.
        let rocks = |t: f64| about(3.0 * (TAU * (t - 1.0).max(0.0)).sin() * DVec3::X);
        let (movements, angle) = counted(6.0, |t| rocks(t) * about(20.0 * t.min(1.0) * DVec3::Y));
        assert!(movements == 5 && (angle - 6.0).abs() < 1e-5, "{movements} of {angle} degrees");
        // The axis turns by 90 degrees during five periods.
        let axis = |t: f64| DQuat::from_rotation_z(0.05 * TAU * t) * DVec3::X;
        let (movements, angle) = counted(5.0, |t| about(8.0 * (TAU * t).sin() * axis(t)));
        println!("{movements} movements of {angle:.2} degrees");
        assert_eq!(movements, 5);
        // Each swing turns its axis by 9 degrees, which takes about 1 - cos 4.5 degrees = 0.3 % from the 16 degrees.
        assert!((15.9..16.0).contains(&angle));
        // It is inclined by 10 degrees and rolls around three times on its edge.
        let inclined = |t: f64| DQuat::from_rotation_z(TAU * t) * DVec3::X;
        let (movements, angle) = counted(3.0, |t| about(10.0 * inclined(t)));
        assert!(movements == 3 && (angle - 20.0).abs() < 1e-5, "{movements} of {angle} degrees");
    }

    #[test]
    fn the_state_reads_back_from_json_to_the_same_bits() {
        let mut rocking = Rocking::new(DQuat::from_rotation_x(0.7));
        for step in 0..100 {
            rocking.add(DQuat::from_rotation_x(0.7 + 0.1 * (0.3 * f64::from(step)).sin()), 0.03);
        }
        assert!(rocking.movements() > 3);
        assert_eq!(serde_json::from_str::<Rocking>(&serde_json::to_string(&rocking).unwrap()).unwrap(), rocking);
    }
}
