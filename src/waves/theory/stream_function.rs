//! Stream function wave theory: regular waves of permanent form by Fourier approximation, from deep water to cnoidal
//! waves.
//!
//! Rienecker & Fenton (1981), "A Fourier approximation method for steady water waves"; Fenton (1988). The equations
//! use units of the depth d and gravity g, and the frame of the wave, where the water flows towards negative x. psi is
//! the stream function, U the mean speed, Q the volume flux and R the Bernoulli constant:
//!
//! ```text
//! psi(X, Y) = - U Y + sum_j B_j sinh(j k Y) / cosh(j k) cos(j X),  X = k x - omega t,  Y from the bed
//! psi = - Q and (u^2 + v^2) / 2 + Y = R on the surface
//! ```
//!
//! The surface conditions hold at N + 1 points from crest to trough, where N is the number of coefficients B_j. Mean
//! depth, height, period and mean flow complete the 2 N + 6 equations. Newton's method solves them for a low wave first
//! and then for increasing heights.

use std::f64::consts::{PI, TAU};

use super::regular::{MeanFlow, RegularWave, WaveError, linear_wavenumber_per_m, max_height_over_depth};

mod equations;
pub use equations::cosh_ratio;
use equations::{SteadyWave, solve};

/// Ratio of the wave heights of successive solutions [-].
const HEIGHT_GROWTH: f64 = 1.25;
/// Largest Ursell number H L^2 / d^3 of the first and lowest wave that is solved [-]. A wave below this limit is nearly
/// a cosine.
const FIRST_URSELL: f64 = 4.0;
/// Largest height of this first wave, divided by the depth [-].
const FIRST_HEIGHT: f64 = 0.02;
/// Limit of the wavelength, divided by the depth [-]. The crests of longer waves are practically solitary waves.
const MAX_WAVELENGTH: f64 = 60.0;

/// A solution of stream function wave theory in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct StreamFunctionWave {
    parameters: RegularWave,
    wavenumber: f64,
    celerity: f64,
    mean_velocity: f64,
    /// Coefficients E_j [m] from j = 0, with elevation = sum E_j cos(j X).
    elevation: Vec<f64>,
    /// Coefficients j k B_j [m/s] from j = 1.
    velocity: Vec<f64>,
}

impl StreamFunctionWave {
    /// Computes the wave.
    ///
    /// # Errors
    /// If a value is out of range, the wave would break, or the solution does not converge.
    pub fn new(parameters: RegularWave, mean_flow: MeanFlow) -> Result<Self, WaveError> {
        let length_guess = check(&parameters)?;
        let RegularWave { height_m, period_s, depth_m, gravity } = parameters;
        let not_found = || WaveError::NotFound { height_m, period_s, depth_m };
        let height = height_m / depth_m;
        let period = period_s * (gravity / depth_m).sqrt();
        // The crest of a long wave covers a small part of the wavelength, so a higher order is needed to resolve it.
        let order = (16.0 + 0.8 * length_guess).min(64.0) as usize;
        let wave = solve_by_growing_height(order, height, period, mean_flow).ok_or_else(not_found)?;
        if !wave.falls_from_crest_to_trough() {
            return Err(not_found());
        }
        Ok(Self::in_si(parameters, &wave))
    }

    fn in_si(parameters: RegularWave, wave: &SteadyWave) -> Self {
        let d = parameters.depth_m;
        let speed = (parameters.gravity * d).sqrt();
        let velocity = wave.b.iter().enumerate().map(|(i, b)| (i + 1) as f64 * wave.k * b * speed).collect();
        Self {
            parameters,
            wavenumber: wave.k / d,
            celerity: wave.c * speed,
            mean_velocity: (wave.c - wave.u) * speed,
            elevation: cosine_coefficients(&wave.surface).iter().map(|e| e * d).collect(),
            velocity,
        }
    }

    /// Height, period and depth for which the wave was computed.
    pub fn parameters(&self) -> &RegularWave {
        &self.parameters
    }

    /// Wavenumber k [1/m].
    pub fn wavenumber_per_m(&self) -> f64 {
        self.wavenumber
    }

    /// Celerity [m/s].
    pub fn celerity_m_s(&self) -> f64 {
        self.celerity
    }

    /// Phase X = k x - omega t [rad] at x [m] and t [s]; 0 under a crest.
    pub fn phase(&self, x: f64, t: f64) -> f64 {
        self.wavenumber * x - TAU / self.parameters.period_s * t
    }

    /// Elevation above still water [m] at a phase [rad].
    pub fn elevation_m(&self, phase: f64) -> f64 {
        self.elevation.iter().enumerate().map(|(j, e)| e * (j as f64 * phase).cos()).sum()
    }

    /// Harmonics of the velocity at a phase [rad]: for each the number j times k d [-], and the velocity at still water
    /// level [m/s].
    pub fn harmonics(&self, phase: f64) -> impl Iterator<Item = [f64; 2]> {
        let kd = self.wavenumber * self.parameters.depth_m;
        self.velocity.iter().enumerate().map(move |(i, v)| {
            let j = (i + 1) as f64;
            [j * kd, v * (j * phase).cos()]
        })
    }

    /// Horizontal velocity [m/s] at a phase [rad] and z [m] above still water.
    pub fn velocity_m_s(&self, phase: f64, z: f64) -> f64 {
        let d = self.parameters.depth_m;
        let terms = self.harmonics(phase).map(|[kd, velocity]| velocity * cosh_ratio(kd, (z + d) / d));
        self.mean_velocity + terms.sum::<f64>()
    }
}

/// Checks the ranges of the parameters. Returns the wavelength of linear theory, divided by the
/// depth [-].
fn check(wave: &RegularWave) -> Result<f64, WaveError> {
    for (name, value) in
        [("height_m", wave.height_m), ("period_s", wave.period_s), ("depth_m", wave.depth_m), ("gravity", wave.gravity)]
    {
        WaveError::require_positive(name, value)?;
    }
    let length = wave.wavelength_m() / wave.depth_m;
    if !length.is_finite() || length >= MAX_WAVELENGTH {
        let allowed =
            format!("short enough for a wavelength below {MAX_WAVELENGTH} depths (linear theory: {length:.1})");
        return Err(WaveError::Value { name: "period_s", value: wave.period_s, allowed });
    }
    // A high wave is up to 20 % longer than in linear theory, so the limit is taken for 1.2 times the linear
    // wavelength. For breaking waves below this limit, Newton's method does not converge.
    let highest = max_height_over_depth(1.2 * length) * wave.depth_m;
    if wave.height_m >= highest {
        let allowed = format!("below {highest:.4}, where waves of this period and depth break");
        return Err(WaveError::Value { name: "height_m", value: wave.height_m, allowed });
    }
    Ok(length)
}

/// Solves for increasing heights, from a low wave up to `height`. Each initial guess extrapolates the last two
/// solutions.
fn solve_by_growing_height(order: usize, height: f64, period: f64, mean_flow: MeanFlow) -> Option<SteadyWave> {
    let k = linear_wavenumber_per_m(TAU / period, 1.0, 1.0);
    let first = height.min(FIRST_HEIGHT).min(FIRST_URSELL * (k / TAU).powi(2));
    let mut current = first;
    let mut wave = solve(SteadyWave::linear(order, current, k), current, period, mean_flow)?;
    let mut before: Option<(f64, SteadyWave)> = None;
    while current < height {
        let next = (current * HEIGHT_GROWTH).min(height);
        let start = match &before {
            Some((height_before, earlier)) => wave.extrapolated(earlier, (next - current) / (current - height_before)),
            None => wave.clone(),
        };
        let higher = solve(start, next, period, mean_flow)?;
        before = Some((current, std::mem::replace(&mut wave, higher)));
        current = next;
    }
    Some(wave)
}

/// Coefficients E_j of elevation(X) = sum E_j cos(j X), where elevation = `surface` - 1 at N + 1 points from crest to
/// trough.
fn cosine_coefficients(surface: &[f64]) -> Vec<f64> {
    let n = surface.len() - 1;
    let half_at_ends = |i: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
    let coefficient = |j: usize| {
        let sum: f64 =
            (0..=n).map(|m| half_at_ends(m) * (surface[m] - 1.0) * (j as f64 * m as f64 * PI / n as f64).cos()).sum();
        2.0 / n as f64 * half_at_ends(j) * sum
    };
    (0..=n).map(coefficient).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(height_m: f64, period_s: f64, depth_m: f64, mean_flow: MeanFlow) -> StreamFunctionWave {
        let parameters = RegularWave { height_m, period_s, depth_m, gravity: 9.81 };
        StreamFunctionWave::new(parameters, mean_flow).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn low_wave_is_linear() {
        let w = wave(1e-4, 2.02, 0.4, MeanFlow::NoCurrent);
        let k = linear_wavenumber_per_m(TAU / 2.02, 0.4, 9.81);
        // Nonlinear corrections of k are of order (H/d)^2 / (kd)^4 = 1e-6.
        assert!((w.wavenumber_per_m() / k - 1.0).abs() < 1e-5);
        let u = 0.5e-4 * TAU / 2.02 / (k * 0.4).tanh();
        // The second harmonic, divided by the first, is of order (H/d) / (kd)^2 = 6e-4.
        assert!((w.velocity_m_s(0.0, 0.0) / u - 1.0).abs() < 1e-3);
    }

    /// Celerity by Stokes' fifth-order theory without mean current (Fenton 1985, table 1):
    /// c sqrt(k/g) = C0 + e^2 C2 + e^4 C4, e = k H / 2, S = sech(2 k d).
    fn stokes_celerity(k: f64, height: f64, depth: f64) -> f64 {
        let s = 1.0 / (2.0 * k * depth).cosh();
        let c0 = (k * depth).tanh().sqrt();
        let c2 = c0 * (2.0 + 7.0 * s * s) / (4.0 * (1.0 - s).powi(2));
        let c4 = c0 * (4.0 + 32.0 * s - 116.0 * s.powi(2) - 400.0 * s.powi(3) - 71.0 * s.powi(4) + 146.0 * s.powi(5))
            / (32.0 * (1.0 - s).powi(5));
        let e = 0.5 * k * height;
        (c0 + e * e * c2 + e.powi(4) * c4) * (9.81 / k).sqrt()
    }

    #[test]
    fn celerity_agrees_with_stokes_fifth_order() {
        for (height, period, depth) in [(0.08, 1.0, 0.5), (0.15, 1.5, 1.0), (0.1, 1.2, 2.0)] {
            let w = wave(height, period, depth, MeanFlow::NoCurrent);
            let expected = stokes_celerity(w.wavenumber_per_m(), height, depth);
            // The next term of the series is of order e^6; here it is below 2e-4.
            assert!((w.celerity_m_s() / expected - 1.0).abs() < 2e-4, "{} {expected}", w.celerity_m_s());
            assert!((w.elevation_m(0.0) - w.elevation_m(PI) - height).abs() < 1e-9);
        }
    }

    #[test]
    fn long_wave_travels_as_a_solitary_wave_over_its_trough() {
        // At the Ursell number 150, the crest behaves like a solitary wave in water as deep as under the trough. The
        // celerity of such a solitary wave is known.
        let w = wave(0.08, 14.0, 1.0, MeanFlow::NoCurrent);
        let trough = 1.0 + w.elevation_m(PI);
        let e = 0.08 / trough;
        let solitary = (9.81 * trough * (1.0 + e - e * e / 20.0 - 3.0 * e.powi(3) / 70.0)).sqrt();
        let over_trough = w.celerity_m_s() - w.velocity_m_s(PI, -0.5);
        // The limit is 1e-3, not zero, because the trough is exactly level only for infinitely long waves.
        assert!((over_trough / solitary - 1.0).abs() < 1e-3, "{over_trough} {solitary}");
    }

    #[test]
    fn no_transport_makes_the_mass_flux_zero() {
        let w = wave(0.1, 2.5, 0.5, MeanFlow::NoTransport);
        let (phases, rows) = (200, 100);
        let mut transport = 0.0;
        for p in 0..phases {
            let phase = TAU * f64::from(p) / f64::from(phases);
            let depth = 0.5 + w.elevation_m(phase);
            for row in 0..rows {
                let z = -0.5 + depth * (f64::from(row) + 0.5) / f64::from(rows);
                transport += w.velocity_m_s(phase, z) * depth / f64::from(rows * phases);
            }
        }
        // Limit 1e-6 m2/s: the error of the midpoint rule with 100 rows is 1e-5 of H sqrt(g d) / 2 = 0.1 m2/s.
        assert!(transport.abs() < 1e-6, "{transport}");
        assert!(w.mean_velocity < 0.0);
    }

    #[test]
    fn impossible_waves_are_rejected() {
        let make = |height_m, period_s| {
            let wave = RegularWave { height_m, period_s, depth_m: 0.4, gravity: 9.81 };
            StreamFunctionWave::new(wave, MeanFlow::NoTransport).unwrap_err().to_string()
        };
        assert_eq!(make(0.1, -1.0), "wave: period_s is -1, it must be above 0");
        assert!(make(0.1, 100.0).contains("below 60 depths"));
        assert!(make(0.35, 2.0).contains("waves of this period and depth break"));
    }
}
