//! K-layer non-hydrostatic flume model in one horizontal dimension.
//!
//! Zijlema, Stelling & Smit (2011), "SWASH: An operational public domain code for simulating wave fields and rapidly
//! varied flows in coastal waters"; Stelling & Zijlema (2003); Zijlema & Stelling (2005, 2008). All layers of a column
//! are equally thick. The depth H is stored in the cells, the horizontal velocity u_m of layer m at the faces, and the
//! vertical velocity w_m in the middle of layer m:
//!
//! ```text
//! dH/dt + dx sum(h_m u_m) = 0
//! du_m/dt + adv = - g dx eta - [dx q_bar_m - (q_{m+1} - q_m) dx z_m / h_m]
//! dw_m/dt + adv = - (q_{m+1} - q_m) / h_m
//! ```
//!
//! Here dx is the derivative along x, adv the advection term and eta the surface level. Layer m has the depth
//! h_m = H / K and its middle at the level z_m. q_m is the non-hydrostatic pressure, divided by the density, at the
//! bottom of layer m; q_bar_m = (q_m + q_{m+1}) / 2.
//!
//! | part | method | module |
//! | --- | --- | --- |
//! | time | leapfrog: H at time level n, u and w at n + 1/2; second-order Adams-Bashforth for advection | here |
//! | moving piston | cells follow the piston, fluxes relative to the faces | `grid` |
//! | advection | momentum-conservative, third-order upwind | `advection` |
//! | pressure q | Keller box with the transpose as continuity equation; one direct solve per time step | `pressure` |
//! | free surface, wetting and drying, breaking | face depths at half the time step; hydrostatic fronts | `surface` |
//! | ends | wall, piston, wave inflow, radiation, sponge | `ends` |
//! | friction | Manning or smooth bed, implicit | `friction` |
//! | flow at any x | cubic interpolation between the cells | `sample` |

mod advection;
mod block_tridiagonal;
mod ends;
mod friction;
mod grid;
mod parameters;
mod pressure;
mod sample;
mod surface;

pub use parameters::{Breaking, Friction, LayeredParameters, LeftEnd, Pressure, RightEnd};
pub use sample::{Column, SurfacePoint};

use block_tridiagonal::BlockTridiagonal;
use grid::Grid;

/// Depth below which a cell counts as dry and its water does not move [m].
pub(super) const DRY_DEPTH_M: f64 = 1e-5;

/// Parameters, state and workspace of a flume run.
#[derive(Debug, Clone)]
pub struct LayeredFlume {
    gravity: f64,
    layers: usize,
    still_level_m: f64,
    left_end: LeftEnd,
    /// Differences between the velocity profiles of the model and of wave theory; see `ends::inflow_shapes`.
    inflow_shapes: Vec<f64>,
    right_end: RightEnd,
    pressure: Pressure,
    friction: Friction,
    breaking_law: Breaking,
    sponge_rate: Vec<f64>,
    hydrostatic_below_m: f64,
    grid: Grid,
    time_s: f64,
    step_s: f64,
    first_step: bool,
    // State: `depth` of each cell, `u` of each face and layer, `w` of each cell and layer.
    depth: Vec<f64>,
    u: Vec<f64>,
    w: Vec<f64>,
    paddle_m: f64,
    entered_m2: f64,
    // Kept for the advection terms of the next time step.
    flux: Vec<f64>,
    rise_m_s: Vec<f64>,
    breaking: Vec<bool>,
    earlier_u: Vec<f64>,
    earlier_w: Vec<f64>,
    advection_u: Vec<f64>,
    advection_w: Vec<f64>,
    // Scratch memory.
    next_u: Vec<f64>,
    next_w: Vec<f64>,
    exchange: Vec<f64>,
    total_flux: Vec<f64>,
    mean_depth: Vec<f64>,
    next_depth: Vec<f64>,
    open: Vec<bool>,
    active: Vec<bool>,
    smooth: Vec<bool>,
    system: BlockTridiagonal,
}

impl LayeredFlume {
    /// Creates a flume with still water.
    pub fn new(parameters: LayeredParameters) -> Self {
        let LayeredParameters { still_level_m, layers, cell_m, step_s, .. } = parameters;
        let mapped_m = match parameters.left_end {
            LeftEnd::Piston { mapped_m, .. } => mapped_m,
            LeftEnd::Wall | LeftEnd::Inflow(_) => 0.0,
        };
        let grid = Grid::new(parameters.profile.clone(), cell_m, mapped_m);
        let sponge_rate = ends::sponge_rates(&parameters, &grid.face_x);
        let cells = grid.cells();
        let depth: Vec<f64> = grid.bed.iter().map(|bed| (still_level_m - bed).max(0.0)).collect();
        let (in_cells, at_faces) = (vec![0.0; cells * layers], vec![0.0; (cells + 1) * layers]);
        Self {
            gravity: parameters.gravity_m_s2,
            layers,
            still_level_m,
            inflow_shapes: ends::inflow_shapes(&parameters.left_end, layers),
            left_end: parameters.left_end,
            right_end: parameters.right_end,
            pressure: parameters.pressure,
            friction: parameters.friction,
            breaking_law: parameters.breaking,
            sponge_rate,
            hydrostatic_below_m: surface::hydrostatic_below_m(&depth),
            grid,
            time_s: 0.0,
            step_s,
            first_step: true,
            next_depth: depth.clone(),
            depth,
            u: at_faces.clone(),
            w: in_cells.clone(),
            paddle_m: 0.0,
            entered_m2: 0.0,
            flux: at_faces.clone(),
            rise_m_s: vec![0.0; cells],
            breaking: vec![false; cells],
            earlier_u: at_faces.clone(),
            earlier_w: in_cells.clone(),
            next_u: at_faces.clone(),
            next_w: in_cells.clone(),
            advection_u: at_faces,
            advection_w: in_cells.clone(),
            exchange: in_cells,
            total_flux: vec![0.0; cells + 1],
            mean_depth: vec![0.0; cells + 1],
            open: vec![false; cells + 1],
            active: vec![false; cells],
            smooth: vec![false; cells],
            system: BlockTridiagonal::new(cells, layers),
        }
    }

    /// Sets the initial flow: `elevation(x)` above still water [m] at t = 0 and `velocity(x, z)` [m/s] at t = -dt/2.
    pub fn set_flow(&mut self, elevation: impl Fn(f64) -> f64, velocity: impl Fn(f64, f64) -> f64) {
        let k = self.layers;
        for cell in 0..self.grid.cells() {
            if self.depth[cell] > 0.0 {
                let surface = self.still_level_m + elevation(self.grid.centre_x[cell]);
                self.depth[cell] = (surface - self.grid.bed[cell]).max(0.0);
            }
        }
        self.measure_faces();
        for face in (1..self.grid.cells()).filter(|&f| self.open[f]) {
            let bed = 0.5 * (self.grid.bed[face - 1] + self.grid.bed[face]);
            for m in 0..k {
                let z = bed + self.mean_depth[face] * (m as f64 + 0.5) / k as f64;
                self.u[face * k + m] = velocity(self.grid.face_x[face], z);
                self.flux[face * k + m] = self.mean_depth[face] / k as f64 * self.u[face * k + m];
            }
        }
        (0..self.grid.cells()).for_each(|cell| self.follow(cell));
    }

    /// Advances the flow by one time step.
    pub fn step(&mut self) {
        self.advance_velocities();
        self.advance_depths();
    }

    /// Advances u and w from time level n - 1/2 to n + 1/2, the first half of a time step. Afterwards [`Self::column`]
    /// returns the flow at n.
    pub fn advance_velocities(&mut self) {
        self.grid.aim(self.next_paddle_m(), self.step_s);
        self.measure_faces();
        self.classify_cells();
        self.exchange_between_layers();
        self.accelerate_u();
        self.accelerate_w();
        self.adopt_provisional_velocities();
        self.correct_with_pressure();
        self.limit_film_velocities();
        self.first_step = false;
    }

    /// Advances the depths from time level n to n + 1, the second half of a time step.
    pub fn advance_depths(&mut self) {
        let paddle_m = self.next_paddle_m();
        self.volume_fluxes(self.step_s);
        self.update_depths(self.step_s);
        self.entered_m2 += self.step_s * (self.total_flux[0] - self.total_flux[self.grid.cells()]);
        self.grid.arrive(paddle_m);
        self.paddle_m = paddle_m;
        self.time_s += self.step_s;
    }

    /// Computes the provisional u without non-hydrostatic pressure: u -= dt (adv + g dx eta). Friction and sponge
    /// damping are implicit; u is zero at faces without water.
    fn accelerate_u(&mut self) {
        let (k, dt) = (self.layers, self.step_s);
        for face in 1..self.grid.cells() {
            let slope = self.surface_slope(face);
            let damping = 1.0 / (1.0 + dt * self.damping_rate(face));
            for m in 0..k {
                let index = face * k + m;
                let new = if self.open[face] { self.advection_of_u(face, m) } else { 0.0 };
                let old = std::mem::replace(&mut self.advection_u[index], new);
                self.next_u[index] = if self.open[face] {
                    damping * (self.u[index] - dt * (self.adams_bashforth(new, old) + self.gravity * slope))
                } else {
                    0.0
                };
            }
        }
    }

    /// Computes the provisional w without non-hydrostatic pressure: w -= dt adv.
    fn accelerate_w(&mut self) {
        let (k, dt) = (self.layers, self.step_s);
        for cell in 0..self.grid.cells() {
            for m in 0..k {
                let index = cell * k + m;
                let new = if self.active[cell] { self.advection_of_w(cell, m) } else { 0.0 };
                let old = std::mem::replace(&mut self.advection_w[index], new);
                self.next_w[index] = self.w[index] - dt * self.adams_bashforth(new, old);
            }
        }
    }

    /// Makes the provisional velocities the current u and w, and keeps the old ones in `earlier_u` and `earlier_w`.
    fn adopt_provisional_velocities(&mut self) {
        std::mem::swap(&mut self.u, &mut self.earlier_u);
        std::mem::swap(&mut self.u, &mut self.next_u);
        std::mem::swap(&mut self.w, &mut self.earlier_w);
        std::mem::swap(&mut self.w, &mut self.next_w);
        self.set_end_velocities();
    }

    /// Second-order Adams-Bashforth rate from the current and the previous rate; the first time step uses Euler's
    /// method.
    fn adams_bashforth(&self, new: f64, old: f64) -> f64 {
        if self.first_step { new } else { 1.5 * new - 0.5 * old }
    }

    /// Slope of the free surface dx eta at an inner face [-].
    fn surface_slope(&self, face: usize) -> f64 {
        let level = |cell: usize| self.grid.bed[cell] + self.depth[cell];
        (level(face) - level(face - 1)) / self.grid.spacing(face)
    }

    /// Time of the current depths [s].
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Displacement of the piston from its rest position [m].
    pub fn paddle_m(&self) -> f64 {
        self.paddle_m
    }

    /// Net volume of water that has entered through both ends, per metre of width [m2].
    pub fn entered_m2(&self) -> f64 {
        self.entered_m2
    }

    /// Volume of water in the flume per metre of width [m2].
    pub fn volume_m2(&self) -> f64 {
        self.depth.iter().zip(&self.grid.width).map(|(h, dx)| h * dx).sum()
    }

    /// Largest magnitude of the elevation above still water over the wet cells [m].
    pub fn largest_elevation_m(&self) -> f64 {
        let levels = self.depth.iter().zip(&self.grid.bed).filter(|(h, _)| **h > 0.0).map(|(h, bed)| h + bed);
        levels.fold(0.0, |largest, level| f64::max(largest, (level - self.still_level_m).abs()))
    }

    /// Largest magnitude of the horizontal velocity [m/s].
    pub fn largest_velocity_m_s(&self) -> f64 {
        self.u.iter().fold(0.0, |largest, u| f64::max(largest, u.abs()))
    }

    /// Position x [m] of the first unstable cell: a value is not finite, or the water moves by more than
    /// one cell width in a time step.
    pub fn first_unstable_x_m(&self) -> Option<f64> {
        let is_too_fast = |face: usize| {
            // `limit_film_velocities` allows exactly one cell per time step; the 1e-6 covers rounding.
            let limit = (1.0 + 1e-6) * self.grid.spacing(face) / self.step_s;
            self.u[face * self.layers..(face + 1) * self.layers].iter().any(|u| !u.is_finite() || u.abs() > limit)
        };
        let is_unstable = |cell: usize| is_too_fast(cell) || is_too_fast(cell + 1) || !self.depth[cell].is_finite();
        (0..self.grid.cells()).find(|&cell| is_unstable(cell)).map(|cell| self.grid.centre_x[cell])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::profile::Profile;

    /// A closed basin 2 m long and 0.8 m deep.
    fn basin(layers: usize) -> LayeredFlume {
        LayeredFlume::new(LayeredParameters {
            profile: Profile::new(vec![[0.0, -0.8], [2.0, -0.8]]),
            still_level_m: 0.0,
            gravity_m_s2: 9.81,
            layers,
            cell_m: 0.02,
            step_s: 0.002,
            left_end: LeftEnd::Wall,
            right_end: RightEnd::Wall,
            pressure: Pressure::NonHydrostatic,
            friction: Friction::None,
            breaking: Breaking::Unlimited,
        })
    }

    /// Returns c^2 / (g d) of small waves with the celerity c and mu = k d. For one and two layers, this is
    /// the value of the linearised Keller box (see `pressure`); for more layers, the value of linear wave theory.
    fn dispersion(layers: usize, mu: f64) -> f64 {
        match layers {
            1 => 1.0 / (1.0 + mu.powi(2) / 4.0),
            2 => (1.0 + mu.powi(2) / 16.0) / (1.0 + 3.0 / 8.0 * mu.powi(2) + mu.powi(4) / 256.0),
            _ => mu.tanh() / mu,
        }
    }

    #[test]
    fn standing_wave_has_the_period_of_linear_theory() {
        // The basin is one wavelength long, k d = 2.5. In a hydrostatic model these waves would be 60 % too fast.
        let k = std::f64::consts::PI;
        // With one and two layers, only the errors of grid and time step remain, k^2 dx^2 / 24 = 2e-4. With eight
        // layers, the model is within 1e-3 of linear theory.
        for (layers, tolerance) in [(1, 5e-4), (2, 5e-4), (8, 1e-3)] {
            let period = std::f64::consts::TAU / (k * (9.81 * 0.8 * dispersion(layers, k * 0.8)).sqrt());
            let mut flume = basin(layers);
            flume.set_flow(|x| 1e-4 * (k * x).cos(), |_, _| 0.0);
            let mut down_crossings = Vec::new();
            let mut before = flume.surface_m(0.01);
            while down_crossings.len() < 4 {
                flume.step();
                let now = flume.surface_m(0.01);
                if before > 0.0 && now <= 0.0 {
                    down_crossings.push(flume.time_s() - 0.002 * now / (now - before));
                }
                before = now;
            }
            let measured = (down_crossings[3] - down_crossings[0]) / 3.0;
            assert!((measured / period - 1.0).abs() < tolerance, "K = {layers}: {measured} {period}");
        }
    }

    #[test]
    fn small_standing_wave_keeps_its_height() {
        let mut flume = basin(2);
        let k = std::f64::consts::PI;
        flume.set_flow(|x| 1e-4 * (k * x).cos(), |_, _| 0.0);
        let mut highest = 0.0f64;
        for step in 0..5000 {
            flume.step();
            if step > 4000 {
                highest = highest.max(flume.surface_m(0.01));
            }
        }
        // Leapfrog scheme and pressure conserve energy. Only the upwind advection reduces the wave height, by less than
        // 1 % in the nine periods of the test.
        assert!((highest / 1e-4 - 1.0).abs() < 0.01, "{highest}");
    }
}
