//! Measures the peak arithmetic speed and the memory bandwidth of the machine.

use std::{hint::black_box, time::Instant};

use rayon::prelude::*;

use crate::sph::lanes::{InstructionSet, Lanes, WithLanes};

/// Number of independent chains of operations. This number exceeds the duration of an operation [cycles] times the
/// number of arithmetic units, so that no arithmetic unit waits for a result.
const CHAINS: usize = 12;

/// Number of entries of each of the three arrays of the bandwidth test. An array has 64 MiB, much more than the caches
/// of a core.
const NUMBERS: usize = 1 << 24;

/// Measured peak speed and bandwidth for 1, 2, ... threads.
#[derive(Debug, Clone)]
pub struct Machine {
    flops: Vec<f64>,
    bandwidth: Vec<f64>,
}

impl Machine {
    /// Measures speed and bandwidth with 1, 2, ... `threads` threads. The measurement takes about a second for each
    /// number of threads.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn measure(instructions: InstructionSet, threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let mut machine = Self { flops: Vec::new(), bandwidth: Vec::new() };
        for count in 1..=threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
            machine.flops.push(pool.install(|| peak_flops(instructions, count)));
            machine.bandwidth.push(pool.install(peak_bandwidth));
        }
        Ok(machine)
    }

    /// Returns the peak number of single-precision operations per second with this number of threads. A fused
    /// multiply-add counts as two operations.
    pub fn flops(&self, threads: usize) -> f64 {
        self.flops[threads - 1]
    }

    /// Returns the peak memory traffic with this number of threads [bytes/s].
    pub fn bandwidth(&self, threads: usize) -> f64 {
        self.bandwidth[threads - 1]
    }
}

/// Computes `rounds` fused multiply-adds in each chain; `run` returns the number of operations.
struct Chains {
    rounds: u32,
}

impl WithLanes for Chains {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let (factor, summand) = (L::splat(black_box(0.999)), L::splat(black_box(0.001)));
        let mut chains = [L::splat(black_box(1.0)); CHAINS];
        for _ in 0..self.rounds {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, summand);
            }
        }
        let sum = chains.into_iter().reduce(|a, b| a + b).map(L::to_array);
        black_box(sum);
        2.0 * f64::from(self.rounds) * (CHAINS * L::COUNT) as f64
    }
}

fn peak_flops(instructions: InstructionSet, threads: usize) -> f64 {
    let measure = |rounds: u32| {
        let begin = Instant::now();
        let operations: f64 =
            (0..threads).into_par_iter().with_max_len(1).map(|_| instructions.dispatch(Chains { rounds })).sum();
        operations / begin.elapsed().as_secs_f64()
    };
    best_of(|| measure(4_000_000))
}

/// Measures the memory traffic [bytes/s] of the operation a = b + s c on arrays: two arrays are read and one is
/// written.
fn peak_bandwidth() -> f64 {
    let (b, c) = (vec![1.0_f32; NUMBERS], vec![2.0_f32; NUMBERS]);
    let mut a = vec![0.0_f32; NUMBERS];
    let s = black_box(0.5);
    best_of(|| {
        let begin = Instant::now();
        (&mut a, &b, &c).into_par_iter().with_min_len(1 << 16).for_each(|(a, b, c)| *a = s * c + b);
        black_box(&a);
        (3 * NUMBERS * size_of::<f32>()) as f64 / begin.elapsed().as_secs_f64()
    })
}

fn best_of(mut measure: impl FnMut() -> f64) -> f64 {
    (0..5).map(|_| measure()).fold(0.0, f64::max)
}
