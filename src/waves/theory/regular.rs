//! Regular waves given by height, period and depth; linear dispersion relation and breaking heights.

use std::f64::consts::{PI, TAU};

use thiserror::Error;

/// Steepness (height divided by wavelength) at which a wave of permanent form breaks in deep water [-] (Miche 1944).
const MICHE: f64 = 0.142;
/// Largest Ursell number H L^2 / d^3 (height H, wavelength L, depth d) at which a second-order wave has a single crest
/// per period [-]: 8 pi^2 / 3 (Madsen 1971).
const LARGEST_URSELL: f64 = 8.0 * PI * PI / 3.0;

/// Regular waves in water of uniform depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularWave {
    /// Height H from trough to crest [m].
    pub height_m: f64,
    /// Period T [s].
    pub period_s: f64,
    /// Still water depth d [m].
    pub depth_m: f64,
    /// Gravitational acceleration g [m/s2].
    pub gravity: f64,
}

impl RegularWave {
    /// Angular frequency omega = 2 pi / T [rad/s].
    pub fn angular_frequency(&self) -> f64 {
        TAU / self.period_s
    }

    /// Wavenumber k of linear theory [1/m].
    pub fn wavenumber_per_m(&self) -> f64 {
        linear_wavenumber_per_m(self.angular_frequency(), self.depth_m, self.gravity)
    }

    /// Wavelength L = 2 pi / k [m].
    pub fn wavelength_m(&self) -> f64 {
        TAU / self.wavenumber_per_m()
    }

    /// Group velocity omega / (2 k) (1 + 2kd / sinh 2kd) of linear theory [m/s].
    pub fn group_velocity_m_s(&self) -> f64 {
        let k = self.wavenumber_per_m();
        let two_kd = 2.0 * k * self.depth_m;
        // For 2kd > 710, sinh overflows to infinity; the quotient is then zero, which is the correct limit.
        0.5 * self.angular_frequency() / k * (1.0 + two_kd / two_kd.sinh())
    }

    /// Breaking height 0.142 L tanh(k d) [m] (Miche 1944).
    pub fn breaking_height_m(&self) -> f64 {
        MICHE * self.wavelength_m() * (self.wavenumber_per_m() * self.depth_m).tanh()
    }

    /// Returns true if a second-order wave has one crest per period: H L^2 / d^3 is below 8 pi^2 / 3 (Madsen 1971).
    pub fn is_second_order(&self) -> bool {
        self.height_m * self.wavelength_m().powi(2) / self.depth_m.powi(3) < LARGEST_URSELL
    }
}

/// Mean flow under regular waves; stream function theory needs this additional condition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeanFlow {
    /// Zero mean mass transport, as in a closed flume.
    NoTransport,
    /// Zero mean Eulerian velocity below the troughs, as in open water.
    NoCurrent,
}

/// Reasons why a wave cannot be generated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WaveError {
    /// A value is outside its range.
    #[error("wave: {name} is {value}, it must be {allowed}")]
    Value {
        /// Name of the value.
        name: &'static str,
        /// The value.
        value: f64,
        /// Allowed range.
        allowed: String,
    },
    /// Stream function theory did not converge.
    #[error(
        "wave: stream function theory has no solution for height {height_m} m, period {period_s} s, depth {depth_m} m; reduce the height or the period"
    )]
    NotFound {
        /// Height [m].
        height_m: f64,
        /// Period [s].
        period_s: f64,
        /// Depth [m].
        depth_m: f64,
    },
}

impl WaveError {
    /// Returns an error unless the value is finite and above zero.
    pub(super) fn require_positive(name: &'static str, value: f64) -> Result<(), Self> {
        let fits = value.is_finite() && value > 0.0;
        if fits { Ok(()) } else { Err(Self::Value { name, value, allowed: "above 0".to_owned() }) }
    }
}

/// Height of the highest stable wave for a given wavelength, both divided by the depth [-] (Fenton 1990, fitted to the
/// results of Williams 1981).
pub fn max_height_over_depth(length_over_depth: f64) -> f64 {
    let l = length_over_depth;
    (0.141_063 * l + 0.009_572_1 * l * l + 0.007_782_9 * l.powi(3))
        / (1.0 + 0.078_834_0 * l + 0.031_756_7 * l * l + 0.009_340_7 * l.powi(3))
}

/// Solves omega^2 = g k tanh(k d) for the wavenumber k [1/m] by Newton's method from Eckart's (1952) estimate.
pub fn linear_wavenumber_per_m(angular_frequency: f64, depth_m: f64, gravity: f64) -> f64 {
    let deep_kd = angular_frequency * angular_frequency * depth_m / gravity;
    // Eckart's estimate is within 5 %. Each Newton iteration squares the error: 1e-3, 1e-6, 1e-12, rounding error.
    let mut kd = deep_kd / deep_kd.tanh().sqrt();
    for _ in 0..5 {
        let tanh = kd.tanh();
        kd -= (kd * tanh - deep_kd) / (tanh + kd * (1.0 - tanh * tanh));
    }
    kd / depth_m
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAVE: RegularWave = RegularWave { height_m: 0.1, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };

    #[test]
    fn wavenumber_satisfies_the_dispersion_relation_at_any_depth() {
        for depth_m in [0.01, 0.1, 0.4, 2.0, 50.0] {
            let wave = RegularWave { depth_m, ..WAVE };
            let k = wave.wavenumber_per_m();
            let right = wave.gravity * k * (k * depth_m).tanh();
            assert!((right / wave.angular_frequency().powi(2) - 1.0).abs() < 1e-12, "depth {depth_m}");
        }
        let deep = RegularWave { depth_m: 50.0, ..WAVE };
        assert!((deep.wavelength_m() / (9.81 * 1.44 / TAU) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn breaking_height_follows_miche() {
        // In deep water with T = 1.2 s, waves break at the height 0.142 g T^2 / (2 pi).
        let deep = RegularWave { depth_m: 50.0, ..WAVE };
        assert!((deep.breaking_height_m() - 0.142 * 9.81 * 1.44 / TAU).abs() < 1e-9);
        assert!(WAVE.is_second_order() && !RegularWave { period_s: 6.0, ..WAVE }.is_second_order());
    }

    #[test]
    fn highest_wave_has_the_solitary_and_deep_water_limits() {
        // The limit of a solitary wave is H/d = 0.8332. The limit in deep water is H/L = 0.141, the first coefficient
        // of the fit.
        assert!((max_height_over_depth(1e6) - 0.8332).abs() < 1e-3);
        assert!((max_height_over_depth(1e-3) / 1e-3 - 0.141).abs() < 1e-3);
    }
}
