use std::ops::Range;

use crate::method::Description;
use crate::{
    Bernstein, Choice, GaussLanes, Method, Radau, RungeKutta, StepError, Stepper, System,
    Tolerance, Window,
};

const AT_ONCE: &str = "the tolerance is very tight, and code takes eight stages at once";

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "auto",
    about: "dopri5, dop853, gauss_lanes, radau9 or radau13, by tolerance, stiffness and code; orders of the first two",
    order: |tolerance| Automatic::explicit(tolerance).order(tolerance),
    dense_order: |tolerance| Automatic::explicit(tolerance).dense_order(tolerance),
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Automatic::new(tolerance)),
};

/// Begins with the explicit method that suits the tolerance. Where the system takes eight states at once,
/// stages side by side follow, once a motion has gone on for some steps; and one of Radau's implicit methods
/// while stability and not accuracy bounds steps.
#[derive(Debug)]
pub struct Automatic {
    explicit: Box<RungeKutta>,
    /// Only for tolerances that it suits.
    lanes: Option<Box<GaussLanes>>,
    /// Whether they come first where the system takes eight states at once.
    lanes_first: bool,
    implicit: Box<Radau>,
    active: Active,
    controlled: usize,
    /// Steps of the explicit method since a start or a change.
    explicit_steps: usize,
    /// Whether the iteration of stages side by side has been slow since the last start.
    lanes_were_slow: bool,
    /// Steps in a row, less those that say otherwise, for which another method would be better.
    against: usize,
    /// How many of these it takes to go back from the implicit method.
    patience: usize,
    /// Whether the fastest motion has been looked at since the last start.
    has_looked: bool,
    /// Room for the variables that a method leaves to the next one.
    handed_over: Vec<f64>,
    choice: Choice,
}

/// The method that takes the next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Active {
    Explicit,
    Lanes,
    Implicit,
}

/// From this relative tolerance on, the method of order 5 is cheaper than that of order 8.
const LOOSE: f64 = 1e-5;
/// Up to this relative tolerance, stages side by side are cheaper than an explicit method.
const TIGHT: f64 = 1e-7;
/// Up to this one they are so from the first step of a motion, however short it is.
const VERY_TIGHT: f64 = 1e-10;
/// Above this one implicit steps are cheaper with five stages than with seven.
const FEW_STAGES: f64 = 1e-6;
/// Explicit steps after which a motion is taken to go on for so long that stages side by side pay, if as
/// many could follow.
const SETTLED: usize = 12;
/// Steps bounded by stability after which a problem counts as stiff, and steps in between that
/// show the contrary (Hairer and Wanner, Section IV.2).
const STIFF: usize = 15;
/// Likewise of stages side by side whose iteration is slow; such a step costs several explicit ones.
const SLOW: usize = 4;
/// What slowed them down most often bounds explicit steps too: as many count as seen, and are forgotten after half
/// as many that it does not bound.
const SEEN_BY_LANES: usize = 10;
/// Share of the stability limit beyond which a step counts as bounded by it: the tighter the
/// tolerance, the further below the limit steps settle. Oscillations that accuracy bounds stay
/// below a third of it.
const NEAR: f64 = 0.7;
/// The first step of another method may be this many times the last one.
const GROWTH: f64 = 10.0;
/// Likewise of stages side by side. Their own estimate of a first step knows one state only, and without a
/// polynomial to begin from their iteration does not converge over ten explicit steps.
const GROWTH_OF_LANES: f64 = 2.0;
/// An implicit step costs as much as this many explicit ones.
const COST: f64 = 3.0;
/// With so many explicit steps to come, one step that a decay bounds is enough.
const MANY: f64 = 1000.0;

impl Automatic {
    /// The methods with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        let explicit = match Self::explicit(tolerance) {
            Method::Dopri5 => RungeKutta::dopri5(tolerance),
            _ => RungeKutta::dop853(tolerance),
        };
        let is_tight = tolerance.relative <= TIGHT;
        Self {
            choice: Self::first(Self::explicit(tolerance)),
            handed_over: Vec::new(),
            explicit: Box::new(explicit),
            lanes: is_tight.then(|| Box::new(GaussLanes::new(tolerance))),
            lanes_first: tolerance.relative <= VERY_TIGHT,
            implicit: Box::new(Self::implicit(tolerance)),
            active: Active::Explicit,
            controlled: 0,
            explicit_steps: 0,
            lanes_were_slow: false,
            against: 0,
            patience: STIFF,
            has_looked: false,
        }
    }

    /// The explicit method under a tolerance.
    pub(crate) fn explicit(tolerance: Tolerance) -> Method {
        if tolerance.relative >= LOOSE { Method::Dopri5 } else { Method::Dop853 }
    }

    /// The implicit method under a tolerance.
    fn implicit(tolerance: Tolerance) -> Radau {
        if tolerance.relative > FEW_STAGES {
            Radau::order_9(tolerance)
        } else {
            Radau::order_13(tolerance)
        }
    }

    /// What runs begin with: this explicit method.
    fn first(method: Method) -> Choice {
        let reason = match method {
            Method::Dopri5 => "the tolerance is loose",
            _ => "the tolerance is tight",
        };
        Choice { method, reason }
    }

    fn stepper(&self) -> &dyn Stepper {
        match (self.active, &self.lanes) {
            (Active::Lanes, Some(lanes)) => &**lanes,
            (Active::Implicit, _) => &*self.implicit,
            _ => &*self.explicit,
        }
    }

    fn stepper_mut(&mut self) -> &mut dyn Stepper {
        match (self.active, &mut self.lanes) {
            (Active::Lanes, Some(lanes)) => &mut **lanes,
            (Active::Implicit, _) => &mut *self.implicit,
            _ => &mut *self.explicit,
        }
    }

    /// Whether the step just taken speaks against the method that took it.
    fn is_against(&mut self) -> bool {
        match (self.active, &self.lanes) {
            (Active::Lanes, Some(lanes)) => lanes.is_held_back(),
            (Active::Implicit, _) => {
                self.implicit.stiffness() < COST * self.explicit.stability_limit()
            }
            _ => self.explicit.stiffness() > NEAR * self.explicit.stability_limit(),
        }
    }

    /// Whether a motion that dies down without oscillating bounded the step just taken, and would bound many
    /// explicit steps on the way to `limit`. Looks once after each start.
    fn is_clearly_stiff(&mut self, system: &mut dyn System, limit: f64) -> bool {
        let may_be = self.active != Active::Implicit && self.against > 0;
        if !may_be || std::mem::replace(&mut self.has_looked, true) {
            return false;
        }
        let (active, controlled) = (self.active, self.controlled);
        let Self { explicit, lanes, implicit, .. } = self;
        let window = match (active, lanes) {
            (Active::Lanes, Some(lanes)) => lanes.window(),
            _ => explicit.window(),
        };
        let remaining = limit - window.time;
        let Some(rate) = implicit.rate_of_decay(system, window, controlled) else { return false };
        let is_stiff = rate * remaining > MANY * explicit.stability_limit();
        self.window_mut().counts.jacobians += 1;
        is_stiff
    }

    /// The method that should take the next step instead, and why.
    fn better(&mut self, system: &mut dyn System, limit: f64) -> Option<(Active, &'static str)> {
        if self.is_clearly_stiff(system, limit) {
            // What is seen so early may still be on its way to where explicit steps are short.
            self.patience *= 2;
            return Some((Active::Implicit, "a motion that dies down fast bounded a step"));
        }
        match self.active {
            Active::Explicit if self.against >= STIFF => {
                Some((Active::Implicit, "stability, not accuracy, bounded explicit steps"))
            }
            Active::Explicit => {
                let Window { time, next_step, .. } = self.explicit.window();
                let lasts = limit - time > SETTLED as f64 * next_step;
                let pay = self.explicit_steps >= SETTLED && lasts && self.against == 0;
                let may = self.lanes.is_some() && !self.lanes_were_slow;
                let reason = "the motion goes on for long, and code takes eight stages at once";
                (pay && may && system.takes_eight()).then_some((Active::Lanes, reason))
            }
            Active::Lanes => (self.against >= SLOW)
                .then_some((Active::Explicit, "damping slowed the iteration of stages down")),
            Active::Implicit => (self.against >= self.patience)
                .then_some((Active::Explicit, "accuracy, not stability, bounds steps again")),
        }
    }

    /// Whether a motion begins with stages side by side.
    fn begins_side_by_side(&self, system: &mut dyn System) -> bool {
        self.lanes_first && system.takes_eight()
    }

    /// Goes on with another method from where this one is.
    fn change(&mut self, system: &mut dyn System, to: Active, reason: &'static str) {
        let mut state = std::mem::take(&mut self.handed_over);
        let &Window { time, state: ref present, next_step: usual, .. } = self.window();
        state.clone_from(present);
        let from = self.active;
        self.hand_over(to, reason);
        match from {
            Active::Lanes => {
                self.lanes_were_slow = true;
                // What speaks against the explicit method speaks for the implicit one.
                self.against = if to == Active::Explicit { SEEN_BY_LANES } else { 0 };
            }
            Active::Implicit => self.patience *= 2,
            Active::Explicit => {}
        }
        let controlled = self.controlled;
        self.stepper_mut().start(system, time, &state, controlled);
        self.handed_over = state;
        let growth = if to == Active::Lanes { GROWTH_OF_LANES } else { GROWTH };
        let window = self.window_mut();
        window.next_step = window.next_step.min(growth * usual);
    }

    /// Takes note of what the step just taken says of the method that took it.
    fn note_step(&mut self) {
        let against = self.is_against();
        self.against = if against { self.against + 1 } else { self.against.saturating_sub(2) };
        self.explicit_steps += usize::from(self.active == Active::Explicit);
    }

    /// Makes another method the active one, which goes on counting.
    fn hand_over(&mut self, to: Active, reason: &'static str) {
        let counts = self.window().counts;
        (self.active, self.against, self.explicit_steps) = (to, 0, 0);
        self.window_mut().counts = counts;
        self.choice = Choice { method: self.stepper().choice().method, reason };
    }
}

impl Stepper for Automatic {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against, self.explicit_steps) = (controlled, 0, 0);
        self.has_looked = false;
        if self.active == Active::Explicit && self.begins_side_by_side(system) {
            self.hand_over(Active::Lanes, AT_ONCE);
        }
        self.stepper_mut().start(system, t, y, controlled);
    }

    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against, self.explicit_steps) = (controlled, 0, 0);
        (self.lanes_were_slow, self.has_looked) = (false, false);
        match (self.active, self.begins_side_by_side(system)) {
            (Active::Lanes, false) => {
                self.hand_over(Active::Explicit, "an event began another motion");
                self.stepper_mut().start(system, t, y, controlled);
            }
            (Active::Explicit, true) => {
                self.hand_over(Active::Lanes, AT_ONCE);
                self.stepper_mut().start(system, t, y, controlled);
            }
            _ => self.stepper_mut().restart(system, t, y, controlled),
        }
    }

    fn reset(&mut self) {
        self.explicit.reset();
        self.implicit.reset();
        if let Some(lanes) = &mut self.lanes {
            lanes.reset();
        }
        (self.active, self.lanes_were_slow, self.patience) = (Active::Explicit, false, STIFF);
        self.choice = Self::first(self.explicit.choice().method);
    }

    fn limit_steps(&mut self, longest: f64) {
        self.explicit.limit_steps(longest);
        self.implicit.limit_steps(longest);
        if let Some(lanes) = &mut self.lanes {
            lanes.limit_steps(longest);
        }
    }

    fn step(&mut self, system: &mut dyn System, limit: f64) -> Result<(), StepError> {
        let mut attempt = self.begin_step(system, limit)?;
        while let Some(step) = attempt {
            self.explicit.take(system, step);
            attempt = self.judge(limit)?;
        }
        Ok(())
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        if let Some((to, reason)) = self.better(system, limit) {
            self.change(system, to, reason);
        }
        let attempt = self.stepper_mut().begin_step(system, limit)?;
        if attempt.is_none() {
            self.note_step();
        }
        Ok(attempt)
    }

    fn judge(&mut self, limit: f64) -> Result<Option<f64>, StepError> {
        let attempt = self.stepper_mut().judge(limit)?;
        if attempt.is_none() {
            self.note_step();
        }
        Ok(attempt)
    }

    fn explicit(&mut self) -> Option<&mut RungeKutta> {
        self.stepper_mut().explicit()
    }

    fn prepare_dense(&mut self, system: &mut dyn System) {
        self.stepper_mut().prepare_dense(system);
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.stepper().interpolate(fraction, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        self.stepper().polynomial(i)
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.stepper_mut().retake(system, step);
    }

    fn ends_inside(&self) -> bool {
        self.stepper().ends_inside()
    }

    fn end_inside(&mut self, fraction: f64) -> bool {
        self.stepper_mut().end_inside(fraction)
    }

    fn move_end(&mut self, system: &mut dyn System, by: f64) -> bool {
        self.stepper_mut().move_end(system, by)
    }

    fn advance(&mut self) {
        self.stepper_mut().advance();
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.stepper_mut().scale(range, factor);
    }

    fn window(&self) -> &Window {
        self.stepper().window()
    }

    fn window_mut(&mut self) -> &mut Window {
        self.stepper_mut().window_mut()
    }

    fn slopes(&self) -> Option<&[f64]> {
        self.stepper().slopes()
    }

    fn error_of(&self, i: usize) -> f64 {
        self.stepper().error_of(i)
    }

    fn last_evaluated(&self) -> &[f64] {
        self.stepper().last_evaluated()
    }

    fn choice(&self) -> Choice {
        self.choice
    }
}
