use std::ops::Range;

use crate::method::Description;
use crate::{
    Bernstein, Choice, Method, Radau, RungeKutta, StepError, Stepper, System, Tolerance, Window,
};

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "auto",
    about: "dopri5, dop853 or radau5, by tolerance and stiffness",
    order: |tolerance| Automatic::explicit(tolerance).order(tolerance),
    dense_order: |tolerance| Automatic::explicit(tolerance).dense_order(tolerance),
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Automatic::new(tolerance)),
};

/// Takes the explicit method that suits the tolerance, and Radau's implicit one while stability
/// and not accuracy bounds the explicit one's steps.
#[derive(Debug)]
pub struct Automatic {
    explicit: RungeKutta,
    implicit: Radau,
    is_stiff: bool,
    controlled: usize,
    /// Steps in a row, less those that say otherwise, for which the other method would be better.
    against: usize,
    /// How many of these it takes to go back to the explicit method.
    patience: usize,
    choice: Choice,
}

/// From this relative tolerance on, the method of order 5 is cheaper than that of order 8.
const LOOSE: f64 = 1e-5;
/// Steps bounded by stability after which a problem counts as stiff, and steps in between that
/// show the contrary (Hairer and Wanner, Section IV.2).
const STIFF: usize = 15;
/// Share of the stability limit beyond which a step counts as bounded by it: the tighter the
/// tolerance, the further below the limit steps settle. Oscillations that accuracy bounds stay
/// below a third of it.
const NEAR: f64 = 0.7;
/// The first step of a method may be this many times the last one of the other.
const GROWTH: f64 = 10.0;
/// An implicit step costs as much as this many explicit ones.
const COST: f64 = 3.0;

impl Automatic {
    /// The methods with this tolerance; the explicit one begins.
    pub fn new(tolerance: Tolerance) -> Self {
        let (explicit, reason) = match Self::explicit(tolerance) {
            Method::Dopri5 => (RungeKutta::dopri5(tolerance), "the tolerance is loose"),
            _ => (RungeKutta::dop853(tolerance), "the tolerance is tight"),
        };
        Self {
            choice: Choice { reason, ..explicit.choice() },
            explicit,
            implicit: Radau::new(tolerance),
            is_stiff: false,
            controlled: 0,
            against: 0,
            patience: STIFF,
        }
    }

    /// The explicit method for a tolerance.
    pub(crate) fn explicit(tolerance: Tolerance) -> Method {
        if tolerance.relative >= LOOSE { Method::Dopri5 } else { Method::Dop853 }
    }

    fn active(&self) -> &dyn Stepper {
        if self.is_stiff { &self.implicit } else { &self.explicit }
    }

    fn active_mut(&mut self) -> &mut dyn Stepper {
        if self.is_stiff { &mut self.implicit } else { &mut self.explicit }
    }

    fn active_window_mut(&mut self) -> &mut Window {
        if self.is_stiff { self.implicit.window_mut() } else { self.explicit.window_mut() }
    }

    /// Whether the step just taken speaks for the other method.
    fn is_against(&mut self) -> bool {
        let limit = self.explicit.stability_limit();
        if self.is_stiff {
            self.implicit.stiffness() < COST * limit
        } else {
            self.explicit.stiffness() > NEAR * limit
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
            Choice { reason, ..self.explicit.choice() }
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

    fn limit_steps(&mut self, longest: f64) {
        self.explicit.limit_steps(longest);
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
