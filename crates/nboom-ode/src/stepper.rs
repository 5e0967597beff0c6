use std::ops::Range;

use crate::{Bernstein, Counts, Method, RungeKutta, StepError, System};

/// A method that takes one step at a time.
///
/// [`step`](Self::step) finds a step that meets the tolerance; until
/// [`advance`](Self::advance) makes its end the new start, its inside can be looked at and it
/// can be taken again to another length.
pub trait Stepper: Send {
    /// Starts at (`t`, `y`) with nothing remembered of earlier steps. Only the first
    /// `controlled` variables decide on the step size, and on the order where that changes; no derivative
    /// depends on the others.
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize);

    /// Starts at (`t`, `y`) anew, where what the system does has changed a little or at once: as
    /// [`start`](Self::start), but methods that can go on with the step that they had.
    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.start(system, t, y, controlled);
    }

    /// Forgets all steps and what they have cost, as if it had just been made; its room stays.
    fn reset(&mut self) {
        self.window_mut().reset();
    }

    /// Bounds steps from now on by `longest`, which a step may exceed by up to a hundredth to reach
    /// a limit. Without this call steps have any length.
    fn limit_steps(&mut self, longest: f64) {
        self.window_mut().longest = longest;
    }

    /// Takes a step that meets the tolerance and does not pass `limit`, which is reached
    /// exactly when the step comes close.
    ///
    /// # Errors
    /// When no step that changes the time meets the tolerance; the start is still there.
    fn step(&mut self, system: &mut dyn System, limit: f64) -> Result<(), StepError> {
        let mut attempt = self.begin_step(system, limit)?;
        while let Some(length) = attempt {
            let explicit = self.explicit().expect("a step that is left to be taken is explicit");
            explicit.take(system, length);
            attempt = self.judge(limit)?;
        }
        Ok(())
    }

    /// Begins what [`step`](Self::step) does. An [explicit](Self::explicit) method returns the length of a step
    /// that is then to be taken and [judged](Self::judge), by whoever evaluates its stages; other methods take
    /// the step and return none.
    ///
    /// # Errors
    /// As those of [`step`](Self::step).
    fn begin_step(&mut self, system: &mut dyn System, limit: f64)
    -> Result<Option<f64>, StepError>;

    /// Judges the step that an explicit method was to take on the way to `limit`; none if it is good, else the
    /// length of another one that is to be taken.
    ///
    /// # Errors
    /// As those of [`step`](Self::step).
    fn judge(&mut self, _limit: f64) -> Result<Option<f64>, StepError> {
        Ok(None)
    }

    /// The explicit method that takes the next step, if one does.
    fn explicit(&mut self) -> Option<&mut RungeKutta> {
        None
    }

    /// Prepares [`interpolate`](Self::interpolate) and [`polynomial`](Self::polynomial) for the
    /// step just taken, with further evaluations where the method needs some.
    fn prepare_dense(&mut self, system: &mut dyn System);

    /// The variables at `fraction` of the step that dense output was prepared for.
    fn interpolate(&self, fraction: f64, out: &mut [f64]);

    /// Variable `i` over the step that dense output was prepared for.
    fn polynomial(&self, i: usize) -> Bernstein;

    /// Takes the step again with another length, whatever its error; dense output stays that
    /// of the step before.
    fn retake(&mut self, system: &mut dyn System, step: f64);

    /// Whether steps may [end inside](Self::end_inside).
    fn ends_inside(&self) -> bool {
        false
    }

    /// Ends the step at this `fraction` of it by the dense output that was prepared, if that is about as accurate
    /// there as the end of a step; else returns `false` and leaves the step as it is. May be called several times, and
    /// after it comes a [start](Self::start) or [`restart`](Self::restart).
    fn end_inside(&mut self, _fraction: f64) -> bool {
        false
    }

    /// Moves the end of the step by `by` along a parabola, if the motion bends so little on the way
    /// that what is left out is far below the tolerance; else, or where a method takes steps again at
    /// no great cost, returns `false` and leaves the step as it is.
    fn move_end(&mut self, _system: &mut dyn System, _by: f64) -> bool {
        false
    }

    /// Makes the end of the step the start of the next one.
    fn advance(&mut self);

    /// Multiplies the variables `range` and their derivatives at the start of the next step by
    /// `factor`: a projection onto an invariant in which the equations are homogeneous.
    fn scale(&mut self, range: Range<usize>, factor: f64);

    /// The step just taken.
    fn window(&self) -> &Window;

    /// Likewise, for the method itself to change.
    fn window_mut(&mut self) -> &mut Window;

    /// The derivatives where the next step starts, right after a start or restart; none of methods whose steps do not
    /// [end inside](Self::ends_inside).
    fn slopes(&self) -> Option<&[f64]> {
        None
    }

    /// Estimated error of variable `i` in the last step tried, in units of the tolerance and
    /// per unit of time.
    fn error_of(&self, i: usize) -> f64;

    /// The variables at which the derivative was evaluated last.
    fn last_evaluated(&self) -> &[f64];

    /// The method that takes the next step.
    fn choice(&self) -> Choice;
}

/// A method, and why it was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// Why this one.
    pub reason: &'static str,
}

impl Choice {
    pub(crate) fn demanded(method: Method) -> Self {
        Self { method, reason: "as demanded" }
    }
}

/// Share of a step about its end in which dense output is about as good as the end: it has the value and the slope
/// of the end, so its error goes with the square of the distance. In the middle it errs by up to the tolerance.
const NEAR_END: f64 = 0.015;

/// Whether dense output is good enough there to end a step by it.
pub(crate) fn is_near_end(fraction: f64) -> bool {
    (fraction - 1.0).abs() <= NEAR_END
}

/// Share of the way to its limit that a step takes where nothing moves, and may begin to.
const AT_REST: f64 = 1e-3;

/// The step just taken, from its start to its end.
#[derive(Clone, Debug)]
pub struct Window {
    /// Time of the step's start.
    pub time: f64,
    /// Variables at the step's start.
    pub state: Vec<f64>,
    /// Time of the step's end.
    pub end_time: f64,
    /// Variables at the step's end.
    pub end_state: Vec<f64>,
    /// Natural sizes of the variables, where the step starts.
    pub sizes: Vec<f64>,
    /// The step that is tried next; infinite where nothing moves.
    pub next_step: f64,
    /// What no step is longer than.
    pub longest: f64,
    /// What integration has cost so far.
    pub counts: Counts,
}

impl Default for Window {
    fn default() -> Self {
        Self {
            time: 0.0,
            state: Vec::new(),
            end_time: 0.0,
            end_state: Vec::new(),
            sizes: Vec::new(),
            next_step: 0.0,
            longest: f64::INFINITY,
            counts: Counts::default(),
        }
    }
}

impl Window {
    /// Length of the step.
    pub fn length(&self) -> f64 {
        self.end_time - self.time
    }

    pub(crate) fn reset(&mut self) {
        (self.next_step, self.counts) = (0.0, Counts::default());
    }

    pub(crate) fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64]) {
        (self.time, self.end_time) = (t, t);
        for buffer in [&mut self.state, &mut self.end_state, &mut self.sizes] {
            buffer.clear();
            buffer.extend_from_slice(y);
        }
        self.measure(system);
    }

    /// Asks for the natural sizes where the step starts.
    pub(crate) fn measure(&mut self, system: &mut dyn System) {
        system.sizes(&self.state, &mut self.sizes);
    }

    /// The magnitude of variable `i` at the step's start, or its natural size if that is more.
    pub(crate) fn magnitude(&self, i: usize) -> f64 {
        self.state[i].abs().max(self.sizes[i])
    }

    /// The step that is tried next on the way to `limit`.
    pub(crate) fn wanted(&self, limit: f64) -> f64 {
        let careful = AT_REST * (limit - self.time);
        if self.next_step.is_finite() { self.next_step } else { careful.min(self.longest) }
    }

    /// The step to try on the way to `limit`, and whether it reaches it, which it does when it
    /// comes close; `None` where it would not change the time.
    pub(crate) fn attempt(&self, limit: f64) -> Option<(f64, bool)> {
        let (remaining, wanted) = (limit - self.time, self.wanted(limit));
        let changes_time = |step: f64| self.time + 0.1 * step != self.time;
        // At rest a careful step may be too short for the time there is, however near the limit.
        let reaches =
            wanted * 1.01 >= remaining || self.next_step == f64::INFINITY && !changes_time(wanted);
        let step = if reaches { remaining } else { wanted };
        (reaches || changes_time(step)).then_some((step, reaches))
    }

    /// Takes note of a step to `end` that is as good as the tolerance asks for, after which
    /// `next` may be tried.
    pub(crate) fn accept(&mut self, end: f64, reaches: bool, next: f64) {
        self.end_time = end;
        // A step cut short by the limit must not slow the next one down.
        let next =
            if reaches && self.next_step.is_finite() { self.next_step.max(next) } else { next };
        self.next_step = next.min(self.longest);
        self.counts.accepted += 1;
    }

    /// Ends variable `i` at its start and an increment; returns what rounding takes from it.
    pub(crate) fn end_after(&mut self, i: usize, increment: f64) -> f64 {
        let start = self.state[i];
        let end = start + increment;
        let added = end - start;
        self.end_state[i] = end;
        (start - (end - added)) + (increment - added)
    }

    pub(crate) fn advance(&mut self) {
        self.time = self.end_time;
        std::mem::swap(&mut self.state, &mut self.end_state);
    }
}

/// Root mean square of so many numbers; zero of none.
pub(crate) fn root_mean_square(count: usize, number: impl Fn(usize) -> f64) -> f64 {
    let sum: f64 = (0..count).map(|i| number(i).powi(2)).sum();
    (sum / count.max(1) as f64).sqrt()
}
