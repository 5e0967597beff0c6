use nboom_dynamics::{Invariants, LockUp, Recursive, VelocityJump};
use nboom_elements::Kind;
use nboom_model::{External, HingeState, Mode, Release, Rotor, SAME_ANGLE, Scene};
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::bound::Bound;
use crate::events::event::{Event, EventKind, Jump};
use crate::events::guard::{GuardKind, Guards, read};
use crate::events::pieces::set_pieces_at_time;
use crate::events::schedule::Schedule;

/// Angle \[rad\] through which the fastest arriving hinge turns in one instant; where it slides,
/// its travel as a share of its stroke; for a line, its change of length as a share of the length
/// at which it arrives.
const ONE_INSTANT: f64 = 1e-11;

/// Spacings of `f64` that an instant lasts at least.
const SPACINGS: f64 = 4.0;

/// Share of the span that an instant lasts at most, however slowly something arrives.
const LONGEST: f64 = 1e-6;

/// How long after the first arrival at `time` an instant lasts, when the fastest to arrive goes at
/// `pace`, radians, strokes or lengths at a bound per time unit; zero where nothing moves.
pub(crate) fn duration(scene: &Scene, time: f64, pace: f64) -> f64 {
    let spacings = SPACINGS * (time.abs().next_up() - time.abs());
    if pace == 0.0 {
        return spacings;
    }
    let longest = LONGEST * (scene.end_time - scene.initial.time);
    (ONE_INSTANT / pace).min(longest).max(spacings)
}

/// What has changed sign in an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arrivals {
    locks: Vec<usize>,
    triggered: Vec<usize>,
    /// Bounds of force laws.
    bounds: Vec<Bound>,
    /// Hinges with friction that come to rest.
    stops: Vec<usize>,
    /// What is scheduled until this long after belongs to the instant, too.
    duration: f64,
    /// The guards on their way to zero, of which those that are not in the instant are left out.
    coming: Vec<Coming>,
}

/// A guard on its way to zero.
#[derive(Clone, Copy, Debug)]
struct Coming {
    /// How long before or after.
    away: f64,
    pace: f64,
    /// Which one of the guards.
    number: usize,
}

impl Arrivals {
    /// Notes the guards at zero: the one that ended the step, and those that reach zero within the
    /// same instant.
    pub fn find<R: Number>(
        &mut self,
        scene: &Scene,
        guards: &Guards,
        dynamics: &Recursive<R>,
        state: &State<R>,
        located: Option<GuardKind>,
    ) {
        self.find_within_an_instant(scene, guards, dynamics, state, |kind| located == Some(kind));
    }

    /// Notes what the initial time itself brings: releases by an angle that holds already, and what
    /// reaches zero within the same instant.
    pub fn at_start<R: Number>(
        &mut self,
        scene: &Scene,
        guards: &Guards,
        dynamics: &Recursive<R>,
        state: &State<R>,
    ) {
        let holds = |i: usize| match scene.bodies[i].hinge.release {
            Release::Angle { hinge, angle } => {
                let from_start = scene.bodies[hinge].hinge.start.angle - angle;
                from_start.abs() <= SAME_ANGLE * scene.coordinate_scale(hinge)
            }
            _ => false,
        };
        self.find_within_an_instant(
            scene,
            guards,
            dynamics,
            state,
            |kind| matches!(kind, GuardKind::Trigger { hinge, .. } if holds(hinge)),
        );
        // Held hinges have no guards.
        for i in (0..scene.bodies.len()).filter(|&i| holds(i)) {
            if !self.triggered.contains(&i) {
                self.triggered.push(i);
            }
        }
    }

    /// Notes the guards that are `here`, and those that arrive in the same instant.
    fn find_within_an_instant<R: Number>(
        &mut self,
        scene: &Scene,
        guards: &Guards,
        dynamics: &Recursive<R>,
        state: &State<R>,
        here: impl Fn(GuardKind) -> bool,
    ) {
        let Self { locks, triggered, bounds, stops, coming, .. } = self;
        coming.clear();
        for (number, guard) in guards.list.iter().enumerate() {
            let reading = read(guard.kind, dynamics, state);
            let away = if here(guard.kind) { Some(0.0) } else { guard.time_away(reading) };
            let pace = guard.kind.pace(scene, dynamics.elements(), reading);
            coming.extend(away.map(|away| Coming { away, pace, number }));
        }
        let time = state.time.to_f64();
        coming.sort_unstable_by(|a, b| a.away.total_cmp(&b.away).then(a.number.cmp(&b.number)));
        let (mut arrived, mut fastest) = (0, 0.0_f64);
        for &Coming { away, pace, .. } in &*coming {
            let faster = fastest.max(pace);
            if away > duration(scene, time, faster) {
                break;
            }
            fastest = faster;
            arrived += 1;
        }
        self.duration = duration(scene, time, fastest);
        coming.truncate(arrived);
        coming.sort_unstable_by_key(|of| of.number);
        locks.clear();
        triggered.clear();
        bounds.clear();
        stops.clear();
        for of in &*coming {
            match guards.list[of.number].kind {
                GuardKind::Lock { hinge, .. } => locks.push(hinge),
                GuardKind::Trigger { hinge, .. } => triggered.push(hinge),
                GuardKind::Bound(Bound { element, .. }) if element.kind == Kind::Friction => {
                    stops.push(element.hinge);
                }
                GuardKind::Bound(bound) => bounds.push(bound),
            }
        }
    }

    /// Whether nothing has arrived.
    pub fn is_empty(&self) -> bool {
        self.locks.is_empty() && self.triggered.is_empty() && self.bounds.is_empty()
    }

    /// How long the instant lasts.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The hinges with friction that come to rest. Whether they stay so is found when all else has happened.
    pub fn stops(&self) -> &[usize] {
        &self.stops
    }

    /// The hinges that lock.
    pub fn locks(&self) -> &[usize] {
        &self.locks
    }
}

/// The result of an instant: events in the order in which they are reported, and the elements that
/// have just passed a bound of their law, with the bound.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<R> {
    pub events: Vec<Event>,
    pub crossed: Vec<(usize, usize)>,
    /// The hinges at rest that start to move without an acceleration, as friction lets them go.
    pub gradual: Vec<usize>,
    /// The hinges that become free.
    pub released: Vec<usize>,
    /// The hinges that were free before.
    free: Vec<usize>,
    /// The positions among these of the hinges that lock.
    locking: Vec<usize>,
    /// Energy and momenta just before a lock-up.
    pub before_lock_up: Option<Invariants<R>>,
    lock_up: LockUp<R>,
}

impl<R: Number> Outcome<R> {
    /// That of an instant in which nothing happens.
    pub fn nothing() -> Self {
        Self {
            events: Vec::new(),
            crossed: Vec::new(),
            gradual: Vec::new(),
            released: Vec::new(),
            free: Vec::new(),
            locking: Vec::new(),
            before_lock_up: None,
            lock_up: LockUp::of_none(),
        }
    }

    /// Makes it that of an instant in which nothing happens.
    pub fn reset(&mut self) {
        self.events.clear();
        self.crossed.clear();
        self.gradual.clear();
        for hinges in [&mut self.released, &mut self.free, &mut self.locking] {
            hinges.clear();
        }
        self.before_lock_up = None;
        self.lock_up.reset(0, 0);
    }

    /// What each hinge that locks changes, for the hinges that were [free](Self::free_before).
    pub fn velocity_jumps(&self) -> impl Iterator<Item = VelocityJump<'_, R>> {
        self.lock_up.jumps()
    }

    /// The hinges that were free before a lock-up.
    pub fn free_before(&self) -> &[usize] {
        &self.free
    }

    /// What each hinge that locks changes, for all hinges.
    pub fn jumps(&self, hinges: usize) -> impl Iterator<Item = Jump> {
        self.locking.iter().zip(self.lock_up.jumps()).map(move |(&position, jump)| {
            let mut tau = vec![0.0; hinges];
            for (&i, change) in self.free.iter().zip(jump.tau) {
                tau[i] = change.to_f64();
            }
            let (velocity_body, omega_body) =
                (jump.velocity_body.to_f64(), jump.omega_body.to_f64());
            Jump { hinge: self.free[position], velocity_body, omega_body, tau }
        })
    }

    /// Takes `state`, whose invariants may be `known`, and `mode` through an instant: lock-ups jointly, then
    /// releases, then force laws and what acts from outside. `dynamics` is in the mode before and is left there.
    /// Returns the invariants after it, if they had to be found or nothing changes them.
    pub fn pass(
        &mut self,
        scene: &Scene,
        dynamics: &mut Recursive<R>,
        (arrivals, schedule): (&Arrivals, &Schedule<R>),
        (state, known): (&mut State<R>, Option<Invariants<R>>),
        mode: &mut Mode,
    ) -> Result<Option<Invariants<R>>, SimError> {
        self.reset();
        let time = state.time.to_f64();
        let due = |i: &usize| {
            mode.hinges[*i] == HingeState::Unreleased
                && (schedule.releases_by(time + arrivals.duration, *i)
                    || is_triggered(scene, arrivals, *i))
        };
        self.released.extend((0..scene.bodies.len()).filter(due));
        let end = time + arrivals.duration;
        if arrivals.is_empty() && self.released.is_empty() && goes_on(scene, mode, end) {
            return Ok(known);
        }
        let found_before = known.unwrap_or_else(|| state.invariants(dynamics));
        let before = Totals::of(state, &found_before);
        self.lock(scene, dynamics, &arrivals.locks, state, mode)?;
        self.before_lock_up = (!self.locking.is_empty()).then_some(found_before);
        let found = if self.locking.is_empty() { found_before } else { state.invariants(dynamics) };
        let after = Totals::of(state, &found);
        let Self { events, crossed, released, free, locking, lock_up, .. } = self;
        let event = |kind, hinge, impulse: Option<R>, before: Totals| {
            let impulse = impulse.map(Number::to_f64);
            Event { time, kind, hinge, impulse, before, after }
        };
        for (&position, &impulse) in locking.iter().zip(&lock_up.impulses) {
            events.push(event(EventKind::LockUp, Some(free[position]), Some(impulse), before));
        }
        for &i in &*released {
            mode.hinges[i] = HingeState::Free;
            events.push(event(EventKind::Release, Some(i), None, after));
        }
        for &bound in &arrivals.bounds {
            let index = bound.element.index;
            mode.pieces[index] = bound.next_piece();
            crossed.push((index, bound.number));
            let kind = GuardKind::Bound(bound);
            events.push(event(kind.event(), Some(kind.hinge()), None, after));
        }
        for (one, &piece) in scene.externals.iter().zip(&mode.externals) {
            let before = one.course.acts(piece);
            if one.course.acts(one.course.piece_at(end)) != before {
                let kind = if before { EventKind::ThrustOff } else { EventKind::ThrustOn };
                events.push(event(kind, one.body, None, after));
            }
        }
        set_pieces_at_time(mode, scene, end);
        Ok(Some(found))
    }

    /// Locks hinges with the exact change of all velocities.
    fn lock(
        &mut self,
        scene: &Scene,
        dynamics: &mut Recursive<R>,
        locks: &[usize],
        state: &mut State<R>,
        mode: &mut Mode,
    ) -> Result<(), SimError> {
        let Self { free, locking, lock_up, .. } = self;
        let Some(&first) = locks.first() else { return Ok(()) };
        free.extend(dynamics.free_hinges());
        locking.extend(locks.iter().filter_map(|i| free.iter().position(|j| j == i)));
        for &i in locks {
            if let Some(angle) = scene.bodies[i].hinge.lock_angle {
                state.beta[i] = R::constant(angle);
            }
        }
        let (time, hinge) = (state.time.to_f64(), Some(scene.label(first)));
        let before = state.held.map(|_| state.invariants(dynamics));
        let motion = state.motion(dynamics);
        let locked = dynamics.lock_up(motion.beta, motion.tau, locking, lock_up);
        locked.map_err(|_| SimError::LockUp { time, hinge })?;
        state.omega_body += lock_up.delta_omega_body;
        for (&i, &change) in free.iter().zip(&lock_up.delta_tau) {
            state.tau[i] += change;
        }
        state.work.lock_ups -= lock_up.delta_energy;
        for &i in locks {
            state.tau[i] = R::zero();
            mode.hinges[i] = HingeState::Locked;
        }
        state.follow_hinges(dynamics);
        if let Some(before) = before {
            // What moves the main body holds out against the impulse.
            let after = state.invariants(dynamics);
            let force = after.linear_momentum - before.linear_momentum;
            let moment =
                after.angular_momentum_about_origin() - before.angular_momentum_about_origin();
            state.work.thrust += force.dot(after.origin_velocity) + moment.dot(state.omega_body);
        }
        Ok(())
    }
}

/// Whether all that goes by a table over time is in the same piece at `time`.
fn goes_on(scene: &Scene, mode: &Mode, time: f64) -> bool {
    let acts_on = |(one, &piece): (&External, &usize)| one.course.piece_at(time) == piece;
    let turns_on = |(rotor, &piece): (&Rotor, &usize)| rotor.speed.piece_at(time) == piece;
    scene.externals.iter().zip(&mode.externals).all(acts_on)
        && scene.rotors.iter().zip(&mode.rotors).all(turns_on)
        && scene.base.piece_at(time) == mode.drive
}

/// Whether the angle has arrived that releases hinge `i`.
fn is_triggered(scene: &Scene, arrivals: &Arrivals, i: usize) -> bool {
    let locked_at = |hinge: usize, angle: f64| {
        let lock_angle = scene.bodies[hinge].hinge.lock_angle;
        let same = SAME_ANGLE * scene.coordinate_scale(hinge);
        arrivals.locks.contains(&hinge) && lock_angle.is_some_and(|at| (at - angle).abs() <= same)
    };
    match scene.bodies[i].hinge.release {
        Release::Angle { hinge, angle } => {
            arrivals.triggered.contains(&i) || locked_at(hinge, angle)
        }
        Release::Time(_) | Release::AfterLock { .. } | Release::Never => false,
    }
}
