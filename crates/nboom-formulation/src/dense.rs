//! Dense elimination without a search for pivots.

use nboom_scalar::Real;

/// Solves a square system given row by row, taking unknowns and equations in the same `order`.
pub(crate) fn solve<R: Real>(matrix: &[R], right: &[R], order: &[usize]) -> Vec<R> {
    let size = order.len();
    let mut rows = Vec::with_capacity(size * size);
    for &row in order {
        rows.extend(order.iter().map(|&column| matrix[row * size + column]));
    }
    let mut right: Vec<R> = order.iter().map(|&row| right[row]).collect();
    let mut inverse_pivots = Vec::with_capacity(size);
    for k in 0..size {
        let (done, below) = rows.split_at_mut((k + 1) * size);
        let pivot = &done[k * size..];
        let inverse = R::one() / pivot[k];
        inverse_pivots.push(inverse);
        let of_pivot = right[k];
        for (row, right) in below.chunks_exact_mut(size).zip(&mut right[k + 1..]) {
            let factor = row[k] * inverse;
            for (entry, &pivot) in row[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
                *entry -= factor * pivot;
            }
            *right -= factor * of_pivot;
        }
    }
    for k in (0..size).rev() {
        let mut left = right[k];
        for j in k + 1..size {
            left -= rows[k * size + j] * right[j];
        }
        right[k] = left * inverse_pivots[k];
    }
    let mut solution = right.clone();
    for (&unknown, value) in order.iter().zip(right) {
        solution[unknown] = value;
    }
    solution
}

/// Hinges from the last to the first, then the main body's force and moment rows.
///
/// In this order A and B are B₀ times a triangular matrix with a unit diagonal on the right:
/// their pivots are those of B₀, all positive, whatever ρ̄ and v̄ are.
pub(crate) fn hinges_first(size: usize) -> Vec<usize> {
    (6..size).rev().chain(0..6).collect()
}
