use std::ops::{Add, Div, Mul, Range, Sub};

use faer::traits::ComplexField;

use super::iteration_matrix::Derivatives;
use crate::linear::Lu;

/// A matrix λI − hJ, factored.
///
/// Where ẏᵢ = yⱼ, row i is λxᵢ − hxⱼ = bᵢ: such xᵢ are eliminated beforehand, which for equations of
/// second order leaves half of the unknowns and an eighth of the work.
#[derive(Clone, Debug, Default)]
pub(super) struct Shifted<F> {
    lu: Lu<F>,
    /// h, and h / λ.
    step: f64,
    lift: F,
    lambda: F,
    /// Right side and solution without what is eliminated.
    left: Vec<F>,
}

impl<F> Shifted<F>
where
    F: ComplexField<Real = f64> + Copy + From<f64> + Mul<f64, Output = F>,
    F: Add<Output = F> + Sub<Output = F> + Mul<Output = F> + Div<Output = F>,
{
    pub fn resize(&mut self, derivatives: &Derivatives) {
        let left = derivatives.size - derivatives.integrals.len();
        self.lu.resize(left);
        self.left.clear();
        self.left.resize(left, F::from(0.0));
    }

    /// Factors the matrix; `false` when it is singular or not finite.
    pub fn factor(&mut self, lambda: F, step: f64, derivatives: &Derivatives) -> bool {
        let lift = F::from(step) / lambda;
        (self.lambda, self.step, self.lift) = (lambda, step, lift);
        self.lu.factor(|row, column| {
            let (i, j) = (derivatives.left(row), derivatives.left(column));
            let diagonal = if i == j { lambda } else { F::from(0.0) };
            let entry = diagonal - F::from(step * derivatives.row(i)[j]);
            match derivatives.integral_of(j) {
                Some(integral) => entry - lift * (step * derivatives.row(i)[integral]),
                None => entry,
            }
        })
    }

    /// Replaces the right side `b` by the solution.
    pub fn solve(&mut self, derivatives: &Derivatives, b: &mut [F]) {
        let Range { start, end } = derivatives.integrals;
        for (at, left) in self.left.iter_mut().enumerate() {
            let i = derivatives.left(at);
            let terms = derivatives.row(i)[start..end].iter().zip(&b[start..end]);
            let sum = terms.fold(F::from(0.0), |sum, (&a, &x)| sum + x * a);
            *left = b[i] + self.lift * sum;
        }
        self.lu.solve(&mut self.left);
        for (at, &x) in self.left.iter().enumerate() {
            b[derivatives.left(at)] = x;
        }
        for i in start..end {
            b[i] = (b[i] + b[derivatives.rate_of(i)] * self.step) / self.lambda;
        }
    }
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;

    /// J of variables of which the second and the third are integrals of the last two.
    fn derivatives() -> Derivatives {
        let rows = [
            [0.5, 2.0, -1.0, 3.0, 0.25],
            [0.0, 0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0],
            [-1.5, -40.0, 7.0, -0.5, 2.0],
            [4.0, 6.0, -90.0, 1.0, -3.0],
        ];
        let mut derivatives = Derivatives::default();
        derivatives.resize(5, [1..3, 3..5]);
        derivatives.entries.copy_from_slice(&rows.concat());
        derivatives
    }

    #[test]
    fn the_whole_system_is_solved() {
        let (lambda, step, derivatives) = (c64::new(2.5, 3.0), 0.3, derivatives());
        let right: Vec<c64> = (0..5).map(|i| c64::new(f64::from(i) - 1.5, 0.5)).collect();
        let (mut shifted, mut x) = (Shifted::default(), right.clone());
        shifted.resize(&derivatives);
        assert!(shifted.factor(lambda, step, &derivatives));
        shifted.solve(&derivatives, &mut x);
        for (i, b) in right.into_iter().enumerate() {
            let terms = derivatives.row(i).iter().zip(&x).map(|(&a, &x)| x * (step * a));
            let left = terms.fold(lambda * x[i], |sum, term| sum - term);
            // Rounding of terms of about 30.
            assert!((left - b).norm() < 1e-14, "{i}: {left} {b}");
        }
    }
}
