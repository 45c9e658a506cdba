//! Random numbers from a seed, identical on every machine.

use glam::DQuat;
use std::f64::consts::TAU;

/// Random number generator SplitMix64 (Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators").
#[derive(Debug, Clone)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// Creates the generator with the given seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Returns a random number, uniformly distributed from 0 (included) to 1 (excluded), with 53 random bits.
    pub fn next_share(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 * (-53f64).exp2()
    }

    /// Returns a random rotation, uniformly distributed over all orientations (Shoemake 1992).
    pub fn next_rotation(&mut self) -> DQuat {
        let [u, v, w] = [0; 3].map(|_| self.next_share());
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        let ((s_v, c_v), (s_w, c_w)) = ((TAU * v).sin_cos(), (TAU * w).sin_cos());
        DQuat::from_xyzw(a * s_v, a * c_v, b * s_w, b * c_w).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn generator_reproduces_the_published_numbers() {
        // First two outputs of SplitMix64 for the seed 1234567, from the reference code of S. Vigna.
        let mut random = SplitMix64::new(1_234_567);
        let expected = [6_457_827_717_110_365_317u64, 3_203_168_211_198_807_973];
        for number in expected {
            assert_eq!(random.next_share(), (number >> 11) as f64 * (-53f64).exp2());
        }
    }

    #[test]
    fn rotations_have_no_preferred_direction() {
        let mut random = SplitMix64::new(1);
        let count = 20_000;
        let mean = (0..count).map(|_| random.next_rotation() * DVec3::Z).sum::<DVec3>() / f64::from(count);
        // The mean of n = 20000 random unit vectors has a length of about 1/sqrt(n) = 0.007; the limit is 3 times it.
        assert!(mean.length() < 0.021, "{mean}");
    }
}
