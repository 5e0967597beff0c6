use nalgebra::DMatrix;

/// What rounding in the entries of a mass matrix is relative to, for each row: √ of the inertia that the row's
/// direction moves, in whichever direction that is largest.
///
/// A body that is turned to other axes has rounding of its largest moment of inertia in all entries. About a hinge along
/// a slender body that is much of the diagonal entry.
pub(crate) fn sizes(matrix: &[f64], of_hinges: impl Iterator<Item = f64>) -> Vec<f64> {
    let size = matrix.len().isqrt();
    let diagonal = |i: usize| matrix[i * size + i];
    let turned = 0.5 * (diagonal(3) + diagonal(4) + diagonal(5));
    let moved = [diagonal(0); 3].into_iter().chain([turned; 3]).chain(of_hinges);
    moved.map(f64::sqrt).collect()
}

/// The condition of a mass matrix, given row by row, when its rows and columns are divided by these `sizes`; infinite
/// where it is not positive definite. Of a main body that is held, whose rows come first, only hinges count.
pub(crate) fn condition(matrix: &[f64], sizes: &[f64], is_held: bool) -> f64 {
    let (size, first) = (sizes.len(), if is_held { 6 } else { 0 });
    let n = size - first;
    if n == 0 {
        return 1.0;
    }
    let entry = |i: usize, j: usize| matrix[(first + i) * size + first + j];
    let scaled = |i: usize, j: usize| entry(i, j) / (sizes[first + i] * sizes[first + j]);
    let scaled = DMatrix::from_fn(n, n, scaled);
    // What is no number would be iterated on for ever.
    if !((0..n).all(|i| entry(i, i) > 0.0) && scaled.iter().all(|x| x.is_finite())) {
        return f64::INFINITY;
    }
    let values = scaled.symmetric_eigenvalues();
    let (least, largest) = (values.min(), values.max());
    if least > 0.0 { largest / least } else { f64::INFINITY }
}

/// How much rounding is magnified in accelerations that are compared with one of this `scale`. `terms` are what the right
/// sides and the accelerations themselves come to in each row, in terms of the root of the inertia that it moves.
///
/// Rounding is relative to the largest term and magnified by the condition; where little moves, much of it is left of an
/// acceleration.
pub(crate) fn magnification(
    condition: f64,
    sizes: &[f64],
    terms: impl Iterator<Item = f64>,
    scale: f64,
) -> f64 {
    let least = sizes.iter().copied().filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min);
    condition * (terms.fold(0.0, f64::max) / (least * scale)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_matrices_whose_condition_is_known() {
        // Divided to diagonal 1 and 0.5 beside it: 1.5 and 0.5.
        assert!((condition(&[4.0, 3.0, 3.0, 9.0], &[2.0, 3.0], false) - 3.0).abs() < 1e-14);
        // 2 + 2 cos(k π / 4), halved.
        let expected = (2.0 + 2.0_f64.sqrt()) / (2.0 - 2.0_f64.sqrt());
        let chain = [2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0];
        let found = condition(&chain, &[1.0; 3], false);
        assert!((found - expected).abs() < 1e-13, "{found}");
        assert!((condition(&[3.0], &[7.0], false) - 1.0).abs() < 1e-15);
        // What turns a slender body about itself is small beside what the body's rounding is relative to.
        assert!((condition(&[4.0, 0.0, 0.0, 1e-4], &[2.0, 1.0], false) - 1e4).abs() < 1e-8);
    }

    #[test]
    fn what_is_light_shows_rounding_of_what_is_heavy() {
        let of = |sizes: &[f64]| magnification(30.0, sizes, [2.0, 8.0].into_iter(), 2.0);
        assert_eq!([of(&[4.0, 4.0]), of(&[4.0, 0.5]), of(&[0.0, 0.5])], [30.0, 240.0, 240.0]);
    }

    #[test]
    fn sizes_are_those_of_what_moves() {
        let mut matrix = vec![0.0; 49];
        for (i, entry) in [5.0, 5.0, 5.0, 1.0, 7.0, 8.0, 0.1].into_iter().enumerate() {
            matrix[8 * i] = entry;
        }
        let expected = [5.0, 5.0, 5.0, 8.0, 8.0, 8.0, 4.0].map(f64::sqrt);
        assert_eq!(sizes(&matrix, [4.0].into_iter()), expected);
    }

    #[test]
    fn a_main_body_that_is_held_does_not_count() {
        let mut matrix = vec![0.0; 64];
        for (at, entry) in [(54, 4.0), (55, 3.0), (62, 3.0), (63, 9.0)] {
            matrix[at] = entry;
        }
        let sizes = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 3.0];
        assert!((condition(&matrix, &sizes, true) - 3.0).abs() < 1e-14);
        assert!(condition(&matrix, &sizes, false).is_infinite());
        assert_eq!(condition(&[0.0; 36], &[0.0; 6], true), 1.0);
    }

    #[test]
    fn of_what_is_not_positive_definite() {
        let broken = [[f64::NAN, 0.0, 0.0, 1.0], [1.0, f64::NAN, f64::NAN, 1.0]];
        for matrix in [[1.0, 2.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0]].into_iter().chain(broken) {
            assert!(condition(&matrix, &[1.0; 2], false).is_infinite());
        }
    }
}
