use faer::c64;

use crate::linear::Lu;
use crate::side_by_side::Variables;
use crate::{Counts, System};

/// The matrices λI − hJ of the simplified Newton iteration, one for each eigenvalue λ, without integrals
/// of unknowns and quadratures.
#[derive(Clone, Debug)]
pub(super) struct IterationMatrix {
    size: usize,
    eigenvalue: f64,
    pairs: &'static [c64],
    /// J, row by row.
    jacobian: Vec<f64>,
    pub real: Lu<f64>,
    pub complex: Vec<Lu<c64>>,
    /// The variable that is the integral of each unknown, if there is one.
    integral_of: Vec<Option<usize>>,
    /// h J of unknowns by unknowns, and h² J by their integrals, column by column.
    slopes: Vec<f64>,
    by_integrals: Vec<f64>,
    /// h of the factors.
    factored: Option<f64>,
    shifted: Vec<f64>,
    shifted_slope: Vec<f64>,
    /// About the eigenvector of J's largest eigenvalue, and J times it, in natural sizes.
    dominant: [Vec<f64>; 2],
}

/// Multiplications by J that improve an eigenvector from one step to the next.
const ITERATIONS: usize = 4;

/// Difference of the growths of two products, as a share, up to which the power method has found a real eigenvalue.
const SETTLED: f64 = 0.1;

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

/// About the eigenvalue of J of largest magnitude.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fastest {
    /// Its magnitude.
    pub rate: f64,
    /// Its real part with the sign changed, if it is real; zero of a pair.
    pub decay: f64,
}

impl IterationMatrix {
    /// Of these eigenvalues, a real one and one of each pair.
    pub fn new(eigenvalue: f64, pairs: &'static [c64]) -> Self {
        Self {
            size: 0,
            eigenvalue,
            pairs,
            jacobian: Vec::new(),
            real: Lu::default(),
            complex: vec![Lu::default(); pairs.len()],
            integral_of: Vec::new(),
            slopes: Vec::new(),
            by_integrals: Vec::new(),
            factored: None,
            shifted: Vec::new(),
            shifted_slope: Vec::new(),
            dominant: Default::default(),
        }
    }

    /// Makes room for these variables, of which the evaluated ones are unknowns.
    pub fn resize(&mut self, size: usize, variables: &Variables) {
        self.size = size;
        let unknowns = &variables.evaluated;
        self.real.resize(unknowns.len());
        self.complex.iter_mut().for_each(|factors| factors.resize(unknowns.len()));
        self.integral_of.clone_from(&variables.integral_of);
        self.factored = None;
        let entries = unknowns.len().pow(2);
        for (buffer, len) in [
            (&mut self.slopes, entries),
            (&mut self.by_integrals, entries),
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

    /// J's largest eigenvalue, by the power method; `sizes` has the natural sizes of the first variables, on
    /// which the others do not act.
    pub fn fastest(&mut self, sizes: &[f64]) -> Fastest {
        let Self { size, jacobian, dominant, .. } = self;
        let [vector, image] = dominant.each_mut().map(|all| &mut all[..sizes.len()]);
        let none = Fastest { rate: 0.0, decay: 0.0 };
        let [mut before_last, mut found] = [none; 2];
        if sizes.is_empty() {
            return none;
        }
        for _ in 0..ITERATIONS {
            let rows = jacobian.chunks_exact(*size).zip(sizes);
            for (out, (row, size_of_row)) in image.iter_mut().zip(rows) {
                let terms = row.iter().zip(sizes).zip(&*vector);
                *out = terms.map(|((a, size), x)| a * size * x).sum::<f64>() / size_of_row;
            }
            let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let (before, after) = (product(vector, vector).sqrt(), product(image, image).sqrt());
            before_last = found;
            found = Fastest {
                rate: after / before,
                decay: -product(vector, image) / (before * before),
            };
            if !(found.rate > 0.0 && found.rate.is_finite()) {
                return none;
            }
            for (x, y) in vector.iter_mut().zip(&*image) {
                *x = y / after;
            }
        }
        // What oscillates does not grow and turn alike in two products in a row.
        let is_settled = (found.rate - before_last.rate).abs() < SETTLED * found.rate;
        let decay = if is_settled { found.decay.min(before_last.decay) } else { 0.0 };
        Fastest { decay, ..found }
    }

    /// Evaluates J if the system has one of its own; returns whether it has.
    pub fn evaluate_own(&mut self, system: &mut dyn System, time: f64, state: &[f64]) -> bool {
        system.jacobian(time, state, &mut self.jacobian)
    }

    /// Evaluates J.
    pub fn evaluate(&mut self, system: &mut dyn System, point: Point<'_>, counts: &mut Counts) {
        self.factored = None;
        counts.jacobians += 1;
        if !self.evaluate_own(system, point.time, point.state) {
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
    ///
    /// An integral x of an unknown y obeys λ x = h y + …, which is put in place of it.
    pub fn factor(&mut self, step: f64, unknowns: &[usize], counts: &mut Counts) -> bool {
        if self.factored == Some(step) {
            return true;
        }
        counts.factorizations += 1;
        self.collect(step, unknowns);
        let (m, eigenvalue) = (unknowns.len(), self.eigenvalue);
        let (slopes, by_integrals) = (&self.slopes, &self.by_integrals);
        let diagonal = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let entry = |i: usize, j: usize| (slopes[j * m + i], by_integrals[j * m + i]);
        let mut pairs = self.complex.iter_mut().zip(self.pairs);
        let regular = self.real.factor(|i, j| {
            let (slope, by_integral) = entry(i, j);
            eigenvalue * diagonal(i, j) - (slope + by_integral / eigenvalue)
        }) && pairs.all(|(factors, eigenvalue)| {
            let inverse = eigenvalue.inv();
            factors.factor(|i, j| {
                let (slope, by_integral) = entry(i, j);
                *eigenvalue * diagonal(i, j) - (inverse * by_integral + slope)
            })
        });
        self.factored = regular.then_some(step);
        regular
    }

    /// Collects what all matrices for steps of `step` have in common, column by column.
    fn collect(&mut self, step: f64, unknowns: &[usize]) {
        let Self { size: n, jacobian, integral_of, slopes, by_integrals, .. } = self;
        let n = *n;
        let columns = unknowns.iter().zip(&*integral_of);
        let entries = columns.flat_map(|(&j, &integral)| {
            unknowns.iter().map(move |&i| (i * n + j, integral.map(|integral| i * n + integral)))
        });
        let both = slopes.iter_mut().zip(by_integrals);
        for ((slope, by_integral), (at, at_integral)) in both.zip(entries) {
            *slope = step * jacobian[at];
            *by_integral = at_integral.map_or(0.0, |at| step * step * jacobian[at]);
        }
    }

    /// Replaces `right`, of all variables but quadratures, by the solution x of (λI − hJ) x = `right`, with the real λ
    /// and h of the factors; `of_unknowns` is room.
    pub fn solve(&mut self, variables: &Variables, right: &mut [f64], of_unknowns: &mut [f64]) {
        let (n, step, eigenvalue) = (self.size, self.factored.unwrap_or(0.0), self.eigenvalue);
        for (out, &i) in of_unknowns.iter_mut().zip(&variables.evaluated) {
            let row = &self.jacobian[i * n..][..n];
            let of_integrals = variables.integrals.iter().map(|&(j, _)| row[j] * right[j]);
            *out = right[i] + step / eigenvalue * of_integrals.sum::<f64>();
        }
        self.real.solve(of_unknowns);
        for (x, &i) in of_unknowns.iter().zip(&variables.evaluated) {
            right[i] = *x;
        }
        for &(i, rate) in &variables.integrals {
            right[i] = (right[i] + step * right[rate]) / eigenvalue;
        }
    }
}
