use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::sine::sin_cos;
use crate::{Pack, Real};

/// One number in code that is compiled for a processor that fuses products and sums.
///
/// It computes what a lane of [`Several`](crate::Several) does, without the array around it: a routine is
/// thousands of operations in a row, and a compiler takes half as long when each is one instruction
/// to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(crate) struct Fused(f64);

impl Real for Fused {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = sin_cos(self.0);
        (Self(sine), Self(cosine))
    }

    /// One loop over numbers, which the compiler turns into vector code.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            (sines[i], cosines[i]) = sin_cos(angles[i].0);
        }
        std::array::from_fn(|i| (Self(sines[i]), Self(cosines[i])))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add(factor.0, term.0))
    }
}

impl Add for Fused {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Fused {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Fused {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for Fused {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl AddAssign for Fused {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl SubAssign for Fused {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        self.0 -= other.0;
    }
}

impl Pack<f64> for Fused {
    #[inline(always)]
    fn gather(from: &[f64], at: usize) -> Self {
        Self(from[at])
    }

    #[inline(always)]
    fn gather_apart(from: &[f64], at: usize, _apart: usize) -> Self {
        Self(from[at])
    }

    #[inline(always)]
    fn spread(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn scatter(self, to: &mut [f64], at: usize) {
        to[at] = self.0;
    }

    #[inline(always)]
    fn scatter_apart(self, to: &mut [f64], at: usize, _apart: usize) {
        to[at] = self.0;
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Several;

    /// Every operation once.
    fn every_operation<P: Pack<f64>>(numbers: &[f64], out: &mut [f64]) {
        let (a, b) = (P::gather(numbers, 0), P::gather_apart(numbers, 1, 7));
        let c = P::spread(numbers[2]);
        let (s, o) = (a * c).sin_cos();
        let mut sum = (a + b * c - s / b) * o;
        sum += (a * a).sqrt() * P::constant(0.7);
        sum -= -b.mul_add(c, a);
        sum.scatter(out, 0);
        sum.scatter_apart(out, 1, 5);
        let of_two = P::sin_cos_all([a, sum]);
        out[2] = sum.sum();
        of_two.iter().enumerate().for_each(|(i, pair)| {
            pair.0.scatter(out, 3 + 2 * i);
            pair.1.scatter(out, 4 + 2 * i);
        });
    }

    #[test]
    fn it_computes_what_a_lane_does() {
        let numbers = [0.3, -1.9, 40.0];
        let (mut expected, mut found) = ([0.0; 7], [0.0; 7]);
        every_operation::<Several<1>>(&numbers, &mut expected);
        every_operation::<Fused>(&numbers, &mut found);
        assert_eq!(found, expected);
        assert!(found.iter().all(|number| *number != 0.0));
    }
}
