//! SIMD lanes: four double-precision numbers in a register, and vectors of lanes. Each formula is written once for all
//! processors.
//!
//! Products and sums are rounded separately (no fused multiply-add), so every processor gives bitwise equal results.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// Number of lanes.
pub const LANES: usize = 4;

/// Four numbers with the operations of a SIMD register.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Loads four numbers into the lanes.
    fn load(values: &[f64; LANES]) -> Self;
    /// Returns the numbers of the lanes.
    fn to_array(self) -> [f64; LANES];
    /// Square root.
    fn sqrt(self) -> Self;
    /// Maximum per lane; the number of `other` if one of the two numbers is NaN.
    fn max(self, other: Self) -> Self;
    /// Minimum per lane; the number of `other` if one of the two numbers is NaN.
    fn min(self, other: Self) -> Self;

    /// Fills all lanes with the same number.
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self::load(&[value; LANES])
    }

    /// Fills the lanes from a function of the lane number.
    #[inline(always)]
    fn from_fn(mut f: impl FnMut(usize) -> f64) -> Self {
        Self::load(&[f(0), f(1), f(2), f(3)])
    }
}

/// A computation for any lane type. `run` and all functions on lanes that it calls must be `#[inline(always)]`.
/// Otherwise, the compiler does not use the instructions that [`dispatch`] selects. Do not use `map` on arrays of
/// lanes, because the compiler does not inline it.
pub trait WithLanes {
    /// Result of the computation.
    type Output;
    /// Runs the computation with a lane type.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Runs a computation with the fastest lane type of this processor.
#[inline]
pub fn dispatch<W: WithLanes>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: AVX2 has just been detected; the standard library caches the result.
        return unsafe { x86::with_avx2(work) };
    }
    work.run::<Portable>()
}

/// Four vectors, with one set of lanes per component.
#[derive(Debug, Clone, Copy)]
pub struct Vectors<L> {
    /// Components along x.
    pub x: L,
    /// Components along y.
    pub y: L,
    /// Components along z.
    pub z: L,
}

impl<L: Lanes> Vectors<L> {
    /// Builds the vectors from a function of the lane number.
    #[inline(always)]
    pub fn from_fn(mut f: impl FnMut(usize) -> DVec3) -> Self {
        let [a, b, c, d] = [f(0), f(1), f(2), f(3)];
        Self { x: L::load(&[a.x, b.x, c.x, d.x]), y: L::load(&[a.y, b.y, c.y, d.y]), z: L::load(&[a.z, b.z, c.z, d.z]) }
    }

    /// Returns the four vectors.
    #[inline(always)]
    pub fn to_array(self) -> [DVec3; LANES] {
        let (x, y, z) = (self.x.to_array(), self.y.to_array(), self.z.to_array());
        [
            DVec3::new(x[0], y[0], z[0]),
            DVec3::new(x[1], y[1], z[1]),
            DVec3::new(x[2], y[2], z[2]),
            DVec3::new(x[3], y[3], z[3]),
        ]
    }

    /// Scalar product per lane.
    #[inline(always)]
    pub fn dot(self, other: Self) -> L {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product per lane.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
}

impl<L: Lanes> Add for Vectors<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<L: Lanes> Sub for Vectors<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<L: Lanes> Mul<L> for Vectors<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: L) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

/// Implements the operators of a lane type from functions of two arguments.
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
    };
}

/// Lane type for any processor: an array of four numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Portable([f64; LANES]);

impl Portable {
    #[inline(always)]
    fn pairwise(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
}

impl Lanes for Portable {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        Self(*values)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.0
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.pairwise(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.pairwise(other, |a, b| if a < b { a } else { b })
    }
}

arithmetic!(Portable,
    Add add |a: Self, b: Self| a.pairwise(b, |a, b| a + b),
    Sub sub |a: Self, b: Self| a.pairwise(b, |a, b| a - b),
    Mul mul |a: Self, b: Self| a.pairwise(b, |a, b| a * b),
    Div div |a: Self, b: Self| a.pairwise(b, |a, b| a / b));

/// SAFETY of every intrinsic in this module: [`x86::Avx2`] is used only through [`x86::with_avx2`], whose caller has
/// detected AVX2.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::*;
    use std::ops::{Add, Div, Mul, Neg, Sub};

    use super::{LANES, Lanes, WithLanes};

    /// Runs a computation with AVX2.
    #[target_feature(enable = "avx2")]
    pub fn with_avx2<W: WithLanes>(work: W) -> W::Output {
        work.run::<Avx2>()
    }

    /// Four lanes of an AVX2 register.
    #[derive(Debug, Clone, Copy)]
    pub struct Avx2(__m256d);

    impl Lanes for Avx2 {
        #[inline(always)]
        fn load(values: &[f64; LANES]) -> Self {
            Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
        }
        #[inline(always)]
        fn to_array(self) -> [f64; LANES] {
            let mut values = [0.0; LANES];
            unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
            values
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(unsafe { _mm256_sqrt_pd(self.0) })
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            Self(unsafe { _mm256_max_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            Self(unsafe { _mm256_min_pd(self.0, other.0) })
        }
    }

    arithmetic!(Avx2,
        Add add |a: Self, b: Self| Self(unsafe { _mm256_add_pd(a.0, b.0) }),
        Sub sub |a: Self, b: Self| Self(unsafe { _mm256_sub_pd(a.0, b.0) }),
        Mul mul |a: Self, b: Self| Self(unsafe { _mm256_mul_pd(a.0, b.0) }),
        Div div |a: Self, b: Self| Self(unsafe { _mm256_div_pd(a.0, b.0) }));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A computation that uses all operations.
    struct All([f64; LANES], [f64; LANES]);

    impl WithLanes for All {
        type Output = [f64; LANES];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let (a, b) = (L::load(&self.0), L::load(&self.1));
            let v = Vectors { x: a, y: b, z: a * b };
            let w = Vectors { x: -b, y: a.max(b), z: a.min(b) };
            ((v.cross(w) + v - w * a).dot(w) / (L::splat(3.0) + v.dot(v)).sqrt()).to_array()
        }
    }

    #[test]
    fn all_lane_types_give_bitwise_equal_results() {
        let (a, b) = ([1.1, -2.3, 1e-9, 4e7], [0.7, 5.1, -3.3, 1.9]);
        assert_eq!(dispatch(All(a, b)), All(a, b).run::<Portable>());
        let lanes = |k: usize| All([a[k]; LANES], [b[k]; LANES]).run::<Portable>()[0];
        assert_eq!(dispatch(All(a, b)), std::array::from_fn(lanes));
    }
}
