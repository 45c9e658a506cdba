//! Active absorption of returning waves by a rigid or multi-layer piston.

use glam::DVec2;

use crate::simulation::flume::Simulation;
use crate::{
    sph::particles::boundary::Boundary,
    waves::{generation::absorption::AbsorptionState, generation::wavemaker::Wavemaker},
};

impl Simulation {
    /// Measures the free surface in front of the piston, and updates the motion that absorbs returning waves, over a
    /// time step of length `dt` [s].
    pub(crate) fn absorb(&mut self, dt: f64) {
        let Some(wavemaker) = &self.wavemaker else { return };
        let Some(absorption) = wavemaker.absorption() else { return };
        let excess = self.excess(wavemaker, absorption.gauge_m, self.flume_time());
        absorption.advance(&mut self.absorbed, excess, dt);
    }

    /// Returns the measured elevation minus the elevation of the generated wave [m], at `distance` [m] in front of the
    /// piston and at the flume time `t` [s]; 0 if there is no water.
    fn excess(&self, wavemaker: &Wavemaker, distance: f64, t: f64) -> f64 {
        let (domain, flume) = (&self.case.domain, &self.case.flume);
        let x = wavemaker.x_at_surface_m(t) + self.absorbed.displacement_m + distance;
        let surface = self.sampler().surface(DVec2::new(x, 0.5 * domain.width), flume.profile.z(x));
        let made = match (wavemaker, &self.flume) {
            (Wavemaker::Paddle(paddle), _) => paddle.elevation_m(distance, t),
            (Wavemaker::MlPiston(_), Some(record)) => record.elevation(x, t),
            (Wavemaker::MlPiston(_), None) => {
                unreachable!("the case check refuses an absorption gauge without the flume model")
            }
        };
        surface.map_or(0.0, |z| z - flume.still_water_level - made)
    }
}

/// Returns displacement [m] and velocity [m/s] of each row of the wavemaker at the flume time `t` [s]. This time is
/// `before_end` [s] before the end of the time step; `absorbed` is the state at the end of the time step.
pub(crate) fn rows(wavemaker: &Wavemaker, absorbed: &AbsorptionState, t: f64, before_end: f64) -> Vec<[f64; 2]> {
    let offset = absorbed.displacement_m - before_end * absorbed.velocity_m_s;
    wavemaker.rows_at(t).into_iter().map(|[x, v]| [x + offset, v + absorbed.velocity_m_s]).collect()
}

/// Moves the particles of the wavemaker to the positions of its [`rows`].
pub(crate) fn move_wavemaker(
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
