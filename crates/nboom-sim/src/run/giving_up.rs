//! When a run is given up, and whom that is blamed on.

use nboom_dynamics::Singularity;
use nboom_elements::Kind;
use nboom_model::{Body, HingeLabel, Joint, MassProperties, Scene};
use nboom_ode::StepError;
use nboom_scalar::RigidInertia;

use super::Run;
use crate::error::SimError;
use crate::events::event::EventKind;
use crate::events::situation::Situation;
use crate::options::Options;

/// A larger torque overflows when squared.
const LARGEST_TORQUE: f64 = 1e154;

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

const FRICTION: &str = "friction may catch a hinge and let go of it again and again";
const STOP: &str = "a hinge at its stop may bounce on and on";

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
            return Err(SimError::Runaway { time, runaway });
        }
        if used_up {
            let Options { max_steps: steps, max_steps_by: by, .. } = self.options;
            return Err(SimError::StepsUsedUp { time, steps, by });
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
        match self.runaway() {
            Some(runaway) => SimError::Runaway { time: self.situation.state.time, runaway },
            None => SimError::from_step(error, hinge),
        }
    }

    /// The hinge with the largest error in the last step.
    fn worst_hinge(&self) -> Option<HingeLabel> {
        let free = self.equations.entered.dynamics.free_hinges();
        let (position, _) = self.largest_error()?;
        Some(self.equations.scene.label(free[position]))
    }

    /// Where the hinge with the largest error in the last step stands among the free ones, and that error.
    fn largest_error(&self) -> Option<(usize, f64)> {
        let rates = self.equations.variables.layout.hinge_motion();
        let errors = rates.map(|variable| self.stepper.error_of(variable)).enumerate();
        errors.max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// The hinge that keeps the stepper from going on: one whose torque is beyond bounds, else
    /// the one with the largest error, unless that is far below the main body's.
    fn hinge_to_blame(&mut self, error: StepError) -> Option<HingeLabel> {
        let free = self.equations.entered.dynamics.free_hinges().to_vec();
        let mut torques = vec![0.0; free.len()];
        let dynamics = &mut self.equations.entered.dynamics;
        let motion = self.equations.variables.motion(dynamics, self.stepper.last_evaluated());
        dynamics.hinge_forces(&motion, &mut torques);
        let bounded = |torque: f64| torque.abs() < LARGEST_TORQUE;
        let without_bound = torques.iter().position(|&torque| !bounded(torque));
        let of_all = match error {
            StepError::Underflow { variable, .. } => self.stepper.error_of(variable),
            StepError::NotFinite { .. } | StepError::NoSeries { .. } => f64::INFINITY,
        };
        let counts = self.largest_error().filter(|(_, error)| *error >= COUNTS * of_all);
        let counts = counts.map(|(position, _)| position);
        without_bound.or(counts).map(|position| self.equations.scene.label(free[position]))
    }

    /// Refuses a mode in which a link has no inertia about its hinge, or none that double precision can hold.
    pub(super) fn check_regular(&self) -> Result<(), SimError> {
        let Some(singularity) = self.equations.singularity else { return Ok(()) };
        let (time, scene) = (self.situation.state.time, &self.equations.scene);
        let hinge = singularity.hinge().map(|i| scene.label(i));
        if has_inertia(scene, singularity) {
            return Err(SimError::LostInertia { time, hinge });
        }
        Err(SimError::SingularMassMatrix { time, hinge })
    }

    /// Refuses a mode in which a force acts along a line that moves and has no length.
    pub(super) fn check_lines(&self) -> Result<(), SimError> {
        let Self { situation: Situation { state, .. }, equations, .. } = self;
        let dynamics = &equations.entered.dynamics;
        for (number, line) in dynamics.elements().lines().iter().enumerate() {
            let acts = line.acts && line.link.is_some();
            if acts && state.length_of(dynamics, number) <= NO_LENGTH * line.size {
                let (time, hinge) = (state.time, equations.scene.label(line.hinge));
                return Err(SimError::NoDirection { time, hinge, element: line.kind.names().name });
            }
        }
        Ok(())
    }

    /// Gives up a run whose events follow one another without the time getting on, or are too
    /// many in all. Points of tables over time and samples of a control law are no events.
    pub(super) fn check_chatter(&mut self) -> Result<(), SimError> {
        let Situation { outcome, arrivals, .. } = &*self.situation;
        let events = &outcome.events;
        let at_rest = arrivals.halts().first().copied().or(self.rest.slipped);
        if events.is_empty() && arrivals.is_empty() && at_rest.is_none() {
            return Ok(());
        }
        // Rebounds get slower and end by themselves, in however short a time.
        let rebounds = arrivals.is_rebound();
        let (start, time) = (self.equations.scene.initial.time, self.situation.state.time);
        let (since, count) = self.burst;
        let span = CHATTER_SPAN * (self.equations.scene.end_time - start);
        let goes_on = time - since > if rebounds { 0.0 } else { span };
        self.burst =
            if goes_on { (time, events.len()) } else { (since, count + events.len().max(1)) };
        let (since, events_since) = self.burst;
        let (hinge, cause) = match (events.last(), arrivals.impacts().first()) {
            (Some(event), _) => (event.hinge, cause_of_more(event.kind)),
            (None, Some(impact)) => (Some(impact.hinge), STOP),
            (None, None) => {
                let hinge = at_rest.map(|i| &self.equations.scene.bodies[i].hinge);
                let by_stop = hinge.is_some_and(|hinge| hinge.friction == 0.0);
                (at_rest, if by_stop { STOP } else { FRICTION })
            }
        };
        let hinge = hinge.map(|i| self.equations.scene.label(i));
        if events_since >= CHATTER_EVENTS + self.equations.scene.bodies.len() {
            let (events, within) = (events_since, time - since);
            return Err(SimError::Chatter { time, hinge, cause, events, within });
        }
        let events = self.options.max_events;
        if self.summary.events >= events {
            return Err(SimError::EventsUsedUp { time, hinge, cause, events });
        }
        Ok(())
    }
}

/// What may make events like this one again and again.
fn cause_of_more(last: EventKind) -> &'static str {
    match last {
        EventKind::Impact | EventKind::Rest | EventKind::Leave => STOP,
        EventKind::Stick | EventKind::Slip => FRICTION,
        EventKind::Rise(kind) | EventKind::Fall(kind) => match kind {
            Kind::KickOff => "a spring at its limit length may chatter",
            Kind::Friction => FRICTION,
            Kind::TorqueTable => "a hinge may pass a point of its table on and on",
        },
        EventKind::ThrustOn | EventKind::ThrustOff => {
            "a force from outside may be switched again and again"
        }
        EventKind::LockUp | EventKind::Release | EventKind::End => {
            "the scene has very many of them"
        }
    }
}

/// Whether the body alone of a singularity has inertia: the main body in all directions, another about its hinge.
fn has_inertia(scene: &Scene, of: Singularity) -> bool {
    let Singularity::Hinge(hinge) = of else {
        return scene.main_body.principal_moments()[0] > 0.0;
    };
    let Body { joint, axis, mass_properties, .. } = &scene.bodies[hinge];
    let MassProperties { mass, center_of_mass, inertia } = *mass_properties;
    match joint {
        Joint::Revolute => {
            axis.dot(RigidInertia::new(mass, center_of_mass, inertia).about_origin * *axis) > 0.0
        }
        Joint::Prismatic => mass > 0.0,
    }
}

#[cfg(test)]
mod tests {
    use nboom_model::{Appendage, Hinge, Mount, SceneDescription, Segment};
    use nboom_scalar::{Sym3, Vec3};

    use super::*;
    use crate::options::Options;
    use crate::run::Simulator;
    use crate::run::record::Nobody;

    /// What keeps a hub with a boom of this mass, so far out, from running.
    fn refused(inertia: Sym3<f64>, mass: f64, out: f64) -> Option<SimError> {
        let hub = MassProperties::new(100.0, Vec3::zero(), inertia);
        let mut description = SceneDescription::at_rest("boom", hub, 0.1);
        let boom = MassProperties::new(mass, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
        let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
        description
            .attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y() * out), segments });
        let scene = Scene::new(description).expect("bodies");
        Simulator::new(&scene, Options::default()).run(&mut Nobody).err().map(|failed| failed.error)
    }

    #[test]
    fn inertia_that_double_precision_cannot_hold_is_not_called_none() {
        let inertia = Sym3::diagonal(40.0, 30.0, 20.0);
        for (mass, out) in [(3.0, 2.0), (1e12, 2.0), (3.0, 1e4)] {
            assert!(refused(inertia, mass, out).is_none(), "{mass:e}, {out:e}");
        }
        for (mass, out) in [(1e18, 2.0), (1e30, 2.0), (1e300, 2.0), (3.0, 1e120)] {
            let error = refused(inertia, mass, out);
            assert!(
                matches!(error, Some(SimError::LostInertia { .. })),
                "{mass:e}, {out:e}: {error:?}"
            );
        }
        // A point in the hinge turns about its axis as it likes.
        let error = refused(Sym3::zero(), 3.0, 0.0);
        assert!(
            matches!(error, Some(SimError::SingularMassMatrix { hinge: None, .. })),
            "{error:?}"
        );
    }
}
