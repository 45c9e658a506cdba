//! Continuity of the water column, wetting and drying, wave breaking.
//!
//! * Depth at a face: in calm deep water, it is the mean depth of both cells. In shallow, fast or breaking flow, it is
//!   the upwind surface level (Stelling & Duinmeijer 2003) minus the higher bed level of both sides, reconstructed with
//!   limited slopes.
//! * Breaking: where the surface rises faster than 0.6 sqrt(g H) in the depth H, a front becomes hydrostatic. It stays
//!   hydrostatic while it rises faster than 0.3 sqrt(g H) (Smit, Zijlema & Stelling 2013). The front steepens into a
//!   bore, in which the momentum-conservative scheme dissipates energy.

use super::{Breaking, DRY_DEPTH_M, LayeredFlume, Pressure};

/// Depth below which water is hydrostatic, relative to the largest still water depth [-]. Waves in such films are
/// not dispersive.
const HYDROSTATIC_SHARE: f64 = 2.5e-3;
/// Froude numbers between which the face depth changes from the mean to the upwind depth.
const FROUDE_RANGE: [f64; 2] = [0.7, 1.0];

/// Surface and bed level on one side of a face.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// Surface level z [m].
    level: f64,
    /// Bed level z [m].
    bed: f64,
}

/// Returns the depth below which water is hydrostatic [m], from the still water depths of all cells [m].
pub(super) fn hydrostatic_below_m(still_depths: &[f64]) -> f64 {
    HYDROSTATIC_SHARE * still_depths.iter().copied().fold(DRY_DEPTH_M / HYDROSTATIC_SHARE, f64::max)
}

impl LayeredFlume {
    /// Marks the breaking cells, the cells with non-hydrostatic pressure, and the cells with third-order advection.
    pub(super) fn classify_cells(&mut self) {
        let cells = self.grid.cells();
        let before = std::mem::take(&mut self.breaking);
        self.breaking = (0..cells).map(|cell| self.is_breaking(cell, &before)).collect();
        for cell in 0..cells {
            let is_deep = self.depth[cell] > self.hydrostatic_below_m;
            self.active[cell] = is_deep && !self.breaking[cell] && self.pressure == Pressure::NonHydrostatic;
        }
        for cell in 0..cells {
            let around = cell.saturating_sub(1)..(cell + 2).min(cells);
            let is_calm = around.clone().all(|c| !self.breaking[c]);
            self.smooth[cell] = is_calm && around.skip(1).all(|face| self.deep_share(face) >= 1.0);
        }
    }

    /// Returns true if a cell breaks, from its rate of rise and the cells that broke in the previous time step.
    fn is_breaking(&self, cell: usize, before: &[bool]) -> bool {
        let Breaking::HydrostaticFront { onset, persistence } = self.breaking_law else { return false };
        if self.depth[cell] < self.hydrostatic_below_m {
            return false;
        }
        let steepness = self.rise_m_s[cell] / (self.gravity * self.depth[cell]).sqrt();
        let broke_nearby = before[cell.saturating_sub(1)..(cell + 2).min(before.len())].contains(&true);
        steepness > onset || (broke_nearby && steepness > persistence)
    }

    /// Weight of the deep-water form of the face depth (see the top of the file) [-]: 1 if the water is deep compared
    /// with the difference of the bed levels of the two cells at the face, 0 if the water is shallow.
    fn deep_share(&self, face: usize) -> f64 {
        let step = 2.0 * (self.grid.bed[face] - self.grid.bed[face - 1]).abs() + self.hydrostatic_below_m;
        (self.depth[face - 1].min(self.depth[face]) / step - 1.0).clamp(0.0, 1.0)
    }

    /// Depth of the water that crosses a face with the velocity `u` [m]; `depth` is the list of cell depths [m].
    pub(super) fn transport_depth(&self, face: usize, depth: &[f64], u: f64) -> f64 {
        let (left, right) = (face - 1, face);
        let bed = &self.grid.bed;
        let mean_depth = 0.5 * (depth[left] + depth[right]);
        let central = self.central_share(face, u.abs() / (self.gravity * mean_depth.max(DRY_DEPTH_M)).sqrt());
        if central >= 1.0 {
            return mean_depth;
        }
        let deep = self.deep_share(face);
        let sides = [self.reconstruct(left, 1.0, depth), self.reconstruct(right, -1.0, depth)];
        let upwind = match u {
            u if u > 0.0 => sides[0].level,
            u if u < 0.0 => sides[1].level,
            _ => (bed[left] + depth[left]).max(bed[right] + depth[right]),
        };
        let sill = deep * 0.5 * (bed[left] + bed[right]) + (1.0 - deep) * sides[0].bed.max(sides[1].bed);
        let surface = central * (0.5 * (bed[left] + bed[right]) + mean_depth) + (1.0 - central) * upwind;
        (surface - sill).max(0.0)
    }

    /// Weight of the mean depth of both cells in the depth at a face [-]; the upwind level has the remaining weight.
    fn central_share(&self, face: usize, froude: f64) -> f64 {
        if self.breaking[face - 1] || self.breaking[face] {
            return 0.0;
        }
        let subcritical = ((FROUDE_RANGE[1] - froude) / (FROUDE_RANGE[1] - FROUDE_RANGE[0])).clamp(0.0, 1.0);
        self.deep_share(face) * subcritical
    }

    /// Reconstructs surface and bed level of a cell at its right (`sign` = 1) or left (-1) face, with limited slopes of
    /// level and depth (Audusse et al. 2004, section 4). On a plane bed, the cells on both sides give the same bed
    /// level at the face. At the ends and next to dry cells, the values of the cell itself are used.
    fn reconstruct(&self, cell: usize, sign: f64, depth: &[f64]) -> Side {
        let level = |cell: usize| self.grid.bed[cell] + depth[cell];
        let is_inner = cell > 0 && cell + 1 < depth.len();
        if !is_inner || depth[cell - 1..cell + 2].iter().any(|h| *h <= DRY_DEPTH_M) {
            return Side { level: level(cell), bed: self.grid.bed[cell] };
        }
        let to_face = |before: f64, here: f64, after: f64| here + 0.5 * sign * van_leer(here - before, after - here);
        let at_face = to_face(level(cell - 1), level(cell), level(cell + 1));
        Side { level: at_face, bed: at_face - to_face(depth[cell - 1], depth[cell], depth[cell + 1]) }
    }

    /// Depth-mean velocity at a face [m/s].
    pub(super) fn mean_velocity(&self, face: usize) -> f64 {
        self.u[face * self.layers..(face + 1) * self.layers].iter().sum::<f64>() / self.layers as f64
    }

    /// Computes the volume fluxes through the faces, relative to the moving faces [m2/s]. The fluxes follow from the
    /// depths at half the time step, which a predictor computes. No cell loses more water than it contains.
    pub(super) fn volume_fluxes(&mut self, dt: f64) {
        self.next_depth.copy_from_slice(&self.depth);
        self.compute_total_fluxes();
        for cell in 0..self.grid.cells() {
            self.next_depth[cell] = self.depth_after(cell, 0.5 * dt);
        }
        self.compute_total_fluxes();
        self.limit_outflow(dt);
        let k = self.layers;
        for face in 0..=self.grid.cells() {
            let face_velocity = self.grid.face_velocity[face];
            let mean = self.mean_velocity(face) - face_velocity;
            let depth = if mean == 0.0 { self.mean_depth[face] } else { self.total_flux[face] / mean };
            for m in 0..k {
                self.flux[face * k + m] = depth / k as f64 * (self.u[face * k + m] - face_velocity);
            }
        }
    }

    /// Computes the total flux through each face, h_f (U - v), with the face velocity v and the depths in `next_depth`.
    fn compute_total_fluxes(&mut self) {
        for face in 1..self.grid.cells() {
            let u = self.mean_velocity(face);
            let h = if self.open[face] { self.transport_depth(face, &self.next_depth, u) } else { 0.0 };
            self.total_flux[face] = h * (u - self.grid.face_velocity[face]);
        }
        for face in [0, self.grid.cells()] {
            if self.is_open_end(face) {
                self.total_flux[face] = self.end_depth(face, &self.next_depth) * self.mean_velocity(face);
            }
        }
    }

    /// Depth of a cell after `dt` with the current fluxes and face velocities [m].
    fn depth_after(&self, cell: usize, dt: f64) -> f64 {
        let outflow = self.total_flux[cell + 1] - self.total_flux[cell];
        let growth = self.grid.face_velocity[cell + 1] - self.grid.face_velocity[cell];
        let width = self.grid.width[cell];
        ((self.depth[cell] * width - dt * outflow) / (width + dt * growth)).max(0.0)
    }

    /// Limits the outflow of each cell to its volume, so that depths stay non-negative and volume is conserved.
    fn limit_outflow(&mut self, dt: f64) {
        let cells = self.grid.cells();
        let share: Vec<f64> = (0..cells)
            .map(|cell| {
                let out = self.total_flux[cell + 1].max(0.0) - self.total_flux[cell].min(0.0);
                let held = self.depth[cell] * self.grid.width[cell];
                if out * dt > held { held / (out * dt) } else { 1.0 }
            })
            .collect();
        for face in 0..=cells {
            let upwind = if self.total_flux[face] > 0.0 { face.checked_sub(1) } else { Some(face) };
            // Inflow through an end has no upwind cell.
            if let Some(share) = upwind.and_then(|cell| share.get(cell)) {
                self.total_flux[face] *= share;
            }
        }
    }

    /// Limits the velocities in shallow water, which the grid does not resolve. Films get a uniform velocity over their
    /// depth. Shallow water crosses at most one cell per time step, dt |u| / dx <= 1.
    pub(super) fn limit_film_velocities(&mut self) {
        let k = self.layers;
        for face in (1..self.grid.cells()).filter(|&face| self.open[face]) {
            if self.mean_depth[face] < self.hydrostatic_below_m {
                let mean = self.mean_velocity(face);
                self.u[face * k..(face + 1) * k].fill(mean);
            }
            if self.deep_share(face) < 1.0 {
                let limit = self.grid.spacing(face) / self.step_s;
                self.u[face * k..(face + 1) * k].iter_mut().for_each(|u| *u = u.clamp(-limit, limit));
            }
        }
    }

    /// Updates the depths and the rate of rise of the surface [m/s].
    pub(super) fn update_depths(&mut self, dt: f64) {
        for cell in 0..self.grid.cells() {
            self.next_depth[cell] = self.depth_after(cell, dt);
            self.rise_m_s[cell] = (self.next_depth[cell] - self.depth[cell]) / dt;
        }
        std::mem::swap(&mut self.depth, &mut self.next_depth);
    }

    /// Marks the faces through which water can flow, and computes the depth at each face: the mean depth of its two
    /// cells, 0 at a dry face, an extrapolated depth at the ends.
    pub(super) fn measure_faces(&mut self) {
        let cells = self.grid.cells();
        for face in 1..cells {
            let u = self.mean_velocity(face);
            self.open[face] = self.transport_depth(face, &self.depth, u) > DRY_DEPTH_M
                || (u == 0.0 && self.transport_depth(face, &self.depth, 0.0) > DRY_DEPTH_M);
            self.mean_depth[face] = if self.open[face] { 0.5 * (self.depth[face - 1] + self.depth[face]) } else { 0.0 };
        }
        for face in [0, cells] {
            self.mean_depth[face] = self.end_depth(face, &self.depth);
        }
    }
}

/// Van Leer's (1974) limiter: the harmonic mean of two differences, 0 at an extremum to prevent overshoot.
pub(super) fn van_leer(a: f64, b: f64) -> f64 {
    if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 }
}
