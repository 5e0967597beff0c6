use std::ops::Range;

use crate::first_step::{Onset, in_units_of};
use crate::method::Description;
use crate::stepper::{is_near_end, root_mean_square};
use crate::weighted_sum::BLOCK;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

mod control;
mod curve;
mod differences;
mod formulas;

use control::Control;
use curve::Curve;
use differences::{Correction, Differences, Prediction};
use formulas::Formulas;

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "adams",
    about: "Adams' predictor and corrector, for long motions without code for eight states; orders up to this",
    order: |_| HIGHEST as u32 + 1,
    dense_order: |_| HIGHEST as u32 + 1,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Adams::new(tolerance)),
};

/// Highest order of the predictor; the corrector's is one more.
const HIGHEST: usize = 12;

/// Share of the tolerance that a step may err by: there are several steps for one of a Runge-Kutta method, and the ends
/// of both then err by about as much.
const SHARE: f64 = 0.05;
/// Less than that is lost in rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Order times step times eigenvalue above which stability bounds steps: about 3 for oscillations and more for decays.
/// Where accuracy bounds them it is 0.5 to 2.4.
const STABLE: f64 = 2.6;
/// Weight of the last step in what has been of late.
const LATELY: f64 = 0.1;

/// Adams' predictor and corrector of variable step and order: the slope is continued by the polynomial through those at
/// the last steps' ends, and corrected once.
///
/// A step evaluates twice, however high its order, which starts with 1. In Krogh's modified divided differences, as
/// Shampine and Gordon arrange them (Computer Solution of Ordinary Differential Equations, 1975).
#[derive(Clone, Debug)]
pub struct Adams {
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    differences: Differences,
    formulas: Formulas,
    control: Control,
    /// The variables at the start of the step, and where it is predicted to end.
    start: Vec<f64>,
    predicted: Vec<f64>,
    /// The slope there, the one that differences predict, and what it has more than that.
    slope: Vec<f64>,
    expected: Vec<f64>,
    correction: Vec<f64>,
    /// The slope at the end of the step.
    end_slope: Vec<f64>,
    /// Absolute part of the error allowed in each variable; infinite in those that do not count.
    absolute: Vec<f64>,
    /// One over the error allowed.
    per_tolerance: Vec<f64>,
    curve: Curve,
    /// What tells whether steps are [held back](Self::is_held_back).
    stiffness: f64,
}

impl Adams {
    /// The method with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        let Tolerance { relative, absolute } = tolerance;
        let relative = (SHARE * relative).max(ROUNDING).min(relative);
        Self {
            tolerance: Tolerance { relative, absolute: SHARE * absolute },
            controlled: 0,
            window: Window::default(),
            differences: Differences::default(),
            formulas: Formulas::default(),
            control: Control::default(),
            start: Vec::new(),
            predicted: Vec::new(),
            slope: Vec::new(),
            expected: Vec::new(),
            correction: Vec::new(),
            end_slope: Vec::new(),
            absolute: Vec::new(),
            per_tolerance: Vec::new(),
            curve: Curve::default(),
            stiffness: 0.0,
        }
    }

    fn size(&self) -> usize {
        self.window.state.len()
    }

    /// Makes room for (`t`, `y`) and evaluates there.
    fn begin(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.window.start(system, t, y);
        (self.control, self.stiffness) = (Control::default(), 0.0);
        let room = y.len().next_multiple_of(BLOCK);
        self.differences.start(room);
        self.formulas.prepare(&self.differences, 1, 1.0);
        self.curve.start(room);
        for buffer in [
            &mut self.start,
            &mut self.predicted,
            &mut self.slope,
            &mut self.expected,
            &mut self.correction,
            &mut self.end_slope,
            &mut self.per_tolerance,
        ] {
            buffer.clear();
            buffer.resize(room, 0.0);
        }
        self.absolute.clear();
        self.absolute.resize(room, f64::INFINITY);
        system.derivative(t, y, &mut self.differences.slope_mut()[..y.len()]);
        self.window.counts.evaluations += 1;
    }

    /// A first step, of order 1, whose error goes with its square; infinite where nothing moves.
    fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let Self { tolerance, window, differences, predicted, slope, controlled, .. } = self;
        let size = window.state.len();
        let room = [&mut predicted[..size], &mut slope[..size]];
        let begin = &differences.slope()[..size];
        let onset = Onset::find(system, window, begin, room, in_units_of(*tolerance, *controlled));
        onset.map_or(f64::INFINITY, |onset| onset.step(1.0, 0.5))
    }

    /// Notes where the step starts and what of its error does not depend on that.
    fn measure(&mut self) {
        self.start[..self.window.state.len()].copy_from_slice(&self.window.state);
        let sizes = self.window.sizes[..self.controlled].iter();
        for (absolute, size) in self.absolute.iter_mut().zip(sizes) {
            *absolute = self.tolerance.absolute * size;
        }
    }

    fn allow(&mut self) {
        differences::allow(
            self.tolerance.relative,
            [&self.absolute, &self.start, &self.predicted],
            &mut self.per_tolerance,
        );
    }

    /// Root mean square over the controlled variables, in units of the tolerance.
    fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        root_mean_square(self.controlled, |i| values(i) * self.per_tolerance[i])
    }

    fn of_sum(&self, squares: f64) -> f64 {
        (squares / self.controlled.max(1) as f64).sqrt()
    }

    /// Predicts a step of this length, evaluates at its end, and finds its errors.
    fn predict(&mut self, system: &mut dyn System, step: f64) {
        let n = self.size();
        self.formulas.prepare(&self.differences, self.control.order, step);
        let Self { differences, formulas, start, predicted, slope, expected, .. } = self;
        Prediction { differences, formulas, start, end: predicted, slope: expected }.make();
        system.derivative(self.window.time + step, &predicted[..n], &mut slope[..n]);
        self.window.counts.evaluations += 1;
        self.allow();
        let Self { differences, formulas, slope, expected, per_tolerance, .. } = self;
        let correction = Correction { differences, formulas, slope, expected, per_tolerance };
        let squares = correction.make(&mut self.correction);
        let norms = squares.map(|sum| self.of_sum(sum));
        self.control.judge(&self.formulas, norms);
    }

    /// Corrects the step that was predicted, and evaluates at its end; whether the slope there is finite.
    fn correct(&mut self, system: &mut dyn System) -> bool {
        let n = self.size();
        let Formulas { step, .. } = self.formulas;
        let weight = step * self.formulas.last_weight();
        for (i, end) in self.window.end_state.iter_mut().enumerate() {
            *end = self.predicted[i] + weight * self.correction[i];
        }
        let end = self.window.time + step;
        system.derivative(end, &self.window.end_state, &mut self.end_slope[..n]);
        self.window.counts.evaluations += 1;
        self.end_slope[..n].iter().all(|slope| slope.is_finite())
    }

    /// The norm of what makes the error of the order above, if it is known.
    fn norm_above(&self) -> Option<f64> {
        let Self { differences, formulas, end_slope, expected, per_tolerance, .. } = self;
        let slope = end_slope;
        let correction = Correction { differences, formulas, slope, expected, per_tolerance };
        correction.square_above().map(|sum| self.of_sum(sum))
    }

    /// Whether stability and not accuracy bounds steps, as it has been of late.
    pub(crate) fn is_held_back(&self) -> bool {
        self.stiffness > STABLE
    }

    /// Notes the order times the step times about the magnitude of the fastest motion's eigenvalue, from the two slopes
    /// at the step's end.
    fn note_stiffness(&mut self) {
        let order = self.formulas.order as f64;
        let of_states = self.formulas.last_weight() * self.norm(|i| self.correction[i]);
        let of_slopes = self.norm(|i| self.end_slope[i] - self.slope[i]);
        let found = if of_states > 0.0 { order * of_slopes / of_states } else { 0.0 };
        self.stiffness += LATELY * (found - self.stiffness);
    }

    fn too_short(&self, step: f64) -> StepError {
        let time = self.window.time;
        let not_finite = |&i: &usize| {
            let Self { predicted, slope, end_slope, differences, .. } = self;
            let found = [predicted[i], slope[i], end_slope[i], differences.slope()[i]];
            found.iter().any(|number| !number.is_finite())
        };
        if let Some(variable) = (0..self.size()).find(not_finite) {
            return StepError::NotFinite { time, variable };
        }
        StepError::underflow(time, step, 0..self.controlled, |i| self.error_of(i))
    }
}

impl Stepper for Adams {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.begin(system, t, y, controlled);
        self.window.next_step = self.first_step(system).min(self.window.longest);
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        self.window.measure(system);
        self.measure();
        loop {
            let Some((step, reaches)) = self.window.attempt(limit) else {
                return Err(self.too_short(self.window.next_step));
            };
            self.predict(system, step);
            if self.control.is_good() && self.correct(system) {
                self.note_stiffness();
                let next = self.control.accept(&self.formulas, self.norm_above());
                let end = if reaches { limit } else { self.window.time + step };
                self.window.accept(end, reaches, next);
                return Ok(None);
            }
            self.window.counts.rejected += 1;
            self.window.next_step = self.control.reject(step);
            if self.window.time + 0.1 * self.window.next_step == self.window.time {
                return Err(self.too_short(step));
            }
        }
    }

    fn prepare_dense(&mut self, _system: &mut dyn System) {
        if !self.curve.is_there() {
            self.curve.prepare(&self.differences, &self.formulas, &self.correction);
        }
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.curve.interpolate(&self.differences, &self.window.state, fraction, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        self.curve.polynomial(&self.differences, self.window.state[i], i)
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.predict(system, step);
        self.correct(system);
        self.window.end_time = self.window.time + step;
    }

    fn ends_inside(&self) -> bool {
        true
    }

    fn end_inside(&mut self, fraction: f64) -> bool {
        if !self.curve.is_there() || !is_near_end(fraction) {
            return false;
        }
        let mut end = std::mem::take(&mut self.window.end_state);
        self.interpolate(fraction, &mut end);
        self.window.end_state = end;
        self.window.end_time = self.window.time + fraction * self.curve.step();
        true
    }

    fn advance(&mut self) {
        self.window.advance();
        self.differences.advance(&self.formulas, &self.end_slope);
        self.control.advance();
        self.curve.forget();
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.differences.scale(range.clone(), factor);
        self.window.state[range].iter_mut().for_each(|y| *y *= factor);
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn slopes(&self) -> Option<&[f64]> {
        Some(&self.differences.slope()[..self.size()])
    }

    fn error_of(&self, i: usize) -> f64 {
        self.correction[i].abs() * self.per_tolerance[i] * self.formulas.judged()
            / self.formulas.step
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::Adams)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.predicted[..self.size()]
    }
}
