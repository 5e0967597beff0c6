use faer::c64;

use super::coefficients::{COMPLEX, REAL};
use crate::linear::Lu;
use crate::{Counts, System};

/// The matrices λI − hJ of the simplified Newton iteration, one real and one complex.
#[derive(Clone, Debug, Default)]
pub(super) struct IterationMatrix {
    size: usize,
    /// J, row by row.
    jacobian: Vec<f64>,
    pub real: Lu<f64>,
    pub complex: Lu<c64>,
    /// h of the factors.
    factored: Option<f64>,
    shifted: Vec<f64>,
    shifted_slope: Vec<f64>,
    /// About the eigenvector of J's largest eigenvalue, and J times it, in natural sizes.
    dominant: [Vec<f64>; 2],
}

/// Multiplications by J that improve an eigenvector from one step to the next.
const ITERATIONS: usize = 4;

/// A point of a solution.
#[derive(Clone, Copy)]
pub(super) struct Point<'a> {
    pub time: f64,
    pub state: &'a [f64],
    /// f(t, y)
    pub slope: &'a [f64],
    /// Natural sizes of the variables.
    pub sizes: &'a [f64],
}

impl IterationMatrix {
    pub fn resize(&mut self, size: usize) {
        self.size = size;
        self.real.resize(size);
        self.complex.resize(size);
        for (buffer, len) in [
            (&mut self.jacobian, size * size),
            (&mut self.shifted, size),
            (&mut self.shifted_slope, size),
        ] {
            buffer.clear();
            buffer.resize(len, 0.0);
        }
        for vector in &mut self.dominant {
            vector.clear();
            // Unequal numbers, so that no eigenvector is left out by symmetry.
            vector.extend((0..size).map(|i| 1.0 + i as f64 / size as f64));
        }
    }

    /// About the magnitude of J's largest eigenvalue, by the power method; `sizes` has the natural
    /// sizes of the first variables, on which the others do not act.
    pub fn spectral_radius(&mut self, sizes: &[f64]) -> f64 {
        let Self { size, jacobian, dominant, .. } = self;
        let [vector, image] = dominant.each_mut().map(|all| &mut all[..sizes.len()]);
        let mut growth = 0.0;
        for _ in 0..ITERATIONS {
            let rows = jacobian.chunks_exact(*size).zip(sizes);
            for (out, (row, size_of_row)) in image.iter_mut().zip(rows) {
                let terms = row.iter().zip(sizes).zip(&*vector);
                *out = terms.map(|((a, size), x)| a * size * x).sum::<f64>() / size_of_row;
            }
            let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (before, after) = (norm(&*vector), norm(&*image));
            growth = after / before;
            if !(growth > 0.0 && growth.is_finite()) {
                return 0.0;
            }
            for (x, y) in vector.iter_mut().zip(&*image) {
                *x = y / after;
            }
        }
        growth
    }

    /// Evaluates J.
    pub fn evaluate(&mut self, system: &mut dyn System, point: Point<'_>, counts: &mut Counts) {
        self.factored = None;
        counts.jacobians += 1;
        if !system.jacobian(point.time, point.state, &mut self.jacobian) {
            self.take_differences(system, point);
            counts.evaluations += self.size;
        }
    }

    fn take_differences(&mut self, system: &mut dyn System, point: Point<'_>) {
        let n = self.size;
        self.shifted.copy_from_slice(point.state);
        for j in 0..n {
            let y = point.state[j];
            let shift = f64::EPSILON.sqrt() * y.abs().max(point.sizes[j]);
            self.shifted[j] = y + shift;
            system.derivative(point.time, &self.shifted, &mut self.shifted_slope);
            let shift = self.shifted[j] - y;
            for i in 0..n {
                self.jacobian[i * n + j] = (self.shifted_slope[i] - point.slope[i]) / shift;
            }
            self.shifted[j] = y;
        }
    }

    /// Factors the matrices for steps of `step`; `false` when one is singular.
    pub fn factor(&mut self, step: f64, counts: &mut Counts) -> bool {
        if self.factored == Some(step) {
            return true;
        }
        counts.factorizations += 1;
        let (n, jacobian) = (self.size, &self.jacobian);
        let diagonal = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let real = |i, j| REAL * diagonal(i, j) - step * jacobian[i * n + j];
        let complex = |i, j| COMPLEX * diagonal(i, j) - step * jacobian[i * n + j];
        let regular = self.real.factor(real) && self.complex.factor(complex);
        self.factored = regular.then_some(step);
        regular
    }
}
