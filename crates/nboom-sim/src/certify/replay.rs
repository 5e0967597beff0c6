//! A run in double-double that follows the events of a run on `f64`.

use nboom_dynamics::Recursive;
use nboom_model::{Mode, Scene};
use nboom_scalar::{DoubleDouble, Real};

use crate::certify::expansion::{Accuracy, Expansion};
use crate::equations::layout::VariableLayout;
use crate::equations::series::exact_graph;
use crate::equations::sizes::Sizes;
use crate::equations::state::State;
use crate::equations::variables::Variables;
use crate::error::SimError;
use crate::events::event::Event;
use crate::events::guard::{GuardKind, Reading, read};
use crate::events::instant;
use crate::events::situation::Situation;
use crate::run::record::Snapshot;
use crate::run::snapshot;

/// Corrections after which an event's time is as good as it gets.
const CORRECTIONS: usize = 20;

/// Share of a step by which the last correction may change an event's time.
const LOCATED: f64 = 1e-20;

/// A run of a scene in double-double.
///
/// The guide, the events of an `f64` run, tells what happens next. No guard is therefore searched
/// for its first root: the guard of the next event is followed to its root by Newton's method, and
/// no other may have changed sign at the end of any step. Equations, guards and instants are those
/// of every run.
pub(crate) struct Replay<'a> {
    scene: &'a Scene,
    guide: &'a [Event],
    accuracy: Accuracy,
    most_steps: usize,
    interrupted: &'a dyn Fn() -> bool,
    steps: usize,
    dynamics: Recursive<DoubleDouble>,
    pub situation: Situation<DoubleDouble>,
    scratch: State<DoubleDouble>,
    sizes: Sizes,
    /// What has happened so far.
    pub events: Vec<Event>,
}

/// How a mode goes on.
struct ModeMotion {
    variables: Variables<DoubleDouble>,
    expansion: Expansion,
    /// The variables at the present state.
    now: Vec<DoubleDouble>,
    /// The variables at another time.
    then: Vec<DoubleDouble>,
}

/// What ends a mode.
enum Ending {
    Guard(GuardKind),
    Schedule,
    /// Something that the guide has no event for.
    Astray,
}

impl<'a> Replay<'a> {
    /// A replay at the beginning of `scene`; `guide` has its events without the end.
    pub fn new(
        scene: &'a Scene,
        guide: &'a [Event],
        accuracy: Accuracy,
        most_steps: usize,
        interrupted: &'a dyn Fn() -> bool,
    ) -> Self {
        let mut dynamics = Recursive::new(scene);
        let mut situation = Situation::new(scene);
        situation.begin(scene, &Mode::at_start(scene), &mut dynamics);
        Self {
            scene,
            guide,
            accuracy,
            most_steps,
            interrupted,
            steps: 0,
            dynamics,
            sizes: Sizes::of(scene),
            scratch: situation.state.clone(),
            situation,
            events: Vec::new(),
        }
    }

    /// Runs to the end; false when the guide has other events, and then only up to the first.
    ///
    /// # Errors
    /// When the motion cannot be followed or an event not be located.
    pub fn complete(&mut self) -> Result<bool, SimError> {
        let Self { scene, situation, dynamics, .. } = self;
        dynamics.set_mode(&situation.mode, &situation.state.beta);
        situation.watch(scene, dynamics);
        situation.arrive_at_start(scene, dynamics);
        loop {
            self.pass_instant()?;
            let kinds = |events: &[Event]| -> Vec<_> {
                events.iter().map(|event| (event.kind, event.hinge)).collect()
            };
            if !kinds(self.guide).starts_with(&kinds(&self.events)) {
                return Ok(false);
            }
            if self.situation.is_at_end(self.scene) {
                return Ok(self.events.len() == self.guide.len());
            }
            let course = self.enter();
            let located = match self.follow(course)? {
                Ending::Guard(kind) => Some(kind),
                Ending::Schedule => None,
                Ending::Astray => return Ok(false),
            };
            self.situation.arrive(self.scene, &self.dynamics, located);
        }
    }

    /// What a recorder sees of the present state.
    pub fn snapshot(&mut self) -> Snapshot {
        let Situation { mode, state, .. } = &mut self.situation;
        let found = state.invariants(&mut self.dynamics);
        let mut seen = Snapshot::empty();
        snapshot::write(self.scene, mode, state, &found, &mut seen);
        seen
    }

    /// Changes the mode as the instant demands.
    fn pass_instant(&mut self) -> Result<(), SimError> {
        let Self { scene, situation, dynamics, .. } = self;
        situation.pass(scene, dynamics)?;
        let Situation { state, mode, .. } = &mut *situation;
        dynamics.set_mode(mode, &state.beta);
        state.spin_up(scene, mode, None);
        dynamics.spin_from(state.time, state.rotors.iter().copied());
        situation.forget_invariants();
        self.events.extend(&situation.outcome.events);
        Ok(())
    }

    /// Takes up the mode at the present state.
    fn enter(&mut self) -> ModeMotion {
        self.situation.watch(self.scene, &self.dynamics);
        let Self { scene, dynamics, situation: Situation { state, mode, .. }, .. } = self;
        let layout = VariableLayout::of_velocities(scene, dynamics, state);
        let graph = exact_graph(scene, mode, layout);
        let mut fixed = state.beta.clone();
        fixed.extend(state.carried().velocity.to_array());
        fixed.push(state.time);
        fixed.extend(state.rotors.iter().map(|rotor| rotor.speed));
        self.sizes.enter(dynamics.free_hinges());
        self.sizes.saw_omega(&state.omega_body.to_array().map(|rate| rate.to_f64()));
        let free = dynamics.free_hinges().iter();
        self.sizes.saw_tau(&free.map(|&i| state.tau[i].to_f64()).collect::<Vec<_>>());
        let mut sizes = vec![1.0; layout.len()];
        self.sizes.write(&layout, &mut sizes);
        sizes.truncate(layout.controlled());
        let expansion = Expansion::new(&graph, &fixed, sizes, self.accuracy);
        let mut variables = Variables::new(scene, mode, layout, state);
        let mut now = Vec::new();
        variables.write(dynamics, &mut now);
        ModeMotion { variables, expansion, then: now.clone(), now }
    }

    /// Goes on until the guide's next event, something scheduled, or the end.
    fn follow(&mut self, mut course: ModeMotion) -> Result<Ending, SimError> {
        let limit = self.situation.limit(self.scene);
        let (expected, awaited) = self.awaited();
        loop {
            let since_start = self.situation.state.time - course.variables.origin.time;
            let reach = course.expansion.expand(since_start, &course.now);
            self.check_step(reach)?;
            let remaining = limit - self.situation.state.time;
            let guess = expected - self.situation.state.time.to_f64();
            let is_near = guess <= reach;
            let first =
                if is_near { self.first(&awaited, guess, reach, &mut course)? } else { None };
            let within = |(since, _): &(DoubleDouble, GuardKind)| {
                since.to_f64() <= reach && *since <= remaining
            };
            let (since, ending) = match first.filter(within) {
                Some((since, kind)) => (since, Some(Ending::Guard(kind))),
                None if remaining.to_f64() <= reach => (remaining, Some(Ending::Schedule)),
                None => (exact(reach), None),
            };
            let is_past = first.is_some_and(|(_, kind)| -since.to_f64() > self.instant_of(kind));
            if is_past || !self.go_on(since, first.map(|(_, kind)| kind), &mut course) {
                return Ok(Ending::Astray);
            }
            if let Some(ending) = ending {
                return Ok(ending);
            }
            self.situation.guards.note_sides(&self.dynamics, &self.situation.state);
        }
    }

    /// The guards of the guide's next instant, and when that is; now, if the guide has it at the time of what has just
    /// happened, as where a hinge is released on a bound on which it rests.
    fn awaited(&self) -> (f64, Vec<GuardKind>) {
        let next = &self.guide[self.events.len()..];
        let expected = next.first().map_or(f64::INFINITY, |event| event.time);
        let tells = |event: &&Event| event.time == expected;
        let events: Vec<&Event> = next.iter().take_while(tells).collect();
        let kinds = self.situation.guards.list.iter().map(|guard| guard.kind);
        let is_told = |kind: &GuardKind| {
            let tells =
                |event: &&Event| event.kind == kind.event() && event.hinge == Some(kind.hinge());
            events.iter().any(tells)
        };
        let last = self.events.len().checked_sub(1).map(|last| self.guide[last].time);
        let is_now = last == Some(expected);
        let when = if is_now { self.situation.state.time.to_f64() } else { expected };
        (when, kinds.filter(is_told).collect())
    }

    /// The first of the `awaited` guards to reach zero, and how long after the present time.
    fn first(
        &mut self,
        awaited: &[GuardKind],
        guess: f64,
        reach: f64,
        course: &mut ModeMotion,
    ) -> Result<Option<(DoubleDouble, GuardKind)>, SimError> {
        let mut first: Option<(DoubleDouble, GuardKind)> = None;
        for &kind in awaited {
            let since = self.locate(kind, guess, reach, course)?;
            if first.is_none_or(|(earliest, _)| since < earliest) {
                first = Some((since, kind));
            }
        }
        Ok(first)
    }

    /// How long an instant would last that a guard makes as fast as it is now.
    fn instant_of(&mut self, kind: GuardKind) -> f64 {
        let reading = read(kind, &self.dynamics, &self.situation.state);
        let pace = kind.pace(self.scene, self.dynamics.elements(), reading);
        instant::duration(self.scene, self.situation.state.time.to_f64(), pace)
    }

    /// When a guard is zero, as time since the present, by Newton's method.
    fn locate(
        &mut self,
        kind: GuardKind,
        guess: f64,
        reach: f64,
        course: &mut ModeMotion,
    ) -> Result<DoubleDouble, SimError> {
        let (mut since, mut last) = (exact(guess), f64::INFINITY);
        for _ in 0..CORRECTIONS {
            self.look(since, course);
            let Reading { value, rate } = read(kind, &self.dynamics, &self.scratch);
            // At rest on a bound no rate tells when it was reached.
            if value == exact(0.0) {
                return Ok(since);
            }
            let correction = value / rate;
            let size = correction.to_f64().abs();
            let better = size < 0.5 * last;
            if !better {
                break;
            }
            since -= correction;
            last = size;
        }
        if last <= LOCATED * reach.min(self.scene.end_time - self.scene.initial.time) {
            return Ok(since);
        }
        let hinge = self.scene.label(kind.hinge());
        Err(SimError::NotLocated { time: self.scratch.time.to_f64(), hinge })
    }

    /// Sets `scratch` to the state `since` after the present one.
    fn look(&mut self, since: DoubleDouble, course: &mut ModeMotion) {
        course.expansion.evaluate(since, &mut course.then);
        let time = self.situation.state.time + since;
        course.variables.read(&mut self.dynamics, time, &course.then, &mut self.scratch);
    }

    /// Goes on to `since` after the present state; false when a guard other than `awaited` has
    /// changed sign on the way.
    fn go_on(
        &mut self,
        since: DoubleDouble,
        awaited: Option<GuardKind>,
        course: &mut ModeMotion,
    ) -> bool {
        self.look(since, course);
        std::mem::swap(&mut self.situation.state, &mut self.scratch);
        self.situation.forget_invariants();
        std::mem::swap(&mut course.now, &mut course.then);
        !self.situation.guards.missed(self.scene, &self.dynamics, &self.situation.state, awaited)
    }

    /// Refuses a step that leads nowhere.
    fn check_step(&mut self, reach: f64) -> Result<(), SimError> {
        let time = self.situation.state.time.to_f64();
        if (self.interrupted)() {
            return Err(SimError::Interrupted { time });
        }
        if reach.is_nan() {
            return Err(SimError::NotFinite { time, hinge: None });
        }
        if self.situation.state.time + exact(reach) == self.situation.state.time {
            return Err(SimError::StepUnderflow { time, step: reach, hinge: None });
        }
        self.steps += 1;
        if self.steps > self.most_steps {
            return Err(SimError::StepsUsedUp { time, steps: self.most_steps, by: "max_steps" });
        }
        Ok(())
    }
}

fn exact(value: f64) -> DoubleDouble {
    DoubleDouble::constant(value)
}

#[cfg(test)]
mod tests;
