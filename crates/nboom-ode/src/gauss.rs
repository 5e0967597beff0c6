use std::ops::Range;

use coefficients::{Coefficients, Matrix, STAGES, dot};
use plan::Plan;

use crate::method::Description;
use crate::stepper::root_mean_square;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

pub(crate) mod coefficients;
mod plan;

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "gauss",
    about: "implicit Runge-Kutta 16, symmetric, for long free spin",
    order: |_| 16,
    dense_order: |_| 8,
    keeps_invariants: true,
    stepper: |tolerance| Box::new(Gauss::new(tolerance)),
};

/// Gauss's collocation method with eight stages, of order 16, for motions to be followed long.
///
/// It is symmetric, symplectic in canonical variables, and keeps every quadratic invariant. The
/// step is constant from a start on: as long as the collocation polynomial, which is the dense
/// output and of order 8, meets the tolerance. The error at its end is below rounding then. So
/// that rounding remains a random walk, the stages are iterated until rounding, increments are
/// added with their rounding errors carried along, and coefficients keep their symmetries
/// (Hairer, McLachlan, Razakarivony, BIT 48, 2008).
///
/// Where the tolerance asks for shorter steps, or the iteration does not converge, all steps
/// until the next start are shorter. The iteration is not Newton's: stiff systems take
/// steps as short as explicit methods do.
#[derive(Clone, Debug)]
pub struct Gauss {
    coefficients: Coefficients,
    tolerance: Tolerance,
    controlled: usize,
    window: Window,
    plan: Plan,
    /// What rounding has taken from the variables at the start and the end of the step.
    lost: Vec<f64>,
    end_lost: Vec<f64>,
    /// Lⱼ = h bⱼ f(Yⱼ) of each variable, over `curve`.
    increments: Vec<[f64; STAGES]>,
    curve: Curve,
    continuation: Continuation,
    argument: Vec<f64>,
    derivative: Vec<f64>,
    /// The increments of the step that dense output was prepared for.
    dense: Vec<[f64; STAGES]>,
}

/// Where the increments are from.
#[derive(Clone, Copy, Debug, Default)]
struct Curve {
    /// Length of the step they were computed for; zero when there is none.
    length: f64,
    /// The fraction of it at which the present step begins.
    from: f64,
}

/// The matrix that continues the increments of one step over another.
#[derive(Clone, Debug, Default)]
struct Continuation {
    from: f64,
    ratio: f64,
    matrix: Matrix,
}

/// Iterations after which a step is tried shorter.
const MOST: usize = 40;
/// Steps tried at a start until one meets the tolerance well.
const TRIALS: usize = 24;
/// Error at which the first step of a start is aimed, in units of the tolerance; as the error
/// varies along the motion, it is well below one.
const AIM: f64 = 0.01;
/// Limits of the change of step size.
const SHRINK: f64 = 0.1;
const GROW: f64 = 8.0;

impl Gauss {
    /// The method with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            coefficients: Coefficients::new(),
            tolerance,
            controlled: 0,
            window: Window::default(),
            plan: Plan::default(),
            lost: Vec::new(),
            end_lost: Vec::new(),
            increments: Vec::new(),
            curve: Curve::default(),
            continuation: Continuation::default(),
            argument: Vec::new(),
            derivative: Vec::new(),
            dense: Vec::new(),
        }
    }

    fn scale_of(&self, i: usize) -> f64 {
        self.tolerance.allowed(self.window.sizes[i], self.window.state[i])
    }

    /// Root mean square of `values` over the controlled variables, in units of the tolerance.
    fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        root_mean_square(self.controlled, |i| values(i) / self.scale_of(i))
    }

    /// Increments to begin with: those of the polynomial at hand, else of the slope at the start.
    fn guess(&mut self, system: &mut dyn System, step: f64) {
        let Curve { length, from } = self.curve;
        if length == 0.0 {
            system.derivative(self.window.time, &self.window.state, &mut self.derivative);
            self.window.counts.evaluations += 1;
            for (increments, slope) in self.increments.iter_mut().zip(&self.derivative) {
                *increments = self.coefficients.weights.map(|b| step * b * slope);
            }
            return;
        }
        let ratio = step / length;
        let known = &mut self.continuation;
        if (known.from, known.ratio) != (from, ratio) {
            let matrix = self.coefficients.continuation(from, ratio);
            *known = Continuation { from, ratio, matrix };
        }
        for increments in &mut self.increments {
            *increments = known.matrix.map(|row| dot(&row, increments));
        }
    }

    /// Computes the increments of a step to rounding; returns whether the iteration converged.
    fn solve(&mut self, system: &mut dyn System, step: f64) -> bool {
        self.guess(system, step);
        self.curve = Curve { length: step, from: 0.0 };
        let rounding = 100.0 * f64::EPSILON / self.tolerance.relative.max(f64::EPSILON);
        let (mut last, mut at_rounding) = (f64::INFINITY, false);
        for _ in 0..MOST {
            let change = self.iterate(system, step);
            if change == 0.0 || at_rounding {
                return true;
            }
            if change.is_nan() || change == f64::INFINITY {
                break;
            }
            // Corrections shrink until rounding makes them; the variables that are still
            // behind get one more.
            at_rounding = change >= last && change <= rounding.max(0.01);
            last = change;
        }
        self.curve.length = 0.0;
        false
    }

    /// Computes all increments once, each from the latest others; returns the largest change in
    /// units of the tolerance.
    fn iterate(&mut self, system: &mut dyn System, step: f64) -> f64 {
        let mut largest = 0.0;
        for stage in 0..STAGES {
            let row = &self.coefficients.couplings[stage];
            for (i, argument) in self.argument.iter_mut().enumerate() {
                let of_stages = &self.increments[i];
                let half = 0.5 * of_stages.iter().sum::<f64>();
                *argument = self.window.state[i] + (self.lost[i] + half + dot(row, of_stages));
            }
            let time = self.window.time + self.coefficients.nodes[stage] * step;
            system.derivative(time, &self.argument, &mut self.derivative);
            let length = step * self.coefficients.weights[stage];
            for (i, slope) in self.derivative.iter().enumerate() {
                let increment = length * slope;
                let change = (increment - self.increments[i][stage]).abs();
                self.increments[i][stage] = increment;
                if i < self.controlled {
                    let of_tolerance = change / self.scale_of(i);
                    largest = if of_tolerance <= largest { largest } else { of_tolerance };
                }
            }
        }
        self.window.counts.evaluations += STAGES;
        largest
    }

    /// Adds the increments to the start of the step, and keeps what rounding loses.
    fn keep(&mut self) {
        for (i, of_stages) in self.increments.iter().enumerate() {
            let increment = self.lost[i] + of_stages.iter().sum::<f64>();
            self.end_lost[i] = self.window.end_after(i, increment);
        }
    }

    /// Estimated error of the polynomial of variable `i`, were it of one degree less.
    fn last_term(&self, i: usize, before: usize) -> f64 {
        let degree = STAGES - 1 - before;
        dot(&self.coefficients.spectrum[degree], &self.increments[i]) / (4 * degree + 2) as f64
    }

    /// Estimated error of the polynomial in units of the tolerance: its last term, times what
    /// the next one would be less, as the last three have it.
    fn error(&self) -> f64 {
        let last = self.norm(|i| self.last_term(i, 0));
        let earlier = self.norm(|i| self.last_term(i, 2));
        let error = if last < earlier { last * (last / earlier).sqrt() } else { last };
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// Tries a step; returns its error.
    fn attempt(&mut self, system: &mut dyn System, step: f64) -> f64 {
        if self.solve(system, step) { self.error() } else { f64::INFINITY }
    }

    /// By how much a step with this error should be longer.
    fn factor(error: f64) -> f64 {
        if error.is_finite() {
            (AIM / error).powf(1.0 / (STAGES + 1) as f64).clamp(SHRINK, GROW)
        } else {
            0.5
        }
    }

    /// A step over which the variables change by about a hundredth; infinite where nothing moves.
    fn first_guess(&mut self, system: &mut dyn System) -> f64 {
        let Self { window, derivative, .. } = self;
        system.derivative(window.time, &window.state, derivative);
        window.counts.evaluations += 1;
        let (size, slope) =
            (self.norm(|i| self.window.magnitude(i)), self.norm(|i| self.derivative[i]));
        let guess = 0.01 * size / slope;
        if guess.is_finite() { guess } else { f64::INFINITY }
    }

    /// The step for the motion that begins here, found by trying.
    fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let mut step = self.first_guess(system);
        let mut too_long = f64::INFINITY;
        for _ in 0..if step.is_finite() { TRIALS } else { 0 } {
            let error = self.attempt(system, step);
            if error > 1.0 {
                too_long = step;
            }
            let factor = Self::factor(error);
            let next = step * factor;
            if error <= 1.0 && (factor < 1.1 || next >= too_long) {
                break;
            }
            step = next;
        }
        step
    }

    fn too_short(&mut self, system: &mut dyn System) -> StepError {
        let Self { window, derivative, .. } = self;
        let (time, step) = (window.time, window.next_step);
        system.derivative(time, &window.state, derivative);
        if let Some(variable) = derivative.iter().position(|slope| !slope.is_finite()) {
            return StepError::NotFinite { time, variable };
        }
        StepError::underflow(time, step, 0..self.controlled, |i| self.error_of(i))
    }
}

impl Stepper for Gauss {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.window.start(system, t, y);
        let size = y.len();
        for buffer in [&mut self.lost, &mut self.end_lost, &mut self.argument, &mut self.derivative]
        {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        for buffer in [&mut self.increments, &mut self.dense] {
            buffer.clear();
            buffer.resize(size, [0.0; STAGES]);
        }
        self.curve = Curve::default();
        self.plan = Plan::default();
        self.window.next_step = self.first_step(system).min(self.window.longest);
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        self.window.measure(system);
        loop {
            let time = self.window.time;
            self.plan.head_for(limit, time, self.window.next_step);
            let step = self.plan.step;
            if time + 0.1 * step == time && time + step != limit {
                return Err(self.too_short(system));
            }
            let error = self.attempt(system, step);
            if error <= 1.0 {
                self.keep();
                self.window.end_time = self.plan.end();
                self.window.counts.accepted += 1;
                return Ok(None);
            }
            self.window.counts.rejected += 1;
            self.window.next_step = step * Self::factor(error).min(0.9);
            self.plan = Plan::default();
        }
    }

    fn prepare_dense(&mut self, _system: &mut dyn System) {
        self.dense.copy_from_slice(&self.increments);
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        for (i, value) in out.iter_mut().enumerate() {
            *value = self.polynomial(i).at(fraction);
        }
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        let start = self.window.state[i];
        Bernstein::new(&self.coefficients.bernstein(start, &self.dense[i]))
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.solve(system, step);
        self.keep();
        self.plan = Plan::default();
        self.window.end_time = self.window.time + step;
    }

    fn advance(&mut self) {
        self.window.advance();
        std::mem::swap(&mut self.lost, &mut self.end_lost);
        self.curve.from = 1.0;
        self.plan.advance();
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        for i in range {
            self.window.state[i] *= factor;
            self.lost[i] *= factor;
            self.increments[i].iter_mut().for_each(|increment| *increment *= factor);
        }
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn error_of(&self, i: usize) -> f64 {
        self.last_term(i, 0).abs() / (self.scale_of(i) * self.curve.length)
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::Gauss)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.argument
    }
}
