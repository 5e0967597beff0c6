use nalgebra::DMatrix;

/// The condition of a mass matrix, given row by row, when its rows and columns are scaled so that the diagonal is 1;
/// infinite where it is not positive definite. Of a main body that is held, whose rows come first, only hinges count.
pub(crate) fn condition(matrix: &[f64], is_held: bool) -> f64 {
    let (size, first) = (matrix.len().isqrt(), if is_held { 6 } else { 0 });
    let n = size - first;
    if n == 0 {
        return 1.0;
    }
    let entry = |i: usize, j: usize| matrix[(first + i) * size + first + j];
    let diagonal = |i: usize| entry(i, i);
    let scaled = |i: usize, j: usize| entry(i, j) / (diagonal(i) * diagonal(j)).sqrt();
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
        assert!((condition(&[4.0, 3.0, 3.0, 9.0], false) - 3.0).abs() < 1e-14);
        // 2 + 2 cos(k π / 4), halved.
        let expected = (2.0 + 2.0_f64.sqrt()) / (2.0 - 2.0_f64.sqrt());
        let found = condition(&[2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0], false);
        assert!((found - expected).abs() < 1e-13, "{found}");
        assert!((condition(&[3.0], false) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_main_body_that_is_held_does_not_count() {
        let mut matrix = vec![0.0; 64];
        for (at, entry) in [(54, 4.0), (55, 3.0), (62, 3.0), (63, 9.0)] {
            matrix[at] = entry;
        }
        assert!((condition(&matrix, true) - 3.0).abs() < 1e-14);
        assert!(condition(&matrix, false).is_infinite());
        assert_eq!(condition(&[0.0; 36], true), 1.0);
    }

    #[test]
    fn of_what_is_not_positive_definite() {
        let broken = [[f64::NAN, 0.0, 0.0, 1.0], [1.0, f64::NAN, f64::NAN, 1.0]];
        for matrix in [[1.0, 2.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0]].into_iter().chain(broken) {
            assert!(condition(&matrix, false).is_infinite());
        }
    }
}
