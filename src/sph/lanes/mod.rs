//! Single-precision numbers in the lanes of a SIMD register, and the traits that let a physical term be written once,
//! for lanes of any width and for scalars.
//!
//! [`InstructionSet::dispatch`] is the one place where a computation meets the processor it runs on.

mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub use portable::Portable;

/// The largest number of lanes of any instruction set.
pub const MOST_LANES: usize = 16;

/// A number that the physical terms compute with: a scalar or lanes of them.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// The same value everywhere.
    fn splat(value: f32) -> Self;
    /// self * a + b.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Square root, to one unit in the last place; of zero, zero or next to it.
    fn sqrt(self) -> Self;
    /// The larger one.
    fn max(self, other: Self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The nearest whole number.
    fn round(self) -> Self;
    /// self where `switch` > 0, zero elsewhere.
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

/// Eight or sixteen lanes.
pub trait Lanes: Real {
    /// Number of lanes, and of particles in a full cluster.
    const COUNT: usize;
    /// Lanes from the first [`Self::COUNT`] values; panics if there are fewer.
    fn load(values: &[f32]) -> Self;
    /// The values of the lanes, followed by zeros.
    fn to_array(self) -> [f32; MOST_LANES];
    /// Bit k is set where lane k is at most `limit`.
    fn at_most(self, limit: Self) -> u32;
    /// Write `base` + k for each set bit k, lowest first, to the front of `out`, which has room for
    /// [`Self::COUNT`] numbers; what follows them there is left undefined.
    fn list_set_bits(bits: u32, base: u32, out: &mut [u32]);

    /// Lanes with the values of a function of the lane.
    #[inline(always)]
    fn from_fn(f: impl FnMut(usize) -> f32) -> Self {
        Self::load(&std::array::from_fn::<f32, MOST_LANES, _>(f))
    }
}

/// A computation that is written for any lanes. Its `run` has to be `#[inline(always)]`: only then is it compiled for
/// the instruction set that it is dispatched to.
pub trait WithLanes {
    /// What it returns.
    type Output;
    /// Compute with the given lanes.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Instructions that lanes are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InstructionSet {
    /// Whatever the compiler makes of arrays of eight.
    #[default]
    Portable,
    /// Eight lanes of AVX2 with FMA.
    Avx2,
    /// Sixteen lanes of AVX-512.
    Avx512,
}

impl InstructionSet {
    /// All of them that this processor has, best last.
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

    /// The one with the most lanes that this processor has.
    pub fn best() -> Self {
        Self::available().into_iter().next_back().unwrap_or_default()
    }

    /// Number of its lanes.
    pub fn lanes(self) -> usize {
        match self {
            Self::Portable | Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    /// Compute with this instruction set, or portably if the processor does not have it.
    #[inline]
    pub fn dispatch<W: WithLanes>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        match self {
            // SAFETY: the processor is asked; the answer is cached by the standard library.
            Self::Avx2 if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") => {
                return unsafe { x86::with_avx2(work) };
            }
            // SAFETY: as above.
            Self::Avx512 if is_x86_feature_detected!("avx512f") => return unsafe { x86::with_avx512(work) },
            _ => {}
        }
        work.run::<Portable>()
    }
}

/// Operators of a lane type from functions of two.
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

    struct LanesDoWhatScalarsDo;

    impl WithLanes for LanesDoWhatScalarsDo {
        type Output = usize;

        #[inline(always)]
        fn run<L: Lanes>(self) -> usize {
            let (a, b) = (L::from_fn(|lane| A[lane % 8]), L::from_fn(|lane| B[(lane + lane / 8) % 8]));
            for lane in 0..L::COUNT {
                let (x, y) = (A[lane % 8], B[(lane + lane / 8) % 8]);
                let at = |lanes: L| lanes.to_array()[lane];
                assert_eq!(at(a * b), x * y);
                assert!((at(a / b) - x / y).abs() <= f32::EPSILON * (x / y).abs());
                assert_eq!(at(-a), -x);
                // One rounding or two.
                assert!((at(a.mul_add(b, a)) - (x * y + x)).abs() <= f32::EPSILON * (x * y).abs().max(x.abs()));
                assert_eq!(at(a.max(b)), x.max(y));
                assert_eq!(at(a.min(b)), x.min(y));
                assert_eq!(at(a.abs()), x.abs());
                assert!((at(a.abs().sqrt()) - x.abs().sqrt()).abs() <= f32::EPSILON * x.abs().sqrt());
                assert!(at(L::splat(0.0).sqrt()) < 1e-14);
                assert_eq!(at(a.round()), x.round_ties_even());
                assert_eq!(at(a.where_positive(b)), if y > 0.0 { x } else { 0.0 });
                assert_eq!(a.at_most(b) >> lane & 1 == 1, x <= y);
            }
            assert_eq!(a.at_most(b) >> (L::COUNT - 1) >> 1, 0);
            let mut out = [0; MOST_LANES];
            let bits = 0b1000_0001_0010_1101 & ((1 << L::COUNT) - 1);
            L::list_set_bits(bits, 100, &mut out);
            let expected: Vec<u32> = (0..32).filter(|k| bits >> k & 1 == 1).map(|k| 100 + k).collect();
            assert_eq!(out[..expected.len()], expected);
            L::COUNT
        }
    }

    #[test]
    fn every_instruction_set_does_what_scalars_do() {
        for set in InstructionSet::available() {
            assert_eq!(set.dispatch(LanesDoWhatScalarsDo), set.lanes());
        }
    }
}
