use std::ops::Range;

use coefficients::{C, ERROR};
use collocation::Collocation;
use iteration_matrix::{IterationMatrix, Point};
use newton::{MOST, Outcome, Stages};

use crate::stepper::root_mean_square;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

mod coefficients;
mod collocation;
mod iteration_matrix;
mod newton;

pub(crate) use coefficients::DESCRIPTION;

/// The implicit method of Radau IIA of order 5 for stiff systems, after RADAU5: simplified
/// Newton iteration, error estimate of order 3, Gustafsson's step control; the collocation
/// polynomial is the dense output (Hairer and Wanner, Solving Ordinary Differential Equations
/// II, 2nd ed., Section IV.8).
///
/// As the estimate is of lower order than the method, it is compared with a wider tolerance,
/// 0.1 · relative^(2/3) in place of `relative`, and so is dense output within a step.
#[derive(Clone, Debug)]
pub struct Radau {
    /// What the estimate is compared with.
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    step: f64,
    /// f at the start, unless it has moved since.
    slope: Vec<f64>,
    slope_is_known: bool,
    /// Error allowed in each controlled variable.
    scales: Vec<f64>,
    matrix: IterationMatrix,
    jacobian: Age,
    stages: Stages,
    /// Estimated error of the last step tried, and its length.
    error: Vec<f64>,
    tried: f64,
    dense: Vec<Collocation>,
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
    curves: Vec<Collocation>,
}

/// How the next step relates to one that was tried.
enum Verdict {
    Accepted(f64),
    Rejected(f64),
}

const SAFETY: f64 = 0.9;
/// Limits of the change of step size.
const SHRINK: f64 = 0.2;
const GROW: f64 = 8.0;
/// A step that could grow by no more than this keeps its size, and with it the factors.
const NOT_WORTH_IT: f64 = 1.2;
/// A contraction up to which the Jacobian is good enough for the next step.
const GOOD: f64 = 1e-3;
/// An error this small does not speed up the next step any more.
const SMALL_ERROR: f64 = 1e-2;
/// An error below this one counts as this one.
const SMALLEST_ERROR: f64 = 1e-10;

impl Radau {
    /// The method with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        let Tolerance { relative, absolute } = tolerance;
        let wider = 0.1 / relative.max(10.0 * f64::EPSILON).cbrt();
        Self {
            tolerance: Tolerance { relative: relative * wider, absolute: absolute * wider },
            controlled: 0,
            window: Window::default(),
            step: 0.0,
            slope: Vec::new(),
            slope_is_known: false,
            scales: Vec::new(),
            matrix: IterationMatrix::default(),
            jacobian: Age::Outdated,
            stages: Stages::default(),
            error: Vec::new(),
            tried: 0.0,
            dense: Vec::new(),
            last: LastStep::default(),
        }
    }

    /// The last step times the magnitude of the fastest motion's eigenvalue.
    pub(crate) fn stiffness(&mut self) -> f64 {
        self.step * self.matrix.spectral_radius(&self.window.sizes[..self.controlled])
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

    /// Tries a step.
    fn attempt(&mut self, system: &mut dyn System, step: f64, rejected: bool) -> Verdict {
        if !self.matrix.factor(step, &mut self.window.counts) {
            return Verdict::Rejected(0.5);
        }
        let Self { stages, last, .. } = self;
        match last.length {
            0.0 => stages.guess(|_| [0.0; 3]),
            length => stages.guess(|i| {
                let (curve, end) = (&last.curves[i], last.curves[i].at(1.0));
                C.map(|c| curve.at(1.0 + c * step / length) - end)
            }),
        }
        let rounding = 10.0 * f64::EPSILON / self.tolerance.relative;
        let goal = rounding.max(self.tolerance.relative.sqrt().min(0.03));
        let outcome = self.stages.iterate(
            system,
            &mut self.matrix,
            (&mut self.window, step),
            (&self.scales, goal),
        );
        match outcome {
            Outcome::Converged(count) => self.judge(system, step, count, rejected),
            Outcome::Slow(factor) => Verdict::Rejected(factor),
            Outcome::Diverged => Verdict::Rejected(0.5),
        }
    }

    /// Estimates the error of a step that took `count` corrections.
    fn judge(
        &mut self,
        system: &mut dyn System,
        step: f64,
        count: usize,
        rejected: bool,
    ) -> Verdict {
        let first = self.last.length == 0.0;
        let mut error = self.estimate(step);
        if error >= 1.0 && (first || rejected) {
            error = self.filtered_estimate(system, step);
        }
        let effort = (1 + 2 * MOST) as f64 / (count + 2 * MOST) as f64;
        let factor = (SAFETY * effort.min(1.0) / error.powf(0.25)).clamp(SHRINK, GROW);
        if error < 1.0 {
            self.accept(step, error, first, factor)
        } else if first {
            Verdict::Rejected(0.1)
        } else {
            Verdict::Rejected(factor.min(SAFETY))
        }
    }

    fn accept(&mut self, step: f64, error: f64, first: bool, factor: f64) -> Verdict {
        let trend = (step / self.last.length) * (self.last.error / error.powi(2)).powf(0.25);
        let predicted = (SAFETY * trend).clamp(SHRINK, GROW);
        let factor = if first { factor } else { factor.min(predicted) };
        self.last.error = error.max(SMALL_ERROR);
        self.keep(step);
        let worth_it = self.stages.contraction > GOOD || !(1.0..=NOT_WORTH_IT).contains(&factor);
        Verdict::Accepted(if worth_it { factor } else { 1.0 })
    }

    /// Makes the stages' last one the end of the step.
    fn keep(&mut self, step: f64) {
        let Self { window, stages, .. } = self;
        for (end, (y, z)) in window.end_state.iter_mut().zip(window.state.iter().zip(&stages.z)) {
            *end = y + z[2];
        }
        self.step = step;
        self.window.end_time = self.window.time + step;
    }

    fn estimate(&mut self, step: f64) -> f64 {
        self.tried = step;
        self.error.copy_from_slice(&self.slope);
        self.solve_for_error(step)
    }

    /// The estimate made anew with the slope where the first one leads: where the system is
    /// stiff, the first is far too large.
    fn filtered_estimate(&mut self, system: &mut dyn System, step: f64) -> f64 {
        let Self { window, stages, error, .. } = self;
        for (out, (y, e)) in stages.argument.iter_mut().zip(window.state.iter().zip(&*error)) {
            *out = y + e;
        }
        system.derivative(window.time, &stages.argument, error);
        window.counts.evaluations += 1;
        self.solve_for_error(step)
    }

    /// Turns the slope in `error` into the estimated error.
    fn solve_for_error(&mut self, step: f64) -> f64 {
        for (e, z) in self.error.iter_mut().zip(&self.stages.z) {
            *e = step * *e + ERROR[0] * z[0] + ERROR[1] * z[1] + ERROR[2] * z[2];
        }
        self.matrix.real.solve(&mut self.error);
        let norm = self.norm(|i| self.error[i]);
        if norm.is_nan() { f64::INFINITY } else { norm.max(SMALLEST_ERROR) }
    }

    fn too_short(&self, step: f64) -> StepError {
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
        self.window.start(system, t, y);
        self.matrix.resize(size);
        self.stages.resize(size);
        for (buffer, len) in
            [(&mut self.slope, size), (&mut self.error, size), (&mut self.scales, controlled)]
        {
            buffer.clear();
            buffer.resize(len, 0.0);
        }
        self.last.length = 0.0;
        for curves in [&mut self.dense, &mut self.last.curves] {
            curves.clear();
            curves.resize(size, Collocation::default());
        }
        (self.step, self.slope_is_known, self.jacobian) = (0.0, false, Age::Outdated);
        self.prepare(system);
        self.window.next_step = self.first_step().min(self.window.longest);
    }

    fn step(&mut self, system: &mut dyn System, limit: f64) -> Result<(), StepError> {
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
                    return Ok(());
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
        for (curve, z) in self.dense.iter_mut().zip(&self.stages.z) {
            *curve = Collocation::through(*z);
        }
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        for (value, (y, curve)) in out.iter_mut().zip(self.window.state.iter().zip(&self.dense)) {
            *value = y + curve.at(fraction);
        }
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        Bernstein::of_terms(self.window.state[i], &self.dense[i].terms)
    }

    /// Corrections go on until rounding, so that the end is a smooth function of the length.
    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.prepare(system);
        let ratio = if self.step > 0.0 { step / self.step } else { 0.0 };
        for (z, curve) in self.stages.z.iter().zip(&mut self.last.curves) {
            *curve = Collocation::through(*z);
        }
        let Self { stages, last, .. } = self;
        stages.guess(|i| C.map(|c| last.curves[i].at(c * ratio)));
        if self.matrix.factor(step, &mut self.window.counts) {
            let rounding = f64::EPSILON / self.tolerance.relative;
            self.stages.settle(
                system,
                &mut self.matrix,
                (&mut self.window, step),
                (&self.scales, rounding),
            );
        }
        self.keep(step);
    }

    fn advance(&mut self) {
        self.window.advance();
        self.last.length = self.step;
        for (curve, z) in self.last.curves.iter_mut().zip(&self.stages.z) {
            *curve = Collocation::through(*z);
        }
        self.slope_is_known = false;
        self.jacobian = if self.stages.contraction <= GOOD { Age::Kept } else { Age::Outdated };
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        for y in &mut self.window.state[range] {
            *y *= factor;
        }
        self.slope_is_known = false;
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
        Choice::demanded(Method::Radau5)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.stages.argument
    }
}
