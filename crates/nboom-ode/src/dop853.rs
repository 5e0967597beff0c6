use crate::tableau::{A, ALL_STAGES, C, D, E3, E5, STAGES};
use crate::{Bernstein, StepError};

/// A system of ordinary differential equations ẏ = f(t, y).
pub trait System {
    /// Writes f(t, y) to `dy`, which has the length of `y`.
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]);
}

/// Error allowed in a step: `absolute + relative · |y|` for each variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative part.
    pub relative: f64,
    /// Absolute part, in the variable's unit.
    pub absolute: f64,
}

/// The explicit Runge-Kutta method of order 8 of Dormand and Prince, with step control by
/// estimates of order 5 and 3 and dense output of order 7.
///
/// [`step`](Self::step) finds a step that meets the tolerance; until
/// [`advance`](Self::advance) makes its end the new start, its inside can be looked at and it
/// can be taken again to another length.
#[derive(Clone, Debug)]
pub struct Dop853 {
    tolerance: Tolerance,
    controlled: usize,
    t: f64,
    y: Vec<f64>,
    step: f64,
    end: f64,
    y_end: Vec<f64>,
    stages: Vec<f64>,
    stage_state: Vec<f64>,
    dense: Vec<f64>,
    next_step: f64,
    previous_error: f64,
    counts: Counts,
}

/// What integration has cost so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
    /// Evaluations of the derivative.
    pub evaluations: usize,
}

/// Terms of dense output after the start value.
const TERMS: usize = 7;
/// Order of the step control, the safety factor, and the bounds on the change of step size.
const EXPONENT: f64 = 1.0 / 8.0;
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 1.0 / 3.0;
const GROW: f64 = 6.0;
/// Weight of the previous error in the step control (Gustafsson's PI controller).
const MEMORY: f64 = 0.04;

impl Dop853 {
    /// A stepper without a problem.
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            controlled: 0,
            t: 0.0,
            y: Vec::new(),
            step: 0.0,
            end: 0.0,
            y_end: Vec::new(),
            stages: Vec::new(),
            stage_state: Vec::new(),
            dense: Vec::new(),
            next_step: 0.0,
            previous_error: 1e-4,
            counts: Counts::default(),
        }
    }

    /// Starts at (`t`, `y`) with nothing remembered of earlier steps. Only the first
    /// `controlled` variables decide on the step size.
    pub fn start(&mut self, system: &mut impl System, t: f64, y: &[f64], controlled: usize) {
        let n = y.len();
        self.controlled = controlled;
        (self.t, self.end) = (t, t);
        self.previous_error = 1e-4;
        for buffer in [&mut self.y, &mut self.y_end] {
            buffer.clear();
            buffer.extend_from_slice(y);
        }
        self.stages.clear();
        self.stages.resize(n * ALL_STAGES, 0.0);
        self.stage_state.clear();
        self.stage_state.resize(n, 0.0);
        self.dense.clear();
        self.dense.resize(n * TERMS, 0.0);
        system.derivative(t, y, &mut self.stages[..n]);
        self.counts.evaluations += 1;
        self.next_step = self.first_step(system);
    }

    /// Takes a step that meets the tolerance and does not pass `limit`, which is reached
    /// exactly when the step comes close.
    ///
    /// # Errors
    /// When no step that changes the time meets the tolerance; the start is still there.
    pub fn step(&mut self, system: &mut impl System, limit: f64) -> Result<(), StepError> {
        let mut last_rejected = false;
        loop {
            let remaining = limit - self.t;
            let wanted = self.next_step;
            let reaches = wanted * 1.01 >= remaining;
            let step = if reaches { remaining } else { wanted };
            if !reaches && self.t + 0.1 * step == self.t {
                return Err(self.too_short(step));
            }
            self.take(system, step);
            let error = self.error_norm(step);
            if error <= 1.0 {
                self.step = step;
                self.end = if reaches { limit } else { self.t + step };
                let factor = self.factor(error);
                let factor = if last_rejected { factor.min(1.0) } else { factor };
                self.previous_error = error.max(1e-4);
                // A step cut short by the limit must not slow the next one down.
                self.next_step = if reaches { wanted.max(step * factor) } else { step * factor };
                self.counts.accepted += 1;
                return Ok(());
            }
            last_rejected = true;
            self.counts.rejected += 1;
            self.next_step = step * self.factor(error).min(1.0);
            if self.t + 0.1 * self.next_step == self.t {
                return Err(self.too_short(step));
            }
        }
    }

    /// Prepares [`interpolate`](Self::interpolate) and [`polynomial`](Self::polynomial) for the
    /// step just taken; three more evaluations.
    pub fn prepare_dense(&mut self, system: &mut impl System) {
        for stage in STAGES + 1..ALL_STAGES {
            self.evaluate_stage(system, stage, self.step);
        }
        let (n, h) = (self.y.len(), self.step);
        for i in 0..n {
            let difference = self.y_end[i] - self.y[i];
            let (first, last) = (h * self.stages[i], h * self.stages[STAGES * n + i]);
            let terms = &mut self.dense[i * TERMS..(i + 1) * TERMS];
            terms[0] = difference;
            terms[1] = first - difference;
            terms[2] = 2.0 * difference - (first + last);
            for (term, row) in terms[3..].iter_mut().zip(D) {
                *term = h * row.iter().map(|&(j, d)| d * self.stages[j * n + i]).sum::<f64>();
            }
        }
    }

    /// The variables at `fraction` of the step that dense output was prepared for.
    pub fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        let (x, rest) = (fraction, 1.0 - fraction);
        for (i, value) in out.iter_mut().enumerate() {
            let c = &self.dense[i * TERMS..(i + 1) * TERMS];
            let inner = c[3] + x * (c[4] + rest * (c[5] + x * c[6]));
            *value = self.y[i] + x * (c[0] + rest * (c[1] + x * (c[2] + rest * inner)));
        }
    }

    /// Variable `i` over the step that dense output was prepared for.
    pub fn polynomial(&self, i: usize) -> Bernstein {
        let terms = &self.dense[i * TERMS..(i + 1) * TERMS];
        Bernstein::new(std::array::from_fn(|j| {
            let products = terms.iter().zip(&TERM_COEFFICIENTS).map(|(c, row)| c * row[j]);
            self.y[i] + products.sum::<f64>()
        }))
    }

    /// Takes the step again with another length, whatever its error; dense output stays that
    /// of the step before.
    pub fn retake(&mut self, system: &mut impl System, step: f64) {
        self.take(system, step);
        self.step = step;
        self.end = self.t + step;
    }

    /// Makes the end of the step the start of the next one.
    pub fn advance(&mut self) {
        self.t = self.end;
        let n = self.y.len();
        std::mem::swap(&mut self.y, &mut self.y_end);
        self.stages.copy_within(STAGES * n..(STAGES + 1) * n, 0);
    }

    /// Multiplies the variables `range` and their derivatives at the start of the next step by
    /// `factor`: a projection onto an invariant in which the equations are homogeneous.
    pub fn scale(&mut self, range: std::ops::Range<usize>, factor: f64) {
        for i in range {
            self.y[i] *= factor;
            self.stages[i] *= factor;
        }
    }

    /// Time of the step's start.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// Variables at the step's start.
    pub fn state(&self) -> &[f64] {
        &self.y
    }

    /// Time of the step's end.
    pub fn end_time(&self) -> f64 {
        self.end
    }

    /// Variables at the step's end.
    pub fn end_state(&self) -> &[f64] {
        &self.y_end
    }

    /// The step that is tried next.
    pub fn next_step(&self) -> f64 {
        self.next_step
    }

    /// Estimated error of variable `i` in the last step tried, in units of the tolerance and
    /// per unit of time.
    pub fn error_of(&self, i: usize) -> f64 {
        self.estimate(E5, i).abs() / self.scale_of(i)
    }

    /// The variables at which the derivative was evaluated last.
    pub fn last_evaluated(&self) -> &[f64] {
        &self.stage_state
    }

    /// What integration has cost so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    fn take(&mut self, system: &mut impl System, step: f64) {
        for stage in 1..STAGES {
            self.evaluate_stage(system, stage, step);
        }
        self.combine(STAGES, step);
        self.y_end.copy_from_slice(&self.stage_state);
        self.evaluate(system, STAGES, step);
    }

    fn evaluate_stage(&mut self, system: &mut impl System, stage: usize, step: f64) {
        self.combine(stage, step);
        self.evaluate(system, stage, step);
    }

    fn combine(&mut self, stage: usize, step: f64) {
        let n = self.y.len();
        for i in 0..n {
            let sum: f64 = A[stage].iter().map(|&(j, a)| a * self.stages[j * n + i]).sum();
            self.stage_state[i] = self.y[i] + step * sum;
        }
    }

    fn evaluate(&mut self, system: &mut impl System, stage: usize, step: f64) {
        let n = self.y.len();
        let derivative = &mut self.stages[stage * n..(stage + 1) * n];
        system.derivative(self.t + C[stage] * step, &self.stage_state, derivative);
        self.counts.evaluations += 1;
    }

    /// Estimated error of the step in units of the tolerance.
    fn error_norm(&self, step: f64) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..self.controlled {
            let scale = self.scale_of(i);
            fifth += (self.estimate(E5, i) / scale).powi(2);
            third += (self.estimate(E3, i) / scale).powi(2);
        }
        let finite = self.y_end.iter().all(|y| y.is_finite());
        if !finite || !(fifth + third).is_finite() {
            return f64::INFINITY;
        }
        let denominator = fifth + 0.01 * third;
        if denominator <= 0.0 {
            return 0.0;
        }
        step.abs() * fifth / (denominator * self.controlled as f64).sqrt()
    }

    fn estimate(&self, weights: &[(usize, f64)], i: usize) -> f64 {
        let n = self.y.len();
        weights.iter().map(|&(j, e)| e * self.stages[j * n + i]).sum()
    }

    fn scale_of(&self, i: usize) -> f64 {
        let size = self.y[i].abs().max(self.y_end[i].abs());
        self.tolerance.absolute + self.tolerance.relative * size
    }

    fn factor(&self, error: f64) -> f64 {
        let growth =
            SAFETY * self.previous_error.powf(MEMORY) / error.powf(EXPONENT - 0.2 * MEMORY);
        growth.clamp(SHRINK, GROW)
    }

    fn too_short(&self, step: f64) -> StepError {
        let time = self.t;
        let n = self.y.len();
        let not_finite =
            |&i: &usize| (0..=STAGES).any(|stage| !self.stages[stage * n + i].is_finite());
        if let Some(variable) = (0..n).find(not_finite) {
            return StepError::NotFinite { time, variable };
        }
        let larger = |&a: &usize, &b: &usize| self.error_of(a).total_cmp(&self.error_of(b));
        let variable = (0..self.controlled).max_by(larger).unwrap_or(0);
        StepError::Underflow { time, step, variable }
    }

    /// A first step from the sizes of the first and second derivative (Hairer, Nørsett, Wanner,
    /// Section II.4).
    fn first_step(&mut self, system: &mut impl System) -> f64 {
        let n = self.y.len();
        let size = self.norm(|i| self.y[i]);
        let slope = self.norm(|i| self.stages[i]);
        let guess = 0.01 * size / slope;
        let guess = if size < 1e-5 || slope < 1e-5 || !guess.is_finite() { 1e-6 } else { guess };
        for i in 0..n {
            self.stage_state[i] = self.y[i] + guess * self.stages[i];
        }
        let (t, state) = (self.t + guess, &self.stage_state);
        system.derivative(t, state, &mut self.stages[n..2 * n]);
        self.counts.evaluations += 1;
        let curvature = self.norm(|i| self.stages[n + i] - self.stages[i]) / guess;
        let largest = slope.max(curvature);
        let by_order = if largest <= 1e-15 || largest.is_nan() {
            (guess * 1e-3).max(1e-6)
        } else {
            (0.01 / largest).powf(EXPONENT)
        };
        by_order.min(100.0 * guess)
    }

    /// Root mean square of `values` over the controlled variables, in units of the tolerance.
    fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        let square = |i: usize| (values(i) / self.scale_of(i)).powi(2);
        ((0..self.controlled).map(square).sum::<f64>() / self.controlled.max(1) as f64).sqrt()
    }
}

/// Bernstein coefficients of the terms x, x(1−x), x²(1−x), x²(1−x)², … of dense output:
/// xᵃ(1−x)ᵇ has C(7−a−b, j−a) / C(7, j) at index j.
const TERM_COEFFICIENTS: [[f64; TERMS + 1]; TERMS] = {
    let mut table = [[0.0; TERMS + 1]; TERMS];
    let mut term = 0;
    while term < TERMS {
        let (a, b) = (term / 2 + 1, term.div_ceil(2));
        let mut j = a;
        while j <= TERMS - b {
            table[term][j] = binomial(TERMS - a - b, j - a) / binomial(TERMS, j);
            j += 1;
        }
        term += 1;
    }
    table
};

const fn binomial(n: usize, k: usize) -> f64 {
    let mut value = 1.0;
    let mut i = 0;
    while i < k {
        value = value * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    value
}
