//! Irregular waves: a first-order JONSWAP sea with random phases.
//!
//! The spectrum S(f) is proportional to f^-5 exp(-1.25 (f_p/f)^4) gamma^a (Hasselmann et al. 1973), with the peak
//! frequency f_p and a = exp(-(f - f_p)^2 / (2 s^2 f_p^2)); s is 0.07 below f_p and 0.09 above. S is scaled so that
//! H_s = 4 sqrt(m_0), where m_0 is the integral of S. The surface is a sum of waves with random phases and the
//! amplitude sqrt(2 S df), spaced by df in frequency. It repeats after 1/df. Velocities follow linear theory with
//! Wheeler (1970) stretching. The sum has no bound long waves, because the nonlinear flume model generates them. The
//! flume model also generates spurious free long waves, which second-order wave generation would suppress.

use std::f64::consts::TAU;

use super::regular::{WaveError, linear_wavenumber_per_m};
use crate::random::SplitMix64;

/// Lowest and highest f / f_p of the wave components [-]; 1 to 2 % of the spectral energy lies outside.
const BAND: [f64; 2] = [0.6, 3.0];
/// Largest number of wave components; it limits the run time, because the flume model evaluates all components at every
/// time step.
const MAX_COMPONENTS: usize = 5000;

/// Parameters of a JONSWAP sea.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JonswapSea {
    /// Significant height H_s = 4 sqrt(m_0) [m].
    pub significant_height_m: f64,
    /// Peak period T_p [s].
    pub peak_period_s: f64,
    /// Peak enhancement factor gamma [-]: 3.3 is the mean of measured seas, 1 gives the spectrum of Pierson & Moskowitz
    /// (1964).
    pub peak_enhancement: f64,
    /// Still water depth d [m].
    pub depth_m: f64,
    /// Gravitational acceleration g [m/s2].
    pub gravity: f64,
    /// Time after which the sea repeats [s].
    pub repeat_s: f64,
    /// Seed of the random phases: the same seed gives the same sea.
    pub seed: u64,
}

/// Linear wave components of an irregular sea at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct IrregularWave {
    sea: JonswapSea,
    components: Vec<Component>,
}

/// One linear wave: amplitude [m], angular frequency [rad/s], wavenumber [1/m] and phase [rad].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Component {
    amplitude: f64,
    angular_frequency: f64,
    wavenumber: f64,
    phase: f64,
}

impl IrregularWave {
    /// Creates the wave components with random phases.
    ///
    /// # Errors
    /// If a value is out of range.
    pub fn new(sea: JonswapSea) -> Result<Self, WaveError> {
        check(&sea)?;
        let df = 1.0 / sea.repeat_s;
        let peak = 1.0 / sea.peak_period_s;
        let first = (BAND[0] * peak / df).ceil().max(1.0) as usize;
        let last = (BAND[1] * peak / df).floor() as usize;
        let shapes: Vec<f64> = (first..=last).map(|i| jonswap_shape(i as f64 * df / peak, &sea)).collect();
        let m_0 = (sea.significant_height_m / 4.0).powi(2);
        let scale = m_0 / shapes.iter().sum::<f64>();
        let mut random = SplitMix64::new(sea.seed);
        let components = shapes.iter().enumerate().map(|(i, shape)| {
            let angular_frequency = TAU * (first + i) as f64 * df;
            Component {
                // The amplitude a of a component follows from a^2 / 2 = S df.
                amplitude: (2.0 * scale * shape).sqrt(),
                angular_frequency,
                wavenumber: linear_wavenumber_per_m(angular_frequency, sea.depth_m, sea.gravity),
                phase: TAU * random.next_share(),
            }
        });
        Ok(Self { sea, components: components.collect() })
    }

    /// Parameters of the sea.
    pub fn sea(&self) -> &JonswapSea {
        &self.sea
    }

    /// Elevation above still water [m] at time t [s].
    pub fn elevation_m(&self, t: f64) -> f64 {
        self.components.iter().map(|c| c.amplitude * c.angle(t).cos()).sum()
    }

    /// Components of the velocity at time t [s]: for each k d [-] and the velocity at still water level [m/s].
    pub fn harmonics(&self, t: f64) -> impl Iterator<Item = [f64; 2]> {
        let d = self.sea.depth_m;
        self.components.iter().map(move |c| [c.wavenumber * d, c.velocity(d, d, t)])
    }

    /// Returns the shortest and the longest period of the central part of the spectrum [s], and the parts before and
    /// after it contain the share `outside` [-] of the energy each.
    pub fn period_band_s(&self, outside: f64) -> [f64; 2] {
        let energy = |c: &Component| c.amplitude * c.amplitude;
        let total: f64 = self.components.iter().map(energy).sum();
        let period_at = |share: f64| {
            let mut sum = 0.0;
            let found = self.components.iter().find(|c| {
                sum += energy(c);
                sum >= share * total
            });
            found.or(self.components.last()).map_or(self.sea.peak_period_s, |c| TAU / c.angular_frequency)
        };
        [period_at(1.0 - outside), period_at(outside)]
    }

    /// Horizontal velocity [m/s] at z [m] above still water and time t [s]: the sum over the components of a omega
    /// cosh(k d s) / sinh(k d) cos(angle), with s = (z + d)/(d + eta), amplitude a and elevation eta of the sum.
    pub fn velocity_m_s(&self, z: f64, t: f64) -> f64 {
        let d = self.sea.depth_m;
        let stretched_height = d * ((z + d) / (d + self.elevation_m(t))).clamp(0.0, 1.0);
        self.components.iter().map(|c| c.velocity(stretched_height, d, t)).sum()
    }
}

impl Component {
    fn angle(&self, t: f64) -> f64 {
        self.phase - self.angular_frequency * t
    }

    /// Horizontal velocity at a height above the bed [m/s]. Exponentials keep cosh / sinh finite in deep water.
    fn velocity(&self, height: f64, depth: f64, t: f64) -> f64 {
        let k = self.wavenumber;
        let ratio = ((k * (height - depth)).exp() + (-k * (height + depth)).exp()) / (1.0 - (-2.0 * k * depth).exp());
        self.amplitude * self.angular_frequency * ratio * self.angle(t).cos()
    }
}

fn check(sea: &JonswapSea) -> Result<(), WaveError> {
    for (name, value) in [
        ("significant_height_m", sea.significant_height_m),
        ("peak_period_s", sea.peak_period_s),
        ("depth_m", sea.depth_m),
        ("gravity", sea.gravity),
        ("repeat_s", sea.repeat_s),
    ] {
        WaveError::require_positive(name, value)?;
    }
    let refuse = |name, value, allowed: String| Err(WaveError::Value { name, value, allowed });
    if !(1.0..=10.0).contains(&sea.peak_enhancement) {
        return refuse("peak_enhancement", sea.peak_enhancement, "from 1 to 10".to_owned());
    }
    let longest = MAX_COMPONENTS as f64 / (BAND[1] - BAND[0]) * sea.peak_period_s;
    let shortest = 20.0 * sea.peak_period_s;
    if !(shortest..=longest).contains(&sea.repeat_s) {
        return refuse("repeat_s", sea.repeat_s, format!("from {shortest} (20 peak periods) to {longest}"));
    }
    // The highest of 3,000 waves is twice as high as the significant height. A solitary wave breaks at 0.8 of the
    // depth, so the limit of the significant height is 0.4 of the depth.
    let highest = 0.4 * sea.depth_m;
    if sea.significant_height_m > highest {
        return refuse(
            "significant_height_m",
            sea.significant_height_m,
            format!("at most {highest} (0.4 of the depth)"),
        );
    }
    Ok(())
}

/// Unscaled shape of the spectrum at f / f_p [-].
fn jonswap_shape(ratio: f64, sea: &JonswapSea) -> f64 {
    let width = if ratio <= 1.0 { 0.07 } else { 0.09 };
    let peak = (-(ratio - 1.0).powi(2) / (2.0 * width * width)).exp();
    ratio.powi(-5) * (-1.25 * ratio.powi(-4)).exp() * sea.peak_enhancement.powf(peak)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sea() -> JonswapSea {
        JonswapSea {
            significant_height_m: 0.08,
            peak_period_s: 2.0,
            peak_enhancement: 3.3,
            depth_m: 0.8,
            gravity: 9.81,
            repeat_s: 400.0,
            seed: 7,
        }
    }

    #[test]
    fn sea_has_the_target_height_and_repeats() {
        let wave = IrregularWave::new(sea()).unwrap();
        let samples = 4000;
        let eta: Vec<f64> = (0..samples).map(|i| wave.elevation_m(0.1 * f64::from(i))).collect();
        let variance = eta.iter().map(|e| e * e).sum::<f64>() / f64::from(samples);
        // Over the repeat time, the variance equals the sum of the variances of the components to rounding.
        assert!((4.0 * variance.sqrt() / 0.08 - 1.0).abs() < 1e-9);
        assert!((wave.elevation_m(3.3) - wave.elevation_m(403.3)).abs() < 1e-9);
        let other = IrregularWave::new(JonswapSea { seed: 8, ..sea() }).unwrap();
        assert!((wave.elevation_m(3.3) - other.elevation_m(3.3)).abs() > 1e-6);
        assert_eq!(wave, IrregularWave::new(sea()).unwrap());
    }

    #[test]
    fn long_components_have_long_wave_velocities() {
        // For a wave with k d = 0.05 and the amplitude a, u = sqrt(g/d) a within (k d)^2 = 0.25 %.
        let wave = Component { amplitude: 0.01, angular_frequency: 0.175, wavenumber: 0.0625, phase: 0.0 };
        let u = wave.velocity(0.4, 0.8, 0.0);
        assert!((u / (0.01 * (9.81f64 / 0.8).sqrt()) - 1.0).abs() < 2.5e-3, "{u}");
    }

    #[test]
    fn impossible_seas_are_rejected() {
        let message = |change: fn(&mut JonswapSea)| {
            let mut sea = sea();
            change(&mut sea);
            IrregularWave::new(sea).unwrap_err().to_string()
        };
        assert_eq!(message(|s| s.peak_period_s = 0.0), "wave: peak_period_s is 0, it must be above 0");
        assert!(message(|s| s.peak_enhancement = 0.5).contains("from 1 to 10"));
        assert!(message(|s| s.repeat_s = 10.0).contains("from 40 (20 peak periods)"));
        assert!(message(|s| s.significant_height_m = 0.5).contains("(0.4 of the depth)"));
    }
}
