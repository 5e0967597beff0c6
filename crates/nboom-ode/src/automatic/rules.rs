//! When a method hands over to another one.

use super::{Active, Automatic, TIGHT};
use crate::{Pace, Stepper, System, Window};

/// Explicit steps after which a motion is taken to go on for so long that what starts slowly pays, if as many could
/// follow; twice as many after each time that it was left.
pub(super) const SETTLED: usize = 12;
/// Steps bounded by stability after which a problem counts as stiff, and steps in between that
/// show the contrary (Hairer and Wanner, Section IV.2).
pub(super) const STIFF: usize = 15;
/// Likewise of stages side by side whose iteration is slow; such a step costs several explicit ones.
const SLOW: usize = 4;
/// What speaks against them or against several steps most often bounds explicit steps too: as many count as seen, and
/// are forgotten after half as many that it does not bound.
pub(super) const SEEN_BEFORE: usize = 10;
/// Share of the stability limit beyond which a step counts as bounded by it: the tighter the
/// tolerance, the further below the limit steps settle. Oscillations that accuracy bounds stay
/// below a third of it.
const NEAR: f64 = 0.7;
/// Share of it up to which stability does not bound the methods that follow either.
const CLEAR: f64 = 0.33;
/// An implicit step costs as much as this many explicit ones.
const COST: f64 = 3.0;
/// With so many explicit steps to come, one step that a decay bounds is enough.
const MANY: f64 = 1000.0;
/// Usual steps to come without which so many cannot.
const FEWEST: f64 = 500.0;

impl Automatic {
    /// Whether the step just taken speaks against the method that took it.
    fn is_against(&mut self) -> bool {
        match self.active {
            Active::Explicit => {
                self.stiffness = self.explicit.stiffness();
                self.stiffness > NEAR * self.explicit.stability_limit()
            }
            Active::Lanes => self.lanes.is_held_back(),
            Active::Multistep => self.multistep.is_held_back(),
            Active::Implicit => self.implicit.stiffness() < COST * self.explicit.stability_limit(),
        }
    }

    /// Whether a motion that dies down without oscillating bounded the step just taken, and would bound many
    /// explicit steps on the way to `limit`. Looks once after each start.
    fn is_clearly_stiff(&mut self, system: &mut dyn System, limit: f64) -> bool {
        let &Window { time, next_step, .. } = self.window();
        let remaining = limit - time;
        let may_be =
            self.active != Active::Implicit && self.against > 0 && remaining > FEWEST * next_step;
        if !may_be || std::mem::replace(&mut self.has_looked, true) {
            return false;
        }
        let (active, controlled) = (self.active, self.controlled);
        let Self { explicit, lanes, multistep, implicit, .. } = self;
        let window = match active {
            Active::Lanes => lanes.window(),
            Active::Multistep => multistep.window(),
            _ => explicit.window(),
        };
        let Some(rate) = implicit.rate_of_decay(system, window, controlled) else { return false };
        let is_stiff = rate * remaining > MANY * explicit.stability_limit();
        self.window_mut().counts.jacobians += 1;
        is_stiff
    }

    /// The method that should take the next step instead, and why.
    pub(super) fn better(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Option<(Active, &'static str)> {
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
                let lasts = limit - time > self.settled as f64 * next_step;
                let is_steady = self.steps >= self.settled && lasts && self.against == 0;
                let is_free = self.stiffness < CLEAR * self.explicit.stability_limit();
                let may = self.tolerance.relative <= TIGHT && !self.was_left;
                if is_steady && is_free && may { follower(system) } else { None }
            }
            Active::Lanes => (self.against >= SLOW)
                .then_some((Active::Explicit, "damping slowed the iteration of stages down")),
            Active::Multistep => (self.against >= STIFF)
                .then_some((Active::Explicit, "stability, not accuracy, bounded many steps")),
            Active::Implicit => (self.against >= self.patience)
                .then_some((Active::Explicit, "accuracy, not stability, bounds steps again")),
        }
    }

    /// Takes note of what the step just taken says of the method that took it.
    pub(super) fn note_step(&mut self) {
        let against = self.is_against();
        self.against = if against { self.against + 1 } else { self.against.saturating_sub(2) };
        self.steps += 1;
    }
}

/// The method that takes over from the explicit one where a motion goes on, if one pays.
fn follower(system: &mut dyn System) -> Option<(Active, &'static str)> {
    match system.pace() {
        Pace::SideBySide => {
            let reason = "the motion goes on for long, and code takes eight stages at once";
            Some((Active::Lanes, reason))
        }
        Pace::Slow => {
            let reason = "the motion goes on for long, and evaluations are slow";
            Some((Active::Multistep, reason))
        }
        Pace::Fast => None,
    }
}
