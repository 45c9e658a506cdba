//! Wavemakers: rows of boundary particles that move at the seaward end of the particle domain.
//!
//! To add a kind of wavemaker, add a variant of [`Wavemaker`] that gives the displacement and velocity of each row.

use crate::waves::{generation::absorption::Absorption, generation::ml_piston::MlPiston, generation::paddle::Paddle};

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
    pub fn rest_x_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.rest_x_m(),
            Self::Paddle(paddle) => paddle.rest_x_m(),
        }
    }

    /// Parameters of the active absorption; `None` without absorption.
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

    /// Position x [m] of the wavemaker near the surface at flume time t [s]: at still water level for a paddle, of the
    /// highest row for a multi-layer piston.
    pub fn x_at_surface_m(&self, t: f64) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.rest_x_m() + piston.displacement_m(piston.row_heights_m().len() - 1, t),
            Self::Paddle(paddle) => paddle.rest_x_m() + paddle.motion_m(t),
        }
    }

    /// Position x [m] of the row that is furthest shoreward at flume time t [s].
    pub fn foremost_row_x_m(&self, t: f64) -> f64 {
        let furthest = self.rows_at(t).iter().map(|row| row[0]).fold(f64::MIN, f64::max);
        self.rest_x_m() + furthest
    }

    /// Largest seaward displacement of a row from its rest position [m].
    pub fn max_seaward_displacement_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.max_seaward_displacement_m(),
            Self::Paddle(paddle) => paddle.displacement_bounds_m()[0],
        }
    }

    /// Largest shoreward displacement of a row from its rest position [m].
    pub fn max_shoreward_displacement_m(&self) -> f64 {
        match self {
            Self::MlPiston(piston) => piston.max_shoreward_displacement_m(),
            Self::Paddle(paddle) => paddle.displacement_bounds_m()[1],
        }
    }
}
