use nalgebra::DMatrix;

/// The condition of a positive definite matrix, given row by row, when its rows and columns are
/// scaled so that the diagonal is 1; infinite where it is not positive definite.
pub(crate) fn condition(matrix: &[f64]) -> f64 {
    let n = matrix.len().isqrt();
    let diagonal = |i: usize| matrix[i * n + i];
    let scaled = |i: usize, j: usize| matrix[i * n + j] / (diagonal(i) * diagonal(j)).sqrt();
    let scaled = DMatrix::from_fn(n, n, scaled);
    // What is no number would be iterated on for ever.
    if !((0..n).all(|i| diagonal(i) > 0.0) && scaled.iter().all(|x| x.is_finite())) {
        return f64::INFINITY;
    }
    let values = scaled.symmetric_eigenvalues();
    let (least, largest) = (values.min(), values.max());
    if least > 0.0 { largest / least } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_matrices_whose_condition_is_known() {
        // Scaled to diagonal 1 and 0.5 beside it: 1.5 and 0.5.
        assert!((condition(&[4.0, 3.0, 3.0, 9.0]) - 3.0).abs() < 1e-14);
        // 2 + 2 cos(k π / 4), halved.
        let expected = (2.0 + 2.0_f64.sqrt()) / (2.0 - 2.0_f64.sqrt());
        let found = condition(&[2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
        assert!((found - expected).abs() < 1e-13, "{found}");
        assert!((condition(&[3.0]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn of_what_is_not_positive_definite() {
        let broken = [[f64::NAN, 0.0, 0.0, 1.0], [1.0, f64::NAN, f64::NAN, 1.0]];
        for matrix in [[1.0, 2.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0]].into_iter().chain(broken) {
            assert!(condition(&matrix).is_infinite());
        }
    }
}
