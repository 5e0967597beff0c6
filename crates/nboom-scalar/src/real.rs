use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::DoubleDouble;

/// A scalar that equations of motion can be evaluated on.
///
/// Implementations may record, carry derivatives or hold several states at once, so the trait
/// has no comparison: code written over it never branches on a value.
pub trait Real:
    Copy
    + Debug
    + PartialEq
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// The scalar that holds the constant `value`.
    fn constant(value: f64) -> Self;

    /// Square root; the argument is not negative.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle \[rad\].
    fn sin_cos(self) -> (Self, Self);

    /// Sines and cosines of several angles at once.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut pairs = [(Self::zero(), Self::zero()); N];
        for i in 0..N {
            pairs[i] = angles[i].sin_cos();
        }
        pairs
    }

    /// `self · factor + term`; scalars that can, round once.
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// Says what the operations that follow compute. Scalars that record write it down; it is
    /// nothing to all others.
    #[inline(always)]
    fn remark(_words: impl FnOnce() -> String) {}

    /// The constant zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    /// The constant one.
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0)
    }
}

/// A scalar that holds one number, so that code may look at it and branch.
pub trait Number: Real {
    /// The nearest `f64`.
    fn to_f64(self) -> f64;
}

impl Number for f64 {
    fn to_f64(self) -> f64 {
        self
    }
}

impl Number for DoubleDouble {
    fn to_f64(self) -> f64 {
        self.high()
    }
}

impl Real for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
}
