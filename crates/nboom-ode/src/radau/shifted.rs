use std::ops::{Add, Div, Mul, Sub};

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
        let left = derivatives.left.len();
        self.lu.resize(left);
        self.left.clear();
        self.left.resize(left, F::from(0.0));
    }

    /// Factors the matrix; `false` when it is singular or not finite.
    pub fn factor(&mut self, lambda: F, step: f64, derivatives: &Derivatives) -> bool {
        let lift = F::from(step) / lambda;
        (self.lambda, self.step, self.lift) = (lambda, step, lift);
        self.lu.factor(|row, column| {
            let (i, j) = (derivatives.left[row], derivatives.left[column]);
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
        let Derivatives { integrals, left, .. } = derivatives;
        for (out, &i) in self.left.iter_mut().zip(left) {
            let row = derivatives.row(i);
            let terms = integrals.iter().map(|&(integral, _)| b[integral] * row[integral]);
            let sum = terms.fold(F::from(0.0), |sum, term| sum + term);
            *out = b[i] + self.lift * sum;
        }
        self.lu.solve(&mut self.left);
        for (&x, &i) in self.left.iter().zip(left) {
            b[i] = x;
        }
        for &(integral, rate) in integrals {
            b[integral] = (b[integral] + b[rate] * self.step) / self.lambda;
        }
    }
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::Role;

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
        let roles =
            [Role::Coupled, Role::Integral(3), Role::Integral(4), Role::Coupled, Role::Coupled];
        derivatives.resize(roles.into_iter());
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
