//! Lanes of AVX2 and AVX-512 registers. Plain arrays reach only a third of the speed of these lanes, because the
//! compiler turns half of the array operations into scalar instructions.
//!
//! SAFETY of every intrinsic in this file: [`Avx2`] and [`Avx512`] are used only through [`with_avx2`] and
//! [`with_avx512`]. The callers of these two functions check that the processor supports the instructions.

use std::arch::x86_64::*;

use super::{Lanes, MAX_LANES, Real, WithLanes, arithmetic, portable::list_set_bits_of_byte};

/// Runs `work` with AVX2 and FMA.
#[target_feature(enable = "avx2,fma")]
pub fn with_avx2<W: WithLanes>(work: W) -> W::Output {
    work.run::<Avx2>()
}

/// Runs `work` with AVX-512.
#[target_feature(enable = "avx512f,avx2,fma")]
pub fn with_avx512<W: WithLanes>(work: W) -> W::Output {
    work.run::<Avx512>()
}

/// Eight lanes of an AVX2 register.
#[derive(Debug, Clone, Copy)]
pub struct Avx2(__m256);

impl Lanes for Avx2 {
    const COUNT: usize = 8;

    #[inline(always)]
    fn load(values: &[f32]) -> Self {
        let values = &values[..Self::COUNT];
        // The slice has eight values.
        Self(unsafe { _mm256_loadu_ps(values.as_ptr()) })
    }
    #[inline(always)]
    fn to_array(self) -> [f32; MAX_LANES] {
        let mut values = [0.0; MAX_LANES];
        // The array has room for eight values.
        unsafe { _mm256_storeu_ps(values.as_mut_ptr(), self.0) };
        values
    }
    #[inline(always)]
    fn at_most(self, limit: Self) -> u32 {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, limit.0)) as u32 }
    }
    #[inline(always)]
    fn list_set_bits(bits: u32, base: u32, out: &mut [u32]) {
        list_set_bits_of_byte(bits, base, out);
    }
}

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

arithmetic!(
    Avx2,
    Add add |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_add_ps(a.0, b.0) }),
    Sub sub |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_sub_ps(a.0, b.0) }),
    Mul mul |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_mul_ps(a.0, b.0) }),
    Div div |a: Avx2, b: Avx2| Avx2(unsafe { _mm256_div_ps(a.0, b.0) })
);

/// Sixteen lanes of an AVX-512 register. Square roots and quotients are estimates, corrected once by the residual.
/// Their error is at most one unit in the last place. The instructions for exact roots and quotients would take longer
/// than all other operations for a pair of particles.
#[derive(Debug, Clone, Copy)]
pub struct Avx512(__m512);

impl Lanes for Avx512 {
    const COUNT: usize = 16;

    #[inline(always)]
    fn load(values: &[f32]) -> Self {
        let values = &values[..Self::COUNT];
        // The slice has sixteen values.
        Self(unsafe { _mm512_loadu_ps(values.as_ptr()) })
    }
    #[inline(always)]
    fn to_array(self) -> [f32; MAX_LANES] {
        let mut values = [0.0; MAX_LANES];
        // The array has room for sixteen values.
        unsafe { _mm512_storeu_ps(values.as_mut_ptr(), self.0) };
        values
    }
    #[inline(always)]
    fn at_most(self, limit: Self) -> u32 {
        u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, limit.0) })
    }
    #[inline(always)]
    fn list_set_bits(bits: u32, base: u32, out: &mut [u32]) {
        let out = &mut out[..Self::COUNT];
        // The slice has room for sixteen numbers. Compressing directly into memory is slow on some processors.
        unsafe {
            let lane = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
            let numbers = _mm512_add_epi32(lane, _mm512_set1_epi32(base as i32));
            _mm512_storeu_si512(out.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(bits as __mmask16, numbers));
        }
    }
}

impl Real for Avx512 {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(unsafe { _mm512_set1_ps(value) })
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(unsafe { _mm512_fmadd_ps(self.0, a.0, b.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe {
            // The lower bound 1e-30 keeps the estimate of 1 / sqrt(x) finite. Smaller values give the root 1e-15.
            let x = _mm512_max_ps(self.0, _mm512_set1_ps(1e-30));
            let estimate = _mm512_rsqrt14_ps(x);
            let root = _mm512_mul_ps(x, estimate);
            let residual = _mm512_fnmadd_ps(root, root, x);
            _mm512_fmadd_ps(residual, _mm512_mul_ps(_mm512_set1_ps(0.5), estimate), root)
        })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm512_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm512_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(unsafe { _mm512_abs_ps(self.0) })
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self(unsafe { _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(self.0) })
    }
    #[inline(always)]
    fn where_positive(self, switch: Self) -> Self {
        Self(unsafe {
            let positive = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(switch.0, _mm512_setzero_ps());
            _mm512_maskz_mov_ps(positive, self.0)
        })
    }
}

arithmetic!(
    Avx512,
    Add add |a: Avx512, b: Avx512| Avx512(unsafe { _mm512_add_ps(a.0, b.0) }),
    Sub sub |a: Avx512, b: Avx512| Avx512(unsafe { _mm512_sub_ps(a.0, b.0) }),
    Mul mul |a: Avx512, b: Avx512| Avx512(unsafe { _mm512_mul_ps(a.0, b.0) }),
    Div div |a: Avx512, b: Avx512| quotient(a, b)
);

/// Returns a / b for normal numbers; an infinite or zero divisor gives NaN.
#[inline(always)]
fn quotient(a: Avx512, b: Avx512) -> Avx512 {
    Avx512(unsafe {
        let estimate = _mm512_rcp14_ps(b.0);
        let quotient = _mm512_mul_ps(a.0, estimate);
        let residual = _mm512_fnmadd_ps(quotient, b.0, a.0);
        _mm512_fmadd_ps(residual, estimate, quotient)
    })
}
