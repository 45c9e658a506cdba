//! Linear waves in the layered flume model: wavelength and velocity profile with K layers.
//!
//! On a level bed, the discrete equations of `layered` (Keller box) for a wave exp(i (k x - omega t)) give
//!
//! ```text
//! omega^2 = g k tanh(K theta),   tanh(theta / 2) = k d / (2 K),
//! P_m / P_0 = cosh(m theta),     u_m proportional to P_m + P_(m+1)
//! ```
//!
//! with the pressure P_m at the bottom of layer m = 0 ... K - 1, counted from the bed, and the velocity u_m of the layer.
//! For k d > 2 K, theta is complex: tanh(K theta) becomes tanh(2 K artanh(2 K / (k d))), and the velocities of
//! neighbouring layers have opposite signs. omega approaches 2 K sqrt(g / d) for short waves. Waves of higher frequency
//! do not propagate. Exact waves have omega^2 = g k tanh(k d).

use crate::waves::theory::regular::linear_wavenumber_per_m;

/// Values of k d between which the wavenumber is searched [-].
const RANGE: [f64; 2] = [1e-6, 1e9];

/// Returns the shortest period [s] of waves that propagate in the depth [m] with a number of layers.
pub fn shortest_period_s(depth_m: f64, gravity: f64, layers: usize) -> f64 {
    std::f64::consts::PI / layers as f64 * (depth_m / gravity).sqrt()
}

/// Returns the wavelength in the flume model divided by the exact wavelength, minus 1 [-]. Returns `None` if the wave
/// does not propagate in the flume model.
pub fn wavelength_error(period_s: f64, depth_m: f64, gravity: f64, layers: usize) -> Option<f64> {
    let omega = std::f64::consts::TAU / period_s;
    let target = omega * omega * depth_m / gravity;
    let two_k = 2.0 * layers as f64;
    // (omega^2 d / g) of the wavenumber kd increases towards (2 K)^2.
    let frequency = |kd: f64| {
        let ratio = (kd / two_k).min(two_k / kd);
        kd * (two_k * ratio.min(1.0 - f64::EPSILON).atanh()).tanh()
    };
    let [mut low, mut high] = RANGE;
    if frequency(high) <= target {
        return None;
    }
    // Every step halves the logarithm of the range; 64 steps reach the rounding error.
    for _ in 0..64 {
        let middle = (low * high).sqrt();
        if frequency(middle) < target { low = middle } else { high = middle }
    }
    Some(linear_wavenumber_per_m(omega, depth_m, gravity) * depth_m / low - 1.0)
}

/// Returns the velocity of each layer divided by the depth mean, from the bed upwards, for a wave with the given k d.
pub fn layer_shares(kd: f64, layers: usize) -> Vec<f64> {
    let ratio = kd / (2.0 * layers as f64);
    // At a ratio of 1, theta is infinite. The shares are continuous there, so a value beside it serves.
    let square = if (ratio - 1.0).abs() < 1e-6 { 1.0 - 2e-6 } else { ratio * ratio };
    let cosh = (1.0 + square) / (1.0 - square);
    let mut pressure = [1.0, cosh];
    let mut shares = Vec::with_capacity(layers);
    for _ in 0..layers {
        shares.push(pressure[0] + pressure[1]);
        pressure = [pressure[1], 2.0 * cosh * pressure[1] - pressure[0]];
    }
    let mean = shares.iter().sum::<f64>() / layers as f64;
    shares.iter().map(|share| share / mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_vanish_for_long_waves_and_many_layers() {
        for layers in 1..=8 {
            // k d = 0.06: the error of the wavelength is of the order (k d)^2 / (12 K^2) = 3e-4 or less.
            assert!(wavelength_error(23.0, 0.5, 9.81, layers).unwrap().abs() < 1e-3);
            assert!(layer_shares(0.06, layers).iter().all(|share| (share - 1.0).abs() < 2e-3));
        }
        let errors = [2, 4, 8].map(|layers| wavelength_error(1.4, 0.8, 9.81, layers).unwrap());
        // The Keller box is of second order: twice the layers, a quarter of the error, here for k d = 1.75.
        assert!((errors[0] / errors[1] - 4.0).abs() < 0.5 && (errors[1] / errors[2] - 4.0).abs() < 0.2, "{errors:?}");
    }

    #[test]
    fn short_waves_do_not_propagate() {
        // T = 1 s in 2 m of water: shorter than pi sqrt(d / g) = 1.42 s.
        assert!((shortest_period_s(2.0, 9.81, 1) - 1.4185).abs() < 1e-4);
        assert_eq!(wavelength_error(1.0, 2.0, 9.81, 1), None);
        assert!(wavelength_error(1.41, 2.0, 9.81, 1).is_none() && wavelength_error(1.43, 2.0, 9.81, 1).is_some());
        // Two layers: k d = 8.29 in the dispersion relation, exact 8.05.
        let kd = 8.29_f64;
        let omega_squared = kd * (4.0 * (4.0 / kd).atanh()).tanh();
        assert!((omega_squared / (std::f64::consts::TAU.powi(2) * 2.0 / 9.81) - 1.0).abs() < 1e-3);
        assert!((wavelength_error(1.0, 2.0, 9.81, 2).unwrap() - (8.0485 / 8.29 - 1.0)).abs() < 1e-3);
    }

    #[test]
    fn layer_shares_have_the_mean_one_and_are_continuous() {
        for kd in [0.5, 3.999_999, 4.0, 4.000_001, 9.0, 60.0] {
            let shares = layer_shares(kd, 2);
            assert!((shares.iter().sum::<f64>() / 2.0 - 1.0).abs() < 1e-12);
            // Two layers: u_1 / u_0 = 2 cosh(theta) - 1 = (1 + 3 s) / (1 - s) with s = (k d / 4)^2.
            let s = (kd / 4.0) * (kd / 4.0);
            let top = (1.0 + 3.0 * s) / (1.0 + s);
            assert!((shares[1] / top - 1.0).abs() < 1e-5, "{kd}: {shares:?}");
        }
    }
}
