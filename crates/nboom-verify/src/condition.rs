use faer::linalg::solvers::DenseSolveCore;
use faer::{ColRef, Mat, Side};

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

/// A mass matrix, rows and columns divided by their [`sizes`]. Of a main body that is held, whose rows come first, only
/// hinges count.
pub(crate) struct Scaled<'a> {
    matrix: Mat<f64>,
    sizes: &'a [f64],
}

impl<'a> Scaled<'a> {
    /// Of a matrix given row by row.
    pub fn new(matrix: &[f64], sizes: &'a [f64], is_held: bool) -> Self {
        let (size, first) = (sizes.len(), if is_held { 6 } else { 0 });
        let sizes = &sizes[first..];
        let entry = |i: usize, j: usize| matrix[(first + i) * size + first + j];
        let scaled = |i: usize, j: usize| entry(i, j) / (sizes[i] * sizes[j]);
        Self { matrix: Mat::from_fn(sizes.len(), sizes.len(), scaled), sizes }
    }

    /// Its condition; infinite where it is not positive definite.
    pub fn condition(&self) -> f64 {
        if self.sizes.is_empty() {
            return 1.0;
        }
        // What is no number may have eigenvalues all the same.
        let is_positive = (0..self.sizes.len()).all(|i| self.matrix[(i, i)] > 0.0);
        if !(is_positive && self.matrix.is_all_finite()) {
            return f64::INFINITY;
        }
        match self.matrix.self_adjoint_eigenvalues(Side::Lower).as_deref() {
            Ok([least, .., largest]) if *least > 0.0 => largest / least,
            Ok([only]) if *only > 0.0 => 1.0,
            _ => f64::INFINITY,
        }
    }

    /// How much rounding is magnified in these accelerations, in terms of `scale`, if `right_sides` are so large; both in
    /// the order of all rows. Infinite where the matrix is not positive definite.
    ///
    /// In row j of the equations rounding is relative to the right side, and to an entry times an acceleration, dⱼ dₖ aₖ.
    /// The inverse matrix takes it to the accelerations.
    pub fn magnification(&self, accelerations: &[f64], right_sides: &[f64], scale: f64) -> f64 {
        if self.sizes.is_empty() {
            return 1.0;
        }
        let Ok(factored) = self.matrix.llt(Side::Lower) else { return f64::INFINITY };
        let first = accelerations.len() - self.sizes.len();
        let own = accelerations[first..].iter().zip(self.sizes).map(|(a, size)| a.abs() * size);
        let own: f64 = own.sum();
        let terms = right_sides[first..].iter().zip(self.sizes).map(|(u, size)| u / size + own);
        let (terms, inverse) = (terms.collect::<Vec<f64>>(), factored.inverse());
        let left = |column: ColRef<'_, f64>| -> f64 {
            column.iter().zip(&terms).map(|(entry, term)| entry.abs() * term).sum()
        };
        let left = inverse.col_iter().map(left).zip(self.sizes).map(|(left, size)| left / size);
        left.fold(0.0, f64::max) / scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn condition(matrix: &[f64], sizes: &[f64], is_held: bool) -> f64 {
        Scaled::new(matrix, sizes, is_held).condition()
    }

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
        // Divided, the matrix is [[1, 0.5], [0.5, 1]], and its inverse [[4, -2], [-2, 4]] / 3. Terms are 6 / 2 and 1 / 0.1,
        // each with 2 · 3 and 0.1 · 5: 9.5 and 16.5. They leave 71 / 3 and 85 / 3, 11.8 and 283 once divided.
        let sizes = [2.0, 0.1];
        let of = |is_held| {
            let first = if is_held { 6 } else { 0 };
            let size = first + 2;
            let mut matrix = vec![0.0; size * size];
            for (i, j, entry) in [(0, 0, 4.0), (0, 1, 0.1), (1, 0, 0.1), (1, 1, 0.01)] {
                matrix[(first + i) * size + first + j] = entry;
            }
            let all = |numbers: [f64; 2]| [&vec![0.0; first][..], &numbers].concat();
            let (sizes, accelerations) = (all(sizes), all([3.0, -5.0]));
            Scaled::new(&matrix, &sizes, is_held).magnification(
                &accelerations,
                &all([6.0, 1.0]),
                5.0,
            )
        };
        for is_held in [false, true] {
            assert!((of(is_held) - 850.0 / 3.0 / 5.0).abs() < 1e-12, "{}", of(is_held));
        }
        let none = Scaled::new(&[1.0, 2.0, 2.0, 1.0], &[1.0, 1.0], false);
        assert!(none.magnification(&[1.0, 1.0], &[1.0, 1.0], 1.0).is_infinite());
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
