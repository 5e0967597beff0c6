use nboom_model::Scene;
use nboom_ode::Stepper;

use crate::code::selection::Selection;
use crate::equations::Equations;
use crate::equations::attitude_norm::AttitudeNorm;
use crate::equations::layout::VariableLayout;
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::event::{Event, EventKind};
use crate::events::guard::{GuardKind, read};
use crate::events::instant::{self, Arrivals};
use crate::events::situation::Situation;
use crate::options::Options;
use crate::run::ledger::Ledger;
use crate::run::record::{Failure, Integration, Recorder, Snapshot, Summary};
use crate::run::step_motion::Room;
use crate::run::verdict::Verdict;

pub(crate) mod beforehand;
pub(crate) mod conservation;
pub(crate) mod finite;
pub(crate) mod ledger;
pub(crate) mod record;
pub(crate) mod snapshot;
pub(crate) mod step_motion;
pub(crate) mod verdict;

mod giving_up;
mod runaway;
mod simulator;
mod telling;

use runaway::Resources;
pub use simulator::Simulator;

/// Runs `scene` from its initial to its end time and tells `recorder` on the way.
///
/// # Errors
/// When the motion cannot be followed to the end or the recorder refuses; what was recorded
/// until then stands, and the failure says how far the run came.
pub fn simulate(
    scene: &Scene,
    options: &Options,
    recorder: &mut dyn Recorder,
) -> Result<Summary, Failure> {
    Simulator::new(scene, *options).run(recorder)
}

/// Corrections after which an event's time is as good as it gets.
const CORRECTIONS: usize = 8;

struct Run<'a> {
    options: Options,
    recorder: &'a mut dyn Recorder,
    situation: Situation<'a, f64>,
    scratch: State,
    /// Room for states between those of steps.
    spare: Option<State>,
    /// What the recorder was shown last.
    seen: Snapshot,
    equations: &'a mut Equations,
    stepper: Box<dyn Stepper>,
    ledger: Ledger,
    variables: Vec<f64>,
    next_sample: usize,
    events: usize,
    /// When the last burst of events began, and how many there were since.
    burst: (f64, usize),
    /// Time and number of steps when progress was last looked at.
    pace: (f64, usize),
    resources: Resources,
    selections: Vec<Selection>,
    integrations: Vec<Integration>,
    attitude_norm: AttitudeNorm,
    room: Room,
    verdict: Verdict,
}

impl<'a> Run<'a> {
    /// The beginning of `scene`, which `equations` are of.
    fn new(
        scene: &'a Scene,
        options: Options,
        equations: &'a mut Equations,
        recorder: &'a mut dyn Recorder,
    ) -> Self {
        equations.begin(scene);
        let situation = Situation::at_start(scene, &mut equations.entered.dynamics);
        let Situation { state, mode, .. } = &situation;
        let mut variables = Vec::new();
        equations.enter(scene, mode, state, &mut variables);
        let room = Room::new(scene, equations.entered.dynamics.elements());
        Self {
            options,
            recorder,
            ledger: Ledger::new(scene, equations, state),
            resources: Resources::of(scene, equations, state),
            scratch: state.clone(),
            spare: None,
            seen: Snapshot::empty(),
            verdict: Verdict::of(&mode.hinges, &state.beta),
            situation,
            equations,
            stepper: options.stepper(),
            variables,
            next_sample: 0,
            events: 0,
            burst: (scene.initial.time, 0),
            pace: (scene.initial.time, 0),
            selections: Vec::new(),
            integrations: Vec::new(),
            attitude_norm: AttitudeNorm::new(),
            room,
        }
    }

    fn complete(&mut self) -> Result<(), SimError> {
        self.options
            .check_span(self.situation.scene.end_time - self.situation.scene.initial.time)?;
        let dynamics = &mut self.equations.entered.dynamics;
        self.situation.watch(dynamics, &[]);
        let mut arrivals = self.situation.arrivals_at_start(dynamics);
        loop {
            self.pass_instant(&arrivals)?;
            self.sample_here()?;
            if self.situation.is_at_end() {
                return self.finish();
            }
            let located = self.integrate_to_next_instant()?;
            arrivals = self.situation.arrivals(&mut self.equations.entered.dynamics, located);
        }
    }

    /// Changes the mode as the instant demands and starts integration anew.
    fn pass_instant(&mut self, arrivals: &Arrivals) -> Result<(), SimError> {
        let before = self.before_instant(arrivals)?;
        let outcome = self.situation.pass(&mut self.equations.entered.dynamics, arrivals)?;
        let Situation { scene, state, mode, .. } = &self.situation;
        let (scene, time) = (*scene, state.time);
        self.equations.enter(scene, mode, state, &mut self.variables);
        self.check_regular()?;
        self.check_lines()?;
        self.select()?;
        if self.equations.variables.layout.has_momenta() {
            // A lock-up leaves momenta; rates follow from them and not from its impulse.
            self.equations.read(time, &self.variables, &mut self.situation.state);
        }
        let controlled = self.equations.variables.layout.controlled();
        self.attitude_norm.put_back();
        let (stepper, equations) = (&mut self.stepper, &mut *self.equations);
        if time > scene.initial.time {
            stepper.restart(equations, time, &self.variables, controlled);
        } else {
            stepper.start(equations, time, &self.variables, controlled);
        }
        self.situation.watch(&mut self.equations.entered.dynamics, &outcome.crossed);
        finite::check_instant(scene, time, &outcome.events, &outcome.jumps)?;
        if !outcome.events.is_empty() {
            self.tell_instant(before, outcome.jumps)?;
        }
        self.report(&outcome.events)?;
        self.check_chatter(&outcome.events)
    }

    /// Integrates until a guard changes sign, something is scheduled, or the end, and leaves the
    /// situation there. Returns the guard.
    fn integrate_to_next_instant(&mut self) -> Result<Option<GuardKind>, SimError> {
        let limit = self.situation.limit();
        loop {
            self.step(limit)?;
            let sample_due = self.is_before(self.sample_time(), self.stepper.window().end_time);
            let guards = &mut self.situation.guards;
            if sample_due || self.recorder.needs_steps() || !guards.list.is_empty() {
                self.stepper.prepare_dense(&mut *self.equations);
            }
            let change = guards.first_change(self.equations, &*self.stepper);
            let full = self.stepper.window().length();
            if let Some((kind, fraction)) = change {
                self.locate(kind, fraction * full, full);
            }
            self.sample_within(full, self.stepper.window().end_time)?;
            self.tell_step(full)?;
            self.accept();
            let Situation { state, guards, .. } = &mut self.situation;
            guards.settle(&mut self.equations.entered.dynamics, state);
            if change.is_some() || state.time >= limit {
                return Ok(change.map(|(kind, _)| kind));
            }
        }
    }

    fn step(&mut self, limit: f64) -> Result<(), SimError> {
        self.check_interrupt(self.situation.state.time)?;
        self.check_progress()?;
        self.check_growth()?;
        let taken = self.stepper.step(&mut *self.equations, limit);
        taken.map_err(|error| self.stopped(error))?;
        self.note_method();
        Ok(())
    }

    /// Notes which method took the step, when that is a change.
    fn note_method(&mut self) {
        let (since, choice) = (self.stepper.window().time, self.stepper.choice());
        if self.integrations.last().is_none_or(|last| last.choice.method != choice.method) {
            self.integrations.push(Integration { since, choice });
        }
    }

    /// Takes the step again so that it ends where the guard is zero: Newton's method on the
    /// integrated motion itself, from the place where dense output has the zero. One step is
    /// mostly enough, whose end is then moved.
    fn locate(&mut self, kind: GuardKind, guess: f64, full: f64) {
        let mut step = guess;
        let mut last_correction = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            self.stepper.retake(&mut *self.equations, step);
            let window = self.stepper.window();
            let time = window.end_time;
            self.equations.read(time, &window.end_state, &mut self.scratch);
            let reading = read(kind, &mut self.equations.entered.dynamics, &self.scratch);
            let correction = -reading.value / reading.rate;
            let better = correction.abs() < 0.5 * last_correction;
            let matters = self.stepper.window().time + (step + correction) != time;
            if !(correction.is_finite() && better && matters) {
                return;
            }
            if self.stepper.move_end(&mut *self.equations, correction) {
                return;
            }
            last_correction = correction.abs();
            // Dense output may put a zero just before the step's end that lies just after it.
            step = (step + correction).clamp(0.0, 1.01 * full);
        }
    }

    /// Makes the end of the step the present state, with the attitude put back to norm 1 where
    /// the method does not keep it there.
    fn accept(&mut self) {
        self.stepper.advance();
        let attitude = &self.stepper.window().state[VariableLayout::ATTITUDE];
        let norm = attitude.iter().map(|q| q * q).sum::<f64>().sqrt();
        self.attitude_norm.follow(norm);
        if !self.options.integrator.keeps_invariants() {
            self.stepper.scale(VariableLayout::ATTITUDE, 1.0 / norm);
            self.attitude_norm.put_back();
        }
        let window = self.stepper.window();
        self.equations.read(window.time, &window.state, &mut self.situation.state);
    }

    /// Whether `time` is before `other` and not in its instant, which the fastest motion of all makes.
    fn is_before(&self, time: f64, other: f64) -> bool {
        time < other - instant::duration(self.situation.scene, time, self.equations.fastest())
    }

    fn finish(&mut self) -> Result<(), SimError> {
        let now = Totals::of(
            &self.situation.state,
            &self.situation.state.invariants(&mut self.equations.entered.dynamics),
        );
        let end = Event {
            time: self.situation.state.time,
            kind: EventKind::End,
            hinge: None,
            impulse: None,
            before: now,
            after: now,
        };
        self.report(&[end])
    }

    /// Chooses the code for the mode, and notes when that is a change.
    fn select(&mut self) -> Result<(), SimError> {
        let selection = self.equations.select(self.situation.scene, &self.options);
        let selection =
            selection.map_err(|error| SimError::from_code(error, self.situation.state.time))?;
        self.selections = self.counted_selections();
        let same = |last: &Selection| {
            let Selection { since, evaluations, .. } = *last;
            Selection { since, evaluations, ..selection.clone() } == *last
        };
        if !self.selections.last().is_some_and(same) {
            self.selections.push(selection);
        }
        Ok(())
    }

    /// The selections so far, the last one with all evaluations since the others.
    fn counted_selections(&self) -> Vec<Selection> {
        let mut selections = self.selections.clone();
        if let Some((last, others)) = selections.split_last_mut() {
            let before: usize = others.iter().map(|selection| selection.evaluations).sum();
            last.evaluations = self.equations.evaluations() - before;
        }
        selections
    }

    fn summary(&self) -> Summary {
        let counts = self.stepper.window().counts;
        Summary {
            end_time: self.situation.state.time,
            steps_accepted: counts.accepted,
            steps_rejected: counts.rejected,
            evaluations: counts.evaluations,
            events: self.events,
            conservation: self.ledger.residuals(),
            jacobians: counts.jacobians,
            factorizations: counts.factorizations,
            integrator: self.options.integrator.name(),
            integrations: self.integrations.clone(),
            selections: self.counted_selections(),
            verdict: self
                .verdict
                .ending_with(&self.situation.mode.hinges, &self.situation.state.beta),
            attitude_drift: self.attitude_norm.largest_drift,
        }
    }
}
