//! Axes of OpenFOAM relative to the case.

/// Vertical axis of OpenFOAM.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// y, as in most flumes that are one cell wide.
    Y,
    /// z.
    Z,
}

/// Axes of OpenFOAM: x is the x of the case; y or z points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Vertical axis.
    pub up: Up,
    /// Level z of OpenFOAM's origin in the case [m].
    pub origin_z_m: f64,
}

impl Frame {
    /// Level z of a point [m].
    pub(super) fn z(&self, point: [f64; 3]) -> f64 {
        self.origin_z_m
            + match self.up {
                Up::Y => point[1],
                Up::Z => point[2],
            }
    }

    /// Point at x and level z [m] on the centreline of the flume.
    pub(super) fn point(&self, x: f64, z: f64) -> [f64; 3] {
        match self.up {
            Up::Y => [x, z - self.origin_z_m, 0.0],
            Up::Z => [x, 0.0, z - self.origin_z_m],
        }
    }

    /// Horizontal coordinates of a point.
    pub(super) fn place(&self, point: [f64; 3]) -> [f64; 2] {
        match self.up {
            Up::Y => [point[0], point[2]],
            Up::Z => [point[0], point[1]],
        }
    }
}
