//! Eight lanes in two AVX registers.
//!
//! It computes what a [`Pair`](crate::Pair) of registers does. But a pair reaches the intrinsics through
//! the operations of its halves, and a routine is thousands of operations: a compiler takes a quarter
//! less time where each is two intrinsics to begin with.

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use super::Avx4;
use crate::Real;

/// Two AVX registers that go through the same operations, each rounding as it would alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct TwoAvx4(Avx4, Avx4);

impl Real for TwoAvx4 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        let both = Avx4::constant(value);
        Self(both, both)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let ((s, c), (t, d)) = (self.0.sin_cos(), self.1.sin_cos());
        (Self(s, t), Self(c, d))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: there are registers only where the feature is there.
        unsafe {
            let first = _mm256_fmadd_pd(self.0.0, factor.0.0, term.0.0);
            Self(Avx4(first), Avx4(_mm256_fmadd_pd(self.1.0, factor.1.0, term.1.0)))
        }
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $intrinsic:ident;)*) => {$(
        impl $operator for TwoAvx4 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: there are registers only where the feature is there.
                unsafe {
                    let first = $intrinsic(self.0.0, other.0.0);
                    Self(Avx4(first), Avx4($intrinsic(self.1.0, other.1.0)))
                }
            }
        }
    )*};
}

operators!(
    Add, add, _mm256_add_pd;
    Sub, sub, _mm256_sub_pd;
    Mul, mul, _mm256_mul_pd;
    Div, div, _mm256_div_pd;
);

impl Neg for TwoAvx4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: there are registers only where the feature is there.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            let first = _mm256_xor_pd(self.0.0, sign);
            Self(Avx4(first), Avx4(_mm256_xor_pd(self.1.0, sign)))
        }
    }
}

impl AddAssign for TwoAvx4 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for TwoAvx4 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InstructionSet, Pack};

    /// Every operation once.
    #[inline(always)]
    fn every_operation<R: Real>(a: R, b: R) -> R {
        let (s, o) = (a * b).sin_cos();
        let mut sum = (a + s / b) * o;
        sum += (a * a).sqrt();
        sum -= -b.mul_add(R::constant(0.7), a);
        sum - a
    }

    #[target_feature(enable = "avx2,fma")]
    fn halves_are_registers(numbers: &[f64]) {
        let half = |at: usize| Avx4::gather(numbers, at);
        let found = every_operation(TwoAvx4(half(0), half(4)), TwoAvx4(half(8), half(12)));
        assert_eq!(found.0, every_operation(half(0), half(8)));
        assert_eq!(found.1, every_operation(half(4), half(12)));
        assert_ne!(found.0, found.1);
    }

    #[test]
    fn halves_are_what_each_would_be_alone() {
        if InstructionSet::of_this_processor() >= InstructionSet::Avx2 {
            let numbers: Vec<f64> = (0..16).map(|i| 0.3 + f64::from(i) * 1.7).collect();
            // SAFETY: the features are there.
            unsafe { halves_are_registers(&numbers) };
        }
    }
}
