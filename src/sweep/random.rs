//! Random values of varied keys.

use std::f64::consts::TAU;

use serde_json::{Value, json};

use crate::{
    case::file::{NormalFile, RandomFile},
    random::SplitMix64,
};

/// Largest number of values that are drawn until one is within the limits of a normal distribution.
const TRIES: u32 = 1000;

/// Random values from a seed.
#[derive(Debug)]
pub struct RandomValues {
    random: SplitMix64,
}

impl RandomValues {
    /// Creates the source of the values. The same seed gives the same values.
    pub fn new(seed: u64) -> Self {
        Self { random: SplitMix64::new(seed) }
    }

    /// Draws one value, rounded to six digits, so that the case file of a run shows exactly what was computed.
    ///
    /// # Errors
    /// If the numbers of the distribution are wrong; the text says what is allowed.
    pub fn draw(&mut self, distribution: RandomFile) -> Result<Value, String> {
        match distribution {
            RandomFile::Uniform([low, high]) if low < high => {
                Ok(json!(rounded(low + (high - low) * self.random.next_share()).clamp(low, high)))
            }
            RandomFile::Uniform([low, high]) => {
                Err(format!("uniform = [{low}, {high}]: the first limit must be below the second"))
            }
            RandomFile::Normal(normal) => self.normal(normal).map(|value| json!(value)),
            RandomFile::Seed => Ok(json!((self.random.next_share() * 32f64.exp2()) as u32)),
        }
    }

    /// Draws a normally distributed value within the limits (Box & Muller 1958).
    fn normal(&mut self, NormalFile { mean, deviation, least, most }: NormalFile) -> Result<f64, String> {
        let positive = deviation > 0.0;
        if !positive {
            return Err(format!("normal.deviation = {deviation}: must be above 0"));
        }
        let limits = least.unwrap_or(f64::NEG_INFINITY)..=most.unwrap_or(f64::INFINITY);
        let mut draw = || {
            let [u, v] = [0; 2].map(|_| self.random.next_share());
            rounded(mean + deviation * (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos())
        };
        (0..TRIES).map(|_| draw()).find(|value| limits.contains(value)).ok_or_else(|| {
            format!("normal: of {TRIES} values, none is within `least` and `most`; move the limits towards the mean")
        })
    }
}

/// Rounds to six significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draws(seed: u64, count: usize, distribution: RandomFile) -> Vec<f64> {
        let mut random = RandomValues::new(seed);
        (0..count).map(|_| random.draw(distribution).unwrap().as_f64().unwrap()).collect()
    }

    #[test]
    fn values_follow_their_distribution() {
        let moments = |values: &[f64]| {
            let count = values.len() as f64;
            let mean = values.iter().sum::<f64>() / count;
            (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt())
        };
        let normal = NormalFile { mean: 0.4, deviation: 0.05, least: None, most: None };
        let (mean, deviation) = moments(&draws(7, 10_000, RandomFile::Normal(normal)));
        // The errors of mean and deviation of n = 10,000 values are sigma / sqrt(n) = 0.0005 and sigma / sqrt(2 n) =
        // 0.00035. The limits are 3 times as large.
        assert!((mean - 0.4).abs() < 1.5e-3 && (deviation - 0.05).abs() < 1.1e-3, "{mean} {deviation}");
        let (mean, deviation) = moments(&draws(7, 10_000, RandomFile::Uniform([1.0, 3.0])));
        // Here sigma = 2 / sqrt(12) = 0.577. The error of the deviation is sigma sqrt(0.2 / n) = 0.0026.
        assert!((mean - 2.0).abs() < 1.8e-2 && (deviation - 2.0 / 12f64.sqrt()).abs() < 8e-3, "{mean} {deviation}");
    }

    #[test]
    fn limits_seeds_and_rounding() {
        let cut = NormalFile { mean: 0.4, deviation: 0.05, least: Some(0.38), most: Some(0.45) };
        let values = draws(7, 1000, RandomFile::Normal(cut));
        assert!(values.iter().all(|value| (0.38..=0.45).contains(value)));
        assert_eq!(values, draws(7, 1000, RandomFile::Normal(cut)));
        assert_ne!(values, draws(8, 1000, RandomFile::Normal(cut)));
        assert_eq!(rounded(0.123_456_789), 0.123_457);
        let seeds = draws(1, 2, RandomFile::Seed);
        assert!(seeds[0] != seeds[1] && seeds.iter().all(|seed| seed.fract() == 0.0));
        let far = NormalFile { mean: 0.0, deviation: 1.0, least: Some(50.0), most: None };
        assert!(RandomValues::new(0).draw(RandomFile::Normal(far)).unwrap_err().contains("move the limits"));
        assert!(RandomValues::new(0).draw(RandomFile::Uniform([2.0, 1.0])).unwrap_err().contains("[2, 1]"));
    }
}
