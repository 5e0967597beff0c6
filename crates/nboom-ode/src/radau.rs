use std::ops::Range;

use coefficients::Coefficients;
use collocation::Collocation;
use iteration_matrix::{IterationMatrix, Point};
use newton::{Attempt, Outcome, Stages};

use crate::stepper::root_mean_square;
use crate::{Bernstein, Choice, StepError, Stepper, System, Tolerance, Window};

mod coefficients;
mod collocation;
mod control;
mod iteration_matrix;
mod newton;
pub(crate) mod order_13;
pub(crate) mod order_5;
pub(crate) mod order_9;

/// The implicit methods of Radau IIA with three, five or seven stages for stiff systems, after RADAU5: simplified
/// Newton iteration, error estimate of order 3, 5 or 7, Gustafsson's step control; the collocation
/// polynomial is the dense output (Hairer and Wanner, Solving Ordinary Differential Equations
/// II, 2nd ed., Section IV.8).
///
/// As the estimate is of lower order than the method, it is compared with a wider tolerance,
/// 0.1 · relative^(2/3) in place of `relative`, and so is dense output within a step.
#[derive(Clone, Debug)]
pub struct Radau {
    coefficients: &'static Coefficients,
    /// What the estimate is compared with.
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    step: f64,
    /// f at the start.
    slope: Vec<f64>,
    slope_is_known: bool,
    /// Error allowed in each controlled variable.
    scales: Vec<f64>,
    /// Whether these are of this start.
    is_measured: bool,
    matrix: IterationMatrix,
    jacobian: Age,
    stages: Stages,
    /// Estimated error of the last step tried, and its length.
    error: Vec<f64>,
    /// Room for the error in unknowns.
    room: Vec<f64>,
    tried: f64,
    dense: Collocation,
    last: LastStep,
}

/// Where the Jacobian was evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Age {
    /// At the start.
    New,
    /// At the start of an earlier step, and still good.
    Kept,
    Outdated,
}

/// What is remembered of the last step accepted.
#[derive(Clone, Debug, Default)]
struct LastStep {
    /// Zero when there is none.
    length: f64,
    error: f64,
    curves: Collocation,
}

/// How the next step relates to one that was tried.
enum Verdict {
    Accepted(f64),
    Rejected(f64),
}

/// A step that could grow by no more than this keeps its size, and with it the factors.
const NOT_WORTH_IT: f64 = 1.2;
/// A contraction up to which the Jacobian is good enough for the next step.
const GOOD: f64 = 1e-3;

/// A motion whose decay is at least this share of its rate does not oscillate.
const CLEARLY: f64 = 0.9;

impl Radau {
    /// The method of order 5 with this tolerance.
    pub fn order_5(tolerance: Tolerance) -> Self {
        Self::new(&order_5::COEFFICIENTS, tolerance)
    }

    /// The method of order 9 with this tolerance.
    pub fn order_9(tolerance: Tolerance) -> Self {
        Self::new(&order_9::COEFFICIENTS, tolerance)
    }

    /// The method of order 13 with this tolerance.
    pub fn order_13(tolerance: Tolerance) -> Self {
        Self::new(&order_13::COEFFICIENTS, tolerance)
    }

    fn new(coefficients: &'static Coefficients, tolerance: Tolerance) -> Self {
        let Tolerance { relative, absolute } = tolerance;
        let wider = 0.1 / relative.max(10.0 * f64::EPSILON).cbrt();
        Self {
            coefficients,
            tolerance: Tolerance { relative: relative * wider, absolute: absolute * wider },
            controlled: 0,
            window: Window::default(),
            step: 0.0,
            slope: Vec::new(),
            slope_is_known: false,
            scales: Vec::new(),
            is_measured: false,
            matrix: IterationMatrix::new(coefficients.real, coefficients.pairs),
            jacobian: Age::Outdated,
            stages: Stages::new(coefficients),
            error: Vec::new(),
            room: Vec::new(),
            tried: 0.0,
            dense: Collocation::default(),
            last: LastStep::default(),
        }
    }

    /// The last step times the magnitude of the fastest motion's eigenvalue.
    pub(crate) fn stiffness(&mut self) -> f64 {
        self.step * self.matrix.fastest(&self.window.sizes[..self.controlled]).rate
    }

    /// The rate at which the fastest motion about the start of a step dies down, zero if it oscillates; none if the
    /// system has no Jacobian of its own.
    pub(crate) fn rate_of_decay(
        &mut self,
        system: &mut dyn System,
        at: &Window,
        controlled: usize,
    ) -> Option<f64> {
        let Self { matrix, stages, .. } = self;
        stages.variables.assign(system, at.state.len(), controlled);
        matrix.resize(at.state.len(), &stages.variables);
        if !matrix.evaluate_own(system, at.time, &at.state) {
            return None;
        }
        let fastest = matrix.fastest(&at.sizes[..controlled]);
        Some(if fastest.decay > CLEARLY * fastest.rate { fastest.rate } else { 0.0 })
    }

    fn size(&self) -> usize {
        self.window.state.len()
    }

    /// Brings the slope, the scales and the Jacobian up to the start of the step.
    fn prepare(&mut self, system: &mut dyn System) {
        if !self.slope_is_known {
            let Self { window, slope, .. } = self;
            system.derivative(window.time, &window.state, slope);
            window.counts.evaluations += 1;
            self.slope_is_known = true;
        }
        if !self.is_measured {
            self.is_measured = true;
            self.window.measure(system);
            let variables = self.window.sizes.iter().zip(&self.window.state);
            for (scale, (&size, &y)) in self.scales.iter_mut().zip(variables) {
                *scale = self.tolerance.allowed(size, y);
            }
        }
        if self.jacobian == Age::Outdated {
            let Self { window, slope, .. } = self;
            let Window { time, state, sizes, counts, .. } = window;
            let point = Point { time: *time, state, slope, sizes };
            self.matrix.evaluate(system, point, counts);
            self.jacobian = Age::New;
        }
    }

    /// Root mean square of an error over the controlled variables, in units of the tolerance.
    fn norm(&self, error: impl Fn(usize) -> f64) -> f64 {
        root_mean_square(self.controlled, |i| error(i) / self.scales[i])
    }

    /// A first step over which the variables change by about a hundredth; infinite where nothing
    /// moves.
    fn first_step(&self) -> f64 {
        let size = self.norm(|i| self.window.magnitude(i));
        let guess = 0.01 * size / self.norm(|i| self.slope[i]);
        if guess.is_finite() { guess } else { f64::INFINITY }
    }

    fn factor(&mut self, step: f64) -> bool {
        let Self { matrix, stages, window, .. } = self;
        matrix.factor(step, &stages.variables.evaluated, &mut window.counts)
    }

    /// Tries a step.
    fn attempt(&mut self, system: &mut dyn System, step: f64, rejected: bool) -> Verdict {
        if !self.factor(step) {
            return Verdict::Rejected(0.5);
        }
        let Self { stages, matrix, last, window, scales, .. } = self;
        match last.length {
            0.0 => stages.guess_rest(),
            length => {
                stages.guess(&last.curves, 1.0, step / length);
                if step > NOT_WORTH_IT * length {
                    stages.forget_contraction();
                }
            }
        }
        let rounding = 10.0 * f64::EPSILON / self.tolerance.relative;
        let goal = rounding.max(self.tolerance.relative.sqrt().min(0.03));
        let outcome = stages.iterate(system, matrix, Attempt { window, step, scales }, goal);
        match outcome {
            Outcome::Converged(count) => self.judge(system, step, count, rejected),
            Outcome::Slow(factor) => Verdict::Rejected(factor),
            Outcome::Diverged => Verdict::Rejected(0.5),
        }
    }

    /// Makes the stages' last one the end of the step.
    fn keep(&mut self, step: f64) {
        let Self { coefficients, window, stages, .. } = self;
        let last = coefficients.stages - 1;
        for (end, (y, z)) in window.end_state.iter_mut().zip(window.state.iter().zip(&stages.z)) {
            *end = y + z.0[last];
        }
        self.step = step;
        self.window.end_time = self.window.time + step;
    }

    fn too_short(&mut self, step: f64) -> StepError {
        self.stages.recall(&self.window.state);
        let time = self.window.time;
        let broken = |&i: &usize| !(self.slope[i].is_finite() && self.stages.is_finite(i));
        if let Some(variable) = (0..self.size()).find(broken) {
            return StepError::NotFinite { time, variable };
        }
        StepError::underflow(time, step, 0..self.controlled, |i| self.error_of(i))
    }
}

impl Stepper for Radau {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        let size = y.len();
        self.controlled = controlled;
        // Code for eight states is made ready here, not within a step.
        system.takes_eight();
        self.window.start(system, t, y);
        self.stages.start(system, size, controlled);
        self.matrix.resize(size, &self.stages.variables);
        let unknowns = self.stages.variables.evaluated.len();
        for (buffer, len) in [
            (&mut self.slope, size),
            (&mut self.error, size),
            (&mut self.room, unknowns),
            (&mut self.scales, controlled),
        ] {
            buffer.clear();
            buffer.resize(len, 0.0);
        }
        self.last.length = 0.0;
        for curves in [&mut self.dense, &mut self.last.curves] {
            curves.resize(size);
        }
        (self.step, self.jacobian) = (0.0, Age::Outdated);
        (self.slope_is_known, self.is_measured) = (false, false);
        self.prepare(system);
        self.window.next_step = self.first_step().min(self.window.longest);
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        let mut rejected = false;
        loop {
            self.prepare(system);
            let Some((step, reaches)) = self.window.attempt(limit) else {
                return Err(self.too_short(self.window.next_step));
            };
            let start = self.window.time;
            match self.attempt(system, step, rejected) {
                Verdict::Accepted(factor) => {
                    let next = step * if rejected { factor.min(1.0) } else { factor };
                    let end = if reaches { limit } else { start + step };
                    self.window.accept(end, reaches, next);
                    return Ok(None);
                }
                Verdict::Rejected(factor) => {
                    rejected = true;
                    self.window.counts.rejected += 1;
                    self.window.next_step = step * factor;
                    if self.jacobian == Age::Kept {
                        self.jacobian = Age::Outdated;
                    }
                    if start + 0.1 * self.window.next_step == start {
                        return Err(self.too_short(step));
                    }
                }
            }
        }
    }

    fn prepare_dense(&mut self, _system: &mut dyn System) {
        self.dense.pass_through(self.coefficients, &self.stages.z);
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        for (i, (value, y)) in out.iter_mut().zip(&self.window.state).enumerate() {
            *value = y + self.dense.at(i, fraction);
        }
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        let terms = &self.dense.terms[i].0[..self.coefficients.stages];
        Bernstein::of_terms(self.window.state[i], terms)
    }

    /// Corrections go on until rounding, so that the end is a smooth function of the length.
    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.prepare(system);
        let ratio = if self.step > 0.0 { step / self.step } else { 0.0 };
        self.last.curves.pass_through(self.coefficients, &self.stages.z);
        self.stages.guess(&self.last.curves, 0.0, ratio);
        // Of a step that is not solved nothing is known about the Jacobian.
        self.stages.contraction = 1.0;
        if self.factor(step) {
            let rounding = f64::EPSILON / self.tolerance.relative;
            let Self { stages, matrix, window, scales, .. } = self;
            stages.settle(system, matrix, Attempt { window, step, scales }, rounding);
        }
        self.keep(step);
    }

    fn advance(&mut self) {
        self.window.advance();
        self.last.length = self.step;
        self.last.curves.pass_through(self.coefficients, &self.stages.z);
        self.slope_is_known = self.stages.write_slope(&self.window.state, &mut self.slope);
        self.is_measured = false;
        self.jacobian = if self.stages.contraction <= GOOD { Age::Kept } else { Age::Outdated };
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        let Self { window, slope, last, .. } = self;
        for i in range {
            window.state[i] *= factor;
            slope[i] *= factor;
            last.curves.terms[i].0.iter_mut().for_each(|term| *term *= factor);
        }
        self.is_measured = false;
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn error_of(&self, i: usize) -> f64 {
        let scale = self.scales.get(i).copied().unwrap_or(f64::INFINITY);
        self.error[i].abs() / (scale * self.tried)
    }

    fn choice(&self) -> Choice {
        Choice::demanded(self.coefficients.method)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.stages.states.argument
    }
}
