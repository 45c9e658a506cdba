//! Ends of the flume: wall, piston, wave inflow, radiating end and sponge.
//!
//! * Weakly reflecting inflow (Blayo & Debreu 2005; Zijlema et al. 2011, section 4.4): layer m has the velocity
//!   u_m = u_in(z_m) - sqrt(g / d) (eta - eta_in). u_in and eta_in are velocity and elevation of the incoming wave. The
//!   excess of the elevation eta leaves as a long wave in the still water depth d. Each harmonic of u_in is distributed
//!   over the layers as in a free wave of the model (`dispersion`), with its exact volume flux. With the exact profile,
//!   short waves would lose height at the inflow: 14 % with two layers at k d = 4.
//! * Radiating end: the incoming characteristic has its value in still water, so the depth-mean velocity is
//!   2 (sqrt(g H) - sqrt(g d)), with the depth H. Velocity differences between the layers are copied from the nearest
//!   inner face. This condition is exact for small long waves; higher or shorter waves are partly reflected.
//! * Sponge: du/dt = - sigma u in front of a wall. The damping rate sigma grows with the cube of the distance into the
//!   sponge (Israeli & Orszag 1981).

use super::{LayeredFlume, LayeredParameters, LeftEnd, RightEnd};
use crate::waves::flume_model::dispersion::layer_shares;
use crate::waves::theory::stream_function::cosh_ratio;

/// Integral of the damping rate over the length of the sponge, divided by the long-wave celerity [-]. A long wave that
/// the wall reflects leaves the sponge with exp(-6) = 0.25 % of its height.
const SPONGE_STRENGTH: f64 = 6.0;
/// Node of the two-point Gauss rule on [-1, 1], which is exact for a cubic velocity profile in a layer.
const GAUSS: f64 = 0.577_350_269_189_625_8;

impl LayeredFlume {
    /// Displacement of the piston at the end of the current time step [m].
    pub(super) fn next_paddle_m(&self) -> f64 {
        match &self.left_end {
            LeftEnd::Piston { wave, .. } => wave.piston_displacement_m(self.time_s + self.step_s),
            LeftEnd::Wall | LeftEnd::Inflow(_) => 0.0,
        }
    }

    /// Sets the velocities at the two end faces at n + 1/2.
    pub(super) fn set_end_velocities(&mut self) {
        let (k, cells) = (self.layers, self.grid.cells());
        for m in 0..k {
            self.u[m] = match self.left_end {
                LeftEnd::Wall | LeftEnd::Piston { .. } => self.grid.face_velocity[0],
                LeftEnd::Inflow(_) => self.inflow_velocity(m),
            };
        }
        if self.right_end == RightEnd::Radiating {
            let outflow = self.radiated_velocity();
            let inner = self.mean_velocity(cells - 1);
            for m in 0..k {
                self.u[cells * k + m] = outflow + self.u[(cells - 1) * k + m] - inner;
            }
        } else {
            self.u[cells * k..].fill(0.0);
        }
    }

    /// Velocity of layer m at the inflow at n + 1/2 [m/s]: mean velocity of the incoming wave over the layer, plus the
    /// velocity of the outgoing wave.
    fn inflow_velocity(&self, m: usize) -> f64 {
        let LeftEnd::Inflow(wave) = &self.left_end else { return 0.0 };
        let t = self.time_s + 0.5 * self.step_s;
        let still = self.still_level_m - self.bed_at_left();
        let (eta, incoming) = (self.left_elevation(), wave.elevation_m(t));
        let layer = (still + incoming) / self.layers as f64;
        let velocity = |node: f64| wave.velocity_m_s((m as f64 + 0.5 + 0.5 * node) * layer - still, t);
        let shapes = self.inflow_shapes.iter().skip(m).step_by(self.layers);
        let shift: f64 = wave.harmonics(t).zip(shapes).map(|([_, velocity], shape)| velocity * shape).sum();
        0.5 * (velocity(-GAUSS) + velocity(GAUSS)) + shift - (self.gravity / still).sqrt() * (eta - incoming)
    }

    /// Elevation above still water at the left end face at n + 1/2 [m].
    fn left_elevation(&self) -> f64 {
        let level = |cell: usize| self.grid.bed[cell] + self.depth[cell] + 0.5 * self.step_s * self.rise_m_s[cell];
        1.5 * level(0) - 0.5 * level(1) - self.still_level_m
    }

    fn bed_at_left(&self) -> f64 {
        1.5 * self.grid.bed[0] - 0.5 * self.grid.bed[1]
    }

    /// Depth-mean velocity at the radiating right end at n + 1/2 [m/s].
    fn radiated_velocity(&self) -> f64 {
        let cells = self.grid.cells();
        let extrapolate = |value: &dyn Fn(usize) -> f64| 1.5 * value(cells - 1) - 0.5 * value(cells - 2);
        let still = (self.still_level_m - extrapolate(&|cell| self.grid.bed[cell])).max(0.0);
        let depth = extrapolate(&|cell| self.depth[cell] + 0.5 * self.step_s * self.rise_m_s[cell]).max(0.0);
        2.0 * ((self.gravity * depth).sqrt() - (self.gravity * still).sqrt())
    }

    /// Returns true if a face is an end through which water can flow.
    pub(super) fn is_open_end(&self, face: usize) -> bool {
        if face == 0 {
            matches!(self.left_end, LeftEnd::Inflow(_))
        } else {
            face == self.grid.cells() && self.right_end == RightEnd::Radiating
        }
    }

    /// Depth at an end face, extrapolated from the cell depths [m].
    pub(super) fn end_depth(&self, face: usize, depth: &[f64]) -> f64 {
        let last = depth.len() - 1;
        let [near, far] = if face == 0 { [0, 1] } else { [last, last - 1] };
        (1.5 * depth[near] - 0.5 * depth[far]).max(0.0)
    }
}

/// Differences between the velocity profiles of the model and of wave theory in still water: for each harmonic of the
/// incoming wave and each layer from the bed upwards, the difference divided by the velocity at still water level [-].
pub(super) fn inflow_shapes(left_end: &LeftEnd, layers: usize) -> Vec<f64> {
    let LeftEnd::Inflow(wave) = left_end else { return Vec::new() };
    let difference = |[kd, _]: [f64; 2]| {
        let mean = kd.tanh() / kd;
        let shares = layer_shares(kd, layers).into_iter().enumerate();
        shares.map(move |(m, share)| {
            let exact = |node: f64| cosh_ratio(kd, (m as f64 + 0.5 + 0.5 * node) / layers as f64);
            mean * share - 0.5 * (exact(-GAUSS) + exact(GAUSS))
        })
    };
    wave.harmonics(0.0).flat_map(difference).collect()
}

/// Damping rates of the sponge at positions x [m]: 4 A c s^3 / L [1/s], where A is `SPONGE_STRENGTH`, c the long-wave
/// celerity and L the length of the sponge; s increases from 0 to 1 over this length. The integral over x is A c.
pub(super) fn sponge_rates(parameters: &LayeredParameters, positions: &[f64]) -> Vec<f64> {
    let RightEnd::Sponge { length_m } = parameters.right_end else { return vec![0.0; positions.len()] };
    let points = parameters.profile.points();
    let start = points[points.len() - 1][0] - length_m;
    let depth = (parameters.still_level_m - parameters.profile.z(start)).max(0.0);
    let celerity = (parameters.gravity_m_s2 * depth).sqrt();
    let rate = |x: &f64| 4.0 * SPONGE_STRENGTH * celerity / length_m * ((x - start) / length_m).max(0.0).powi(3);
    positions.iter().map(rate).collect()
}
