//! Momentum-conservative advection of u and w (Stelling & Duinmeijer 2003, section 3). Upwind interpolation is third
//! order in deep, unbroken water (Leonard 1979), elsewhere limited second order (van Leer 1974), and first order next
//! to dry cells.

use super::LayeredFlume;
use super::surface::van_leer;

impl LayeredFlume {
    /// Computes the upward volume flux through the interface below each layer, relative to the interface [m2/s]:
    /// omega_{m+1} = omega_m + sum(dQ) / K - dQ_m. omega_m is the flux below layer m, dQ_m the net outflow through both
    /// faces of layer m, and sum(dQ) the outflow from all K layers.
    pub(super) fn exchange_between_layers(&mut self) {
        let k = self.layers;
        for cell in 0..self.grid.cells() {
            let outflow = |m: usize| self.flux[(cell + 1) * k + m] - self.flux[cell * k + m];
            let mean = (0..k).map(outflow).sum::<f64>() / k as f64;
            let mut omega = 0.0;
            for m in 0..k {
                self.exchange[cell * k + m] = omega;
                omega += mean - outflow(m);
            }
        }
    }

    /// Upward volume flux through the top of layer m of a cell [m2/s]; zero at the surface.
    fn exchange_above(&self, cell: usize, m: usize) -> f64 {
        if m + 1 < self.layers { self.exchange[cell * self.layers + m + 1] } else { 0.0 }
    }

    /// Advection term of u_m at an inner face [m/s2]:
    /// ([F (u_c - u)]_right - [F (u_c - u)]_left + vertical exchange) / (h dx), where u is u_m at the face, h the layer
    /// depth and dx the cell spacing. F and u_c are volume flux and upwind value of u_m at the centre of each cell.
    pub(super) fn advection_of_u(&self, face: usize, m: usize) -> f64 {
        let (k, left, right) = (self.layers, face - 1, face);
        let u = self.u[face * k + m];
        let momentum_flux = |cell: usize| {
            let flux = 0.5 * (self.flux[cell * k + m] + self.flux[(cell + 1) * k + m]);
            flux * (self.u_at_centre(cell, m, flux) - u)
        };
        let vertical = exchange(
            0.5 * (self.exchange[left * k + m] + self.exchange[right * k + m]),
            0.5 * (self.exchange_above(left, m) + self.exchange_above(right, m)),
            &self.u[face * k..(face + 1) * k],
            m,
        );
        let layer_depth = 0.5 * (self.depth[left] + self.depth[right]) / k as f64;
        (momentum_flux(right) - momentum_flux(left) + vertical) / (layer_depth * self.grid.spacing(face))
    }

    /// Upwind value of u_m at a cell centre [m/s].
    fn u_at_centre(&self, cell: usize, m: usize, flux: f64) -> f64 {
        let (k, last) = (self.layers, self.grid.cells());
        let u = |face: usize| self.u[face * k + m];
        let (up, down) = if flux >= 0.0 { (cell, cell + 1) } else { (cell + 1, cell) };
        let far = if flux >= 0.0 { up.checked_sub(1) } else { Some(up + 1).filter(|&f| f <= last) };
        if !self.smooth[cell] {
            let far = far.filter(|&far| self.open[far] && self.open[up] && self.open[down]);
            return u(up) + far.map_or(0.0, |far| 0.5 * van_leer(u(up) - u(far), u(down) - u(up)));
        }
        far.map_or(0.5 * (u(up) + u(down)), |far| quick(u(far), u(up), u(down)))
    }

    /// Advection term of w_m in a cell [m/s2].
    pub(super) fn advection_of_w(&self, cell: usize, m: usize) -> f64 {
        let k = self.layers;
        let w = self.w[cell * k + m];
        let momentum_flux = |face: usize| {
            let flux = self.flux[face * k + m];
            // Water that flows through an end has the w of the end cell, so the term is zero.
            let is_inner = face > 0 && face < self.grid.cells();
            if flux == 0.0 || !is_inner { 0.0 } else { flux * (self.w_at_face(face, m, flux) - w) }
        };
        let vertical =
            exchange(self.exchange[cell * k + m], self.exchange_above(cell, m), &self.w[cell * k..(cell + 1) * k], m);
        let layer_depth = self.depth[cell] / k as f64;
        (momentum_flux(cell + 1) - momentum_flux(cell) + vertical) / (layer_depth * self.grid.width[cell])
    }

    /// Upwind value of w_m at an inner face [m/s].
    fn w_at_face(&self, face: usize, m: usize, flux: f64) -> f64 {
        let (k, cells) = (self.layers, self.grid.cells());
        let w = |cell: usize| self.w[cell * k + m];
        let (up, down) = if flux >= 0.0 { (face - 1, face) } else { (face, face - 1) };
        let far = if flux >= 0.0 { up.checked_sub(1) } else { Some(up + 1).filter(|&c| c < cells) };
        if !(self.smooth[up] && self.smooth[down]) {
            let far = far.filter(|&far| self.active[far] && self.active[up] && self.active[down]);
            return w(up) + far.map_or(0.0, |far| 0.5 * van_leer(w(up) - w(far), w(down) - w(up)));
        }
        far.map_or(0.5 * (w(up) + w(down)), |far| quick(w(far), w(up), w(down)))
    }
}

/// Leonard's (1979) quadratic upwind interpolation, QUICK.
fn quick(far: f64, up: f64, down: f64) -> f64 {
    0.75 * up + 0.375 * down - 0.125 * far
}

/// Vertical exchange term of the velocity v of layer m: omega_above (v_above - v) - omega_below (v_below - v). omega is
/// the upward volume flux through an interface; v_above and v_below are the means of the two layers at an interface.
fn exchange(below: f64, above: f64, layers: &[f64], m: usize) -> f64 {
    let jump = |other: usize| 0.5 * (layers[other] - layers[m]);
    let from_below = if m > 0 { below * jump(m - 1) } else { 0.0 };
    let from_above = if m + 1 < layers.len() { above * jump(m + 1) } else { 0.0 };
    from_above - from_below
}
