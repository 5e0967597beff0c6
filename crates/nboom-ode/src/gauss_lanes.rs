use std::ops::Range;

use collocation::Collocation;
use control::{
    CLEARLY, History, Iteration, MOST, MOST_RETAKEN, Progress, REFUSED, TELLING, factor,
};
use dense::{Dense, Taken};
use end_errors::EndErrors;
use end_slopes::EndSlopes;
use nboom_scalar::Eight;
use stages::{Stages, Start};

use crate::gauss::coefficients::STAGES;
use crate::method::Description;
use crate::side_by_side::SideBySide;
use crate::stepper::is_near_end;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

mod collocation;
mod control;
mod dense;
mod end_errors;
mod end_slopes;
mod first_step;
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
/// The stages follow from fixed-point iterations. These begin with the polynomial of the step before or, when a step
/// is taken again, its own; after a start, with a slope that goes on changing as it does there. Variables that are
/// integrals of others are integrated
/// anew in each iteration ([`System::rate_of`]). The step follows from the last Legendre coefficients
/// of the derivative.
///
/// Stiff damping slows the iteration down, so that steps become as short as in explicit methods.
#[derive(Clone, Debug)]
pub struct GaussLanes {
    collocation: &'static Collocation,
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    stages: Stages,
    ends: EndSlopes,
    /// How many of the evaluated variables are controlled; they come first.
    count: usize,
    /// One over the error allowed, zero for variables that are not controlled.
    per_tolerance: Vec<f64>,
    /// What rounding has taken from the variables at the start and the end of the step.
    lost: Vec<f64>,
    end_lost: Vec<f64>,
    iteration: Iteration,
    /// K of the last step that was solved, over `curve`, but of integrals.
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
            count: 0,
            per_tolerance: Vec::new(),
            lost: Vec::new(),
            end_lost: Vec::new(),
            iteration: Iteration::new(tolerance.relative),
            known: Vec::new(),
            curve: Curve::default(),
            history: History::default(),
        }
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

    /// Iterates the stages; returns whether they converge. A step that is clearly to be refused is left
    /// half-way.
    fn iterate(&mut self, system: &mut dyn System, step: f64, most: usize) -> bool {
        self.guess(system, step);
        let times = self.collocation.times(self.window.time, step);
        let start = Start { state: &self.window.state, lost: &self.lost, step };
        self.stages.place(start, self.collocation);
        self.iteration.begin(step);
        loop {
            self.stages.states.evaluate(system, &times, STAGES);
            self.window.counts.evaluations += STAGES;
            let start = Start { state: &self.window.state, lost: &self.lost, step };
            let squares = self.stages.absorb(start, &self.per_tolerance, self.collocation);
            let mean_square = self.collocation.weights.dot(&squares) / self.count.max(1) as f64;
            match self.iteration.note(mean_square.sqrt(), most) {
                Progress::Converging if most == MOST && self.iteration.count == TELLING => {
                    if self.error() > CLEARLY * REFUSED {
                        return true;
                    }
                }
                Progress::Converging => {}
                progress => return progress == Progress::Converged,
            }
        }
    }

    fn end_errors(&self) -> EndErrors<'_> {
        let Self { collocation, window, per_tolerance, stages: Stages { slopes, .. }, .. } = self;
        EndErrors { last_terms: &collocation.last_terms, slopes, window, per_tolerance }
    }

    /// Mean error of the step, in units of the tolerance.
    fn error(&self) -> f64 {
        let controlled = &self.stages.variables.evaluated[..self.count];
        self.end_errors().sum(controlled) / self.count.max(1) as f64
    }

    /// Tries a step; returns its error or, if that is too large, by how much the step should be
    /// shorter.
    fn attempt(&mut self, system: &mut dyn System, step: f64) -> Result<f64, f64> {
        if !self.iterate(system, step, MOST) {
            return Err(self.iteration.shorter());
        }
        let error = self.error();
        if error.is_nan() || error > REFUSED {
            if error.is_finite() {
                // The shorter step lies inside its polynomial, and beyond that of the step before.
                self.remember(step);
            }
            return Err(factor(error).min(SHORTER));
        }
        Ok(error)
    }

    /// Keeps the polynomial of a step that starts where the present one does.
    fn remember(&mut self, step: f64) {
        self.known.copy_from_slice(&self.stages.slopes);
        self.curve = Curve { length: step, from: 0.0 };
    }

    /// Ends the step where the slopes lead.
    fn keep(&mut self, step: f64) {
        self.remember(step);
        let Self { collocation, window, stages, lost, end_lost, known, .. } = self;
        for &i in &stages.variables.evaluated {
            let increment = lost[i] + collocation.weights.dot(&known[i]);
            end_lost[i] = window.end_after(i, increment);
        }
        for &(i, rate) in &stages.variables.integrals {
            let inner = collocation.weights_twice.dot(&known[rate]);
            let increment = lost[i] + step * (window.state[rate] + lost[rate] + inner);
            end_lost[i] = window.end_after(i, increment);
        }
    }

    /// Begins anew, without a step size.
    fn begin(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        // Nothing is made ready within a step.
        system.takes_eight();
        self.window.start(system, t, y);
        let size = y.len();
        self.stages.start(system, size);
        let evaluated = &self.stages.variables.evaluated;
        self.count = evaluated.iter().filter(|&&i| i < controlled).count();
        self.ends.reset(size);
        self.dense.start(y);
        for buffer in [&mut self.lost, &mut self.end_lost, &mut self.per_tolerance] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        self.known.clear();
        self.known.resize(size, Eight::default());
        self.iteration = Iteration::new(self.tolerance.relative);
        (self.curve, self.history) = (Curve::default(), History::default());
        self.measure(system);
    }

    fn too_short(&mut self, system: &mut dyn System) -> StepError {
        let Self { stages, window, .. } = self;
        let SideBySide { argument, derivative, .. } = &mut stages.states;
        let (time, step) = (window.time, window.next_step);
        argument.copy_from_slice(&window.state);
        system.derivative(time, argument, derivative);
        if let Some(variable) = derivative.iter().position(|slope| !slope.is_finite()) {
            return StepError::NotFinite { time, variable };
        }
        let errors = self.end_errors();
        let evaluated = &self.stages.variables.evaluated[..self.count];
        StepError::underflow(time, step, evaluated.iter().copied(), |i| errors.of(i))
    }
}

/// A refused step is tried shorter by this at least.
const SHORTER: f64 = 0.9;
/// How much of the step it had a motion goes on with after an event, but no more than so many times the
/// cautious first step.
const CARRIED: f64 = 0.8;
const BEYOND_FIRST: f64 = 20.0;

impl Stepper for GaussLanes {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.begin(system, t, y, controlled);
        self.window.next_step = self.first_step(system).min(self.window.longest);
        self.guess_straight(system);
    }

    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        let had = self.window.next_step;
        self.begin(system, t, y, controlled);
        let mut first = self.first_step(system);
        if had > 0.0 && had.is_finite() {
            first = (CARRIED * had).min(BEYOND_FIRST * first);
        }
        self.window.next_step = first.min(self.window.longest);
        self.guess_straight(system);
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
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
                    self.dense.forget();
                    return Ok(None);
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
        self.dense.prepare(system, stages, taken);
        self.window.counts.evaluations += STAGES;
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.dense.interpolate(&self.stages.variables, fraction, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        self.dense.polynomial(&self.stages.variables, i)
    }

    fn ends_inside(&self) -> bool {
        true
    }

    fn end_inside(&mut self, fraction: f64) -> bool {
        let Self { dense, stages, window, ends, .. } = self;
        if dense.step() == 0.0 || !is_near_end(fraction) {
            return false;
        }
        ends.forget_end();
        dense.interpolate(&stages.variables, fraction, &mut window.end_state);
        window.end_time = window.time + fraction * dense.step();
        self.end_lost.fill(0.0);
        true
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.iterate(system, step, MOST_RETAKEN);
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

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn slopes(&self) -> Option<&[f64]> {
        self.ends.known_start()
    }

    fn error_of(&self, i: usize) -> f64 {
        self.end_errors().of(i) / self.iteration.step
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::GaussLanes)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.stages.states.argument
    }
}
