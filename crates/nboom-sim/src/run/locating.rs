use nboom_elements::Coordinate;

use crate::events::guard::{GuardKind, read, watched};
use crate::run::Run;

/// Corrections after which an event's time is as good as it gets.
const CORRECTIONS: usize = 8;

/// How many times as long a step is as the way to where a guard is expected to change: expectations err mostly by less
/// than a hundredth of that.
const BEYOND: f64 = 1.01;

/// Nearer than this share of the next step no step ends on purpose: it might be too short to be taken.
const NEAREST: f64 = 1e-4;

/// When steps have goals: after one was reached in vain, 1 step has none, then 3, 7 and so on.
#[derive(Default)]
pub(super) struct Aims {
    pause: usize,
    /// Steps from now on that have none.
    without: usize,
}

impl Aims {
    pub fn are_made(&self) -> bool {
        self.without == 0
    }

    /// Notes a step in which nothing happened, and whether it reached a goal.
    pub fn note(&mut self, is_in_vain: bool) {
        if is_in_vain {
            self.pause = self.pause.saturating_mul(2) + 1;
            self.without = self.pause;
        } else {
            self.without = self.without.saturating_sub(1);
        }
    }
}

impl Run<'_> {
    /// Just after the next change of a guard, where one is expected within the next step. A method whose steps end
    /// inside then goes no further than it has to, and need not take the step again.
    pub(super) fn goal(&self) -> Option<f64> {
        if !self.stepper.ends_inside() {
            return None;
        }
        let window = self.stepper.window();
        let (now, farthest) = (window.time, window.time + window.next_step);
        let expected = self.situation.guards.expected(self.equations, (now, farthest))?;
        let is_far_enough = expected - now > NEAREST * window.next_step;
        is_far_enough.then_some(now + BEYOND * (expected - now))
    }

    /// Ends the step where the guard is zero, about this `fraction` of its length: inside, where the method allows
    /// that, else by taking it again. That is Newton's method on the integrated motion itself, from the place where
    /// dense output has the zero. One step is mostly enough, whose end is then moved.
    pub(super) async fn locate(&mut self, kind: GuardKind, fraction: f64, full: f64) {
        let slope = self.slope_of_rate(kind, fraction, full);
        let mut step = fraction * full;
        let mut last_correction = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let is_inside = self.end_at(step, full).await;
            let window = self.stepper.window();
            let time = window.end_time;
            self.equations.read(time, &window.end_state, self.scratch);
            let reading = read(kind, &self.equations.entered.dynamics, self.scratch);
            let correction = -reading.value / slope.unwrap_or(reading.rate);
            let better = correction.abs() < 0.5 * last_correction;
            let matters = self.stepper.window().time + (step + correction) != time;
            if !(correction.is_finite() && better && matters) {
                return;
            }
            if !is_inside && self.stepper.move_end(self.equations, correction) {
                return;
            }
            last_correction = correction.abs();
            // Dense output may put a zero just before the step's end that lies just after it.
            step = (step + correction).clamp(0.0, 1.01 * full);
        }
    }

    /// How fast the rate changes that a guard watches, if it watches one, about this `fraction` of the step.
    fn slope_of_rate(&self, kind: GuardKind, fraction: f64, full: f64) -> Option<f64> {
        let dynamics = &self.equations.entered.dynamics;
        let (Coordinate::Rate(hinge), _) = watched(kind, dynamics.elements()) else { return None };
        let position = dynamics.position_of(hinge)?;
        let variable = self.equations.variables.layout.hinge_motion().start + position;
        let [_, slope, _] = self.stepper.polynomial(variable).derivatives(fraction);
        Some(slope / full)
    }

    /// Ends the step at this length: inside, where the method allows that, else by taking it again. Returns whether it
    /// ends inside.
    pub(super) async fn end_at(&mut self, step: f64, full: f64) -> bool {
        let is_inside = self.stepper.end_inside(step / full);
        if !is_inside {
            self.retake(step).await;
        }
        is_inside
    }

    /// Takes the step again with another length.
    pub(super) async fn retake(&mut self, length: f64) {
        if self.stepper.explicit().is_none() {
            return self.stepper.retake(self.equations, length);
        }
        self.take(length, false).await;
        if let Some(explicit) = self.stepper.explicit() {
            explicit.end_after(length);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of so many steps have goals, each of which is reached in vain or not.
    fn goals(steps: usize, in_vain: bool) -> usize {
        let mut aims = Aims::default();
        let has_goal = |_: &usize| {
            let has_goal = aims.are_made();
            aims.note(has_goal && in_vain);
            has_goal
        };
        (0..steps).filter(has_goal).count()
    }

    #[test]
    fn aims_in_vain_become_rare() {
        // The k-th goal comes after 2ᵏ − 1 + … + 1 steps without one.
        assert_eq!([1, 2, 3, 6, 7, 14].map(|steps| goals(steps, true)), [1, 1, 2, 2, 3, 3]);
        assert!(goals(1_000_000, true) < 20);
        assert_eq!(goals(1000, false), 1000);
    }
}
