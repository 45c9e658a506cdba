//! Moving ends of the particle domain: the wavemaker at the seaward end, or two open ends.
//!
//! A moving end consists of rows of boundary particles (see [`Wavemaker`]), one row per level. At an open end, the rows
//! follow the water of the flume model at a fixed position. A row that has moved into the domain by one particle
//! spacing releases its foremost particles: they become water, and the row is set back by one particle spacing. A row
//! that has moved out of the domain by half a particle spacing takes the water particles in front of it, and is set
//! forward. Thus rows stay near the end, and water flows through. This is the buffer of Tafuni et al. (2018) with
//! Lagrangian rows: mDBC gives the density of the rows from ghost nodes in the water, and released particles keep
//! place, velocity and density.
//!
//! Wavemakers and open ends can absorb returning waves: see [`absorption`](crate::waves::generation::absorption).

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::simulation::flume::Simulation;
use crate::sph::particles::boundary::Boundary;
use crate::sph::solver::sampling::Sampler;
use crate::waves::flume_model::record::FlumeRecord;
use crate::waves::generation::absorption::{AbsorptionState, outward_velocity_m_s};
use crate::waves::generation::wavemaker::Wavemaker;

/// Displacement of a row out of the domain at which an open end takes water, divided by the particle spacing [-]. A row
/// must move by half a particle spacing between release and taking, so that it does not alternate between them.
const TAKES_AT: f64 = 0.5;

/// Lower limit of the depth in the absorption at an open end, divided by the still water depth [-]. It bounds the
/// absorbing velocity where the flume model is nearly dry.
const LEAST_DEPTH: f64 = 0.1;

/// Rows of boundary particles that move at one end of the particle domain.
#[derive(Debug, Clone)]
pub struct MovingEnd {
    /// Motion of the rows.
    pub wavemaker: Wavemaker,
    /// Direction along x from the end into the domain: 1 at the seaward end, -1 at the shoreward end.
    pub inwards: f64,
    /// Particle spacing of an open end, by which its rows are set back and forward [m]; `None` for a wavemaker.
    pub open: Option<f64>,
    /// State of the end.
    pub state: EndState,
}

/// State of a moving end; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EndState {
    /// Additional motion by active absorption.
    pub absorbed: AbsorptionState,
    /// For each row of an open end, how often it has released particles, minus how often it has taken particles.
    pub released: Vec<i64>,
    /// For each row of an open end, how many layers of particles it should still release [-], between -0.5 and 0.5.
    pub layers_due: Vec<f64>,
}

impl MovingEnd {
    /// Creates a wavemaker at the seaward end.
    pub fn wavemaker(wavemaker: Wavemaker) -> Self {
        Self { wavemaker, inwards: 1.0, open: None, state: EndState::default() }
    }

    /// Creates an open end with the particle spacing `dp` [m].
    pub fn open(wavemaker: Wavemaker, inwards: f64, dp: f64) -> Self {
        let rows = wavemaker.row_heights_m().len();
        let state = EndState { released: vec![0; rows], layers_due: vec![0.0; rows], ..EndState::default() };
        Self { wavemaker, inwards, open: Some(dp), state }
    }

    /// Returns displacement [m] and velocity [m/s] along x of each row at the flume time `t` [s]. This time is
    /// `before_end` [s] before the end of the time step; `self.state` is the state at the end of the time step.
    pub fn rows(&self, t: f64, before_end: f64) -> Vec<[f64; 2]> {
        let EndState { absorbed, released, .. } = &self.state;
        let offset = absorbed.displacement_m - before_end * absorbed.velocity_m_s;
        let mut rows = self.wavemaker.rows_at(t);
        for [x, v] in &mut rows {
            *x += offset;
            *v += absorbed.velocity_m_s;
        }
        let dp = self.open.unwrap_or(0.0);
        for ([x, _], released) in rows.iter_mut().zip(released) {
            *x -= self.inwards * dp * *released as f64;
        }
        rows
    }

    /// Returns the largest distance [m] by which a row is inside the domain at the flume time `t` [s].
    pub fn foremost(&self, t: f64) -> f64 {
        self.rows(t, 0.0).iter().map(|row| self.inwards * row[0]).fold(f64::MIN, f64::max)
    }

    /// Returns the largest distance by which a row moves out of the domain during the run [m].
    pub fn reach(&self) -> f64 {
        self.open.map_or_else(|| self.wavemaker.max_seaward_displacement_m(), |dp| TAKES_AT * dp)
    }

    /// Updates the motion that absorbs returning waves, over a time step of length `dt` [s] that starts at the flume
    /// time `t` [s].
    fn absorb(&mut self, sampler: &Sampler, case: &Case, flume: Option<&FlumeRecord>, t: f64, dt: f64) {
        let Some(absorption) = self.wavemaker.absorption() else { return };
        let front = match self.open {
            Some(_) => self.wavemaker.rest_x_m(),
            None => self.wavemaker.x_at_surface_m(t) + self.state.absorbed.displacement_m,
        };
        let (x, width) = (front + self.inwards * absorption.gauge_m, case.domain.width);
        let bed = case.flume.section().z(x);
        let measured = match self.open {
            Some(_) => {
                let bed_at = |x: f64| case.flume.section().z(x);
                Some(bed + sampler.hydrostatic_depth(x, absorption.gauge_m, width, bed_at))
            }
            None => sampler.surface(DVec2::new(x, 0.5 * width), bed),
        };
        let generated = generated_elevation(&self.wavemaker, flume, absorption.gauge_m, x, t);
        // Without water at the gauge, there is no wave to absorb.
        let excess = measured.map_or(0.0, |z| z - case.flume.still_water_level - generated);
        let absorbed = &mut self.state.absorbed;
        match (self.open, flume) {
            (Some(_), Some(record)) => {
                absorption.smooth(absorbed, excess, dt);
                let (level, still) = (record.surface_level_m(front, t), case.flume.still_depth(front));
                let depth = (level - case.flume.section().z(front)).max(LEAST_DEPTH * still);
                let outward = outward_velocity_m_s(depth, absorbed.excess_m(), case.fluid.gravity);
                absorption.move_by(absorbed, -self.inwards * outward, dt);
            }
            _ => absorption.advance(absorbed, excess, dt),
        }
    }
}

/// Returns the elevation of the generated wave [m] at x [m], `distance` [m] in front of the wavemaker, at the flume time
/// `t` [s].
fn generated_elevation(wavemaker: &Wavemaker, flume: Option<&FlumeRecord>, distance: f64, x: f64, t: f64) -> f64 {
    match (wavemaker, flume) {
        (Wavemaker::Paddle(paddle), _) => paddle.elevation_m(distance, t),
        (Wavemaker::MlPiston(_), Some(record)) => record.elevation(x, t),
        (Wavemaker::MlPiston(_), None) => {
            unreachable!("the case check refuses an absorption gauge without the flume model")
        }
    }
}

/// Moves the particles of the moving ends to the positions of their [`MovingEnd::rows`].
pub(crate) fn move_ends(boundary: &mut Boundary, ends: &[MovingEnd], t: f64, before_end: f64) {
    for (piston, end) in ends.iter().enumerate() {
        boundary.move_piston(piston, &end.rows(t, before_end));
    }
}

impl Simulation {
    /// Measures the free surface in front of the moving ends, and updates the motion that absorbs returning waves, over
    /// a time step of length `dt` [s].
    pub(crate) fn absorb(&mut self, dt: f64) {
        let t = self.flume_time();
        let mut ends = std::mem::take(&mut self.ends);
        for end in &mut ends {
            end.absorb(&self.sampler(), &self.case, self.flume.as_deref(), t, dt);
        }
        self.ends = ends;
    }

    /// Lets water flow through the open ends, at the end of a time step: rows release and take particles.
    pub(crate) fn exchange_water(&mut self) {
        let mut ends = std::mem::take(&mut self.ends);
        for (piston, end) in ends.iter_mut().enumerate() {
            self.exchange_at(piston, end);
        }
        self.ends = ends;
    }

    /// Lets water flow through one end, which has the particles of a `piston`; does nothing if the end is not open.
    fn exchange_at(&mut self, piston: usize, end: &mut MovingEnd) {
        let Some(dp) = end.open else { return };
        let t = self.flume_time();
        let place = end.wavemaker.rest_x_m();
        let level =
            self.flume.as_ref().map_or(self.case.flume.still_water_level, |flume| flume.surface_level_m(place, t))
                + end.state.absorbed.excess_m();
        let rows = end.rows(t, 0.0);
        let mut taken = vec![f64::NEG_INFINITY; rows.len()];
        for (row, &[displacement, velocity]) in rows.iter().enumerate() {
            let advance = end.inwards * displacement;
            if advance >= dp {
                end.state.released[row] += 1;
                // A row that is partly in the water releases particles in proportion to its depth in the water.
                let depth = level - (end.wavemaker.row_heights_m()[row] - 0.5 * dp);
                end.state.layers_due[row] += (depth / dp).clamp(0.0, 1.0);
                if end.state.layers_due[row] >= 0.5 {
                    end.state.layers_due[row] -= 1.0;
                    self.release(piston, row, place + displacement - 0.5 * end.inwards * dp, velocity);
                }
            } else if advance < -TAKES_AT * dp {
                end.state.released[row] -= 1;
                taken[row] = advance + dp;
            }
        }
        if taken.iter().any(|limit| limit.is_finite()) {
            self.take(end, &taken);
        }
    }

    /// Turns the foremost particles of a row into water, with the position x [m] and the velocity along x [m/s].
    fn release(&mut self, piston: usize, row: usize, x: f64, velocity: f64) {
        let (width, dp, t) = (self.case.domain.width, self.case.domain.dp, self.flume_time());
        // The foremost layer is the nearest to the surface of the row; particles behind the side walls stay there.
        let is_foremost = |particle: usize| {
            let y = self.boundary.position[particle].y;
            self.boundary.to_surface[particle].x.abs() < dp && (0.0..width).contains(&y)
        };
        let of_row = self.boundary.rows_of(piston).filter(|(_, of)| *of == row).map(|(particle, _)| particle);
        for particle in of_row.filter(|&particle| is_foremost(particle)).collect::<Vec<_>>() {
            let DVec3 { y, z, .. } = self.boundary.position[particle];
            let (density, volume) = (self.boundary.density[particle], self.boundary.volume[particle]);
            let rise = self.flume.as_ref().map_or(0.0, |flume| flume.velocity(x, z, t).1);
            self.water.position.push(DVec3::new(x, y, z));
            self.water.velocity.push(DVec3::new(velocity, 0.0, rise));
            self.water.density.push(density);
            let porosity = self.porous.as_ref().map_or(1.0, |porous| porous.at(DVec3::new(x, y, z)).porosity);
            self.water.mass.push(porosity * density * volume);
            self.water.id.push(self.next_id);
            self.next_id += 1;
            self.statistics.exchanged[0] += 1;
            self.statistics.balance.zones += self.energy_of(self.water.len() - 1).iter().sum::<f64>();
        }
    }

    /// Removes the water particles that the rows of an open end reach. `limits` has the distance inside the domain [m]
    /// up to which a row takes particles; minus infinity for rows that take none.
    fn take(&mut self, end: &MovingEnd, limits: &[f64]) {
        let (place, heights) = (end.wavemaker.rest_x_m(), end.wavemaker.row_heights_m());
        let dp = self.case.domain.dp;
        let stays = |position: &DVec3| {
            let row = ((position.z - heights[0]) / dp).round().clamp(0.0, (heights.len() - 1) as f64) as usize;
            end.inwards * (position.x - place) >= limits[row]
        };
        let keep: Vec<bool> = self.water.position.iter().map(stays).collect();
        for leaving in (0..keep.len()).filter(|&particle| !keep[particle]) {
            self.statistics.balance.zones -= self.energy_of(leaving).iter().sum::<f64>();
            self.statistics.exchanged[1] += 1;
        }
        self.water.retain(&keep);
    }
}
