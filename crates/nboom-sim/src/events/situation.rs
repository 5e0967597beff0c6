use nboom_dynamics::{Invariants, Recursive};
use nboom_model::{Mode, Scene};
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::error::SimError;
use crate::events::arrivals::Arrivals;
use crate::events::guard::{GuardKind, Guards};
use crate::events::instant::Outcome;
use crate::events::pieces::{set_pieces_at_motion, set_pieces_at_time};
use crate::events::schedule::Schedule;
use crate::events::side::LockSide;

/// Where a motion has come to: its state and mode, and what may end the mode.
///
/// `scene` and `dynamics`, which its methods borrow, are always those of the motion; `dynamics` are
/// in the same mode.
pub(crate) struct Situation<R> {
    pub state: State<R>,
    /// Energy and momenta of the state, once they have been asked for.
    invariants: Option<Invariants<R>>,
    pub mode: Mode,
    pub guards: Guards,
    /// The side of its lock angle that each hinge was last known to be on; none of a hinge without
    /// a lock angle, or on it since it became free.
    lock_sides: Vec<Option<LockSide>>,
    schedule: Schedule<R>,
    /// What has arrived in the present instant.
    pub arrivals: Arrivals,
    /// What the last instant has changed.
    pub outcome: Outcome<R>,
}

impl<R: Number> Situation<R> {
    /// With room for motions of `scene`; [`begin`](Self::begin) puts it at their beginning.
    pub fn new(scene: &Scene) -> Self {
        Self {
            state: State::initial(scene),
            invariants: None,
            mode: Mode::at_start(scene),
            guards: Guards::new(),
            lock_sides: vec![None; scene.bodies.len()],
            schedule: Schedule::new(scene),
            arrivals: Arrivals::default(),
            outcome: Outcome::nothing(),
        }
    }

    /// Goes to the beginning of `scene`, before the first instant; nothing is watched yet.
    /// `dynamics` is in the mode `start`, in which the scene starts.
    pub fn begin(&mut self, scene: &Scene, start: &Mode, dynamics: &mut Recursive<R>) {
        self.forget_invariants();
        let Self { state, mode, guards, lock_sides, schedule, outcome, .. } = self;
        outcome.reset();
        guards.begin(scene);
        schedule.begin(scene);
        state.begin(scene);
        mode.hinges.clone_from(&start.hinges);
        mode.pieces.clone_from(&start.pieces);
        state.put_center(dynamics, state.center);
        set_pieces_at_motion(mode, dynamics, [&state.beta, &state.tau]);
        set_pieces_at_time(mode, scene, scene.initial.time);
        for (i, side) in lock_sides.iter_mut().enumerate() {
            *side = LockSide::of(scene, i, state.beta[i]);
        }
    }

    /// Watches all that may end the mode.
    pub fn watch(&mut self, scene: &Scene, dynamics: &Recursive<R>) {
        let Self { state, mode, guards, lock_sides, outcome, .. } = self;
        guards.set(scene, mode, dynamics, state, lock_sides, outcome);
    }

    /// Energy and momenta of the present state, main-body axes.
    pub fn invariants(&mut self, dynamics: &mut Recursive<R>) -> Invariants<R> {
        let Self { state, invariants, .. } = self;
        *invariants.get_or_insert_with(|| state.invariants(dynamics))
    }

    /// Notes that the state is another one.
    pub fn forget_invariants(&mut self) {
        self.invariants = None;
    }

    /// Brings those hinges to rest that have come to it.
    pub fn halt(&mut self) {
        for &hinge in self.arrivals.halts() {
            self.state.tau[hinge] = R::zero();
            self.invariants = None;
        }
    }

    /// Notes what the initial time itself brings.
    pub fn arrive_at_start(&mut self, scene: &Scene, dynamics: &Recursive<R>) {
        self.arrivals.at_start(scene, &self.guards, dynamics, &self.state);
    }

    /// Notes what arrives in the present instant, which `located` ended the step for.
    pub fn arrive(&mut self, scene: &Scene, dynamics: &Recursive<R>, located: Option<GuardKind>) {
        self.arrivals.find(scene, &self.guards, dynamics, &self.state, located);
    }

    /// Goes through the instant of what has arrived; `dynamics` stays in the mode before.
    ///
    /// # Errors
    /// When the impulses of lock-ups and impacts cannot be found.
    pub fn pass(&mut self, scene: &Scene, dynamics: &mut Recursive<R>) -> Result<(), SimError> {
        for (hinge, side) in self.lock_sides.iter_mut().enumerate() {
            *side = self.guards.lock_side(hinge).or(*side);
        }
        let Self { state, mode, schedule, arrivals, outcome, .. } = self;
        schedule.note_lock_ups(scene, arrivals.locks(), state.time);
        if outcome.release(scene, arrivals, schedule, mode, state.time.to_f64()) {
            let before = self.invariants(dynamics);
            let Self { state, mode, arrivals, outcome, .. } = self;
            let after = outcome.change(scene, dynamics, arrivals, state, mode, before)?;
            self.invariants = Some(after);
        }
        for &hinge in &self.outcome.released {
            self.lock_sides[hinge] = LockSide::of(scene, hinge, self.state.beta[hinge]);
        }
        Ok(())
    }

    /// Whether a control law is to be asked in the present instant.
    pub fn is_sampled(&self) -> bool {
        self.schedule.sample <= self.state.time.to_f64() + self.arrivals.duration()
    }

    /// Notes when a control law is asked next.
    pub fn sample_at(&mut self, time: f64) {
        self.schedule.sample = time;
    }

    /// The next time at which the scene itself changes the mode or a control law is asked, or its
    /// end.
    pub fn limit(&self, scene: &Scene) -> R {
        self.schedule.next(scene, &self.mode, self.state.time.to_f64())
    }

    /// Whether it is at the initial time.
    pub fn is_at_start(&self, scene: &Scene) -> bool {
        self.state.time.to_f64() <= scene.initial.time
    }

    /// Whether the end time is reached.
    pub fn is_at_end(&self, scene: &Scene) -> bool {
        self.state.time.to_f64() >= scene.end_time
    }
}
