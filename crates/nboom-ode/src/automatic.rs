use std::ops::Range;

use crate::method::Description;
use crate::{
    Adams, Bernstein, Choice, GaussLanes, Method, Pace, Radau, RungeKutta, StepError, Stepper,
    System, Tolerance, Window,
};

mod rules;

use rules::{SEEN_BEFORE, SETTLED, STIFF};

const AT_ONCE: &str = "the tolerance is very tight, and code takes eight stages at once";

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "auto",
    about: "dopri5, dop853, gauss_lanes, adams, radau9 or radau13, by tolerance, stiffness and code; orders of the first two",
    order: |tolerance| Automatic::explicit(tolerance).order(tolerance),
    dense_order: |tolerance| Automatic::explicit(tolerance).dense_order(tolerance),
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Automatic::new(tolerance)),
};

/// Begins with the explicit method that suits the tolerance. Once a motion has gone on for some steps, stages side by
/// side follow where they are cheaper, or steps that evaluate twice where evaluations are slow; and one of Radau's implicit
/// methods while stability and not accuracy bounds steps.
#[derive(Debug)]
pub struct Automatic {
    explicit: Box<RungeKutta>,
    lanes: Box<GaussLanes>,
    multistep: Box<Adams>,
    implicit: Box<Radau>,
    tolerance: Tolerance,
    active: Active,
    controlled: usize,
    /// How many explicit steps it takes to another method for long motions.
    settled: usize,
    /// Steps since a start or a change.
    steps: usize,
    /// Whether what followed explicit steps has been left since the last start.
    was_left: bool,
    /// Steps in a row, less those that say otherwise, for which another method would be better.
    against: usize,
    /// What [tells](RungeKutta::stiffness) whether stability bounded the last explicit step.
    stiffness: f64,
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
    Multistep,
    Implicit,
}

/// From this relative tolerance on, the method of order 5 is cheaper than that of order 8.
const LOOSE: f64 = 1e-5;
/// Up to this relative tolerance, stages side by side or many steps are cheaper than explicit steps.
const TIGHT: f64 = 1e-7;
/// Up to this one stages side by side are so from the first step of a motion, however short it is.
const VERY_TIGHT: f64 = 1e-10;
/// Above this one implicit steps are cheaper with five stages than with seven.
const FEW_STAGES: f64 = 1e-6;
/// The first step of another method may be this many times the last one.
const GROWTH: f64 = 10.0;
/// Likewise of stages side by side. Their own estimate of a first step knows one state only, and without a
/// polynomial to begin from their iteration does not converge over ten explicit steps.
const GROWTH_OF_LANES: f64 = 2.0;

impl Automatic {
    /// The methods with this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        let explicit = match Self::explicit(tolerance) {
            Method::Dopri5 => RungeKutta::dopri5(tolerance),
            _ => RungeKutta::dop853(tolerance),
        };
        Self {
            choice: Self::first(Self::explicit(tolerance)),
            handed_over: Vec::new(),
            explicit: Box::new(explicit),
            lanes: Box::new(GaussLanes::new(tolerance)),
            multistep: Box::new(Adams::new(tolerance)),
            implicit: Box::new(Self::implicit(tolerance)),
            tolerance,
            active: Active::Explicit,
            controlled: 0,
            settled: SETTLED,
            steps: 0,
            stiffness: 0.0,
            was_left: false,
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
        match self.active {
            Active::Explicit => &*self.explicit,
            Active::Lanes => &*self.lanes,
            Active::Multistep => &*self.multistep,
            Active::Implicit => &*self.implicit,
        }
    }

    fn stepper_mut(&mut self) -> &mut dyn Stepper {
        match self.active {
            Active::Explicit => &mut *self.explicit,
            Active::Lanes => &mut *self.lanes,
            Active::Multistep => &mut *self.multistep,
            Active::Implicit => &mut *self.implicit,
        }
    }

    fn all_mut(&mut self) -> [&mut dyn Stepper; 4] {
        let Self { explicit, lanes, multistep, implicit, .. } = self;
        [&mut **explicit, &mut **lanes, &mut **multistep, &mut **implicit]
    }

    /// Whether a motion begins with stages side by side.
    fn begins_side_by_side(&self, system: &mut dyn System) -> bool {
        self.tolerance.relative <= VERY_TIGHT && system.pace() == Pace::SideBySide
    }

    /// Goes on with another method from where this one is.
    fn change(&mut self, system: &mut dyn System, to: Active, reason: &'static str) {
        let mut state = std::mem::take(&mut self.handed_over);
        let &Window { time, state: ref present, next_step: usual, .. } = self.window();
        state.clone_from(present);
        let from = self.active;
        self.hand_over(to, reason);
        match from {
            Active::Lanes | Active::Multistep => {
                self.was_left = true;
                self.settled = self.settled.saturating_mul(2);
                // What speaks against the explicit method speaks for the implicit one.
                self.against = if to == Active::Explicit { SEEN_BEFORE } else { 0 };
            }
            Active::Implicit => self.patience *= 2,
            Active::Explicit => {}
        }
        let controlled = self.controlled;
        self.stepper_mut().start(system, time, &state, controlled);
        self.handed_over = state;
        let growth = match (from, to) {
            // Its steps may have become far too short for another method.
            (Active::Multistep, _) => f64::INFINITY,
            (_, Active::Lanes) => GROWTH_OF_LANES,
            _ => GROWTH,
        };
        let window = self.window_mut();
        window.next_step = window.next_step.min(growth * usual);
    }

    /// Makes another method the active one, which goes on counting.
    fn hand_over(&mut self, to: Active, reason: &'static str) {
        let counts = self.window().counts;
        (self.active, self.against, self.steps) = (to, 0, 0);
        self.window_mut().counts = counts;
        self.choice = Choice { method: self.stepper().choice().method, reason };
    }
}

impl Stepper for Automatic {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against, self.steps) = (controlled, 0, 0);
        self.has_looked = false;
        if self.active == Active::Explicit && self.begins_side_by_side(system) {
            self.hand_over(Active::Lanes, AT_ONCE);
        }
        self.stepper_mut().start(system, t, y, controlled);
    }

    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against, self.steps) = (controlled, 0, 0);
        (self.was_left, self.has_looked) = (false, false);
        match (self.active, self.begins_side_by_side(system)) {
            (Active::Lanes | Active::Multistep, false) => {
                self.hand_over(Active::Explicit, "an event began another motion");
                self.stepper_mut().start(system, t, y, controlled);
            }
            (Active::Explicit | Active::Multistep, true) => {
                self.hand_over(Active::Lanes, AT_ONCE);
                self.stepper_mut().start(system, t, y, controlled);
            }
            _ => self.stepper_mut().restart(system, t, y, controlled),
        }
    }

    fn reset(&mut self) {
        self.all_mut().into_iter().for_each(|stepper| stepper.reset());
        (self.active, self.was_left) = (Active::Explicit, false);
        (self.settled, self.patience) = (SETTLED, STIFF);
        self.choice = Self::first(self.explicit.choice().method);
    }

    fn limit_steps(&mut self, longest: f64) {
        self.all_mut().into_iter().for_each(|stepper| stepper.limit_steps(longest));
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        if let Some((to, reason)) = self.better(system, limit) {
            self.change(system, to, reason);
        }
        let begun = self.stepper_mut().begin_step(system, limit);
        let attempt = if begun.is_err() && self.active == Active::Multistep {
            self.change(system, Active::Explicit, "many steps became too short");
            self.explicit.begin_step(system, limit)?
        } else {
            begun?
        };
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
