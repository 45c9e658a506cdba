//! Extremes of speed and density of the water.

use rayon::prelude::*;

use crate::sph::particles::water::Water;

/// Extremes of the water at one time: each value with the index of the particle that has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// Largest speed [m/s].
    pub fastest: (f64, usize),
    /// Lowest density [kg/m3].
    pub lightest: (f64, usize),
    /// Highest density [kg/m3].
    pub densest: (f64, usize),
}

impl Extremes {
    /// Returns the extremes; ignores NaN values. Returns `None` if there is no particle. If several particles have the
    /// same extreme value, returns the lowest index, so that the result does not depend on the number of threads.
    pub fn of(water: &Water) -> Option<Self> {
        let of_particle = |i: usize| Self {
            fastest: (water.velocity[i].length(), i),
            lightest: (water.density[i], i),
            densest: (water.density[i], i),
        };
        let nothing =
            || Self { fastest: (-1.0, usize::MAX), lightest: (f64::MAX, usize::MAX), densest: (-1.0, usize::MAX) };
        let all = (0..water.len()).into_par_iter().with_min_len(4096);
        let extremes = all.map(of_particle).reduce(nothing, |a, b| Self {
            fastest: larger(a.fastest, b.fastest),
            lightest: smaller(a.lightest, b.lightest),
            densest: larger(a.densest, b.densest),
        });
        let named = [extremes.fastest, extremes.lightest, extremes.densest].iter().all(|(_, i)| *i < water.len());
        named.then_some(extremes)
    }
}

fn larger(a: (f64, usize), b: (f64, usize)) -> (f64, usize) {
    if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) || a.0.is_nan() { b } else { a }
}

fn smaller(a: (f64, usize), b: (f64, usize)) -> (f64, usize) {
    if b.0 < a.0 || (b.0 == a.0 && b.1 < a.1) || a.0.is_nan() { b } else { a }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn extremes_have_the_first_particle_of_equal_values() {
        let density = [1000.0, 998.0, f64::NAN, 1003.0, 998.0, 1003.0].repeat(5000);
        let water = Water {
            velocity: (0..density.len()).map(|i| DVec3::X * if i == 20_000 { -2.0 } else { 1.0 }).collect(),
            position: vec![DVec3::ZERO; density.len()],
            density,
            ..Water::default()
        };
        let extremes = Extremes::of(&water).unwrap();
        assert_eq!(extremes, Extremes { fastest: (2.0, 20_000), lightest: (998.0, 1), densest: (1003.0, 3) });
        assert_eq!(Extremes::of(&Water::default()), None);
    }
}
