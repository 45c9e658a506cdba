//! Single-precision SIMD lanes (one instruction computes all lanes), and the traits with which each physical term is
//! written once, for scalars and for any number of lanes.
//!
//! In the SPH code, only [`InstructionSet::dispatch`] selects code for the instruction set of the processor.

mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub use portable::Portable;

/// Largest number of lanes of any instruction set.
pub const MAX_LANES: usize = 16;

/// Number type of the physical terms: a scalar or SIMD lanes.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// Returns the value in every lane.
    fn splat(value: f32) -> Self;
    /// Returns self * a + b.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Returns the square root; the error is at most one unit in the last place. The result for zero is at most 1e-14.
    fn sqrt(self) -> Self;
    /// Returns the larger value.
    fn max(self, other: Self) -> Self;
    /// Returns the smaller value.
    fn min(self, other: Self) -> Self;
    /// Returns the absolute value.
    fn abs(self) -> Self;
    /// Returns the nearest integer; halves are rounded to the even integer.
    fn round(self) -> Self;
    /// Returns self in lanes where `switch` > 0, and zero in the other lanes.
    fn where_positive(self, switch: Self) -> Self;
}

impl Real for f64 {
    fn splat(value: f32) -> Self {
        f64::from(value)
    }
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }
    fn min(self, other: Self) -> Self {
        f64::min(self, other)
    }
    fn abs(self) -> Self {
        f64::abs(self)
    }
    fn round(self) -> Self {
        f64::round_ties_even(self)
    }
    fn where_positive(self, switch: Self) -> Self {
        if switch > 0.0 { self } else { 0.0 }
    }
}

/// A group of eight or sixteen SIMD lanes.
pub trait Lanes: Real {
    /// Number of lanes, and of particles in a full cluster.
    const COUNT: usize;
    /// Loads the first [`Self::COUNT`] values; panics if there are fewer.
    fn load(values: &[f32]) -> Self;
    /// Returns the values of the lanes, followed by zeros.
    fn to_array(self) -> [f32; MAX_LANES];
    /// Returns a bit mask: bit k is set if lane k of `self` is at most lane k of `limit`.
    fn at_most(self, limit: Self) -> u32;
    /// Writes `base` + k for each set bit k to the front of `out`, lowest k first. `out` must have at least
    /// [`Self::COUNT`] entries. The remaining entries up to [`Self::COUNT`] are undefined.
    fn list_set_bits(bits: u32, base: u32, out: &mut [u32]);

    /// Returns lanes in which lane k has the value `f(k)`.
    #[inline(always)]
    fn from_fn(f: impl FnMut(usize) -> f32) -> Self {
        Self::load(&std::array::from_fn::<f32, MAX_LANES, _>(f))
    }
}

/// A computation that is generic over the type of the lanes. Its function `run` must be `#[inline(always)]`, because
/// only an inlined function is compiled for the instruction set that [`InstructionSet::dispatch`] selects. For the same
/// reason, loops over pairs must not compute lanes in closures that they pass to functions such as
/// [`std::array::from_fn`]: sometimes these functions are not inlined, and then each operation is a function call.
pub trait WithLanes {
    /// Result of the computation.
    type Output;
    /// Runs the computation with lanes of the type `L`.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// SIMD instruction set of the lanes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InstructionSet {
    /// Arrays of eight numbers, from which the compiler generates SIMD instructions.
    #[default]
    Portable,
    /// Eight lanes of AVX2 with FMA.
    Avx2,
    /// Sixteen lanes of AVX-512.
    Avx512,
}

impl InstructionSet {
    /// Returns the instruction sets that this processor supports, the set with the most lanes last.
    pub fn available() -> Vec<Self> {
        let mut sets = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                sets.push(Self::Avx2);
            }
            if is_x86_feature_detected!("avx512f") && sets.contains(&Self::Avx2) {
                sets.push(Self::Avx512);
            }
        }
        sets
    }

    /// Returns the supported instruction set with the most lanes.
    pub fn best() -> Self {
        Self::available().into_iter().next_back().unwrap_or_default()
    }

    /// Returns the number of lanes.
    pub fn lanes(self) -> usize {
        match self {
            Self::Portable | Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    /// Runs `work` with this instruction set, or with portable lanes if the processor does not support it.
    #[inline]
    pub fn dispatch<W: WithLanes>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        match self {
            // SAFETY: the condition checks that the processor supports the instruction set; the standard library caches
            // the result of this check.
            Self::Avx2 if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") => {
                return unsafe { x86::with_avx2(work) };
            }
            // SAFETY: the condition checks that the processor supports the instruction set.
            Self::Avx512 if is_x86_feature_detected!("avx512f") => return unsafe { x86::with_avx512(work) },
            _ => {}
        }
        work.run::<Portable>()
    }
}

/// Implements the operators of a lane type from binary functions.
macro_rules! arithmetic {
    ($lanes:ident, $($trait:ident $method:ident $op:expr),*) => {
        $(impl std::ops::$trait for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $op(self, other)
            }
        })*
        impl std::ops::Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::splat(0.0) - self
            }
        }
        impl std::ops::AddAssign for $lanes {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
    };
}
use arithmetic;

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; 8] = [1.0, -2.0, 3.5, 0.4, -0.6, 7.0, 1e-3, -9.0];
    const B: [f32; 8] = [2.0, 5.0, -1.5, 0.1, 0.2, -3.0, 4.0, 0.5];

    struct CompareLanesWithScalars;

    impl WithLanes for CompareLanesWithScalars {
        type Output = usize;

        #[inline(always)]
        fn run<L: Lanes>(self) -> usize {
            let (a, b) = (L::from_fn(|lane| A[lane % 8]), L::from_fn(|lane| B[(lane + lane / 8) % 8]));
            for lane in 0..L::COUNT {
                let (x, y) = (A[lane % 8], B[(lane + lane / 8) % 8]);
                let lane_of = |lanes: L| lanes.to_array()[lane];
                assert_eq!(lane_of(a * b), x * y);
                assert!((lane_of(a / b) - x / y).abs() <= f32::EPSILON * (x / y).abs());
                assert_eq!(lane_of(-a), -x);
                // Tolerance: `mul_add` rounds once or twice, depending on the instruction set.
                assert!((lane_of(a.mul_add(b, a)) - (x * y + x)).abs() <= f32::EPSILON * (x * y).abs().max(x.abs()));
                assert_eq!(lane_of(a.max(b)), x.max(y));
                assert_eq!(lane_of(a.min(b)), x.min(y));
                assert_eq!(lane_of(a.abs()), x.abs());
                assert!((lane_of(a.abs().sqrt()) - x.abs().sqrt()).abs() <= f32::EPSILON * x.abs().sqrt());
                assert!(lane_of(L::splat(0.0).sqrt()) < 1e-14);
                assert_eq!(lane_of(a.round()), x.round_ties_even());
                assert_eq!(lane_of(a.where_positive(b)), if y > 0.0 { x } else { 0.0 });
                assert_eq!(a.at_most(b) >> lane & 1 == 1, x <= y);
            }
            assert_eq!(a.at_most(b) >> (L::COUNT - 1) >> 1, 0);
            let mut out = [0; MAX_LANES];
            let bits = 0b1000_0001_0010_1101 & ((1 << L::COUNT) - 1);
            L::list_set_bits(bits, 100, &mut out);
            let expected: Vec<u32> = (0..32).filter(|k| bits >> k & 1 == 1).map(|k| 100 + k).collect();
            assert_eq!(out[..expected.len()], expected);
            L::COUNT
        }
    }

    #[test]
    fn every_instruction_set_agrees_with_scalars() {
        for set in InstructionSet::available() {
            assert_eq!(set.dispatch(CompareLanesWithScalars), set.lanes());
        }
    }
}
