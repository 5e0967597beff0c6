//! Symmetric positive definite equations, solved by L D Lᵀ.

use nboom_scalar::{Number, Real};

/// Turns the lower triangle of a matrix, given by its rows, into L below the diagonal; nothing else of
/// the rows counts.
#[inline(always)]
pub(crate) fn factor<R: Real, Row: AsRef<[R]> + AsMut<[R]>>(
    rows: &mut [Row],
    inverse_pivots: &mut [R],
) {
    for i in 0..rows.len() {
        let (above, rest) = rows.split_at_mut(i);
        let row = rest[0].as_mut();
        for (j, of_j) in above.iter().enumerate() {
            for k in 0..j {
                row[j] -= row[k] * of_j.as_ref()[k];
            }
        }
        for k in 0..i {
            let ratio = row[k] * inverse_pivots[k];
            row[i] -= row[k] * ratio;
            row[k] = ratio;
        }
        inverse_pivots[i] = R::one() / row[i];
    }
}

/// Turns `x` from the right side into the solution.
#[inline(always)]
pub(crate) fn solve<R: Real, Row: AsRef<[R]>>(lower: &[Row], inverse_pivots: &[R], x: &mut [R]) {
    for (i, row) in lower.iter().enumerate() {
        for k in 0..i {
            x[i] -= row.as_ref()[k] * x[k];
        }
    }
    for (x, &inverse) in x.iter_mut().zip(inverse_pivots) {
        *x = *x * inverse;
    }
    for i in (0..lower.len()).rev() {
        for k in i + 1..lower.len() {
            x[i] -= lower[k].as_ref()[i] * x[k];
        }
    }
}

/// Whether the matrix that was factored is positive definite, so that what it solves is a solution.
pub(crate) fn is_positive_definite<R: Number>(inverse_pivots: &[R]) -> bool {
    inverse_pivots.iter().map(|p| p.to_f64()).all(|p| p > 0.0 && p.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_equations() {
        let mut rows = [[4.0, 2.0, -2.0], [2.0, 5.0, 3.0], [-2.0, 3.0, 11.0]];
        let (mut inverse_pivots, mut x) = ([0.0; 3], [2.0, 21.0, 37.0]);
        factor(&mut rows, &mut inverse_pivots);
        solve(&rows, &inverse_pivots, &mut x);
        assert!(is_positive_definite(&inverse_pivots));
        assert_eq!(x, [1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_is_not_positive_definite_is_noticed() {
        let two = [[[0.0, 0.0], [0.0, 1.0]], [[1.0, 2.0], [2.0, 4.0]], [[1.0, 2.0], [2.0, 3.0]]];
        let not_a_number = [[1.0, 0.0], [0.0, f64::NAN]];
        for mut rows in two.into_iter().chain([not_a_number]) {
            let mut inverse_pivots = [0.0; 2];
            factor(&mut rows, &mut inverse_pivots);
            assert!(!is_positive_definite(&inverse_pivots), "{rows:?}");
        }
    }
}
