//! Lanes that run on any processor.

use super::{Lanes, MAX_LANES, Real, arithmetic};

const COUNT: usize = 8;

/// Eight lanes for any processor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub struct Portable([f32; COUNT]);

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
    const COUNT: usize = COUNT;

    #[inline(always)]
    fn load(values: &[f32]) -> Self {
        Self(std::array::from_fn(|lane| values[lane]))
    }
    #[inline(always)]
    fn to_array(self) -> [f32; MAX_LANES] {
        std::array::from_fn(|lane| self.0.get(lane).copied().unwrap_or(0.0))
    }
    #[inline(always)]
    fn at_most(self, limit: Self) -> u32 {
        (0..COUNT).map(|lane| u32::from(self.0[lane] <= limit.0[lane]) << lane).sum()
    }
    #[inline(always)]
    fn list_set_bits(bits: u32, base: u32, out: &mut [u32]) {
        list_set_bits_of_byte(bits, base, out);
    }
}

/// Implements [`Lanes::list_set_bits`] for eight lanes. It writes all eight entries without a branch.
#[inline(always)]
pub(super) fn list_set_bits_of_byte(bits: u32, base: u32, out: &mut [u32]) {
    for (out, &bit) in out[..COUNT].iter_mut().zip(&SET_BITS[bits as usize]) {
        *out = base + u32::from(bit);
    }
}

/// Positions of the set bits of each of the 256 values of a byte, lowest bit first, followed by zeros.
static SET_BITS: [[u8; 8]; 256] = set_bits();

const fn set_bits() -> [[u8; 8]; 256] {
    let mut table = [[0; 8]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][count] = bit as u8;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    table
}

impl Real for Portable {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; COUNT])
    }
    // Do not use `f32::mul_add`: on processors without the FMA instruction, it is a slow library call.
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

arithmetic!(
    Portable,
    Add add |a: Portable, b| a.pairwise(b, |a, b| a + b),
    Sub sub |a: Portable, b| a.pairwise(b, |a, b| a - b),
    Mul mul |a: Portable, b| a.pairwise(b, |a, b| a * b),
    Div div |a: Portable, b| a.pairwise(b, |a, b| a / b)
);
