//! Active absorption of the waves that come back to a piston.

use glam::DVec2;

use super::Simulation;
use crate::{
    particles::boundary::Boundary,
    waves::{absorption::AbsorptionState, paddle::Paddle, wavemaker::Wavemaker},
};

impl Simulation {
    /// Read the surface before the piston, and let it take up what comes back over the step of length `dt` [s].
    pub(super) fn absorb(&mut self, dt: f64) {
        let Some(Wavemaker::Paddle(paddle)) = &self.wavemaker else { return };
        let Some(absorption) = paddle.absorption() else { return };
        let excess = self.excess(paddle, absorption.gauge_m, self.flume_time());
        absorption.advance(&mut self.absorbed, excess, dt);
    }

    /// Elevation beyond that of the wave that is made [m], at a distance from the piston [m]; nothing where it is dry.
    fn excess(&self, paddle: &Paddle, distance: f64, t: f64) -> f64 {
        let (domain, flume) = (&self.case.domain, &self.case.flume);
        let x = paddle.place_m() + self.absorbed.displacement_m + paddle.motion_m(t) + distance;
        let surface = self.sampler().surface(DVec2::new(x, 0.5 * domain.width), flume.profile.z(x), domain.top_z);
        surface.map_or(0.0, |z| z - flume.still_level - paddle.elevation_m(distance, t))
    }
}

/// Displacement [m] and velocity [m/s] of the wavemaker's rows at t [s], `before_end` [s] before the end of the step that
/// absorption has moved over.
pub(super) fn rows(wavemaker: &Wavemaker, absorbed: &AbsorptionState, t: f64, before_end: f64) -> Vec<[f64; 2]> {
    let offset = absorbed.displacement_m - before_end * absorbed.velocity_m_s;
    wavemaker.rows_at(t).into_iter().map(|[x, v]| [x + offset, v + absorbed.velocity_m_s]).collect()
}

/// Put the wavemaker where its [`rows`] are.
pub(super) fn move_wavemaker(
    boundary: &mut Boundary,
    wavemaker: Option<&Wavemaker>,
    absorbed: &AbsorptionState,
    t: f64,
    before_end: f64,
) {
    if let Some(wavemaker) = wavemaker {
        boundary.move_piston(&rows(wavemaker, absorbed, t, before_end));
    }
}
