//! A rigid paddle in the particles: rows that move in proportion to one motion.

use crate::waves::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::solitary::SolitaryWave;

/// Motion of a paddle at the still surface, t [s] from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PaddleMotion {
    /// For a solitary wave.
    Solitary(SolitaryWave),
    /// For regular waves.
    Regular(RegularMotion),
}

impl PaddleMotion {
    /// Displacement from the place of rest [m].
    pub fn displacement_m(&self, t: f64) -> f64 {
        match self {
            Self::Solitary(wave) => wave.piston_displacement_m(t),
            Self::Regular(motion) => motion.displacement_m(t),
        }
    }

    /// Velocity [m/s].
    pub fn velocity_m_s(&self, t: f64) -> f64 {
        match self {
            Self::Solitary(wave) => wave.piston_velocity_m_s(t),
            Self::Regular(motion) => motion.velocity_m_s(t),
        }
    }

    /// How far it goes seaward and shoreward of its place of rest, upper bounds [m].
    pub fn reach_m(&self) -> [f64; 2] {
        match self {
            Self::Solitary(wave) => [0.0, wave.stroke_m()],
            Self::Regular(motion) => [motion.reach_m(); 2],
        }
    }
}

/// Rows of a paddle. A flap's rows keep their height: they shear where a rigid flap turns, which differs by the square
/// of its angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Paddle {
    place_m: f64,
    row_heights_m: Vec<f64>,
    /// Displacement of each row over that at the still surface [-].
    shares: Vec<f64>,
    motion: PaddleMotion,
}

impl Paddle {
    /// A paddle at `place_m` with rows at the levels z [m], over a bed at the level `bed_m` [m] in water of the depth
    /// `depth_m` [m].
    pub fn new(
        place_m: f64,
        row_heights_m: Vec<f64>,
        [bed_m, depth_m]: [f64; 2],
        shape: PaddleShape,
        motion: PaddleMotion,
    ) -> Self {
        let shares = row_heights_m.iter().map(|z| shape.share(z - bed_m, depth_m)).collect();
        Self { place_m, row_heights_m, shares, motion }
    }

    /// Place at rest [m].
    pub fn place_m(&self) -> f64 {
        self.place_m
    }

    /// Levels z of the rows [m].
    pub fn row_heights_m(&self) -> &[f64] {
        &self.row_heights_m
    }

    /// Displacement [m] and velocity [m/s] of each row at t [s].
    pub fn rows_at(&self, t: f64) -> impl Iterator<Item = [f64; 2]> {
        let (displacement, velocity) = (self.motion.displacement_m(t), self.motion.velocity_m_s(t));
        self.shares.iter().map(move |share| [share * displacement, share * velocity])
    }

    /// How far any row goes seaward and shoreward of its place of rest, upper bounds [m].
    pub fn reach_m(&self) -> [f64; 2] {
        let largest = self.shares.iter().copied().fold(0.0, f64::max);
        self.motion.reach_m().map(|reach| largest * reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::regular::RegularWave;

    fn paddle(shape: PaddleShape) -> Paddle {
        let wave = RegularWave { height_m: 0.1, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };
        let motion = PaddleMotion::Regular(RegularMotion::new(&wave, shape, 2.0));
        Paddle::new(3.0, vec![1.1, 1.3, 1.4, 1.6], [1.0, 0.4], shape, motion)
    }

    #[test]
    fn rows_of_a_piston_move_as_one() {
        let paddle = paddle(PaddleShape::Piston);
        let rows: Vec<[f64; 2]> = paddle.rows_at(4.1).collect();
        assert!(rows.iter().all(|row| *row == rows[0]) && rows[0][0] != 0.0);
        assert!(rows[0][0].abs() < paddle.reach_m()[1]);
    }

    #[test]
    fn rows_of_a_flap_move_with_their_height_above_the_hinge() {
        let rows: Vec<[f64; 2]> = paddle(PaddleShape::Flap { hinge_m: 0.2 }).rows_at(4.1).collect();
        // Hinge at z = 1.2 m, surface at 1.4 m.
        for (row, share) in rows.iter().zip([0.0, 0.5, 1.0, 2.0]) {
            for k in 0..2 {
                assert!((row[k] - share * rows[2][k]).abs() < 1e-15);
            }
        }
    }
}
