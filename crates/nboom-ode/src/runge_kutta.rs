use std::ops::Range;

use crate::first_step::{Onset, in_units_of};
use crate::stepper::{is_near_end, root_mean_square};
use crate::tableau::{DOP853, DOPRI5, Tableau};
use crate::weighted_sum::{BLOCK, sum_up};
use crate::{Bernstein, Choice, StepError, Stepper, System, Tolerance, Window};

mod estimates;
mod lanes;

use estimates::Squares;
pub use lanes::EightSteps;

/// An explicit Runge-Kutta method with step control and dense output.
#[derive(Clone, Debug)]
pub struct RungeKutta {
    tableau: &'static Tableau,
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    step: f64,
    /// The stages one after the other, each with room for a whole number of blocks.
    stages: Vec<f64>,
    stride: usize,
    stage_state: Vec<f64>,
    /// Estimated errors of the step, and room for other weighted sums of stages.
    sums: [Vec<f64>; 2],
    /// Terms of dense output, variable by variable.
    dense: Vec<f64>,
    previous_error: f64,
    attempt: Attempt,
    /// Of the step, where they were found beside those of others; then its stages are elsewhere, but for the first
    /// and the last.
    squares: Option<Squares>,
    /// Whether terms of dense output are those of the step.
    has_dense: bool,
}

/// The step that is tried.
#[derive(Clone, Copy, Debug, Default)]
struct Attempt {
    step: f64,
    /// Whether it ends at the limit.
    reaches: bool,
    /// Whether another one was rejected before.
    after_rejection: bool,
}

/// Share of the step it had with which a restart begins: the whole of it costs accuracy where the motion
/// has become faster.
const CARRIED: f64 = 0.8;
/// An error this small does not speed up the next step any more.
const SMALL_ERROR: f64 = 1e-4;

impl RungeKutta {
    /// The method of Dormand and Prince of order 8, with step control by estimates of order 5
    /// and 3 and dense output of order 7.
    pub fn dop853(tolerance: Tolerance) -> Self {
        Self::new(&DOP853, tolerance)
    }

    /// The method of Dormand and Prince of order 5, with an estimate and dense output of
    /// order 4.
    pub fn dopri5(tolerance: Tolerance) -> Self {
        Self::new(&DOPRI5, tolerance)
    }

    fn new(tableau: &'static Tableau, tolerance: Tolerance) -> Self {
        Self {
            tableau,
            tolerance,
            controlled: 0,
            window: Window::default(),
            step: 0.0,
            stages: Vec::new(),
            stride: 0,
            stage_state: Vec::new(),
            sums: [Vec::new(), Vec::new()],
            dense: Vec::new(),
            previous_error: SMALL_ERROR,
            attempt: Attempt::default(),
            squares: None,
            has_dense: false,
        }
    }

    /// Makes room for (`t`, `y`) and evaluates there.
    fn begin(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.previous_error = SMALL_ERROR;
        (self.squares, self.has_dense) = (None, false);
        self.window.start(system, t, y);
        self.stride = y.len().next_multiple_of(BLOCK);
        let terms = self.terms();
        let [errors, lowers] = &mut self.sums;
        for (buffer, size) in [
            (&mut self.stages, self.stride * self.tableau.c.len()),
            (&mut self.stage_state, self.stride),
            (errors, self.stride),
            (lowers, self.stride),
            (&mut self.dense, y.len() * terms),
        ] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        system.derivative(t, y, &mut self.stages[..y.len()]);
        self.window.counts.evaluations += 1;
    }

    /// A first step; infinite where nothing moves.
    fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let Self { tableau, tolerance, window, stages, stage_state, controlled, .. } = self;
        let size = window.state.len();
        let (first, second) = stages.split_at_mut(self.stride);
        let room = [&mut stage_state[..size], &mut second[..size]];
        let onset =
            Onset::find(system, window, &first[..size], room, in_units_of(*tolerance, *controlled));
        onset.map_or(f64::INFINITY, |onset| onset.step(0.01, tableau.control.exponent))
    }

    /// Takes a step of this length, whatever its error.
    pub fn take(&mut self, system: &mut dyn System, step: f64) {
        let last = self.tableau.stages;
        (self.squares, self.has_dense) = (None, false);
        for stage in 1..last {
            self.evaluate_stage(system, stage, step);
        }
        self.combine(last, step);
        let size = self.size();
        self.window.end_state.copy_from_slice(&self.stage_state[..size]);
        self.evaluate(system, last, step);
    }

    /// Ends the step after this length, which was [taken](Self::take) whatever its error.
    pub fn end_after(&mut self, step: f64) {
        self.step = step;
        self.window.end_time = self.window.time + step;
    }

    /// The step that is tried on the way to `limit`; its length.
    fn propose(&mut self, limit: f64, after_rejection: bool) -> Result<f64, StepError> {
        let Some((step, reaches)) = self.window.attempt(limit) else {
            return Err(self.too_short(self.window.next_step));
        };
        self.attempt = Attempt { step, reaches, after_rejection };
        Ok(step)
    }

    fn size(&self) -> usize {
        self.window.state.len()
    }

    fn terms(&self) -> usize {
        3 + self.tableau.dense.len()
    }

    fn evaluate_stage(&mut self, system: &mut dyn System, stage: usize, step: f64) {
        self.combine(stage, step);
        self.evaluate(system, stage, step);
    }

    /// Writes the argument of a stage.
    fn combine(&mut self, stage: usize, step: f64) {
        let Self { tableau, window, stages, stage_state, .. } = self;
        sum_up(stages, tableau.a[stage], step, stage_state);
        for (out, y) in stage_state.iter_mut().zip(&window.state) {
            *out += y;
        }
    }

    fn evaluate(&mut self, system: &mut dyn System, stage: usize, step: f64) {
        let size = self.size();
        let derivative = &mut self.stages[stage * self.stride..][..size];
        let time = self.window.time + self.tableau.c[stage] * step;
        system.derivative(time, &self.stage_state[..size], derivative);
        self.window.counts.evaluations += 1;
    }

    fn scale_of(&self, i: usize) -> f64 {
        let value = self.window.state[i].abs().max(self.window.end_state[i].abs());
        self.tolerance.allowed(self.window.sizes[i], value)
    }

    fn factor(&self, error: f64) -> f64 {
        self.tableau.control.factor(error, self.previous_error)
    }

    fn too_short(&self, step: f64) -> StepError {
        let time = self.window.time;
        let last = self.tableau.stages * self.stride;
        let not_finite = |&i: &usize| {
            let found = [self.window.end_state[i], self.sums[0][i], self.stages[last + i]];
            found.iter().any(|number| !number.is_finite())
        };
        if let Some(variable) = (0..self.size()).find(not_finite) {
            return StepError::NotFinite { time, variable };
        }
        StepError::underflow(time, step, 0..self.controlled, |i| self.error_of(i))
    }

    /// Root mean square of `values` over the controlled variables, in units of the tolerance.
    fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        root_mean_square(self.controlled, |i| values(i) / self.scale_of(i))
    }
}

impl Stepper for RungeKutta {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.begin(system, t, y, controlled);
        self.window.next_step = self.first_step(system).min(self.window.longest);
    }

    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        let had = self.window.next_step;
        self.begin(system, t, y, controlled);
        let has_had = had > 0.0 && had.is_finite();
        let first = if has_had { CARRIED * had } else { self.first_step(system) };
        self.window.next_step = first.min(self.window.longest);
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        self.window.measure(system);
        self.propose(limit, false).map(Some)
    }

    fn explicit(&mut self) -> Option<&mut RungeKutta> {
        Some(self)
    }

    fn judge(&mut self, limit: f64) -> Result<Option<f64>, StepError> {
        let Attempt { step, reaches, after_rejection } = self.attempt;
        let start = self.window.time;
        let error = self.error_norm(step);
        if error <= 1.0 {
            self.step = step;
            let factor = self.factor(error);
            let factor = if after_rejection { factor.min(1.0) } else { factor };
            self.previous_error = error.max(SMALL_ERROR);
            let end = if reaches { limit } else { start + step };
            self.window.accept(end, reaches, step * factor);
            return Ok(None);
        }
        self.window.counts.rejected += 1;
        self.window.next_step = step * self.factor(error).min(1.0);
        if start + 0.1 * self.window.next_step == start {
            return Err(self.too_short(step));
        }
        self.propose(limit, true).map(Some)
    }

    fn prepare_dense(&mut self, system: &mut dyn System) {
        if self.has_dense {
            return;
        }
        if self.squares.is_some() {
            self.take(system, self.step);
        }
        let last = self.tableau.stages;
        for stage in last + 1..self.tableau.c.len() {
            self.evaluate_stage(system, stage, self.step);
        }
        let (h, stride, count) = (self.step, self.stride, self.terms());
        for i in 0..self.size() {
            let difference = self.window.end_state[i] - self.window.state[i];
            let (first, end) = (h * self.stages[i], h * self.stages[last * stride + i]);
            let terms = &mut self.dense[i * count..(i + 1) * count];
            terms[0] = difference;
            terms[1] = first - difference;
            terms[2] = 2.0 * difference - (first + end);
        }
        for (row, weights) in self.tableau.dense.iter().enumerate() {
            sum_up(&self.stages, weights, h, &mut self.sums[1]);
            for (terms, sum) in self.dense.chunks_exact_mut(count).zip(&self.sums[1]) {
                terms[3 + row] = *sum;
            }
        }
        self.has_dense = true;
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        let (x, rest) = (fraction, 1.0 - fraction);
        let count = self.terms();
        for (i, value) in out.iter_mut().enumerate() {
            let terms = &self.dense[i * count..(i + 1) * count];
            let mut inner = 0.0;
            for (j, term) in terms.iter().enumerate().rev() {
                inner = (term + inner) * if j % 2 == 0 { x } else { rest };
            }
            *value = self.window.state[i] + inner;
        }
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        let count = self.terms();
        Bernstein::of_terms(self.window.state[i], &self.dense[i * count..(i + 1) * count])
    }

    fn ends_inside(&self) -> bool {
        true
    }

    fn end_inside(&mut self, fraction: f64) -> bool {
        if !self.has_dense || !is_near_end(fraction) {
            return false;
        }
        let mut end = std::mem::take(&mut self.window.end_state);
        self.interpolate(fraction, &mut end);
        self.window.end_state = end;
        self.window.end_time = self.window.time + fraction * self.step;
        true
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.take(system, step);
        self.end_after(step);
    }

    fn move_end(&mut self, system: &mut dyn System, by: f64) -> bool {
        let (size, stride) = (self.size(), self.stride);
        let (end, after) = (self.tableau.stages * stride, stride);
        for i in 0..size {
            self.stage_state[i] = self.window.end_state[i] + by * self.stages[end + i];
        }
        let time = self.window.end_time + by;
        let slope = &mut self.stages[after..][..size];
        system.derivative(time, &self.stage_state[..size], slope);
        self.window.counts.evaluations += 1;
        let bend = |i: usize| 0.5 * by * (self.stages[after + i] - self.stages[end + i]);
        let is_straight = self.norm(bend) <= 1.0;
        if is_straight {
            for i in 0..size {
                self.window.end_state[i] = self.stage_state[i] + bend(i);
            }
            self.step += by;
            self.window.end_time = time;
            self.stages.copy_within(after..after + stride, end);
            self.has_dense = false;
        }
        is_straight
    }

    fn advance(&mut self) {
        self.window.advance();
        let at = self.tableau.stages * self.stride;
        self.stages.copy_within(at..at + self.stride, 0);
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        for i in range {
            self.window.state[i] *= factor;
            self.stages[i] *= factor;
        }
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn slopes(&self) -> Option<&[f64]> {
        Some(&self.stages[..self.size()])
    }

    fn error_of(&self, i: usize) -> f64 {
        self.sums[0][i].abs() / self.scale_of(i)
    }

    fn choice(&self) -> Choice {
        Choice::demanded(self.tableau.method)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.stage_state[..self.size()]
    }
}
