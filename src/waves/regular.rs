//! Regular waves as they are ordered: height, period, depth; linear dispersion, highest waves.

use std::f64::consts::{PI, TAU};

use thiserror::Error;

/// Steepness at which a wave of permanent form breaks in deep water, H / L (Miche 1944).
const MICHE: f64 = 0.142;
/// Largest H L^2 / d^3 at which the crest of a second-order wave is single, 8 pi^2 / 3 (Madsen 1971).
const LARGEST_URSELL: f64 = 8.0 * PI * PI / 3.0;

/// Regular waves in water of even depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularWave {
    /// Height H from trough to crest [m].
    pub height_m: f64,
    /// Period T [s].
    pub period_s: f64,
    /// Still depth d [m].
    pub depth_m: f64,
    /// Gravity g [m/s2].
    pub gravity: f64,
}

impl RegularWave {
    /// Angular frequency omega = 2 pi / T [rad/s].
    pub fn angular_frequency(&self) -> f64 {
        TAU / self.period_s
    }

    /// Wave number k [1/m] of linear theory.
    pub fn number_per_m(&self) -> f64 {
        linear_wavenumber_per_m(self.angular_frequency(), self.depth_m, self.gravity)
    }

    /// Length L = 2 pi / k [m].
    pub fn length_m(&self) -> f64 {
        TAU / self.number_per_m()
    }

    /// Speed at which the energy travels [m/s]: omega / (2 k) (1 + 2kd / sinh 2kd).
    pub fn group_velocity_m_s(&self) -> f64 {
        let k = self.number_per_m();
        let twice = 2.0 * k * self.depth_m;
        // Beyond 700 the hyperbolic sine is infinite and the quotient zero, as it should be.
        0.5 * self.angular_frequency() / k * (1.0 + twice / twice.sinh())
    }

    /// Height at which the wave would break, 0.142 L tanh(k d) [m] (Miche 1944).
    pub fn breaking_height_m(&self) -> f64 {
        MICHE * self.length_m() * (self.number_per_m() * self.depth_m).tanh()
    }

    /// Whether the second-order wave has one crest a period: H L^2 / d^3 below 8 pi^2 / 3 (Madsen 1971).
    pub fn is_second_order(&self) -> bool {
        self.height_m * self.length_m().powi(2) / self.depth_m.powi(3) < LARGEST_URSELL
    }
}

/// Mean motion of the water under regular waves; the wave theory leaves it open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeanFlow {
    /// No water is carried along on average, as in a flume that is closed at its far end.
    NoTransport,
    /// The mean velocity at a point below the troughs is zero, as in open water.
    NoCurrent,
}

/// Why a wave cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WaveError {
    /// A value outside its range.
    #[error("wave: {name} is {value}, it must be {allowed}")]
    Value {
        /// Which value.
        name: &'static str,
        /// The value.
        value: f64,
        /// What would be allowed.
        allowed: String,
    },
    /// No wave of this form was found.
    #[error(
        "wave: no wave of permanent form found for height {height_m} m, period {period_s} s, depth {depth_m} m; take a lower or a shorter one"
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
    /// Require a value to be finite and above zero.
    pub(super) fn require_positive(name: &'static str, value: f64) -> Result<(), Self> {
        let fits = value.is_finite() && value > 0.0;
        if fits { Ok(()) } else { Err(Self::Value { name, value, allowed: "above 0".to_owned() }) }
    }
}

/// Highest wave of a length on a depth, H/d (Fenton 1990, a fit to the computations of Williams 1981) [-].
pub fn highest_over_depth(length_over_depth: f64) -> f64 {
    let l = length_over_depth;
    (0.141_063 * l + 0.009_572_1 * l * l + 0.007_782_9 * l.powi(3))
        / (1.0 + 0.078_834_0 * l + 0.031_756_7 * l * l + 0.009_340_7 * l.powi(3))
}

/// Wavenumber k of linear theory [1/m], omega^2 = g k tanh(k d), by Newton's method from Eckart's (1952) guess.
pub fn linear_wavenumber_per_m(angular_frequency: f64, depth_m: f64, gravity: f64) -> f64 {
    let deep = angular_frequency * angular_frequency * depth_m / gravity;
    // Eckart's guess is within 5 %; Newton's method squares the error: 1e-3, 1e-6, 1e-12, rounding.
    let mut kd = deep / deep.tanh().sqrt();
    for _ in 0..5 {
        let tanh = kd.tanh();
        kd -= (kd * tanh - deep) / (tanh + kd * (1.0 - tanh * tanh));
    }
    kd / depth_m
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAVE: RegularWave = RegularWave { height_m: 0.1, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };

    #[test]
    fn wave_number_obeys_the_dispersion_relation_in_any_depth() {
        for depth_m in [0.01, 0.1, 0.4, 2.0, 50.0] {
            let wave = RegularWave { depth_m, ..WAVE };
            let k = wave.number_per_m();
            let right = wave.gravity * k * (k * depth_m).tanh();
            assert!((right / wave.angular_frequency().powi(2) - 1.0).abs() < 1e-12, "depth {depth_m}");
        }
        let deep = RegularWave { depth_m: 50.0, ..WAVE };
        assert!((deep.length_m() / (9.81 * 1.44 / TAU) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn waves_break_where_miche_says() {
        // Deep water, T = 1.2 s: 0.142 g T^2 / 2 pi.
        let deep = RegularWave { depth_m: 50.0, ..WAVE };
        assert!((deep.breaking_height_m() - 0.142 * 9.81 * 1.44 / TAU).abs() < 1e-9);
        assert!(WAVE.is_second_order() && !RegularWave { period_s: 6.0, ..WAVE }.is_second_order());
    }

    #[test]
    fn highest_waves_have_the_known_limits() {
        // The solitary wave, 0.8332; in deep water H/L = 0.141, the fit's first coefficient.
        assert!((highest_over_depth(1e6) - 0.8332).abs() < 1e-3);
        assert!((highest_over_depth(1e-3) / 1e-3 - 0.141).abs() < 1e-3);
    }
}
