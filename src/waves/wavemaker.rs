//! What moves the rows of boundary particles at the seaward end of the domain.
//!
//! A new kind of wavemaker is a variant here: it tells where each of its rows is and how fast it moves along x.

use crate::waves::{absorption::Absorption, ml_piston::MlPiston, paddle::Paddle};

/// A wavemaker made of rows of particles.
#[derive(Debug, Clone, PartialEq)]
pub enum Wavemaker {
    /// Rows that follow the water of a flume run.
    MlPiston(MlPiston),
    /// Rows of a rigid paddle.
    Paddle(Paddle),
}

impl Wavemaker {
    /// Place at rest [m].
    pub fn place_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.place_m(),
            Self::Paddle(paddle) => paddle.place_m(),
        }
    }

    /// How it takes up what comes back, if it does.
    pub fn absorption(&self) -> Option<&Absorption> {
        match self {
            Self::MlPiston(piston) => piston.absorption(),
            Self::Paddle(paddle) => paddle.absorption(),
        }
    }

    /// Levels z of the rows [m].
    pub fn row_heights_m(&self) -> &[f64] {
        match self {
            Self::MlPiston(piston) => piston.row_heights_m(),
            Self::Paddle(paddle) => paddle.row_heights_m(),
        }
    }

    /// Displacement [m] and velocity [m/s] along x of each row at t [s] of the flume.
    pub fn rows_at(&self, t: f64) -> Vec<[f64; 2]> {
        match self {
            Self::MlPiston(piston) => {
                let rows = 0..piston.row_heights_m().len();
                rows.map(|row| [piston.displacement_m(row, t), piston.velocity_m_s(row, t)]).collect()
            }
            Self::Paddle(paddle) => paddle.rows_at(t).collect(),
        }
    }

    /// Where it stands at t [s] of the flume [m]: a paddle at the still surface, a multi-layer piston with its highest
    /// row.
    pub fn surface_m(&self, t: f64) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.place_m() + piston.displacement_m(piston.row_heights_m().len() - 1, t),
            Self::Paddle(paddle) => paddle.place_m() + paddle.motion_m(t),
        }
    }

    /// Place of the foremost row at t [s] of the flume [m].
    pub fn front_m(&self, t: f64) -> f64 {
        let furthest = self.rows_at(t).iter().map(|row| row[0]).fold(f64::MIN, f64::max);
        self.place_m() + furthest
    }

    /// How far a row goes seaward of its place of rest [m].
    pub fn seaward_reach_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.seaward_reach_m(),
            Self::Paddle(paddle) => paddle.reach_m()[0],
        }
    }

    /// How far a row goes shoreward of its place of rest [m].
    pub fn shoreward_reach_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.shoreward_reach_m(),
            Self::Paddle(paddle) => paddle.reach_m()[1],
        }
    }
}
