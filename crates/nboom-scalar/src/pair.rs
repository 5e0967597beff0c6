use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Real;

/// Two scalars that go through the same operations side by side, each rounding as it would alone.
///
/// Pairs of pairs of `f64` hold several states where there are no registers to use.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Pair<R>(pub(crate) R, pub(crate) R);

impl<R: Real> Real for Pair<R> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(R::constant(value), R::constant(value))
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
        Self(self.0.mul_add(factor.0, term.0), self.1.mul_add(factor.1, term.1))
    }
}

impl<R: Real> Add for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<R: Real> Sub for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<R: Real> Mul for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.1)
    }
}

impl<R: Real> Div for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0, self.1 / other.1)
    }
}

impl<R: Real> Neg for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<R: Real> AddAssign for Pair<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> SubAssign for Pair<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation once.
    fn every_operation<R: Real>(a: R, b: R) -> R {
        let (s, o) = (a * b).sin_cos();
        let mut sum = (a + s / b) * o;
        sum += (a * a).sqrt();
        sum -= -b.mul_add(R::constant(0.7), a);
        sum - a
    }

    #[test]
    fn halves_are_what_each_would_be_alone() {
        let (a, b) = (Pair(0.3, -1.9), Pair(2.6, 40.0));
        let expected = Pair(every_operation(a.0, b.0), every_operation(a.1, b.1));
        assert_eq!(every_operation(a, b), expected);
        assert_ne!(expected.0, expected.1);
    }
}
