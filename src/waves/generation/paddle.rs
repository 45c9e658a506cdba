//! Rigid wave paddle in the particle domain. All rows of particles move in proportion to the motion at still water
//! level.

use crate::waves::generation::absorption::{Absorption, RETURN_PERIODS};
use crate::waves::generation::paddle_motion::{PaddleShape, RegularMotion};
use crate::waves::theory::solitary::SolitaryWave;

/// Motion of a paddle at still water level; the time t [s] counts from the start of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PaddleMotion {
    /// Generates a solitary wave.
    Solitary(SolitaryWave),
    /// Generates regular waves.
    Regular(RegularMotion),
}

impl PaddleMotion {
    /// Displacement from the rest position [m].
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

    /// Upper bounds of the seaward and shoreward displacement from the rest position [m].
    pub fn displacement_bounds_m(&self) -> [f64; 2] {
        match self {
            Self::Solitary(wave) => [0.0, wave.stroke_m()],
            Self::Regular(motion) => [motion.max_displacement_m(); 2],
        }
    }

    /// Elevation of the generated wave [m] at a distance [m] from the paddle and t [s].
    pub fn elevation_m(&self, distance_m: f64, t: f64) -> f64 {
        match self {
            Self::Solitary(wave) => wave.elevation_at_piston_m(t - distance_m / wave.celerity_m_s()),
            Self::Regular(motion) => motion.elevation_m(distance_m, t),
        }
    }

    /// Parameters of the active absorption of a piston with this motion; the gauge is `gauge_m` in front of the piston
    /// [m].
    pub fn absorption(&self, gauge_m: f64) -> Absorption {
        let max_displacement_m = self.displacement_bounds_m()[1];
        match self {
            Self::Solitary(wave) => Absorption {
                gauge_m,
                travel_time_s: gauge_m / wave.celerity_m_s(),
                velocity_per_elevation: (wave.gravity / wave.depth_m).sqrt(),
                max_displacement_m,
                return_time_s: None,
            },
            Self::Regular(motion) => Absorption {
                gauge_m,
                travel_time_s: gauge_m / motion.celerity_m_s(),
                velocity_per_elevation: motion.velocity_per_elevation(),
                max_displacement_m,
                return_time_s: Some(RETURN_PERIODS * motion.period_s()),
            },
        }
    }
}

/// A rigid paddle made of rows of particles. The rows of a flap move only horizontally, so the flap shears instead of
/// rotating. The error is of the order of the flap angle squared.
#[derive(Debug, Clone, PartialEq)]
pub struct Paddle {
    rest_x_m: f64,
    row_heights_m: Vec<f64>,
    /// Displacement of each row, divided by the displacement at still water level [-].
    relative_displacements: Vec<f64>,
    motion: PaddleMotion,
    absorption: Option<Absorption>,
}

impl Paddle {
    /// Creates a paddle at x = `rest_x_m` with rows at the levels z [m], for bed level `bed_m` and depth `depth_m` [m].
    pub fn new(
        rest_x_m: f64,
        row_heights_m: Vec<f64>,
        [bed_m, depth_m]: [f64; 2],
        shape: PaddleShape,
        motion: PaddleMotion,
    ) -> Self {
        let relative_displacements =
            row_heights_m.iter().map(|z| shape.relative_displacement(z - bed_m, depth_m)).collect();
        Self { rest_x_m, row_heights_m, relative_displacements, motion, absorption: None }
    }

    /// Adds active absorption with a gauge `gauge_m` in front of the paddle [m].
    pub fn with_absorption(self, gauge_m: f64) -> Self {
        Self { absorption: Some(self.motion.absorption(gauge_m)), ..self }
    }

    /// Parameters of the active absorption; `None` without absorption.
    pub fn absorption(&self) -> Option<&Absorption> {
        self.absorption.as_ref()
    }

    /// Displacement at still water level at time t [s], without absorption [m].
    pub fn motion_m(&self, t: f64) -> f64 {
        self.motion.displacement_m(t)
    }

    /// Elevation of the generated wave [m] at a distance [m] from the paddle and t [s].
    pub fn elevation_m(&self, distance_m: f64, t: f64) -> f64 {
        self.motion.elevation_m(distance_m, t)
    }

    /// Rest position x [m].
    pub fn rest_x_m(&self) -> f64 {
        self.rest_x_m
    }

    /// Levels z of the rows [m].
    pub fn row_heights_m(&self) -> &[f64] {
        &self.row_heights_m
    }

    /// Displacement [m] and velocity [m/s] of each row at time t [s], without absorption.
    pub fn rows_at(&self, t: f64) -> impl Iterator<Item = [f64; 2]> {
        let (displacement, velocity) = (self.motion.displacement_m(t), self.motion.velocity_m_s(t));
        self.relative_displacements.iter().map(move |relative| [relative * displacement, relative * velocity])
    }

    /// Upper bounds of the seaward and shoreward displacement of any row, with absorption [m].
    pub fn displacement_bounds_m(&self) -> [f64; 2] {
        let largest = self.relative_displacements.iter().copied().fold(0.0, f64::max);
        let absorbed = self.absorption.map_or(0.0, |absorption| absorption.max_displacement_m);
        self.motion.displacement_bounds_m().map(|bound| largest * (bound + absorbed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::theory::regular::RegularWave;

    fn paddle(shape: PaddleShape) -> Paddle {
        let wave = RegularWave { height_m: 0.1, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };
        let motion = PaddleMotion::Regular(RegularMotion::new(&wave, shape, 2.0));
        Paddle::new(3.0, vec![1.1, 1.3, 1.4, 1.6], [1.0, 0.4], shape, motion)
    }

    #[test]
    fn piston_rows_move_together() {
        let paddle = paddle(PaddleShape::Piston);
        let rows: Vec<[f64; 2]> = paddle.rows_at(4.1).collect();
        assert!(rows.iter().all(|row| *row == rows[0]) && rows[0][0] != 0.0);
        assert!(rows[0][0].abs() < paddle.displacement_bounds_m()[1]);
    }

    #[test]
    fn flap_rows_move_in_proportion_to_their_height_above_the_hinge() {
        let rows: Vec<[f64; 2]> = paddle(PaddleShape::Flap { hinge_m: 0.2 }).rows_at(4.1).collect();
        // The hinge is at z = 1.2 m, the still water level at 1.4 m. The shares below are
        // displacements of the rows divided by the displacement at still water level.
        for (row, share) in rows.iter().zip([0.0, 0.5, 1.0, 2.0]) {
            for k in 0..2 {
                assert!((row[k] - share * rows[2][k]).abs() < 1e-15);
            }
        }
    }
}
