//! Sums over particles that have the same bits for any number of threads.

use rayon::prelude::*;

/// Number of particles of which one thread sums the values, in their order.
const CHUNK: usize = 4096;

/// Returns the sums of several values of each of `count` particles. Each chunk of particles is summed in order, and then
/// the sums of the chunks.
pub fn sums<const N: usize>(count: usize, of_particle: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
    let add = |mut sums: [f64; N], values: [f64; N]| {
        sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        sums
    };
    let of_chunk = |chunk: usize| {
        let particles = chunk * CHUNK..((chunk + 1) * CHUNK).min(count);
        particles.map(&of_particle).fold([0.0; N], add)
    };
    let chunks: Vec<[f64; N]> = (0..count.div_ceil(CHUNK)).into_par_iter().map(of_chunk).collect();
    chunks.into_iter().fold([0.0; N], add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_do_not_depend_on_the_number_of_threads() {
        let of_particle = |i: usize| [(i as f64).sqrt(), 1.0];
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| sums(3 * CHUNK + 7, of_particle))
        };
        let one = with(1);
        assert_eq!(one[1], (3 * CHUNK + 7) as f64);
        assert_eq!(one, with(3));
        assert_eq!(sums(0, of_particle), [0.0; 2]);
    }
}
