//! Dense linear systems over real or complex numbers.
//!
//! nalgebra's LU takes its matrix by value and makes a permutation anew each time; this one
//! keeps its storage, as steps must not allocate.

use std::ops::{Div, Mul, Sub};

/// What a matrix may consist of.
pub(crate) trait Field:
    Copy + Default + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A magnitude to choose pivots by.
    fn size(self) -> f64;
}

impl Field for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / (other.re * other.re + other.im * other.im);
        self * Self { re: other.re * inverse, im: -other.im * inverse }
    }
}

impl Field for Complex {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// A square matrix as the product of triangular ones, with rows exchanged.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lu<F> {
    size: usize,
    /// Row by row; the lower factor's ones are left out.
    entries: Vec<F>,
    /// The row that row i was exchanged with in turn i.
    pivots: Vec<usize>,
}

impl<F: Field> Lu<F> {
    /// Makes room for matrices of `size` rows.
    pub fn resize(&mut self, size: usize) {
        self.size = size;
        self.entries.clear();
        self.entries.resize(size * size, F::default());
        self.pivots.clear();
        self.pivots.resize(size, 0);
    }

    /// Factors the matrix with these entries; `false` when it is singular or not finite.
    pub fn factor(&mut self, entry: impl Fn(usize, usize) -> F) -> bool {
        let n = self.size;
        for (at, a) in self.entries.iter_mut().enumerate() {
            *a = entry(at / n, at % n);
        }
        (0..n).all(|k| self.eliminate(k))
    }

    fn eliminate(&mut self, k: usize) -> bool {
        let n = self.size;
        let size_of = |&i: &usize| self.entries[i * n + k].size();
        let pivot = (k..n).max_by(|a, b| size_of(a).total_cmp(&size_of(b))).unwrap_or(k);
        let size = size_of(&pivot);
        if size == 0.0 || !size.is_finite() {
            return false;
        }
        self.pivots[k] = pivot;
        for j in 0..n {
            self.entries.swap(k * n + j, pivot * n + j);
        }
        let (above, below) = self.entries.split_at_mut((k + 1) * n);
        let pivot_row = &above[k * n..];
        for row in below.chunks_exact_mut(n).filter(|row| row[k].size() != 0.0) {
            let factor = row[k] / pivot_row[k];
            row[k] = factor;
            for j in k + 1..n {
                row[j] = row[j] - factor * pivot_row[j];
            }
        }
        true
    }

    /// Replaces the right side `b` by the solution.
    pub fn solve(&self, b: &mut [F]) {
        let n = self.size;
        for k in 0..n {
            b.swap(k, self.pivots[k]);
        }
        for i in 0..n {
            b[i] = self.without(i, 0..i, b);
        }
        for i in (0..n).rev() {
            b[i] = self.without(i, i + 1..n, b) / self.entries[i * n + i];
        }
    }

    /// b_i less what row `i` makes of the other entries `of` it.
    fn without(&self, i: usize, of: std::ops::Range<usize>, b: &[F]) -> F {
        let row = &self.entries[i * self.size..][..self.size];
        of.fold(b[i], |rest, j| rest - row[j] * b[j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_solve() {
        // The first pivot is zero, so that rows must be exchanged.
        let matrix = [[0.0, 2.0, 1.0], [4.0, -1.0, 0.5], [1.0, 3.0, -2.0]];
        let expected = [1.5, -0.25, 3.0];
        let mut lu = Lu::default();
        lu.resize(3);
        assert!(lu.factor(|i, j| matrix[i][j]));
        let mut b = matrix.map(|row| row.iter().zip(expected).map(|(a, x)| a * x).sum::<f64>());
        lu.solve(&mut b);
        assert!(b.iter().zip(expected).all(|(b, x)| (b - x).abs() < 1e-15), "{b:?}");
    }

    #[test]
    fn complex_solutions_solve() {
        // (i, 1; 2, 1 + i) (1 - i, 2 + 3i) = (3 + 4i, 1 + 3i)
        let complex = |re, im| Complex { re, im };
        let matrix =
            [[complex(0.0, 1.0), complex(1.0, 0.0)], [complex(2.0, 0.0), complex(1.0, 1.0)]];
        let mut lu = Lu::default();
        lu.resize(2);
        assert!(lu.factor(|i, j| matrix[i][j]));
        let mut b = [complex(3.0, 4.0), complex(1.0, 3.0)];
        lu.solve(&mut b);
        let difference = [b[0] - complex(1.0, -1.0), b[1] - complex(2.0, 3.0)];
        assert!(difference.iter().all(|d| d.size() < 1e-15), "{b:?}");
    }

    #[test]
    fn singular_and_broken_matrices_are_refused() {
        let mut lu = Lu::default();
        lu.resize(2);
        assert!(!lu.factor(|_, j| j as f64));
        assert!(!lu.factor(|i, _| (i + 1) as f64));
        assert!(!lu.factor(|_, _| f64::NAN));
    }
}
