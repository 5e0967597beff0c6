use crate::gauss::coefficients::STAGES;

/// Iterations after which a step is tried shorter, and those in which a step of given length has
/// to converge.
pub(super) const MOST: usize = 16;
pub(super) const MOST_RETAKEN: usize = 60;
/// Iterations that cost more than a shorter step would.
const MANY: usize = 10;
/// Contraction at which a step is tried shorter.
const SLOW: f64 = 0.7;
/// Contraction at which methods without iterations, or with Newton's, are cheaper.
const RATHER_SLOW: f64 = 0.2;
/// Error that the iteration leaves, in units of the tolerance; what is left of all steps adds up.
const CONVERGED: f64 = 0.005;

/// The fixed-point iteration of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Iteration {
    /// How many the step took.
    pub count: usize,
    /// Length of the step.
    pub step: f64,
    /// By what each iteration multiplies the error.
    contraction: f64,
    last_change: f64,
    /// What rounding alone may change at most, in units of the tolerance.
    rounding: f64,
}

/// The usual share of what rounding may change at most.
const NOISE: f64 = 0.05;

/// Where an iteration stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Progress {
    Converging,
    Converged,
    Hopeless,
}

impl Iteration {
    pub fn new(relative: f64) -> Self {
        let rounding = 100.0 * f64::EPSILON / relative.max(f64::EPSILON);
        Self { count: 0, contraction: 1.0, step: 0.0, last_change: f64::INFINITY, rounding }
    }

    /// A new step begins; the contraction is in proportion to its length.
    pub fn begin(&mut self, step: f64) {
        let contraction = (self.contraction * (step / self.step).abs()).min(1.0);
        *self = Self { count: 0, contraction, step, last_change: f64::INFINITY, ..*self };
    }

    /// Takes note of an iteration that has changed the slopes by this much, in units of the
    /// tolerance.
    pub fn note(&mut self, change: f64, most: usize) -> Progress {
        self.count += 1;
        if !change.is_finite() {
            return Progress::Hopeless;
        }
        // What rounding changes does not shrink.
        let stalls = change >= self.last_change && change <= self.rounding.max(0.01);
        let noise = NOISE * self.rounding;
        if change > noise && self.count > 1 {
            self.contraction = change / self.last_change;
        } else if change <= noise {
            // It is not known better than this.
            self.contraction = self.contraction.min((noise / self.last_change).max(RATHER_SLOW));
        }
        self.last_change = change;
        let is_left = change * self.contraction < CONVERGED * (1.0 - self.contraction);
        if stalls || (self.contraction < 1.0 && is_left) {
            return Progress::Converged;
        }
        let slow = most == MOST && self.count > 2 && self.contraction > SLOW;
        if self.count >= most || slow { Progress::Hopeless } else { Progress::Converging }
    }

    /// By how much a step should be shorter whose iteration does not converge. Where stiffness slows it down,
    /// contraction goes with the square of the step.
    pub fn shorter(&self) -> f64 {
        let just = (EASY / self.contraction).sqrt();
        if just.is_nan() { HALF } else { just.clamp(SHORTEST, HALF) }
    }

    /// Whether a shorter step would converge so much faster that it would cost less.
    pub fn is_slow(&self) -> bool {
        self.count >= MANY || self.contraction > RATHER_SLOW
    }
}

/// How much the error of a step may exceed the tolerance before it is tried again. As it goes with
/// the sixteenth power of the step, a little too much is cheaper than another try.
pub(super) const REFUSED: f64 = 10.0;
/// After so many iterations the error is known well enough to refuse a step that exceeds what is refused
/// by this factor.
pub(super) const TELLING: usize = 4;
pub(super) const CLEARLY: f64 = 2.0;
/// The share of the step that would just do.
const SAFETY: f64 = 0.92;
/// Limits of the change of step size, in general and in the first steps from a start.
const SHRINK: f64 = 0.4;
const GROW: f64 = 1.6;
const GROW_FIRST: f64 = 6.0;
const FIRST: usize = 2;
/// What makes a step cheaper that takes too many iterations.
const EASE: f64 = 0.9;

/// Limits to by how much a step is tried shorter whose iteration does not converge.
const HALF: f64 = 0.5;
const SHORTEST: f64 = 0.1;
/// Contraction with which it should converge then.
const EASY: f64 = 0.2;

/// By how much a step should be longer that has this error, in units of the tolerance.
pub(super) fn factor(error: f64) -> f64 {
    limited(error.powf(EXPONENT))
}

/// By how much a step should be longer that would just do if it were `just` times as long.
fn limited(just: f64) -> f64 {
    let factor = SAFETY * just;
    if factor.is_nan() { HALF } else { factor.clamp(SHRINK, GROW_FIRST) }
}

/// The error of the end goes with this power of the step, inverted.
const EXPONENT: f64 = -0.5 / STAGES as f64;

/// The steps since a start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct History {
    count: usize,
    /// Length of the last one.
    step: f64,
    /// How many times as long it would just do.
    just: f64,
}

impl History {
    /// Takes note of a step; returns by how much the next one may be longer. Where errors have grown,
    /// they are expected to go on growing (Gustafsson, ACM Trans. Math. Softw. 20, 1994).
    pub fn note(&mut self, step: f64, error: f64, iteration: &Iteration) -> f64 {
        let most = match self.count {
            0..FIRST => GROW_FIRST,
            _ if iteration.count > MANY => EASE,
            _ => GROW,
        };
        let just = error.max(SMALL).powf(EXPONENT);
        let trend = if self.count > 0 { step / self.step * (just / self.just) } else { 1.0 };
        *self = Self { count: self.count + 1, step, just };
        (limited(just) * trend.min(1.0)).clamp(SHRINK, most)
    }

    /// Whether the last step could be much longer, were it for its error.
    pub fn is_accurate(&self) -> bool {
        self.just > ACCURATE
    }
}

/// An error of a hundredth of the tolerance.
const ACCURATE: f64 = 1.333_521_432_163_324;
/// Errors below this tell nothing about the next one.
const SMALL: f64 = 1e-8;
