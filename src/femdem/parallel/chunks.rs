//! Chunks of work for the thread pool, and sums over chunks.

use rayon::prelude::*;

/// Number of items per chunk, the unit of work of the thread pool. A sum is formed within each chunk and then over the
/// chunks, so the order of addition does not depend on the number of threads.
pub const CHUNK: usize = 512;

/// Sums `value` over 0..count in an order that does not depend on the number of threads.
pub fn ordered_sum(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let chunks: Vec<f64> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| (chunk * CHUNK..((chunk + 1) * CHUNK).min(count)).map(&value).sum())
        .collect();
    chunks.iter().fold(0.0, |sum, chunk| sum + chunk)
}
