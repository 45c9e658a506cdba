//! Axes of an OpenFOAM run relative to the axes of the breakwater case.

/// Vertical axis of an OpenFOAM run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// y, as in most flumes that are one cell wide.
    Y,
    /// z.
    Z,
}

/// Axes of an OpenFOAM run: its x is the x of the breakwater case; its y or z points upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Vertical axis.
    pub up: Up,
    /// Level z of the origin of the OpenFOAM axes, in the breakwater case [m].
    pub origin_z_m: f64,
}

impl Frame {
    /// Level z, in the breakwater case, of an OpenFOAM point [m].
    pub(super) fn z(&self, point: [f64; 3]) -> f64 {
        self.origin_z_m
            + match self.up {
                Up::Y => point[1],
                Up::Z => point[2],
            }
    }

    /// OpenFOAM point at x and level z of the breakwater case [m], on the centreline of the flume.
    pub(super) fn point(&self, x: f64, z: f64) -> [f64; 3] {
        match self.up {
            Up::Y => [x, z - self.origin_z_m, 0.0],
            Up::Z => [x, 0.0, z - self.origin_z_m],
        }
    }

    /// Horizontal coordinates of an OpenFOAM point [m].
    pub(super) fn place(&self, point: [f64; 3]) -> [f64; 2] {
        match self.up {
            Up::Y => [point[0], point[2]],
            Up::Z => [point[0], point[1]],
        }
    }
}
