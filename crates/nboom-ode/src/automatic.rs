use std::ops::Range;

use smooth::Smooth;

use crate::method::Description;
use crate::{Bernstein, Choice, Method, Radau, StepError, Stepper, System, Tolerance, Window};

mod smooth;

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "auto",
    about: "dopri5, dop853 or radau5, by tolerance and stiffness",
    order: |tolerance| Automatic::smooth(tolerance).order(tolerance),
    dense_order: |tolerance| Automatic::smooth(tolerance).dense_order(tolerance),
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Automatic::new(tolerance)),
};

/// Takes the method that suits the tolerance, and Radau's implicit one while stability and not
/// accuracy bounds its steps.
#[derive(Debug)]
pub struct Automatic {
    smooth: Smooth,
    implicit: Radau,
    is_stiff: bool,
    controlled: usize,
    /// Steps in a row, less those that say otherwise, for which the other method would be better.
    against: usize,
    /// How many of these it takes to go back to the method for smooth motions.
    patience: usize,
    /// The one for smooth motions, with which it begins.
    first_choice: Choice,
    choice: Choice,
}

/// From this relative tolerance on, the method of order 5 is cheaper than that of order 8.
const LOOSE: f64 = 1e-5;
/// Steps bounded by stability after which a problem counts as stiff, and steps in between that
/// show the contrary (Hairer and Wanner, Section IV.2).
const STIFF: usize = 15;
/// The first step of a method may be this many times the last one of the other.
const GROWTH: f64 = 10.0;
/// An implicit step costs as much as this many explicit ones.
const COST: f64 = 3.0;

impl Automatic {
    /// The methods with this tolerance; the one for smooth motions begins.
    pub fn new(tolerance: Tolerance) -> Self {
        let method = Self::smooth(tolerance);
        let reason = match method {
            Method::Dopri5 => "the tolerance is loose",
            _ => "the tolerance is tight",
        };
        Self::with_smooth(Choice { method, reason }, tolerance)
    }

    /// The methods with this tolerance, with this choice for smooth motions: one of
    /// [`Method::Dopri5`], [`Method::Dop853`] and [`Method::GaussLanes`].
    pub fn with_smooth(choice: Choice, tolerance: Tolerance) -> Self {
        Self {
            first_choice: choice,
            choice,
            smooth: Smooth::new(choice.method, tolerance),
            implicit: Radau::new(tolerance),
            is_stiff: false,
            controlled: 0,
            against: 0,
            patience: STIFF,
        }
    }

    /// The method for smooth motions under a tolerance.
    pub(crate) fn smooth(tolerance: Tolerance) -> Method {
        if tolerance.relative >= LOOSE { Method::Dopri5 } else { Method::Dop853 }
    }

    fn active(&self) -> &dyn Stepper {
        if self.is_stiff { &self.implicit } else { self.smooth.stepper() }
    }

    fn active_mut(&mut self) -> &mut dyn Stepper {
        if self.is_stiff { &mut self.implicit } else { self.smooth.stepper_mut() }
    }

    fn active_window_mut(&mut self) -> &mut Window {
        if self.is_stiff { self.implicit.window_mut() } else { self.smooth.window_mut() }
    }

    /// Whether the step just taken speaks for the other method.
    fn is_against(&mut self) -> bool {
        if self.is_stiff {
            self.implicit.stiffness() < COST * self.smooth.limit()
        } else {
            self.smooth.is_held_back()
        }
    }

    /// Goes on with the other method from where this one is.
    fn change(&mut self, system: &mut dyn System) {
        let Window { time, state, counts, next_step: usual, .. } = self.window().clone();
        self.is_stiff = !self.is_stiff;
        self.against = 0;
        self.choice = if self.is_stiff {
            self.active_window_mut().counts = counts;
            let reason = "stability, not accuracy, bounded explicit steps";
            Choice { reason, ..self.implicit.choice() }
        } else {
            self.active_window_mut().counts = counts;
            self.patience *= 2;
            let reason = "accuracy, not stability, bounds steps again";
            Choice { reason, ..self.smooth.stepper().choice() }
        };
        let controlled = self.controlled;
        self.active_mut().start(system, time, &state, controlled);
        let window = self.active_window_mut();
        window.next_step = window.next_step.min(GROWTH * usual);
    }
}

impl Stepper for Automatic {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against) = (controlled, 0);
        self.active_mut().start(system, t, y, controlled);
    }

    fn restart(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        (self.controlled, self.against) = (controlled, 0);
        self.active_mut().restart(system, t, y, controlled);
    }

    fn reset(&mut self) {
        self.smooth.stepper_mut().reset();
        self.implicit.reset();
        (self.is_stiff, self.against, self.patience) = (false, 0, STIFF);
        self.choice = self.first_choice;
    }

    fn limit_steps(&mut self, longest: f64) {
        self.smooth.stepper_mut().limit_steps(longest);
        self.implicit.limit_steps(longest);
    }

    fn step(&mut self, system: &mut dyn System, limit: f64) -> Result<(), StepError> {
        if self.against >= if self.is_stiff { self.patience } else { STIFF } {
            self.change(system);
        }
        self.active_mut().step(system, limit)?;
        let against = self.is_against();
        self.against = if against { self.against + 1 } else { self.against.saturating_sub(2) };
        Ok(())
    }

    fn prepare_dense(&mut self, system: &mut dyn System) {
        self.active_mut().prepare_dense(system);
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.active().interpolate(fraction, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        self.active().polynomial(i)
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        self.active_mut().retake(system, step);
    }

    fn move_end(&mut self, system: &mut dyn System, by: f64) -> bool {
        self.active_mut().move_end(system, by)
    }

    fn advance(&mut self) {
        self.active_mut().advance();
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.active_mut().scale(range, factor);
    }

    fn window(&self) -> &Window {
        self.active().window()
    }

    fn error_of(&self, i: usize) -> f64 {
        self.active().error_of(i)
    }

    fn last_evaluated(&self) -> &[f64] {
        self.active().last_evaluated()
    }

    fn choice(&self) -> Choice {
        self.choice
    }
}
