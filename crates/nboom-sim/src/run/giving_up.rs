//! When a run is given up, and whom that is blamed on.

use nboom_model::HingeLabel;
use nboom_ode::StepError;

use super::Run;
use crate::error::SimError;
use crate::events::situation::Situation;

/// A torque whose square is no number any more.
const BOUND: f64 = 1e154;

/// Share of the largest error from which on a hinge's own error counts.
const COUNTS: f64 = 0.01;

/// Share of its ends' distances below which a line's length is rounding.
const NO_LENGTH: f64 = 1e-14;

/// A run is given up if this many steps do not take it by [`PACE_SPAN`] of the whole span.
const PACE_STEPS: usize = 20_000;
const PACE_SPAN: f64 = 1e-7;

/// Events within [`CHATTER_SPAN`] of the whole span after which a run is given up.
const CHATTER_EVENTS: usize = 1000;
const CHATTER_SPAN: f64 = 1e-4;

impl Run<'_> {
    /// Ends a run whose recorder asks for that; `time` is how far it has come.
    pub(super) fn check_interrupt(&self, time: f64) -> Result<(), SimError> {
        if self.recorder.interrupted() { Err(SimError::Interrupted { time }) } else { Ok(()) }
    }

    /// Gives up a run that has used up its steps, or that would at its present pace.
    pub(super) fn check_progress(&mut self) -> Result<(), SimError> {
        let counts = self.stepper.window().counts;
        let (time, steps) = (self.stepper.window().time, counts.accepted + counts.rejected);
        let span = self.equations.scene.end_time - self.equations.scene.initial.time;
        let (since, steps_then) = self.pace;
        let crawls = steps - steps_then >= PACE_STEPS && time - since < PACE_SPAN * span;
        let used_up = steps >= self.options.max_steps;
        if let Some(runaway) = (crawls || used_up).then(|| self.runaway()).flatten() {
            return Err(runaway);
        }
        if used_up {
            let by = self.options.most_steps_by();
            return Err(SimError::StepsUsedUp { time, steps: self.options.max_steps, by });
        }
        if crawls {
            let (steps, within) = (steps - steps_then, time - since);
            let hinge = self.worst_hinge();
            return Err(SimError::TooManySteps { time, hinge, steps, within });
        }
        if steps - steps_then >= PACE_STEPS {
            self.pace = (time, steps);
        }
        Ok(())
    }

    /// Why the stepper does not go on.
    pub(super) fn stopped(&mut self, error: StepError) -> SimError {
        let hinge = self.hinge_to_blame(error);
        self.runaway().unwrap_or(SimError::from_step(error, hinge))
    }

    /// The hinge with the largest error in the last step.
    fn worst_hinge(&self) -> Option<HingeLabel> {
        let start = self.equations.variables.layout.hinge_motion().start;
        let error_of = |position: usize| self.stepper.error_of(start + position);
        let free = self.equations.entered.dynamics.free_hinges();
        let largest = (0..free.len()).max_by(|&a, &b| error_of(a).total_cmp(&error_of(b)));
        largest.map(|position| self.equations.scene.label(free[position]))
    }

    /// The hinge that keeps the stepper from going on: one whose torque is beyond bounds, else
    /// the one with the largest error, unless that is far below the main body's.
    fn hinge_to_blame(&mut self, error: StepError) -> Option<HingeLabel> {
        let layout = self.equations.variables.layout;
        let free = self.equations.entered.dynamics.free_hinges().to_vec();
        let mut torques = vec![0.0; free.len()];
        let dynamics = &mut self.equations.entered.dynamics;
        let motion = self.equations.variables.motion(dynamics, self.stepper.last_evaluated());
        dynamics.hinge_forces(&motion, &mut torques);
        let bounded = |torque: f64| torque.abs() < BOUND;
        let without_bound = torques.iter().position(|&torque| !bounded(torque));
        let error_of =
            |position: usize| self.stepper.error_of(layout.hinge_motion().start + position);
        let largest = (0..free.len()).max_by(|&a, &b| error_of(a).total_cmp(&error_of(b)));
        let of_all = match error {
            StepError::Underflow { variable, .. } => self.stepper.error_of(variable),
            StepError::NotFinite { .. } | StepError::NoSeries { .. } => f64::INFINITY,
        };
        let counts = largest.filter(|&position| error_of(position) >= COUNTS * of_all);
        without_bound.or(counts).map(|position| self.equations.scene.label(free[position]))
    }

    /// Refuses a mode in which a link has no inertia about its hinge.
    pub(super) fn check_regular(&self) -> Result<(), SimError> {
        match self.equations.singular {
            None => Ok(()),
            Some(hinge) => Err(SimError::SingularMassMatrix {
                time: self.situation.state.time,
                hinge: hinge.map(|i| self.equations.scene.label(i)),
            }),
        }
    }

    /// Refuses a mode in which a force acts along a line that moves and has no length.
    pub(super) fn check_lines(&self) -> Result<(), SimError> {
        let Self { situation: Situation { state, .. }, equations, .. } = self;
        let dynamics = &equations.entered.dynamics;
        for (number, line) in dynamics.elements().lines().iter().enumerate() {
            let acts = line.acts && line.link.is_some();
            let length = || state.line_length(dynamics, number)[0];
            if acts && length() <= NO_LENGTH * line.size {
                let (time, hinge) = (state.time, equations.scene.label(line.hinge));
                return Err(SimError::NoDirection { time, hinge, element: line.kind.names().name });
            }
        }
        Ok(())
    }

    /// Gives up a run whose events follow one another without the time getting on, or are too
    /// many in all. Samples of a control law are no events.
    pub(super) fn check_chatter(&mut self) -> Result<(), SimError> {
        let events = &self.situation.outcome.events;
        if self.sampling.is_some() && events.is_empty() {
            return Ok(());
        }
        let (start, time) = (self.equations.scene.initial.time, self.situation.state.time);
        let (since, count) = self.burst;
        let goes_on = time - since > CHATTER_SPAN * (self.equations.scene.end_time - start);
        self.burst =
            if goes_on { (time, events.len()) } else { (since, count + events.len().max(1)) };
        let (since, events_since) = self.burst;
        let too_many = if events_since >= CHATTER_EVENTS + self.equations.scene.bodies.len() {
            Some((since, events_since))
        } else {
            (self.summary.events >= self.options.max_events).then_some((start, self.summary.events))
        };
        let Some((since, count)) = too_many else { return Ok(()) };
        let hinge =
            events.last().and_then(|event| event.hinge).map(|i| self.equations.scene.label(i));
        Err(SimError::Chatter { time, hinge, events: count, within: time - since })
    }
}
