//! Dense linear systems over real or complex numbers.
//!
//! LU factors by faer, substitution by columns of our own: faer's takes half as long again for a
//! dozen unknowns, which slows runs with two stiff hinges (docs/decisions/0007-linear-algebra.md).

use std::mem::MaybeUninit;
use std::ops::{Div, Mul, Sub};
use std::thread::{self, ThreadId};

use faer::dyn_stack::MemStack;
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::prelude::default;
use faer::traits::ComplexField;
use faer::traits::ext::ComplexFieldExt;
use faer::{MatMut, Par};

/// A square matrix as the product of triangular ones, with rows exchanged.
///
/// Storage is kept from one matrix to the next, as steps must not allocate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lu<F> {
    size: usize,
    /// Both factors in one, column by column; the lower factor's ones are left out.
    factors: Vec<F>,
    /// For each row of the factors the row of the matrix that it was, and the other way round.
    was: Vec<usize>,
    becomes: Vec<usize>,
    scratch: Vec<MaybeUninit<u8>>,
    solution: Vec<F>,
    /// The thread that room was made in.
    made_in: Option<ThreadId>,
}

impl<F> Lu<F>
where
    F: ComplexField<Real = f64> + Copy + Sub<Output = F> + Mul<Output = F> + Div<Output = F>,
{
    /// Makes room for matrices of `size` rows.
    pub fn resize(&mut self, size: usize) {
        let here = thread::current().id();
        if self.size == size && self.made_in == Some(here) {
            return;
        }
        (self.size, self.made_in) = (size, Some(here));
        for (buffer, len) in [(&mut self.factors, size * size), (&mut self.solution, size)] {
            buffer.clear();
            buffer.resize(len, F::zero());
        }
        for rows in [&mut self.was, &mut self.becomes] {
            rows.clear();
            rows.resize(size, 0);
        }
        let needed = lu_in_place_scratch::<usize, F>(size, size, Par::Seq, default());
        self.scratch.resize(needed.unaligned_bytes_required(), MaybeUninit::uninit());
        // The first product of large blocks in a thread allocates; it is in here.
        self.factor(|i, j| if i == j { F::one() } else { F::zero() });
    }

    /// Factors the matrix with these entries; `false` when it is singular or not finite.
    pub fn factor(&mut self, entry: impl Fn(usize, usize) -> F) -> bool {
        let Self { size, factors, was, becomes, scratch, .. } = self;
        let n = *size;
        for (at, a) in factors.iter_mut().enumerate() {
            *a = entry(at % n, at / n);
        }
        let matrix = MatMut::from_column_major_slice_mut(factors, n, n);
        lu_in_place(matrix, was, becomes, Par::Seq, MemStack::new(scratch), default());
        // What is not finite anywhere has reached a pivot.
        let mut pivots = (0..n).map(|k| factors[k * n + k].abs1());
        pivots.all(|pivot| pivot > 0.0 && pivot.is_finite())
    }

    /// Replaces the right side `b` by the solution.
    pub fn solve(&mut self, b: &mut [F]) {
        let Self { size, factors, was, solution: x, .. } = self;
        let column = |k: usize| &factors[k * *size..][..*size];
        for (x, &row) in x.iter_mut().zip(&*was) {
            *x = b[row];
        }
        for k in 0..*size {
            let known = x[k];
            subtract(&mut x[k + 1..], &column(k)[k + 1..], known);
        }
        for k in (0..*size).rev() {
            let known = x[k] / column(k)[k];
            x[k] = known;
            subtract(&mut x[..k], &column(k)[..k], known);
        }
        b.copy_from_slice(x);
    }
}

/// Takes `factor` times a column off `from`.
fn subtract<F: Copy + Sub<Output = F> + Mul<Output = F>>(from: &mut [F], column: &[F], factor: F) {
    for (x, a) in from.iter_mut().zip(column) {
        *x = *x - *a * factor;
    }
}

#[cfg(test)]
mod tests {
    use faer::c64;

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
        let matrix =
            [[c64::new(0.0, 1.0), c64::new(1.0, 0.0)], [c64::new(2.0, 0.0), c64::new(1.0, 1.0)]];
        let mut lu = Lu::default();
        lu.resize(2);
        assert!(lu.factor(|i, j| matrix[i][j]));
        let mut b = [c64::new(3.0, 4.0), c64::new(1.0, 3.0)];
        lu.solve(&mut b);
        let difference = [b[0] - c64::new(1.0, -1.0), b[1] - c64::new(2.0, 3.0)];
        assert!(difference.iter().all(|d| d.norm() < 1e-15), "{b:?}");
    }

    /// Tridiagonal with 2 + 2i in the diagonal and −1 beside it, rows in reverse, times ones: large
    /// enough to be factored block by block.
    #[test]
    fn large_solutions_solve() {
        let n = 203;
        let entry = |i: usize, j: usize| match (n - 1 - i).abs_diff(j) {
            0 => c64::new(2.0, 2.0),
            1 => c64::new(-1.0, 0.0),
            _ => c64::new(0.0, 0.0),
        };
        let mut lu = Lu::default();
        lu.resize(n);
        assert!(lu.factor(entry));
        let mut b: Vec<c64> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).sum()).collect();
        lu.solve(&mut b);
        // The condition is below 4.
        assert!(b.iter().all(|x| (x - 1.0).norm() < 1e-14), "{b:?}");
    }

    #[test]
    fn nothing_is_solved() {
        let mut lu = Lu::<f64>::default();
        lu.resize(0);
        assert!(lu.factor(|_, _| 1.0));
        lu.solve(&mut []);
    }

    #[test]
    fn singular_and_broken_matrices_are_refused() {
        let mut lu = Lu::default();
        lu.resize(2);
        assert!(!lu.factor(|_, j| j as f64));
        assert!(!lu.factor(|i, _| (i + 1) as f64));
        assert!(!lu.factor(|_, _| f64::NAN));
        for at in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            assert!(
                !lu.factor(|i, j| if (i, j) == at { f64::NAN } else { (2 * i + j) as f64 }),
                "{at:?}"
            );
        }
    }
}
