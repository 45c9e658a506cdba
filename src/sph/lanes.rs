//! Eight single-precision numbers in the lanes of a SIMD register, and the trait that lets a physical term be
//! written once for lanes and for scalars.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Number of lanes, and of particles in a cluster.
pub const LANES: usize = 8;

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
    /// Square root.
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

/// Eight lanes.
pub trait Lanes: Real {
    /// Lanes from their values.
    fn from_array(values: [f32; LANES]) -> Self;
    /// The values of the lanes.
    fn to_array(self) -> [f32; LANES];
    /// Bit k is set where lane k is at most `limit`.
    fn at_most(self, limit: Self) -> usize;
}

/// Eight lanes for any processor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub struct Portable([f32; LANES]);

impl Portable {
    #[inline(always)]
    fn each(self, f: impl Fn(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    #[inline(always)]
    fn pairwise(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
}

impl Lanes for Portable {
    fn from_array(values: [f32; LANES]) -> Self {
        Self(values)
    }
    fn to_array(self) -> [f32; LANES] {
        self.0
    }
    #[inline(always)]
    fn at_most(self, limit: Self) -> usize {
        (0..LANES).map(|lane| usize::from(self.0[lane] <= limit.0[lane]) << lane).sum()
    }
}

impl Real for Portable {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; LANES])
    }
    // `f32::mul_add` would be a slow library call on a processor without the instruction.
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.each(f32::sqrt)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.pairwise(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.pairwise(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.each(f32::abs)
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.each(f32::round_ties_even)
    }
    #[inline(always)]
    fn where_positive(self, switch: Self) -> Self {
        self.pairwise(switch, |a, s| if s > 0.0 { a } else { 0.0 })
    }
}

macro_rules! arithmetic {
    ($lanes:ident, $($trait:ident $method:ident $op:expr),*) => {
        $(impl $trait for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $op(self, other)
            }
        })*
        impl Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::splat(0.0) - self
            }
        }
        impl AddAssign for $lanes {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
    };
}
arithmetic!(
    Portable,
    Add add |a: Portable, b| a.pairwise(b, |a, b| a + b),
    Sub sub |a: Portable, b| a.pairwise(b, |a, b| a - b),
    Mul mul |a: Portable, b| a.pairwise(b, |a, b| a * b),
    Div div |a: Portable, b| a.pairwise(b, |a, b| a / b)
);

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;

/// Eight lanes of an AVX2 register. Arrays alone were tried: the compiler scattered half of them over scalar
/// instructions, at a third of the speed.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::*;

    use super::*;

    /// Eight lanes of an AVX2 register. Only to be used inside functions compiled for AVX2 and FMA and called after
    /// [`has_avx2_fma`] has said yes; every use of an intrinsic below relies on that.
    #[derive(Debug, Clone, Copy)]
    pub struct Avx2(__m256);

    impl Lanes for Avx2 {
        #[inline(always)]
        fn from_array(values: [f32; LANES]) -> Self {
            // SAFETY: see `Avx2`; the array has eight values.
            Self(unsafe { _mm256_loadu_ps(values.as_ptr()) })
        }
        #[inline(always)]
        fn to_array(self) -> [f32; LANES] {
            let mut values = [0.0; LANES];
            // SAFETY: see `Avx2`; the array has room for eight values.
            unsafe { _mm256_storeu_ps(values.as_mut_ptr(), self.0) };
            values
        }
        #[inline(always)]
        fn at_most(self, limit: Self) -> usize {
            // SAFETY: see `Avx2`.
            unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, limit.0)) as usize }
        }
    }

    // SAFETY of the intrinsics: see `Avx2`.
    impl Real for Avx2 {
        #[inline(always)]
        fn splat(value: f32) -> Self {
            Self(unsafe { _mm256_set1_ps(value) })
        }
        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            Self(unsafe { _mm256_fmadd_ps(self.0, a.0, b.0) })
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(unsafe { _mm256_sqrt_ps(self.0) })
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            Self(unsafe { _mm256_max_ps(self.0, other.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            Self(unsafe { _mm256_min_ps(self.0, other.0) })
        }
        #[inline(always)]
        fn abs(self) -> Self {
            Self(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
        }
        #[inline(always)]
        fn round(self) -> Self {
            Self(unsafe { _mm256_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(self.0) })
        }
        #[inline(always)]
        fn where_positive(self, switch: Self) -> Self {
            Self(unsafe { _mm256_and_ps(self.0, _mm256_cmp_ps::<_CMP_GT_OQ>(switch.0, _mm256_setzero_ps())) })
        }
    }

    // SAFETY of the intrinsics: see `Avx2`.
    arithmetic!(
        Avx2,
        Add add |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_add_ps(a.0, b.0) }),
        Sub sub |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_sub_ps(a.0, b.0) }),
        Mul mul |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_mul_ps(a.0, b.0) }),
        Div div |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_div_ps(a.0, b.0) })
    );
}

/// Whether the processor has AVX2 and FMA.
pub fn has_avx2_fma() -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; LANES] = [1.0, -2.0, 3.5, 0.4, -0.6, 7.0, 1e-3, -9.0];
    const B: [f32; LANES] = [2.0, 5.0, -1.5, 0.1, 0.2, -3.0, 4.0, 0.5];

    #[inline(always)]
    fn lanes_do_what_scalars_do<L: Lanes>() {
        let (a, b) = (L::from_array(A), L::from_array(B));
        for lane in 0..LANES {
            let (x, y) = (A[lane], B[lane]);
            let at = |lanes: L| lanes.to_array()[lane];
            assert_eq!(at(a * b), x * y);
            assert_eq!(at(a / b), x / y);
            assert_eq!(at(-a), -x);
            // One rounding or two.
            assert!((at(a.mul_add(b, a)) - (x * y + x)).abs() <= f32::EPSILON * (x * y).abs().max(x.abs()));
            assert_eq!(at(a.max(b)), x.max(y));
            assert_eq!(at(a.min(b)), x.min(y));
            assert_eq!(at(a.abs()), x.abs());
            assert_eq!(at(a.round()), x.round_ties_even());
            assert_eq!(at(a.where_positive(b)), if y > 0.0 { x } else { 0.0 });
            assert_eq!(a.at_most(b) >> lane & 1 == 1, x <= y);
        }
    }

    #[test]
    fn portable_lanes() {
        lanes_do_what_scalars_do::<Portable>();
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn avx2_lanes() {
        if has_avx2_fma() {
            lanes_do_what_scalars_do::<Avx2>();
        }
    }
}
