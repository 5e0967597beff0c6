use faer::c64;

use super::coefficients::{COMPLEX, REAL};
use super::shifted::Shifted;
use crate::{Counts, Role, System};

/// J, and which of its rows are known beforehand.
#[derive(Clone, Debug, Default)]
pub(super) struct Derivatives {
    pub size: usize,
    /// Row by row.
    pub entries: Vec<f64>,
    /// Variables that are integrals, each with the variable that is its rate.
    pub integrals: Vec<(usize, usize)>,
    /// All others.
    pub left: Vec<usize>,
    /// The integral whose rate a variable is.
    integral_of: Vec<Option<usize>>,
}

impl Derivatives {
    /// Room for those of variables in these roles.
    pub fn resize(&mut self, roles: impl Iterator<Item = Role>) {
        self.integrals.clear();
        self.left.clear();
        for (i, role) in roles.enumerate() {
            match role {
                Role::Integral(rate) => self.integrals.push((i, rate)),
                Role::Coupled | Role::Follower => self.left.push(i),
            }
        }
        self.size = self.integrals.len() + self.left.len();
        self.integral_of.clear();
        self.integral_of.resize(self.size, None);
        for &(integral, rate) in &self.integrals {
            self.integral_of[rate] = Some(integral);
        }
        self.entries.clear();
        self.entries.resize(self.size * self.size, 0.0);
    }

    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.size..][..self.size]
    }

    /// The integral whose rate a variable is.
    pub fn integral_of(&self, rate: usize) -> Option<usize> {
        self.integral_of[rate]
    }
}

/// The matrices λI − hJ of the simplified Newton iteration, one real and one complex.
#[derive(Clone, Debug, Default)]
pub(super) struct IterationMatrix {
    derivatives: Derivatives,
    real: Shifted<f64>,
    complex: Shifted<c64>,
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
    pub fn resize(&mut self, system: &dyn System, size: usize) {
        self.derivatives.resize((0..size).map(|i| system.role(i)));
        self.real.resize(&self.derivatives);
        self.complex.resize(&self.derivatives);
        for (buffer, len) in [(&mut self.shifted, size), (&mut self.shifted_slope, size)] {
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
        let Self { derivatives, dominant, .. } = self;
        let [vector, image] = dominant.each_mut().map(|all| &mut all[..sizes.len()]);
        let mut growth = 0.0;
        for _ in 0..ITERATIONS {
            for (i, (out, size_of_row)) in image.iter_mut().zip(sizes).enumerate() {
                let terms = derivatives.row(i).iter().zip(sizes).zip(&*vector);
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
        if !system.jacobian(point.time, point.state, &mut self.derivatives.entries) {
            self.take_differences(system, point);
            counts.evaluations += self.derivatives.size;
        }
    }

    fn take_differences(&mut self, system: &mut dyn System, point: Point<'_>) {
        let n = self.derivatives.size;
        self.shifted.copy_from_slice(point.state);
        for j in 0..n {
            let y = point.state[j];
            let shift = f64::EPSILON.sqrt() * y.abs().max(point.sizes[j]);
            self.shifted[j] = y + shift;
            system.derivative(point.time, &self.shifted, &mut self.shifted_slope);
            let shift = self.shifted[j] - y;
            for i in 0..n {
                self.derivatives.entries[i * n + j] =
                    (self.shifted_slope[i] - point.slope[i]) / shift;
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
        let Self { derivatives, real, complex, .. } = self;
        let regular =
            real.factor(REAL, step, derivatives) && complex.factor(COMPLEX, step, derivatives);
        self.factored = regular.then_some(step);
        regular
    }

    /// Replaces the right side `b` of the real system by the solution.
    pub fn solve_real(&mut self, b: &mut [f64]) {
        self.real.solve(&self.derivatives, b);
    }

    /// Replaces the right side `b` of the complex system by the solution.
    pub fn solve_complex(&mut self, b: &mut [c64]) {
        self.complex.solve(&self.derivatives, b);
    }
}
