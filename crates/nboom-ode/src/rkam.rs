use std::ops::Range;

use crate::method::Description;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

mod history;

use history::{FOR_DOUBLING, History};

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "rkam",
    about: "Adams-Moulton 4 as in 1970, to see what the original saw",
    order: |_| 4,
    dense_order: |_| 4,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Rkam::new(RkamSettings::meeting(Bound::Within(tolerance)))),
};

/// What steers [`Rkam`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RkamSettings {
    /// The step after each start; `None` looks for one that meets `upper`.
    pub first_step: Option<f64>,
    /// Steps are not halved below this.
    pub shortest: f64,
    /// Steps are not doubled beyond this.
    pub longest: f64,
    /// Difference of predictor and corrector above which the step is halved.
    pub upper: Bound,
    /// Difference below which it is doubled.
    pub lower: Bound,
}

/// What a difference of predictor and corrector is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// One number for all variables, each in its own unit, as in 1970.
    Number(f64),
    /// What the tolerance allows in each variable.
    Within(Tolerance),
}

impl Bound {
    fn of(self, size: f64, value: f64) -> f64 {
        match self {
            Self::Number(number) => number,
            Self::Within(tolerance) => tolerance.allowed(size, value),
        }
    }

    /// The bound below which a step is doubled; above this one it is halved.
    fn for_doubling(self) -> Self {
        match self {
            Self::Number(number) => Self::Number(number / BAND),
            Self::Within(Tolerance { relative, absolute }) => {
                Self::Within(Tolerance { relative: relative / BAND, absolute: absolute / BAND })
            }
        }
    }
}

/// How far below the upper bound the lower one is, as in the report's sample. Doubling makes
/// the difference 32 times as large.
const BAND: f64 = 50.0;

impl RkamSettings {
    /// Halves above `upper`, doubles well below it, and starts with a step of its own choice.
    pub fn meeting(upper: Bound) -> Self {
        Self {
            first_step: None,
            shortest: 0.0,
            longest: f64::INFINITY,
            upper,
            lower: upper.for_doubling(),
        }
    }
}

/// The integrator of the 1970 program: predictor and corrector of Adams and Moulton, of order 4,
/// started by the classical Runge-Kutta method, with steps that are halved and doubled.
///
/// Steps of the Runge-Kutta method are not tested: three after each start and each halving, and
/// one wherever a step is cut to another length.
#[derive(Clone, Debug)]
pub struct Rkam {
    settings: RkamSettings,
    controlled: usize,
    window: Window,
    step: f64,
    history: History,
    argument: Vec<f64>,
    slope: Vec<f64>,
    /// Corrector less predictor in the last step that was tested.
    difference: Vec<f64>,
    /// Terms of dense output, variable by variable.
    dense: Vec<f64>,
}

/// Weights of the predictor, from the step's start backwards (Adams and Bashforth).
const PREDICTOR: [f64; 4] = [55.0 / 24.0, -59.0 / 24.0, 37.0 / 24.0, -9.0 / 24.0];
/// Weights of the corrector, from the step's end backwards (Adams and Moulton).
const CORRECTOR: [f64; 4] = [9.0 / 24.0, 19.0 / 24.0, -5.0 / 24.0, 1.0 / 24.0];
/// Stages of the Runge-Kutta method after the first: time, and weight in the sum.
const STAGES: [(f64, f64); 3] = [(0.5, 2.0 / 6.0), (0.5, 2.0 / 6.0), (1.0, 1.0 / 6.0)];
/// Terms of dense output.
const TERMS: usize = 4;
/// Share of a step in which dense output looks at the derivative when it has no past one.
const INSIDE: f64 = 1.0 / 3.0;
/// How often a first step is halved before it is left to the control of steps.
const TRIALS: usize = 60;

impl Rkam {
    /// The method under `settings`; where its limits contradict each other, `shortest` holds.
    pub fn new(settings: RkamSettings) -> Self {
        let longest = settings.longest.max(settings.shortest);
        Self {
            settings: RkamSettings { longest, ..settings },
            controlled: 0,
            window: Window::default(),
            step: 0.0,
            history: History::default(),
            argument: Vec::new(),
            slope: Vec::new(),
            difference: Vec::new(),
            dense: Vec::new(),
        }
    }

    fn evaluate(&mut self, system: &mut dyn System, time: f64) {
        system.derivative(time, &self.argument, &mut self.slope);
        self.window.counts.evaluations += 1;
    }

    fn evaluate_end(&mut self, system: &mut dyn System, step: f64) {
        self.argument.copy_from_slice(&self.window.end_state);
        system.derivative(self.window.time + step, &self.argument, self.history.at_end_mut());
        self.window.counts.evaluations += 1;
    }

    /// A step of the classical Runge-Kutta method.
    fn runge_kutta(&mut self, system: &mut dyn System, step: f64) {
        self.slope.copy_from_slice(self.history.past(0));
        let Window { state, end_state, .. } = &mut self.window;
        for ((end, y), f) in end_state.iter_mut().zip(state).zip(&self.slope) {
            *end = *y + step / 6.0 * f;
        }
        for (fraction, weight) in STAGES {
            let start = self.window.state.iter().zip(&self.slope);
            for (argument, (y, f)) in self.argument.iter_mut().zip(start) {
                *argument = y + fraction * step * f;
            }
            self.evaluate(system, self.window.time + fraction * step);
            for (end, f) in self.window.end_state.iter_mut().zip(&self.slope) {
                *end += step * weight * f;
            }
        }
        self.evaluate_end(system, step);
    }

    /// Predicts, evaluates and corrects; the derivative at the end is still that of the
    /// prediction.
    fn adams_moulton(&mut self, system: &mut dyn System, step: f64) {
        for i in 0..self.argument.len() {
            let past = PREDICTOR.iter().enumerate().map(|(j, b)| b * self.history.past(j)[i]);
            self.argument[i] = self.window.state[i] + step * past.sum::<f64>();
        }
        self.evaluate(system, self.window.time + step);
        let [of_end, of_past @ ..] = CORRECTOR;
        for i in 0..self.argument.len() {
            let past = of_past.iter().enumerate().map(|(j, b)| b * self.history.past(j)[i]);
            let slope = of_end * self.slope[i] + past.sum::<f64>();
            self.window.end_state[i] = self.window.state[i] + step * slope;
            self.difference[i] = self.window.end_state[i] - self.argument[i];
        }
    }

    /// Takes a step; whether it stands, and whether the next may be doubled.
    fn attempt(&mut self, system: &mut dyn System, step: f64) -> (bool, bool) {
        let is_tested = self.history.prepare(step, PREDICTOR.len());
        let mut doubles = false;
        if is_tested {
            self.adams_moulton(system, step);
            if self.largest(self.settings.upper) > 1.0 {
                return (false, false);
            }
            doubles = self.largest(self.settings.lower) < 1.0;
            self.evaluate_end(system, step);
        } else {
            self.runge_kutta(system, step);
        }
        let mut values = self.window.end_state.iter().chain(self.history.at_end());
        let finite = values.all(|value| value.is_finite());
        (finite, doubles && self.history.known_with_end(step) >= FOR_DOUBLING)
    }

    /// The largest difference, in units of `bound`.
    fn largest(&self, bound: Bound) -> f64 {
        let share = |i: usize| self.difference[i].abs() / self.bound_of(bound, i);
        (0..self.controlled).map(share).fold(0.0, f64::max)
    }

    fn bound_of(&self, bound: Bound, i: usize) -> f64 {
        bound.of(self.window.sizes[i], self.window.state[i])
    }

    /// A first step at which the last stage and the derivative at the end, which differ by
    /// terms of order 4, agree within the upper bound; infinite where nothing moves.
    fn find_first_step(&mut self, system: &mut dyn System) -> f64 {
        let largest = |value: &dyn Fn(usize) -> f64| {
            let in_sizes = |i: usize| value(i).abs() / self.window.sizes[i];
            (0..self.controlled).map(in_sizes).fold(0.0, f64::max)
        };
        let slopes = self.history.past(0);
        let (y, f) = (largest(&|i| self.window.magnitude(i)), largest(&|i| slopes[i]));
        let guess = 0.1 * y / f;
        if !guess.is_finite() {
            return self.settings.longest;
        }
        let mut step = guess.clamp(self.settings.shortest, self.settings.longest);
        for _ in 0..TRIALS {
            self.runge_kutta(system, step);
            let ends = self.history.at_end().iter().zip(&self.slope);
            for (difference, (f, stage)) in self.difference.iter_mut().zip(ends) {
                *difference = step / 6.0 * (stage - f);
            }
            if self.difference.iter().all(|d| d.is_finite())
                && self.largest(self.settings.upper) <= 1.0
            {
                break;
            }
            step = (0.5 * step).max(self.settings.shortest);
        }
        step
    }

    fn too_short(&self, step: f64) -> StepError {
        let time = self.window.time;
        let latest = self.history.past(0).iter().zip(&self.slope).zip(self.history.at_end());
        let not_finite = |((start, stage), end): ((&f64, &f64), &f64)| {
            !(start.is_finite() && stage.is_finite() && end.is_finite())
        };
        if let Some(variable) = latest.map(not_finite).position(|broken| broken) {
            return StepError::NotFinite { time, variable };
        }
        StepError::underflow(time, step, 0..self.controlled, |i| self.error_of(i))
    }

    /// The next step after one that was refused.
    fn halved(&self, step: f64) -> Result<f64, StepError> {
        let half = (0.5 * step).max(self.settings.shortest);
        let time = self.window.time;
        if half >= step || time + 0.1 * half == time { Err(self.too_short(step)) } else { Ok(half) }
    }

    /// A derivative away from the ends of the step, and at which fraction of it: a past one, or
    /// one inside, which costs an evaluation and is left in `slope`.
    fn third_slope(&mut self, system: &mut dyn System) -> f64 {
        if let Some(spacing) = self.history.spacing() {
            self.slope.copy_from_slice(self.history.past(1));
            return -spacing / self.step;
        }
        for i in 0..self.argument.len() {
            let terms = &self.dense[i * TERMS..][..TERMS - 1];
            self.argument[i] = self.window.state[i] + nested(terms, INSIDE);
        }
        self.evaluate(system, self.window.time + INSIDE * self.step);
        INSIDE
    }
}

/// x (c₀ + x̄ (c₁ + x (c₂ + …))) with x̄ = 1 − x.
fn nested(terms: &[f64], x: f64) -> f64 {
    let factors = [x, 1.0 - x];
    terms.iter().enumerate().rev().fold(0.0, |inner, (j, c)| (c + inner) * factors[j % 2])
}

impl Stepper for Rkam {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.window.start(system, t, y);
        self.history.start(y.len());
        for (buffer, terms) in [
            (&mut self.argument, 1),
            (&mut self.slope, 1),
            (&mut self.difference, 1),
            (&mut self.dense, TERMS),
        ] {
            buffer.clear();
            buffer.resize(y.len() * terms, 0.0);
        }
        self.evaluate_end(system, 0.0);
        self.history.begin();
        let RkamSettings { first_step, shortest, longest, .. } = self.settings;
        let step = first_step.unwrap_or_else(|| self.find_first_step(system));
        self.window.next_step = step.clamp(shortest, longest);
    }

    fn limit_steps(&mut self, longest: f64) {
        for bound in [&mut self.settings.shortest, &mut self.settings.longest] {
            *bound = bound.min(longest);
        }
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        self.window.measure(system);
        loop {
            let wanted = self.window.wanted(limit);
            let remaining = limit - self.window.time;
            let reaches = wanted * 1.01 >= remaining;
            let step = if reaches { remaining } else { wanted };
            let (stands, doubles) = self.attempt(system, step);
            if !stands {
                self.window.counts.rejected += 1;
                self.window.next_step = self.halved(step)?;
                continue;
            }
            self.step = step;
            self.window.end_time = if reaches { limit } else { self.window.time + step };
            self.window.next_step = wanted;
            if doubles && 2.0 * step <= self.settings.longest {
                self.window.next_step = 2.0 * step;
            }
            self.window.counts.accepted += 1;
            return Ok(None);
        }
    }

    fn prepare_dense(&mut self, system: &mut dyn System) {
        let h = self.step;
        for (i, terms) in self.dense.chunks_exact_mut(TERMS).enumerate() {
            let difference = self.window.end_state[i] - self.window.state[i];
            let (first, end) = (h * self.history.past(0)[i], h * self.history.at_end()[i]);
            terms[0] = difference;
            terms[1] = first - difference;
            terms[2] = 2.0 * difference - (first + end);
        }
        let x = self.third_slope(system);
        let by_fourth = 2.0 * x * (1.0 - x) * (1.0 - 2.0 * x);
        for (terms, f) in self.dense.chunks_exact_mut(TERMS).zip(&self.slope) {
            let cubic = terms[0] + (1.0 - 2.0 * x) * terms[1] + x * (2.0 - 3.0 * x) * terms[2];
            terms[3] = (h * f - cubic) / by_fourth;
        }
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        for (i, value) in out.iter_mut().enumerate() {
            let terms = &self.dense[i * TERMS..][..TERMS];
            *value = self.window.state[i] + nested(terms, fraction);
        }
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        Bernstein::of_terms(self.window.state[i], &self.dense[i * TERMS..][..TERMS])
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.runge_kutta(system, step);
        self.step = step;
        self.window.end_time = self.window.time + step;
    }

    fn advance(&mut self) {
        self.window.advance();
        self.history.advance(self.step);
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.window.state[range.clone()].iter_mut().for_each(|y| *y *= factor);
        self.history.scale(range, factor);
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn error_of(&self, i: usize) -> f64 {
        self.difference[i].abs() / (self.bound_of(self.settings.upper, i) * self.step.abs())
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::Rkam)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.argument
    }
}
