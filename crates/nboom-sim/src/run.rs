use nboom_dynamics::Invariants;
use nboom_model::Scene;
use nboom_ode::Stepper;

use crate::equations::Equations;
use crate::equations::attitude_norm::AttitudeNorm;
use crate::equations::layout::VariableLayout;
use crate::equations::state::State;
use crate::error::SimError;
use crate::events::guard::GuardKind;
use crate::events::instant;
use crate::events::rest::Rest;
use crate::events::situation::Situation;
use crate::lanes::Lanes;
use crate::options::Options;
use crate::run::ledger::Ledger;
use crate::run::record::{Failure, Integration, Recorder, Snapshot, Summary};
use crate::run::step_motion::Room;

pub(crate) mod account;
pub(crate) mod beforehand;
pub(crate) mod bodies;
pub(crate) mod conservation;
pub(crate) mod control;
pub(crate) mod finite;
pub(crate) mod ledger;
pub(crate) mod output_times;
pub(crate) mod record;
pub(crate) mod snapshot;
pub(crate) mod step_motion;
pub(crate) mod verdict;

mod closing;
mod giving_up;
mod locating;
mod passing;
mod runaway;
mod simulator;
mod slip;
mod telling;

use control::{Control, Sampling};
use locating::Aims;
use runaway::Resources;
pub use simulator::Simulator;
use simulator::Workspace;

/// Steps after which a run looks at energy and momenta once, if no output time and no event has made it.
const STEPS_UNSEEN: usize = 16;

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
    Simulator::new(scene, *options).run(recorder).cloned()
}

struct Run<'a> {
    options: Options,
    recorder: &'a mut dyn Recorder,
    sampling: Option<Sampling<'a>>,
    equations: &'a mut Equations,
    situation: &'a mut Situation<f64>,
    scratch: &'a mut State,
    /// The state that is shown, which may be between those of steps.
    shown: &'a mut State,
    /// What the recorder was shown last.
    seen: &'a mut Snapshot,
    /// The motion before and after the present instant, where it is wanted.
    sides: &'a mut [Snapshot; 2],
    stepper: &'a mut dyn Stepper,
    lanes: &'a Lanes,
    ledger: Ledger,
    variables: &'a mut Vec<f64>,
    next_sample: usize,
    /// Steps since energy and momenta were last looked at.
    unseen_steps: usize,
    /// Whether the next step is the first one after an instant.
    begins_anew: bool,
    /// When the last burst of events began, and how many there were since.
    burst: (f64, usize),
    /// Time and number of steps when progress was last looked at.
    pace: (f64, usize),
    resources: Resources,
    rest: &'a mut Rest,
    attitude_norm: AttitudeNorm,
    room: &'a mut Room,
    summary: &'a mut Summary,
}

impl<'a> Run<'a> {
    /// The beginning of the scene of `equations`.
    fn new(
        options: Options,
        equations: &'a mut Equations,
        stepper: &'a mut dyn Stepper,
        workspace: &'a mut Workspace,
        control: Option<Control<'a>>,
        lanes: &'a Lanes,
        recorder: &'a mut dyn Recorder,
    ) -> Self {
        let Workspace { situation, scratch, shown, seen, sides, variables, room, rest, summary } =
            workspace;
        rest.begin(&equations.scene);
        stepper.reset();
        equations.begin();
        situation.begin(&equations.scene, &equations.start, &mut equations.entered.dynamics);
        let start = equations.scene.initial.time;
        if control.is_some() {
            situation.sample_at(start);
        }
        let Situation { state, mode, .. } = &mut *situation;
        equations.enter(mode, state, variables);
        let invariants = situation.invariants(&mut equations.entered.dynamics);
        let Situation { state, mode, .. } = &*situation;
        summary.begin(&mode.hinges, &state.beta);
        Self {
            options,
            recorder,
            ledger: Ledger::new(equations, state, &invariants, control.is_some()),
            sampling: control.map(Sampling::new),
            resources: Resources::of(&equations.scene, &invariants),
            scratch,
            shown,
            seen,
            sides,
            situation,
            equations,
            stepper,
            lanes,
            variables,
            next_sample: 0,
            unseen_steps: 0,
            begins_anew: true,
            burst: (start, 0),
            pace: (start, 0),
            rest,
            attitude_norm: AttitudeNorm::new(),
            room,
            summary,
        }
    }

    async fn complete(&mut self) -> Result<(), SimError> {
        let Equations { scene, entered, .. } = &*self.equations;
        self.options.check_span(scene.end_time - scene.initial.time)?;
        self.check_period()?;
        self.check_own_laws()?;
        self.situation.watch(scene, &entered.dynamics);
        self.situation.arrive_at_start(scene, &entered.dynamics);
        loop {
            self.pass_instant()?;
            self.sample_here()?;
            if self.situation.is_at_end(&self.equations.scene) {
                return self.finish();
            }
            let located = self.integrate_to_next_instant().await?;
            let Equations { scene, entered, .. } = &*self.equations;
            self.situation.arrive(scene, &entered.dynamics, located);
        }
    }

    /// Energy and momenta of the present state.
    fn invariants(&mut self) -> Invariants<f64> {
        self.situation.invariants(&mut self.equations.entered.dynamics)
    }

    /// Integrates until a guard changes sign, something is scheduled, or the end, and leaves the
    /// situation there. Returns the guard.
    async fn integrate_to_next_instant(&mut self) -> Result<Option<GuardKind>, SimError> {
        let limit = self.situation.limit(&self.equations.scene);
        let mut aims = Aims::default();
        loop {
            let goal = if aims.are_made() { self.goal() } else { None };
            self.step(goal.map_or(limit, |goal| goal.min(limit))).await?;
            let sample_due = self.is_before(self.sample_time(), self.stepper.window().end_time);
            if sample_due || self.is_searched() {
                self.stepper.prepare_dense(self.equations);
            }
            let change = self.situation.guards.first_change(self.equations, self.stepper);
            let full = self.stepper.window().length();
            let slip = self.first_slip(change.map_or(1.0, |(_, fraction)| fraction));
            self.rest.slipped = match slip {
                Some(slip) => self.locate_slip(slip, full).await,
                None => None,
            };
            let slips = self.rest.slipped.is_some();
            let change = change.filter(|_| !slips);
            if let Some((kind, fraction)) = change {
                self.locate(kind, fraction, full).await;
            }
            self.sample_within(full, self.stepper.window().end_time)?;
            self.note_misses(full);
            self.tell_step(full)?;
            self.accept();
            let Situation { state, guards, .. } = &mut *self.situation;
            guards.note_sides(&self.equations.entered.dynamics, state);
            if slips || change.is_some() || state.time >= limit {
                return Ok(change.map(|(kind, _)| kind));
            }
            aims.note(goal.is_some_and(|goal| state.time >= goal));
        }
    }

    async fn step(&mut self, limit: f64) -> Result<(), SimError> {
        self.check_interrupt(self.situation.state.time)?;
        self.check_progress()?;
        self.check_growth()?;
        let begun = self.stepper.begin_step(self.equations, limit);
        let mut attempt = begun.map_err(|error| self.stopped(error))?;
        while let Some(length) = attempt {
            let has_sample = self.sample_time() <= self.stepper.window().time + length;
            // Most steps are good.
            self.take(length, self.is_searched() || has_sample).await;
            let judged = self.stepper.judge(limit);
            attempt = judged.map_err(|error| self.stopped(error))?;
        }
        self.note_method();
        Ok(())
    }

    /// Whether the steps of the mode are searched, for events or by the recorder.
    fn is_searched(&self) -> bool {
        let Situation { mode, guards, .. } = &*self.situation;
        self.recorder.needs_steps() || !guards.list.is_empty() || self.rest.holds(mode)
    }

    /// Takes a step of this length by the explicit method, whatever its error, in a lane if the run is to.
    async fn take(&mut self, length: f64, with_dense: bool) {
        let Some(explicit) = self.stepper.explicit() else { return };
        match self.equations.in_lanes() {
            Some(mode) => {
                let evaluations = self.lanes.step(explicit, mode, (length, with_dense)).await;
                self.equations.count(evaluations);
            }
            None => explicit.take(self.equations, length),
        }
    }

    /// Notes which method took the step, when that is a change.
    fn note_method(&mut self) {
        let (since, choice) = (self.stepper.window().time, self.stepper.choice());
        let integrations = &mut self.summary.integrations;
        if integrations.last().is_none_or(|last| last.choice.method != choice.method) {
            integrations.push(Integration { since, choice });
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
        self.situation.forget_invariants();
        self.summary.verdict.note_rates(&self.situation.state.tau);
        self.unseen_steps += 1;
        if self.unseen_steps == STEPS_UNSEEN {
            self.unseen_steps = 0;
            let found = self.invariants();
            self.ledger.note_motion(&found);
        }
    }

    /// Whether `time` is before `other` and not in its instant, which the fastest motion of all makes.
    fn is_before(&self, time: f64, other: f64) -> bool {
        time < other - instant::duration(&self.equations.scene, time, self.equations.fastest())
    }

    /// Credits the present code with all evaluations since it was chosen.
    fn count_evaluations(&mut self) {
        if let Some((last, others)) = self.summary.selections.split_last_mut() {
            let before: usize = others.iter().map(|selection| selection.evaluations).sum();
            last.evaluations = self.equations.evaluations() - before;
        }
    }

    /// Sums up how the run went.
    fn sum_up(&mut self) {
        self.count_evaluations();
        let Self { situation: Situation { state, mode, .. }, summary, .. } = self;
        let counts = self.stepper.window().counts;
        summary.end_time = state.time;
        summary.steps_accepted = counts.accepted;
        summary.steps_rejected = counts.rejected;
        summary.evaluations = counts.evaluations;
        summary.jacobians = counts.jacobians;
        summary.factorizations = counts.factorizations;
        summary.conservation = self.ledger.residuals();
        summary.has_angular_momentum = self.ledger.has_angular_momentum();
        summary.integrator = self.options.integrator.name();
        summary.attitude_drift = self.attitude_norm.largest_drift;
        summary.verdict.end(&mode.hinges, &state.beta);
    }
}
