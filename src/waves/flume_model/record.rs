//! Results of a flume run: wave gauges, surface profiles, the shoreline, and the flow in a window, interpolated at any
//! position and time.

use super::dispersion::layer_shares;
use super::interpolation::Stencil;
use super::layered::{Column, SurfacePoint};
use crate::geometry::profile::Profile;
use crate::waves::theory::stream_function::cosh_ratio;

/// Depth below which a point counts as dry in interpolation [m]. At a corner of the bed, the mean bed level of a cell
/// differs from the profile; in films below this depth, the difference would distort the result.
const FILM_M: f64 = 1e-3;

/// Wave gauges, and the flow in a window (a range of x), recorded at a fixed interval.
#[derive(Debug, Clone)]
pub struct FlumeRecord {
    /// Bed of the flume.
    pub profile: Profile,
    /// Still water level z [m].
    pub still_level_m: f64,
    /// Number of layers.
    pub layers: usize,
    /// Time between records [s]; the first record is at t = 0.
    pub interval_s: f64,
    /// Positions x of the gauges [m].
    pub gauges_x_m: Vec<f64>,
    /// Elevation above still water at the gauges [m], one series per gauge; where dry, bed level minus still water
    /// level.
    pub gauge_elevations_m: Vec<Vec<f64>>,
    /// Surface along the whole flume at the requested times.
    pub profiles: Vec<SurfaceProfile>,
    /// Bed level z at the shoreline [m], one value per record.
    pub shore_level_m: Vec<f64>,
    /// Positions x of the points of the window [m].
    pub window_x_m: Vec<f64>,
    /// Displacement of the piston from its rest position [m], one value per record.
    pub paddle_m: Vec<f64>,
    /// Initial volume of water in the flume per metre of width [m2].
    pub volume_m2: f64,
    /// Largest error of the water volume balance in the run, relative to the initial volume [-].
    pub volume_error: f64,
    surface_m: Vec<f64>,
    u: Vec<f64>,
    w: Vec<f64>,
    times_s: Vec<f64>,
}

/// Surface along the whole flume at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceProfile {
    /// Time [s].
    pub time_s: f64,
    /// Surface in each cell, from left to right.
    pub points: Vec<SurfacePoint>,
}

impl SurfaceProfile {
    /// Surface level z [m] at x [m], linear between the cell centres; `None` where dry or outside the centres.
    pub fn surface_m(&self, x: f64) -> Option<f64> {
        let right = self.points.partition_point(|p| p.x_m < x);
        let (a, b) = (self.points.get(right.checked_sub(1)?)?, self.points.get(right)?);
        let share = (x - a.x_m) / (b.x_m - a.x_m);
        let wet = if share < 0.5 { a.depth_m > 0.0 } else { b.depth_m > 0.0 };
        wet.then_some(a.surface_m + share * (b.surface_m - a.surface_m))
    }
}

impl FlumeRecord {
    /// Creates an empty record.
    pub(in crate::waves) fn new(
        profile: Profile,
        still_level_m: f64,
        layers: usize,
        interval_s: f64,
        gauges_x_m: Vec<f64>,
        window_x_m: Vec<f64>,
    ) -> Self {
        Self {
            profile,
            still_level_m,
            layers,
            interval_s,
            gauge_elevations_m: vec![Vec::new(); gauges_x_m.len()],
            gauges_x_m,
            profiles: Vec::new(),
            shore_level_m: Vec::new(),
            window_x_m,
            paddle_m: Vec::new(),
            volume_m2: 0.0,
            volume_error: 0.0,
            surface_m: Vec::new(),
            u: Vec::new(),
            w: Vec::new(),
            times_s: Vec::new(),
        }
    }

    /// Adds the state of the flume as the next record.
    pub(in crate::waves) fn push(
        &mut self,
        paddle_m: f64,
        gauge_levels_m: &[f64],
        columns: impl Iterator<Item = Column>,
    ) {
        self.times_s.push(self.times_s.len() as f64 * self.interval_s);
        self.paddle_m.push(paddle_m);
        for (series, level) in self.gauge_elevations_m.iter_mut().zip(gauge_levels_m) {
            series.push(level - self.still_level_m);
        }
        for column in columns {
            self.surface_m.push(column.surface_m);
            self.u.extend(column.u);
            self.w.extend(column.w);
        }
    }

    /// Times of the records [s].
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Time of the last record [s].
    pub fn end_s(&self) -> f64 {
        self.times_s.last().copied().unwrap_or(0.0)
    }

    /// Elevation above still water [m] at x [m] and t [s]; bed level minus still water level where dry. The
    /// interpolation is cubic in space and time, and constant outside the window and after the end of the run.
    pub fn elevation(&self, x: f64, t: f64) -> f64 {
        self.surface_level_m(x, t) - self.still_level_m
    }

    /// Surface level z [m] at x [m] and t [s], interpolated as in [`Self::elevation`].
    pub fn surface_level_m(&self, x: f64, t: f64) -> f64 {
        let bed = self.profile.z(x);
        self.interpolate_surface(&self.stencils(x, t), bed)
    }

    fn interpolate_surface(&self, stencils: &Stencils, bed: f64) -> f64 {
        stencils.interpolate(|i| if self.is_wet(i) { self.surface_m[i] } else { bed }).max(bed)
    }

    /// Horizontal and vertical velocity [m/s] at (x, z) [m] and t [s], constant above the surface and below the bed.
    /// Between the layers u is a parabola in the height above the bed and w is linear.
    pub fn velocity(&self, x: f64, z: f64, t: f64) -> (f64, f64) {
        let bed = self.profile.z(x);
        let stencils = self.stencils(x, t);
        let depth = self.interpolate_surface(&stencils, bed) - bed;
        let height = if depth > 0.0 { ((z - bed) / depth).clamp(0.0, 1.0) } else { 0.0 };
        let k = self.layers;
        let u = stencils.interpolate(|i| profile_of_u(&self.u[i * k..(i + 1) * k], height));
        let w = stencils.interpolate(|i| profile_of_w(&self.w[i * (k + 1)..(i + 1) * (k + 1)], height));
        (u, w)
    }

    /// Depth-mean horizontal velocity [m/s] at x [m] and t [s].
    pub fn mean_velocity(&self, x: f64, t: f64) -> f64 {
        let k = self.layers;
        self.stencils(x, t).interpolate(|i| self.u[i * k..(i + 1) * k].iter().sum::<f64>() / k as f64)
    }

    /// Height above still water [m] of the crest at a gauge, and time of the crest [s], from the parabola through the
    /// highest record and its two neighbours.
    pub fn crest(&self, gauge: usize) -> (f64, f64) {
        let series = &self.gauge_elevations_m[gauge];
        let highest = (0..series.len()).max_by(|&a, &b| series[a].total_cmp(&series[b])).unwrap_or(0);
        if highest == 0 || highest + 1 >= series.len() {
            return (series.get(highest).copied().unwrap_or(0.0), highest as f64 * self.interval_s);
        }
        let (before, top, after) = (series[highest - 1], series[highest], series[highest + 1]);
        let curvature = before - 2.0 * top + after;
        let shift = if curvature < 0.0 { 0.5 * (before - after) / curvature } else { 0.0 };
        (top - 0.25 * (before - after) * shift, (highest as f64 + shift) * self.interval_s)
    }

    /// Stencil in time for t [s].
    fn time_stencil(&self, t: f64) -> Stencil {
        Stencil::at(&self.times_s, t, |_| true)
    }

    /// Stencils for x [m] and t [s]. The stencil in space leaves out points that are dry at a time of the stencil in
    /// time.
    fn stencils(&self, x: f64, t: f64) -> Stencils {
        let (time, points) = (self.time_stencil(t), self.window_x_m.len());
        let is_wet = |i: usize| time.points().all(|record| self.is_wet(record * points + i));
        Stencils { time, space: Stencil::at(&self.window_x_m, x, is_wet), points }
    }

    /// Returns true if the water at a recorded point is deeper than `FILM_M`.
    fn is_wet(&self, index: usize) -> bool {
        self.surface_m[index] > self.profile.z(self.window_x_m[index % self.window_x_m.len()]) + FILM_M
    }
}

/// Interpolation stencils in time and space for one position and time.
struct Stencils {
    time: Stencil,
    space: Stencil,
    /// Number of points of one record.
    points: usize,
}

impl Stencils {
    /// Interpolates `value(index)` of the recorded points in space and time.
    fn interpolate(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.time.apply(|record| self.space.apply(|i| value(record * self.points + i)))
    }
}

/// Horizontal velocity u at a relative height above the bed (0 to 1), from the layer means. It is linear in the height
/// squared, which is exact for the parabola a + b height^2 of a long irrotational wave.
fn profile_of_u(layers: &[f64], height: f64) -> f64 {
    let k = layers.len();
    if k == 1 {
        return layers[0];
    }
    let node = |m: usize| ((m as f64 + 0.5).powi(2) + 1.0 / 12.0) / (k * k) as f64;
    let square = height * height;
    let below = (1..k - 1).take_while(|&m| node(m) <= square).count();
    let share = (square - node(below)) / (node(below + 1) - node(below));
    layers[below] + share * (layers[below + 1] - layers[below])
}

/// Returns the height of the wave that the velocity profile of the flume model makes at a wavemaker, divided by the
/// height in the flume model, minus 1 [-].
///
/// `kd` is the exact k d of the wave, `model_kd` the value in the flume model. In linear wavemaker theory, the height is
/// proportional to the integral of u cosh(k z) over the depth (Havelock 1929).
pub fn height_error(kd: f64, model_kd: f64, layers: usize) -> f64 {
    /// Number of intervals of the sums over the depth.
    const INTERVALS: u32 = 400;
    let shares = layer_shares(model_kd, layers);
    let mean = kd.tanh() / kd;
    let sums = (0..INTERVALS).map(|i| {
        let height = (f64::from(i) + 0.5) / f64::from(INTERVALS);
        let exact = cosh_ratio(kd, height);
        [mean * profile_of_u(&shares, height) * exact, exact * exact]
    });
    let [given, exact] = sums.fold([0.0; 2], |sum, [a, b]| [sum[0] + a, sum[1] + b]);
    given / exact - 1.0
}

/// Vertical velocity w at a relative height above the bed (0 to 1), linear between the layer interfaces.
fn profile_of_w(interfaces: &[f64], height: f64) -> f64 {
    let k = interfaces.len() - 1;
    let below = ((height * k as f64) as usize).min(k - 1);
    let share = height * k as f64 - below as f64;
    interfaces[below] + share * (interfaces[below + 1] - interfaces[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two layers over a level bed: surface 1 + 0.1 x + 0.2 t, layer means of u = 1 + height^2, w from 0 to 0.5.
    fn record() -> FlumeRecord {
        let profile = Profile::new(vec![[0.0, 0.0], [10.0, 0.0]]);
        let window: Vec<f64> = (0..6).map(f64::from).collect();
        let mut record = FlumeRecord::new(profile, 1.0, 2, 0.5, vec![2.0], window);
        for r in 0..5 {
            let t = 0.5 * f64::from(r);
            let column = |x: i32| Column {
                surface_m: 1.0 + 0.1 * f64::from(x) + 0.2 * t,
                bed_m: 0.0,
                u: vec![1.0 + 1.0 / 12.0, 1.0 + 7.0 / 12.0],
                w: vec![0.0, 0.25, 0.5],
            };
            record.push(0.0, &[1.0 + t * (2.0 - t)], (0..6).map(column));
        }
        record
    }

    #[test]
    fn flow_is_interpolated_in_space_height_and_time() {
        let record = record();
        // The interpolation of linear fields and of a parabola in height is exact to rounding.
        assert!((record.elevation(2.3, 1.1) - (0.23 + 0.22)).abs() < 1e-12);
        let depth = 1.0 + 0.23 + 0.22;
        let (u, w) = record.velocity(2.3, 0.6 * depth, 1.1);
        assert!((u - 1.36).abs() < 1e-12 && (w - 0.3).abs() < 1e-12);
        assert_eq!(record.velocity(2.3, 9.0, 1.1).1, 0.5);
        assert_eq!(record.velocity(2.3, -9.0, 1.1).1, 0.0);
    }

    #[test]
    fn surface_profile_has_values_only_in_wet_cells() {
        let point = |x_m: f64, depth_m: f64| SurfacePoint { x_m, surface_m: 1.0 + x_m, depth_m };
        let points = vec![point(0.5, 0.4), point(1.5, 0.2), point(2.5, 0.0)];
        let profile = SurfaceProfile { time_s: 0.0, points };
        assert_eq!(profile.surface_m(1.0), Some(2.0));
        assert_eq!(profile.surface_m(1.9), Some(2.9));
        assert_eq!((profile.surface_m(2.2), profile.surface_m(0.1), profile.surface_m(3.0)), (None, None, None));
    }

    #[test]
    fn crest_is_the_top_of_a_parabola() {
        let (height, time) = record().crest(0);
        // The series is the parabola t (2 - t).
        assert!((height - 1.0).abs() < 1e-12 && (time - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_profile_makes_long_waves_with_their_height() {
        // The errors in parts per thousand were computed independently from the formulas.
        let waves = [(0.06, 1.0, 2, 0.0), (2.0, 0.9895, 2, 11.9), (3.0, 0.9959, 2, 48.2), (1.0, 0.9699, 1, -18.2)];
        for (kd, ratio, layers, expected) in waves {
            let error = 1e3 * height_error(kd, ratio * kd, layers);
            assert!((error - expected).abs() < 0.3, "kd = {kd}, {layers} layers: {error}");
        }
    }
}
