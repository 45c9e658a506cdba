//! How OpenFOAM's axes stand in the case.

/// The axis of OpenFOAM that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// y, as in most flumes of one cell's width.
    Y,
    /// z.
    Z,
}

/// OpenFOAM's axes: x is that of the case, another points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The axis that points up.
    pub up: Up,
    /// Level z of OpenFOAM's origin [m].
    pub origin_z_m: f64,
}

impl Frame {
    /// Level z [m] of a point.
    pub(super) fn z(&self, point: [f64; 3]) -> f64 {
        self.origin_z_m
            + match self.up {
                Up::Y => point[1],
                Up::Z => point[2],
            }
    }

    /// The point at x and level z [m], in the middle of the flume.
    pub(super) fn point(&self, x: f64, z: f64) -> [f64; 3] {
        match self.up {
            Up::Y => [x, z - self.origin_z_m, 0.0],
            Up::Z => [x, 0.0, z - self.origin_z_m],
        }
    }

    /// The two coordinates of a point that do not tell its level.
    pub(super) fn place(&self, point: [f64; 3]) -> [f64; 2] {
        match self.up {
            Up::Y => [point[0], point[2]],
            Up::Z => [point[0], point[1]],
        }
    }
}
