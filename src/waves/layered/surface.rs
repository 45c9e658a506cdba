//! Continuity of the water column, wetting and drying, breaking.
//!
//! * Depth at a face: mean of both sides (second order) in calm deep water, the upwind side where the flow is shallow,
//!   fast or broken (Stelling & Duinmeijer 2003).
//! * Breaking: the front turns hydrostatic where it rises faster than 0.6 sqrt(g H) and stays so above 0.3 (Smit, Zijlema
//!   & Stelling 2013), which lets it steepen into a bore that the momentum-conservative scheme dissipates.

use super::{LayeredFlume, THIN_M};

/// Rate of rise over sqrt(g H) at which a front begins to break (Smit et al. 2013).
const BREAKING_STARTS: f64 = 0.6;
/// The same at which it still breaks, next to a cell that does.
const BREAKING_LASTS: f64 = 0.3;
/// Water shallower than this is hydrostatic [m]: a film has no dispersion to resolve.
const HYDROSTATIC_BELOW_M: f64 = 2e-3;
/// Froude numbers between which the face depth goes over from the mean to the upwind side.
const FROUDE_RANGE: [f64; 2] = [0.7, 1.0];

impl LayeredFlume {
    /// Find the cells that break, those where pressure is solved for, and those where third order is safe.
    pub(super) fn classify_cells(&mut self) {
        let cells = self.grid.cells();
        let before = std::mem::take(&mut self.breaking);
        self.breaking = (0..cells).map(|cell| self.breaks(cell, &before)).collect();
        for cell in 0..cells {
            self.active[cell] = self.depth[cell] > HYDROSTATIC_BELOW_M && !self.breaking[cell];
        }
        for cell in 0..cells {
            let around = cell.saturating_sub(1)..(cell + 2).min(cells);
            let calm = around.clone().all(|c| !self.breaking[c]);
            self.smooth[cell] = calm && around.skip(1).all(|face| self.deep_share(face) >= 1.0);
        }
    }

    /// Whether a cell breaks, from its rate of rise and from who broke before.
    fn breaks(&self, cell: usize, before: &[bool]) -> bool {
        if self.depth[cell] < HYDROSTATIC_BELOW_M {
            return false;
        }
        let steepness = self.rise_m_s[cell] / (self.gravity * self.depth[cell]).sqrt();
        let near = before[cell.saturating_sub(1)..(cell + 2).min(before.len())].contains(&true);
        steepness > BREAKING_STARTS || (near && steepness > BREAKING_LASTS)
    }

    /// 1 where the water at a face between cells is deep compared with the step of the bed, 0 where it is shallow [-].
    fn deep_share(&self, face: usize) -> f64 {
        let step = 2.0 * (self.grid.bed[face] - self.grid.bed[face - 1]).abs() + HYDROSTATIC_BELOW_M;
        (self.depth[face - 1].min(self.depth[face]) / step - 1.0).clamp(0.0, 1.0)
    }

    /// Depth of the water that crosses a face with velocity `u` [m], `depth` the depths of the cells.
    pub(super) fn transport_depth(&self, face: usize, depth: &[f64], u: f64) -> f64 {
        let (left, right) = (face - 1, face);
        let bed = [self.grid.bed[left], self.grid.bed[right]];
        let level = [bed[0] + depth[left], bed[1] + depth[right]];
        let deep = self.deep_share(face);
        let mean_depth = 0.5 * (depth[left] + depth[right]);
        let froude = u.abs() / (self.gravity * mean_depth.max(THIN_M)).sqrt();
        let calm = ((FROUDE_RANGE[1] - froude) / (FROUDE_RANGE[1] - FROUDE_RANGE[0])).clamp(0.0, 1.0);
        let unbroken = !(self.breaking[left] || self.breaking[right]);
        let central = if unbroken { deep * calm } else { 0.0 };
        let upwind = match u {
            u if u > 0.0 => level[0],
            u if u < 0.0 => level[1],
            _ => level[0].max(level[1]),
        };
        let sill = deep * 0.5 * (bed[0] + bed[1]) + (1.0 - deep) * bed[0].max(bed[1]);
        let surface = central * 0.5 * (level[0] + level[1]) + (1.0 - central) * upwind;
        (surface - sill).max(0.0)
    }

    /// Mean velocity over the depth at a face [m/s].
    pub(super) fn mean_velocity(&self, face: usize) -> f64 {
        self.u[face * self.layers..(face + 1) * self.layers].iter().sum::<f64>() / self.layers as f64
    }

    /// Volume fluxes through the faces over the step, relative to the moving faces [m2/s]: first with the depths at
    /// the start, then with those at half the step, and no more than a cell holds.
    pub(super) fn volume_fluxes(&mut self, dt: f64) {
        self.next_depth.copy_from_slice(&self.depth);
        self.total_fluxes();
        for cell in 0..self.grid.cells() {
            self.next_depth[cell] = self.depth_after(cell, 0.5 * dt);
        }
        self.total_fluxes();
        self.limit_outflow(dt);
        let k = self.layers;
        for face in 1..self.grid.cells() {
            let moving = self.grid.face_velocity[face];
            let mean = self.mean_velocity(face) - moving;
            let depth = if mean == 0.0 { self.mean_depth[face] } else { self.total_flux[face] / mean };
            for m in 0..k {
                self.flux[face * k + m] = depth / k as f64 * (self.u[face * k + m] - moving);
            }
        }
    }

    /// Total flux through each face, h_f (U - v), with the depths in `next_depth`.
    fn total_fluxes(&mut self) {
        for face in 1..self.grid.cells() {
            let u = self.mean_velocity(face);
            let h = if self.open[face] { self.transport_depth(face, &self.next_depth, u) } else { 0.0 };
            self.total_flux[face] = h * (u - self.grid.face_velocity[face]);
        }
    }

    /// Depth of a cell after a time at the present fluxes, its faces moving with theirs [m].
    fn depth_after(&self, cell: usize, dt: f64) -> f64 {
        let outflow = self.total_flux[cell + 1] - self.total_flux[cell];
        let growth = self.grid.face_velocity[cell + 1] - self.grid.face_velocity[cell];
        let width = self.grid.width[cell];
        ((self.depth[cell] * width - dt * outflow) / (width + dt * growth)).max(0.0)
    }

    /// Scale the fluxes out of a cell down to what it holds, so that no depth turns negative and no water is made.
    fn limit_outflow(&mut self, dt: f64) {
        let cells = self.grid.cells();
        let share: Vec<f64> = (0..cells)
            .map(|cell| {
                let out = self.total_flux[cell + 1].max(0.0) - self.total_flux[cell].min(0.0);
                let held = self.depth[cell] * self.grid.width[cell];
                if out * dt > held { held / (out * dt) } else { 1.0 }
            })
            .collect();
        for face in 1..cells {
            let from = if self.total_flux[face] > 0.0 { face - 1 } else { face };
            self.total_flux[face] *= share[from];
        }
    }

    /// New depths, and the rate at which the surface rose [m/s].
    pub(super) fn update_depths(&mut self, dt: f64) {
        for cell in 0..self.grid.cells() {
            self.next_depth[cell] = self.depth_after(cell, dt);
            self.rise_m_s[cell] = (self.next_depth[cell] - self.depth[cell]) / dt;
        }
        std::mem::swap(&mut self.depth, &mut self.next_depth);
    }

    /// Mean depth of the two cells at each face, zero where a face lies dry; extrapolated to the piston.
    pub(super) fn measure_faces(&mut self) {
        let cells = self.grid.cells();
        for face in 1..cells {
            let u = self.mean_velocity(face);
            self.open[face] = self.transport_depth(face, &self.depth, u) > THIN_M
                || (u == 0.0 && self.transport_depth(face, &self.depth, 0.0) > THIN_M);
            self.mean_depth[face] = if self.open[face] { 0.5 * (self.depth[face - 1] + self.depth[face]) } else { 0.0 };
        }
        self.mean_depth[0] = (1.5 * self.depth[0] - 0.5 * self.depth[1]).max(0.0);
        self.mean_depth[cells] = (1.5 * self.depth[cells - 1] - 0.5 * self.depth[cells - 2]).max(0.0);
    }
}
