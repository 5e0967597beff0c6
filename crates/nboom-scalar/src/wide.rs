//! Lanes in vector registers.
//!
//! The compiler does not reliably turn long straight lines of array arithmetic into vector
//! code; held in registers from the start, the same source runs four to six times faster.
//!
//! The intrinsics need a processor feature. Whoever has a value may use them: all values come from
//! `constant`, from `gather`, from memory by `as_registers`, or from other values. Code that makes the
//! first one runs only after the processor was asked, in
//! [`Compiled`](crate::compiled::Compiled) and [`in_vector_registers`](crate::in_vector_registers);
//! builds with assertions ask once more.
#![allow(unsafe_code, reason = "vector intrinsics; see above")]

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::sine::{COSINE, HALF_PI, SINE, TO_INTEGER, TWO_OVER_PI};
use crate::{InstructionSet, Pack, Real};

pub(crate) use two_registers::TwoAvx4;

mod two_registers;

macro_rules! wide {
    (
        $(#[$doc:meta])* $name:ident, $set:ident, $register:ty, $lanes:literal,
        $load:ident, $store:ident, $splat:ident,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $fma:ident, $fnma:ident,
        $to_bits:ident, $from_bits:ident, $splat_bits:ident,
        $and:ident, $xor:ident, $add_bits:ident, $sub_bits:ident, $shift:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub(crate) struct $name($register);

        impl $name {
            /// Whether the feature is there.
            fn may_exist() -> bool {
                InstructionSet::of_this_processor() >= InstructionSet::$set
            }

            #[inline(always)]
            fn to_array(self) -> [f64; $lanes] {
                let mut lanes = [0.0; $lanes];
                // SAFETY: the array has room for every lane.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
                lanes
            }

            #[inline(always)]
            fn horner(self, coefficients: [f64; 6]) -> Self {
                let mut sum = Self::constant(coefficients[0]);
                for i in 1..6 {
                    sum = sum.mul_add(self, Self::constant(coefficients[i]));
                }
                sum
            }
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }

        impl Real for $name {
            #[inline(always)]
            fn constant(value: f64) -> Self {
                debug_assert!(Self::may_exist());
                // SAFETY: this type is named only where the feature is there.
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let shifted = self.mul_add(Self::constant(TWO_OVER_PI), Self::constant(TO_INTEGER));
                let quarters = shifted - Self::constant(TO_INTEGER);
                let mut r = self;
                for i in 0..3 {
                    // SAFETY: as for `constant`.
                    r = Self(unsafe { $fnma(quarters.0, Self::constant(HALF_PI[i]).0, r.0) });
                }
                let z = r * r;
                let sine = (r * z).mul_add(z.horner(SINE), r);
                let half = z.mul_add(Self::constant(-0.5), Self::one());
                let cosine = (z * z).mul_add(z.horner(COSINE), half);
                // SAFETY: as for `constant`.
                unsafe {
                    let quadrant = $to_bits(shifted.0);
                    let (s, c) = ($to_bits(sine.0), $to_bits(cosine.0));
                    let (one, two) = ($splat_bits(1), $splat_bits(2));
                    let odd = $sub_bits($splat_bits(0), $and(quadrant, one));
                    let swapped = $and($xor(s, c), odd);
                    let sine_sign = $shift::<62>($and(quadrant, two));
                    let cosine_sign = $shift::<62>($and($add_bits(quadrant, one), two));
                    let sine = $xor($xor(s, swapped), sine_sign);
                    let cosine = $xor($xor(c, swapped), cosine_sign);
                    (Self($from_bits(sine)), Self($from_bits(cosine)))
                }
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $fma(self.0, factor.0, term.0) })
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $add(self.0, other.0) })
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $sub(self.0, other.0) })
            }
        }

        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $mul(self.0, other.0) })
            }
        }

        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: as for `constant`.
                Self(unsafe { $div(self.0, other.0) })
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: as for `constant`.
                unsafe {
                    let sign = $to_bits($splat(-0.0));
                    Self($from_bits($xor($to_bits(self.0), sign)))
                }
            }
        }

        impl AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl SubAssign for $name {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl Pack<f64> for $name {
            #[inline(always)]
            fn gather(from: &[f64], at: usize) -> Self {
                let lanes = &from[at..at + $lanes];
                debug_assert!(Self::may_exist());
                // SAFETY: as for `constant`, and the slice has as many numbers as there are lanes.
                Self(unsafe { $load(lanes.as_ptr()) })
            }

            #[inline(always)]
            fn gather_apart(from: &[f64], at: usize, apart: usize) -> Self {
                // Zeros to begin with would be written by a call.
                let lanes: [f64; $lanes] = std::array::from_fn(|i| from[at + i * apart]);
                Self::gather(&lanes, 0)
            }

            #[inline(always)]
            fn spread(value: f64) -> Self {
                Self::constant(value)
            }

            #[inline(always)]
            fn scatter(self, to: &mut [f64], at: usize) {
                let lanes = &mut to[at..at + $lanes];
                // SAFETY: the slice has as many places as there are lanes.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
            }

            #[inline(always)]
            fn scatter_apart(self, to: &mut [f64], at: usize, apart: usize) {
                let lanes = self.to_array();
                for i in 0..$lanes {
                    to[at + i * apart] = lanes[i];
                }
            }

            #[inline(always)]
            fn sum(self) -> f64 {
                let lanes = self.to_array();
                let (low, high) = lanes.split_at($lanes / 2);
                low.iter().zip(high).map(|(a, b)| a + b).sum()
            }
        }
    };
}

wide!(
    /// Two lanes in half an AVX register.
    AvxHalf, Avx2, __m128d, 2,
    _mm_loadu_pd, _mm_storeu_pd, _mm_set1_pd,
    _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_sqrt_pd,
    _mm_fmadd_pd, _mm_fnmadd_pd,
    _mm_castpd_si128, _mm_castsi128_pd, _mm_set1_epi64x,
    _mm_and_si128, _mm_xor_si128, _mm_add_epi64, _mm_sub_epi64, _mm_slli_epi64
);

wide!(
    /// Four lanes in an AVX register.
    Avx4, Avx2, __m256d, 4,
    _mm256_loadu_pd, _mm256_storeu_pd, _mm256_set1_pd,
    _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd,
    _mm256_fmadd_pd, _mm256_fnmadd_pd,
    _mm256_castpd_si256, _mm256_castsi256_pd, _mm256_set1_epi64x,
    _mm256_and_si256, _mm256_xor_si256, _mm256_add_epi64, _mm256_sub_epi64, _mm256_slli_epi64
);

wide!(
    /// Eight lanes in an AVX-512 register.
    Avx8, Avx512, __m512d, 8,
    _mm512_loadu_pd, _mm512_storeu_pd, _mm512_set1_pd,
    _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_sqrt_pd,
    _mm512_fmadd_pd, _mm512_fnmadd_pd,
    _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_set1_epi64,
    _mm512_and_si512, _mm512_xor_si512, _mm512_add_epi64, _mm512_sub_epi64, _mm512_slli_epi64
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Several;

    /// Every operation once, on numbers that differ from lane to lane.
    #[inline(always)]
    fn every_operation<P: Pack<f64>>(numbers: &[f64], out: &mut [f64]) {
        let (a, b, c) = (P::gather(numbers, 0), P::gather(numbers, 8), P::spread(numbers[3]));
        let (s, o) = (a * c).sin_cos();
        let mut sum = (a + b * c - s / b) * o;
        sum += (a * a).sqrt();
        sum -= -b.mul_add(c, a);
        sum.scatter(out, 0);
        out[8] = sum.sum();
        P::gather_apart(numbers, 1, 2).scatter_apart(out, 9, 3);
    }

    #[target_feature(enable = "avx2,fma")]
    fn in_half_avx(numbers: &[f64], out: &mut [f64]) {
        every_operation::<AvxHalf>(numbers, out);
    }

    #[target_feature(enable = "avx2,fma")]
    fn in_avx4(numbers: &[f64], out: &mut [f64]) {
        every_operation::<Avx4>(numbers, out);
    }

    #[target_feature(enable = "avx512f,avx2,fma")]
    fn in_avx8(numbers: &[f64], out: &mut [f64]) {
        every_operation::<Avx8>(numbers, out);
    }

    fn numbers() -> Vec<f64> {
        (0..16).map(|i| 0.3 + f64::from(i) * 1.7).collect()
    }

    #[test]
    fn registers_compute_what_arrays_do() {
        let (mut expected, mut found) = ([0.0; 31], [0.0; 31]);
        if AvxHalf::may_exist() {
            every_operation::<Several<2>>(&numbers(), &mut expected);
            // SAFETY: the features are there.
            unsafe { in_half_avx(&numbers(), &mut found) };
            assert_eq!(found, expected);
        }
        if Avx4::may_exist() {
            every_operation::<Several<4>>(&numbers(), &mut expected);
            // SAFETY: the features are there.
            unsafe { in_avx4(&numbers(), &mut found) };
            assert_eq!(found[..4], expected[..4]);
            assert!((found[8] - expected[8]).abs() < 1e-14 * expected[8].abs());
            assert_eq!(found[9..], expected[9..]);
        }
        if Avx8::may_exist() {
            every_operation::<Several<8>>(&numbers(), &mut expected);
            // SAFETY: the feature is there, and AVX2 and FMA with it.
            unsafe { in_avx8(&numbers(), &mut found) };
            assert_eq!(found[..8], expected[..8]);
            assert!((found[8] - expected[8]).abs() < 1e-14 * expected[8].abs());
            assert_eq!(found[9..], expected[9..]);
        }
    }
}
