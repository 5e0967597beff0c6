use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Real;
use crate::sine::sin_cos;

/// Several numbers that go through the same operations side by side.
///
/// Products and sums are fused ([`Real::mul_add`]), and sines come from a polynomial. Both pay
/// only in code compiled for a processor that fuses them. Operations of all lanes are written as
/// loops of fixed length, which the compiler turns into vector instructions of the widest kind it
/// may use.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Several<const N: usize>(pub [f64; N]);

impl<const N: usize> Several<N> {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| operation(self.0[i], other.0[i])))
    }
}

impl<const N: usize> Real for Several<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            (sines[i], cosines[i]) = sin_cos(self.0[i]);
        }
        (Self(sines), Self(cosines))
    }

    #[inline(always)]
    fn sin_cos_all<const M: usize>(angles: [Self; M]) -> [(Self, Self); M] {
        let (mut sines, mut cosines) = ([[0.0; N]; M], [[0.0; N]; M]);
        for i in 0..M {
            for j in 0..N {
                (sines[i][j], cosines[i][j]) = sin_cos(angles[i].0[j]);
            }
        }
        std::array::from_fn(|i| (Self(sines[i]), Self(cosines[i])))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].mul_add(factor.0[i], term.0[i])))
    }
}

impl<const N: usize> Add for Several<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Several<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Several<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for Several<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const N: usize> Neg for Several<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|a| -a))
    }
}

impl<const N: usize> AddAssign for Several<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for Several<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// A scalar that takes its values from, and gives its sum to, numbers of kind `S`.
///
/// A scalar does so one to one; [`Several`] takes neighbouring `f64` into neighbouring lanes.
pub trait Pack<S>: Real {
    /// The number at `at`, or the lanes from there on.
    fn gather(from: &[S], at: usize) -> Self;

    /// What [`gather`](Self::gather) reads at `at`, `at + stride`, and so on.
    ///
    /// A loop rather than a closure over an array: a closure need not be inlined, and code
    /// that is not cannot use the processor features of its caller.
    #[inline(always)]
    fn gather_all<const N: usize>(from: &[S], at: usize, stride: usize) -> [Self; N] {
        let mut all = [Self::zero(); N];
        for i in 0..N {
            all[i] = Self::gather(from, at + i * stride);
        }
        all
    }

    /// The number at `at`, or the lanes from there on, each `apart` places after the one before.
    fn gather_apart(from: &[S], at: usize, apart: usize) -> Self;

    /// One number in every lane.
    fn spread(value: S) -> Self;

    /// Each number in every lane.
    #[inline(always)]
    fn spread_all<const N: usize>(values: [S; N]) -> [Self; N]
    where
        S: Copy,
    {
        let mut all = [Self::zero(); N];
        for i in 0..N {
            all[i] = Self::spread(values[i]);
        }
        all
    }

    /// Writes what [`gather`](Self::gather) would read.
    fn scatter(self, to: &mut [S], at: usize);

    /// Writes what [`gather_all`](Self::gather_all) would read.
    #[inline(always)]
    fn scatter_all<const N: usize>(all: [Self; N], to: &mut [S], at: usize, stride: usize) {
        for i in 0..N {
            all[i].scatter(to, at + i * stride);
        }
    }

    /// Writes what [`gather_apart`](Self::gather_apart) would read.
    fn scatter_apart(self, to: &mut [S], at: usize, apart: usize);

    /// The sum of the lanes.
    fn sum(self) -> S;
}

impl<R: Real> Pack<R> for R {
    #[inline(always)]
    fn gather(from: &[R], at: usize) -> Self {
        from[at]
    }

    #[inline(always)]
    fn gather_apart(from: &[R], at: usize, _apart: usize) -> Self {
        from[at]
    }

    #[inline(always)]
    fn spread(value: R) -> Self {
        value
    }

    #[inline(always)]
    fn scatter(self, to: &mut [R], at: usize) {
        to[at] = self;
    }

    #[inline(always)]
    fn scatter_apart(self, to: &mut [R], at: usize, _apart: usize) {
        to[at] = self;
    }

    #[inline(always)]
    fn sum(self) -> R {
        self
    }
}

impl<const N: usize> Pack<f64> for Several<N> {
    #[inline(always)]
    fn gather(from: &[f64], at: usize) -> Self {
        let lanes: &[f64; N] = from[at..at + N].try_into().expect("N numbers from N places");
        Self(*lanes)
    }

    #[inline(always)]
    fn gather_apart(from: &[f64], at: usize, apart: usize) -> Self {
        let mut lanes = [0.0; N];
        for i in 0..N {
            lanes[i] = from[at + i * apart];
        }
        Self(lanes)
    }

    #[inline(always)]
    fn spread(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn scatter(self, to: &mut [f64], at: usize) {
        to[at..at + N].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn scatter_apart(self, to: &mut [f64], at: usize, apart: usize) {
        for i in 0..N {
            to[at + i * apart] = self.0[i];
        }
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        self.0.iter().sum()
    }
}
