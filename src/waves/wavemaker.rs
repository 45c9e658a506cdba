//! Wavemakers: rows of boundary particles that move at the seaward end of the particle domain.
//!
//! A new kind of wavemaker is a variant of [`Wavemaker`]: it returns the displacement and velocity along x of each row.

use crate::waves::{absorption::Absorption, ml_piston::MlPiston, paddle::Paddle};

/// A wavemaker made of rows of particles.
#[derive(Debug, Clone, PartialEq)]
pub enum Wavemaker {
    /// Multi-layer piston: rows follow the water of a flume run.
    MlPiston(MlPiston),
    /// Rigid paddle.
    Paddle(Paddle),
}

impl Wavemaker {
    /// Rest position x [m].
    pub fn place_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.place_m(),
            Self::Paddle(paddle) => paddle.place_m(),
        }
    }

    /// Active absorption, if any.
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

    /// Displacement [m] and velocity [m/s] along x of each row at flume time t [s].
    pub fn rows_at(&self, t: f64) -> Vec<[f64; 2]> {
        match self {
            Self::MlPiston(piston) => {
                let rows = 0..piston.row_heights_m().len();
                rows.map(|row| [piston.displacement_m(row, t), piston.velocity_m_s(row, t)]).collect()
            }
            Self::Paddle(paddle) => paddle.rows_at(t).collect(),
        }
    }

    /// Position x [m] at flume time t [s]: a paddle at still water level, a multi-layer piston at its highest row.
    pub fn surface_m(&self, t: f64) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.place_m() + piston.displacement_m(piston.row_heights_m().len() - 1, t),
            Self::Paddle(paddle) => paddle.place_m() + paddle.motion_m(t),
        }
    }

    /// Position x of the foremost row at flume time t [s] [m].
    pub fn front_m(&self, t: f64) -> f64 {
        let furthest = self.rows_at(t).iter().map(|row| row[0]).fold(f64::MIN, f64::max);
        self.place_m() + furthest
    }

    /// Largest seaward displacement of a row from its rest position [m].
    pub fn seaward_reach_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.seaward_reach_m(),
            Self::Paddle(paddle) => paddle.reach_m()[0],
        }
    }

    /// Largest shoreward displacement of a row from its rest position [m].
    pub fn shoreward_reach_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.shoreward_reach_m(),
            Self::Paddle(paddle) => paddle.reach_m()[1],
        }
    }
}
