use std::ops::Range;

use collocation::{Collocation, dot};
use control::{
    HALF, History, Iteration, MOST, MOST_RETAKEN, Progress, REFUSED, error_of_end, factor,
};
use dense::{Dense, Taken};
use end_slopes::EndSlopes;
use nboom_scalar::Eight;
use stages::{Stages, Start};

use crate::gauss::coefficients::STAGES;
use crate::method::Description;
use crate::{Bernstein, Choice, Method, Part, StepError, Stepper, System, Tolerance, Window};

mod collocation;
mod control;
mod dense;
mod end_slopes;
mod stages;

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "gauss_lanes",
    about: "implicit Runge-Kutta 16, eight stages side by side, for small errors",
    order: |_| 16,
    dense_order: |_| 10,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(GaussLanes::new(tolerance)),
};

/// Gauss's collocation method with eight stages, of order 16, whose stages are evaluated side by side
/// ([`System::derivatives`]).
///
/// The stages follow from fixed-point iterations, which begin with the polynomial of the step before
/// or, when a step is taken again, its own. Variables that are integrals of others are integrated
/// anew in each iteration; followers are iterated when the others have converged ([`Role`]). The
/// step follows from the last Legendre coefficients of the derivative.
///
/// Stiff damping slows the iteration down, so that steps become as short as in explicit methods.
///
/// [`Role`]: crate::Role
#[derive(Clone, Debug)]
pub struct GaussLanes {
    collocation: &'static Collocation,
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    stages: Stages,
    ends: EndSlopes,
    /// One over the error allowed, zero for variables that are not controlled.
    per_tolerance: Vec<f64>,
    /// What rounding has taken from the variables at the start and the end of the step.
    lost: Vec<f64>,
    end_lost: Vec<f64>,
    iteration: Iteration,
    of_followers: Iteration,
    /// K of the last step that was solved, over `curve`.
    known: Vec<Eight>,
    curve: Curve,
    history: History,
    dense: Dense,
}

/// Where known slopes are from.
#[derive(Clone, Copy, Debug, Default)]
struct Curve {
    /// Length of the step they were computed for; zero when there is none.
    length: f64,
    /// The fraction of it at which the present step begins.
    from: f64,
}

/// No polynomial is continued over so many times its length.
const TOO_FAR: f64 = 4.0;

impl GaussLanes {
    /// The method with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        let collocation = Collocation::of_eight_stages();
        Self {
            dense: Dense::new(collocation),
            collocation,
            tolerance,
            controlled: 0,
            window: Window::default(),
            stages: Stages::default(),
            ends: EndSlopes::default(),
            per_tolerance: Vec::new(),
            lost: Vec::new(),
            end_lost: Vec::new(),
            iteration: Iteration::new(tolerance.relative),
            of_followers: Iteration::new(tolerance.relative),
            known: Vec::new(),
            curve: Curve::default(),
            history: History::default(),
        }
    }

    pub(crate) fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    /// Whether the iteration and not the error bounds the last step.
    pub(crate) fn is_held_back(&self) -> bool {
        self.iteration.is_slow() && self.history.is_accurate()
    }

    /// Asks for natural sizes, and what errors are allowed with them.
    fn measure(&mut self, system: &mut dyn System) {
        self.window.measure(system);
        for i in 0..self.controlled {
            let Window { sizes, state, .. } = &self.window;
            self.per_tolerance[i] = 1.0 / self.tolerance.allowed(sizes[i], state[i]);
        }
    }

    /// Root mean square of `values` over the controlled variables, in units of the tolerance.
    fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        let square = |i: usize| (values(i) * self.per_tolerance[i]).powi(2);
        ((0..self.controlled).map(square).sum::<f64>() / self.controlled.max(1) as f64).sqrt()
    }

    /// Slopes to begin with: those of the polynomial at hand, else the one at the start.
    fn guess(&mut self, system: &mut dyn System, step: f64) {
        let Curve { length, from } = self.curve;
        let ratio = step / length;
        if ratio.abs() < TOO_FAR {
            self.stages.predict(&self.known, from, ratio, self.collocation);
            return;
        }
        let start = self.ends.start(system, &mut self.window);
        for (slopes, slope) in self.stages.slopes.iter_mut().zip(start) {
            *slopes = Eight::splat(step * slope);
        }
    }

    /// Iterates the stages of a part; returns whether they converged.
    fn iterate(&mut self, system: &mut dyn System, part: Part, step: f64, most: usize) -> bool {
        let Self { collocation, window, stages, lost, per_tolerance, .. } = self;
        let iteration = match part {
            Part::Coupled => &mut self.iteration,
            Part::Followers => &mut self.of_followers,
        };
        let start = Start { state: &window.state, lost, per_tolerance };
        let times = collocation.times(window.time, step);
        let members = stages.roles.of(part);
        let controlled = members.iter().filter(|&&i| i < self.controlled).count();
        let mean = 1.0 / (controlled.max(1) as f64).sqrt();
        iteration.begin(step);
        loop {
            stages.place(part, step, &start, collocation);
            window.counts.evaluations += stages.evaluate(system, &[part], &times);
            let change = mean * stages.absorb(part, step, &start);
            let progress = iteration.note(change, most);
            if progress != Progress::Converging {
                stages.place(part, step, &start, collocation);
                return progress == Progress::Converged;
            }
        }
    }

    /// Mean error of a part, in units of the tolerance.
    fn error_of_part(&self, part: Part) -> f64 {
        let members = self.stages.roles.of(part).iter().filter(|&&i| i < self.controlled);
        let add = |(sum, count): (f64, f64), &i: &usize| (sum + self.error_at_end(i), count + 1.0);
        let (sum, count) = members.fold((0.0, 0.0), add);
        if count > 0.0 { sum / count } else { 0.0 }
    }

    fn error_at_end(&self, i: usize) -> f64 {
        let slopes = &self.stages.slopes[i].0;
        let terms = self.collocation.last_terms.map(|row| dot(&row.0, slopes));
        let magnitude = self.window.sizes[i] + self.window.state[i].abs();
        error_of_end(terms, magnitude, self.per_tolerance[i])
    }

    /// Tries a step; returns its error or, if that is too large, by how much the step should be
    /// shorter.
    fn attempt(&mut self, system: &mut dyn System, step: f64) -> Result<f64, f64> {
        self.guess(system, step);
        let mut error = 0.0_f64;
        for part in [Part::Coupled, Part::Followers] {
            if self.stages.roles.of(part).is_empty() {
                continue;
            }
            if !self.iterate(system, part, step, MOST) {
                return Err(HALF);
            }
            let of_part = self.error_of_part(part);
            if of_part.is_nan() || of_part > REFUSED {
                return Err(factor(of_part).min(SHORTER));
            }
            error = error.max(of_part);
        }
        Ok(error)
    }

    /// Ends the step where the slopes lead.
    fn keep(&mut self, step: f64) {
        self.known.copy_from_slice(&self.stages.slopes);
        self.curve = Curve { length: step, from: 0.0 };
        for (i, slopes) in self.known.iter().enumerate() {
            let increment = self.lost[i] + dot(&self.collocation.weights.0, &slopes.0);
            self.end_lost[i] = self.window.end_after(i, increment);
        }
    }

    /// A first step from the times in which the first and the second derivative change the variables
    /// by what they are; infinite where nothing moves.
    fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let slope = self.ends.start(system, &mut self.window);
        self.stages.derivative.copy_from_slice(slope);
        let size = self.norm(|i| self.window.magnitude(i));
        let by_slope = size / self.norm(|i| self.stages.derivative[i]);
        if !by_slope.is_finite() {
            return f64::INFINITY;
        }
        let ahead = AHEAD * by_slope;
        let Self { stages: Stages { argument, derivative, .. }, window, ends, .. } = self;
        for i in 0..argument.len() {
            argument[i] = window.state[i] + ahead * derivative[i];
        }
        system.derivative(window.time + ahead, argument, derivative);
        window.counts.evaluations += 1;
        for (second, first) in derivative.iter_mut().zip(ends.start(system, window)) {
            *second = (*second - first) / ahead;
        }
        let by_curvature = (size / self.norm(|i| self.stages.derivative[i])).sqrt();
        by_slope.min(by_curvature) * size.powf(-0.5 / STAGES as f64)
    }

    fn too_short(&mut self, system: &mut dyn System) -> StepError {
        let Self { stages: Stages { argument, derivative, .. }, window, .. } = self;
        let (time, step) = (window.time, window.next_step);
        argument.copy_from_slice(&window.state);
        system.derivative(time, argument, derivative);
        if let Some(variable) = derivative.iter().position(|slope| !slope.is_finite()) {
            return StepError::NotFinite { time, variable };
        }
        let larger = |&a: &usize, &b: &usize| self.error_at_end(a).total_cmp(&self.error_at_end(b));
        let variable = (0..self.controlled).max_by(larger).unwrap_or(0);
        StepError::Underflow { time, step, variable }
    }
}

/// A refused step is tried shorter by this at least.
const SHORTER: f64 = 0.9;
/// Share of the time in which the slope changes the variables by what they are, after which the
/// slope is evaluated again.
const AHEAD: f64 = 0.01;

impl Stepper for GaussLanes {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.window.start(system, t, y);
        let size = y.len();
        self.stages.start(system, size);
        self.ends.reset(size);
        self.dense.start(y);
        for buffer in [&mut self.lost, &mut self.end_lost, &mut self.per_tolerance] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        self.known.clear();
        self.known.resize(size, Eight::default());
        self.iteration = Iteration::new(self.tolerance.relative);
        self.of_followers = self.iteration;
        (self.curve, self.history) = (Curve::default(), History::default());
        self.measure(system);
        self.window.next_step = self.first_step(system).min(self.window.longest);
    }

    fn reset(&mut self) {
        self.window.reset();
    }

    fn limit_steps(&mut self, longest: f64) {
        self.window.longest = longest;
    }

    fn step(&mut self, system: &mut dyn System, limit: f64) -> Result<(), StepError> {
        self.measure(system);
        let (time, mut most) = (self.window.time, f64::INFINITY);
        loop {
            let Some((step, reaches)) = self.window.attempt(limit) else {
                return Err(self.too_short(system));
            };
            match self.attempt(system, step) {
                Ok(error) => {
                    self.keep(step);
                    let factor = self.history.note(step, error, &self.iteration).min(most);
                    let end = if reaches { limit } else { time + step };
                    self.window.accept(end, reaches, step * factor);
                    self.ends.forget_end();
                    return Ok(());
                }
                Err(shorter) => {
                    self.window.counts.rejected += 1;
                    self.window.next_step = step * shorter;
                    most = 1.0;
                    if time + 0.1 * self.window.next_step == time {
                        return Err(self.too_short(system));
                    }
                }
            }
        }
    }

    fn prepare_dense(&mut self, system: &mut dyn System) {
        let Self { window, stages, ends, known, collocation, curve, .. } = self;
        let ends = ends.both(system, window);
        let Window { time, state, .. } = &*window;
        let (weights, step) = (&collocation.weights, curve.length);
        let taken = Taken { time: *time, step, state, known, ends, weights };
        let evaluations = self.dense.prepare(system, stages, taken);
        self.window.counts.evaluations += evaluations;
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.dense.interpolate(&self.stages.roles, fraction, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        self.dense.polynomial(&self.stages.roles, i)
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.guess(system, step);
        for part in [Part::Coupled, Part::Followers] {
            if !self.stages.roles.of(part).is_empty() {
                self.iterate(system, part, step, MOST_RETAKEN);
            }
        }
        self.keep(step);
        self.window.end_time = self.window.time + step;
        self.ends.forget_end();
    }

    fn advance(&mut self) {
        self.window.advance();
        std::mem::swap(&mut self.lost, &mut self.end_lost);
        self.curve.from = 1.0;
        self.ends.advance();
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.ends.scale(range.clone(), factor);
        for i in range {
            self.window.state[i] *= factor;
            self.lost[i] *= factor;
            self.known[i].0.iter_mut().for_each(|slope| *slope *= factor);
        }
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn error_of(&self, i: usize) -> f64 {
        self.error_at_end(i) / self.iteration.step
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::GaussLanes)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.stages.argument
    }
}
