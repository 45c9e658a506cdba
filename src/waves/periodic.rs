//! Regular waves as they are ordered: height, period, depth and what the water does on average.

use thiserror::Error;

/// Regular waves of permanent form on a level bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularWave {
    /// Height from trough to crest H [m].
    pub height_m: f64,
    /// Period T [s].
    pub period_s: f64,
    /// Still depth d, which is also the mean depth [m].
    pub depth_m: f64,
    /// Gravity g [m/s2].
    pub gravity: f64,
    /// What the water does on average.
    pub mean_flow: MeanFlow,
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

    #[test]
    fn wavenumber_satisfies_the_dispersion_relation() {
        for frequency in [0.05, 1.0, 3.1, 20.0] {
            let k = linear_wavenumber_per_m(frequency, 0.4, 9.81);
            // Newton's method ends in rounding.
            assert!((9.81 * k * (0.4 * k).tanh() / frequency.powi(2) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn highest_waves_have_the_known_limits() {
        // The solitary wave, 0.8332; in deep water H/L = 0.141, the fit's first coefficient.
        assert!((highest_over_depth(1e6) - 0.8332).abs() < 1e-3);
        assert!((highest_over_depth(1e-3) / 1e-3 - 0.141).abs() < 1e-3);
    }
}
