//! Non-hydrostatic pressure: Keller box in the vertical (Stelling & Zijlema 2003; Zijlema & Stelling 2005).
//!
//! The unknown q_m is the pressure, divided by the density, at the bottom of layer m. q is linear within a layer and
//! zero at the surface. With the layer depth h_m, the accelerations are
//!
//! ```text
//! du_m/dt = - [dx q_bar_m - (q_{m+1} - q_m) dx z_m / h_m],   dw_m/dt = - (q_{m+1} - q_m) / h_m
//! ```
//!
//! with the middle z_m of layer m and the mean q_bar_m of q over its bottom and top. The discrete continuity equation
//! is the exact transpose of this force. At the interface between layers m-1 and m it is
//!
//! ```text
//! w_m - w_{m-1} + [dx(h u)_{m-1} + dx(h u)_m] / 2 + u_{m-1} dx z_{m-1} - u_m dx z_m = 0
//! ```
//!
//! and at the bed w_0 + dx(h u)_0 / 2 - u_0 dx z_0 = 0. Therefore the pressure does no work on the water, the system is
//! symmetric and positive definite, and corners of the bed need no special treatment.

use super::LayeredFlume;

/// Weights of q in the derivative dx q for one layer at a face [1/m]: for [bottom, top] of the layer in the left and in
/// the right cell.
#[derive(Debug, Clone, Copy)]
struct Gradient {
    left: [f64; 2],
    right: [f64; 2],
}

impl Gradient {
    /// Computes the weights of dx q at constant z from the cell spacing dx [m], the slope dx z of the middle of the
    /// layer [-] and the layer depth h [m].
    fn new(spacing: f64, slope: f64, layer_depth: f64) -> Self {
        let (a, e) = (0.5 / spacing, 0.5 * slope / layer_depth);
        Self { left: [-a + e, -a - e], right: [a + e, a - e] }
    }
}

impl LayeredFlume {
    /// Corrects the provisional u and w so that they satisfy continuity.
    pub(super) fn correct_with_pressure(&mut self) {
        self.assemble();
        self.system.solve();
        self.apply_pressure();
        self.follow_where_hydrostatic();
    }

    /// Depth of one layer at a face [m].
    fn layer_depth_at(&self, face: usize) -> f64 {
        self.mean_depth[face] / self.layers as f64
    }

    /// Slope of the middle of layer m at an inner face [-].
    fn slope_at(&self, face: usize, m: usize) -> f64 {
        let share = (m as f64 + 0.5) / self.layers as f64;
        let middle = |cell: usize| self.grid.bed[cell] + share * self.depth[cell];
        (middle(face) - middle(face - 1)) / self.grid.spacing(face)
    }

    /// Weights of q for layer m at a face; an end face uses the slope of the nearest inner face.
    fn gradient_at(&self, face: usize, m: usize) -> Gradient {
        let last = self.grid.cells();
        let slope = self.slope_at(face.clamp(1, last - 1), m);
        Gradient::new(self.grid.spacing(face), slope, self.layer_depth_at(face))
    }

    /// Assembles the system A (q dt) = C(u*, w*). C is the continuity error of the provisional velocities u* and w*.
    fn assemble(&mut self) {
        let (k, cells) = (self.layers, self.grid.cells());
        self.system.clear();
        for face in 0..=cells {
            if self.mean_depth[face] > 0.0 && (self.open[face] || face == 0 || face == cells) {
                (0..k).for_each(|m| self.assemble_face(face, m));
            }
        }
        for cell in 0..cells {
            if self.active[cell] {
                (0..k).for_each(|m| self.assemble_cell(cell, m));
            } else {
                (0..k).for_each(|m| self.system.add_diagonal(cell, m, m, 1.0));
            }
        }
    }

    /// Adds the contributions of u_m at a face to the system, weighted with the volume h dx of the layer at the face.
    fn assemble_face(&mut self, face: usize, m: usize) {
        let (k, cells) = (self.layers, self.grid.cells());
        let gradient = self.gradient_at(face, m);
        let mass = self.layer_depth_at(face) * self.grid.spacing(face);
        let u = self.u[face * k + m];
        let left = face.checked_sub(1).filter(|&c| self.active[c]);
        let right = Some(face).filter(|&c| c < cells && self.active[c]);
        let interfaces = [m, m + 1];
        let is_inner = face > 0 && face < cells;
        for (cell, own) in [(left, gradient.left), (right, gradient.right)] {
            let Some(cell) = cell else { continue };
            for (a, &row) in interfaces.iter().enumerate().filter(|(_, row)| **row < k) {
                self.system.add_right(cell, row, mass * own[a] * u);
                for (b, &column) in interfaces.iter().enumerate().filter(|(_, c)| is_inner && **c < k) {
                    self.system.add_diagonal(cell, row, column, mass * own[a] * own[b]);
                }
            }
        }
        if let (Some(left), Some(_), true) = (left, right, is_inner) {
            for (a, &row) in interfaces.iter().enumerate().filter(|(_, row)| **row < k) {
                for (b, &column) in interfaces.iter().enumerate().filter(|(_, c)| **c < k) {
                    self.system.add_upper(left, row, column, mass * gradient.left[a] * gradient.right[b]);
                }
            }
        }
    }

    /// Adds the contributions of w_m in a cell to the system.
    fn assemble_cell(&mut self, cell: usize, m: usize) {
        let k = self.layers;
        let width = self.grid.width[cell];
        let stiffness = width * k as f64 / self.depth[cell];
        let w = self.w[cell * k + m];
        self.system.add_diagonal(cell, m, m, stiffness);
        self.system.add_right(cell, m, -width * w);
        if m + 1 < k {
            self.system.add_diagonal(cell, m + 1, m + 1, stiffness);
            self.system.add_diagonal(cell, m, m + 1, -stiffness);
            self.system.add_diagonal(cell, m + 1, m, -stiffness);
            self.system.add_right(cell, m + 1, width * w);
        }
    }

    /// Applies the pressure impulse q dt to u and w.
    fn apply_pressure(&mut self) {
        let (k, cells) = (self.layers, self.grid.cells());
        for face in 1..cells {
            if !self.open[face] || !(self.active[face - 1] || self.active[face]) {
                continue;
            }
            for m in 0..k {
                let g = self.gradient_at(face, m);
                let (left, right) = (self.impulse(face - 1, m), self.impulse(face, m));
                let change = g.left[0] * left[0] + g.left[1] * left[1] + g.right[0] * right[0] + g.right[1] * right[1];
                self.u[face * k + m] -= change;
            }
        }
        for cell in 0..cells {
            if !self.active[cell] {
                continue;
            }
            for m in 0..k {
                let [bottom, top] = self.impulse(cell, m);
                self.w[cell * k + m] -= (top - bottom) * k as f64 / self.depth[cell];
            }
        }
    }

    /// Pressure impulse q dt at the bottom and the top of layer m of a cell [m2/s].
    fn impulse(&self, cell: usize, m: usize) -> [f64; 2] {
        let k = self.layers;
        let q = self.system.unknowns();
        [q[cell * k + m], if m + 1 < k { q[cell * k + m + 1] } else { 0.0 }]
    }

    /// Sets w from continuity in the hydrostatic cells.
    pub(super) fn follow_where_hydrostatic(&mut self) {
        for cell in 0..self.grid.cells() {
            if !self.active[cell] {
                self.follow(cell);
            }
        }
    }

    /// Sets w of all layers of a cell from continuity, from the bed upwards.
    pub(super) fn follow(&mut self, cell: usize) {
        let k = self.layers;
        if self.depth[cell] < super::DRY_DEPTH_M {
            self.w[cell * k..(cell + 1) * k].fill(0.0);
            return;
        }
        let mut below = [0.0; 2];
        let mut w = 0.0;
        for m in 0..k {
            let [outflow, climb] = self.outflow_and_climb(cell, m);
            w += climb - below[1] - 0.5 * (outflow + below[0]);
            below = [outflow, climb];
            self.w[cell * k + m] = w;
        }
    }

    /// Returns dx(h u)_m, and the mean of u_m dx z_m over both faces of a cell [m/s].
    fn outflow_and_climb(&self, cell: usize, m: usize) -> [f64; 2] {
        let (k, last) = (self.layers, self.grid.cells());
        let flux = |face: usize| self.layer_depth_at(face) * self.u[face * k + m];
        let climb = |face: usize| self.u[face * k + m] * self.slope_at(face.clamp(1, last - 1), m);
        [(flux(cell + 1) - flux(cell)) / self.grid.width[cell], 0.5 * (climb(cell) + climb(cell + 1))]
    }
}
