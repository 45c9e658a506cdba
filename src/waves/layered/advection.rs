//! Advection of u and w: conservative in momentum (Stelling & Duinmeijer 2003, section 3), third-order upwind
//! interpolation (Leonard 1979) where the water is deep and unbroken, elsewhere limited second order (van Leer 1974),
//! first order next to dry ground.

use super::LayeredFlume;
use super::surface::van_leer;

impl LayeredFlume {
    /// Volume flux upwards through the interface below each layer, relative to the layers, per cell [m2/s]:
    /// omega_{m+1} = omega_m + sum(dQ) / K - dQ_m.
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

    /// Flux upwards through the top of layer m of a cell [m2/s]; nothing crosses the surface.
    fn exchange_above(&self, cell: usize, m: usize) -> f64 {
        if m + 1 < self.layers { self.exchange[cell * self.layers + m + 1] } else { 0.0 }
    }

    /// Advective term of u_m at a face between cells [m/s2]:
    /// [F (u_c - u)]_right - [F (u_c - u)]_left over h dx, F the flux through the cell's centre, plus the exchange.
    pub(super) fn advection_of_u(&self, face: usize, m: usize) -> f64 {
        let (k, left, right) = (self.layers, face - 1, face);
        let u = self.u[face * k + m];
        let through = |cell: usize| {
            let flux = 0.5 * (self.flux[cell * k + m] + self.flux[(cell + 1) * k + m]);
            flux * (self.u_at_centre(cell, m, flux) - u)
        };
        let vertical = exchanged(
            0.5 * (self.exchange[left * k + m] + self.exchange[right * k + m]),
            0.5 * (self.exchange_above(left, m) + self.exchange_above(right, m)),
            &self.u[face * k..(face + 1) * k],
            m,
        );
        let layer_depth = 0.5 * (self.depth[left] + self.depth[right]) / k as f64;
        (through(right) - through(left) + vertical) / (layer_depth * self.grid.spacing(face))
    }

    /// u_m carried through a cell's centre [m/s].
    fn u_at_centre(&self, cell: usize, m: usize, flux: f64) -> f64 {
        let (k, last) = (self.layers, self.grid.cells());
        let at = |face: usize| self.u[face * k + m];
        let (up, down) = if flux >= 0.0 { (cell, cell + 1) } else { (cell + 1, cell) };
        let far = if flux >= 0.0 { up.checked_sub(1) } else { Some(up + 1).filter(|&f| f <= last) };
        if !self.smooth[cell] {
            let far = far.filter(|&far| self.open[far] && self.open[up] && self.open[down]);
            return at(up) + far.map_or(0.0, |far| 0.5 * van_leer(at(up) - at(far), at(down) - at(up)));
        }
        far.map_or(0.5 * (at(up) + at(down)), |far| quick(at(far), at(up), at(down)))
    }

    /// Advective term of w_m in a cell [m/s2].
    pub(super) fn advection_of_w(&self, cell: usize, m: usize) -> f64 {
        let k = self.layers;
        let w = self.w[cell * k + m];
        let through = |face: usize| {
            let flux = self.flux[face * k + m];
            // What passes an end has the w of the cell there.
            let inner = face > 0 && face < self.grid.cells();
            if flux == 0.0 || !inner { 0.0 } else { flux * (self.w_at_face(face, m, flux) - w) }
        };
        let vertical =
            exchanged(self.exchange[cell * k + m], self.exchange_above(cell, m), &self.w[cell * k..(cell + 1) * k], m);
        let layer_depth = self.depth[cell] / k as f64;
        (through(cell + 1) - through(cell) + vertical) / (layer_depth * self.grid.width[cell])
    }

    /// w_m carried through a face between cells [m/s].
    fn w_at_face(&self, face: usize, m: usize, flux: f64) -> f64 {
        let (k, cells) = (self.layers, self.grid.cells());
        let at = |cell: usize| self.w[cell * k + m];
        let (up, down) = if flux >= 0.0 { (face - 1, face) } else { (face, face - 1) };
        let far = if flux >= 0.0 { up.checked_sub(1) } else { Some(up + 1).filter(|&c| c < cells) };
        if !(self.smooth[up] && self.smooth[down]) {
            let far = far.filter(|&far| self.active[far] && self.active[up] && self.active[down]);
            return at(up) + far.map_or(0.0, |far| 0.5 * van_leer(at(up) - at(far), at(down) - at(up)));
        }
        far.map_or(0.5 * (at(up) + at(down)), |far| quick(at(far), at(up), at(down)))
    }
}

/// Leonard's quadratic upwind interpolation.
fn quick(far: f64, up: f64, down: f64) -> f64 {
    0.75 * up + 0.375 * down - 0.125 * far
}

/// What the exchange with the layers below and above brings to layer m: omega_above (v_above - v) - omega_below
/// (v_below - v), v at an interface the mean of both layers.
fn exchanged(below: f64, above: f64, layers: &[f64], m: usize) -> f64 {
    let jump = |other: usize| 0.5 * (layers[other] - layers[m]);
    let from_below = if m > 0 { below * jump(m - 1) } else { 0.0 };
    let from_above = if m + 1 < layers.len() { above * jump(m + 1) } else { 0.0 };
    from_above - from_below
}
