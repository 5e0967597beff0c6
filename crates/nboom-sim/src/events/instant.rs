use nboom_dynamics::{Recursive, VelocityJump};
use nboom_elements::{thrust_acts, thrust_change};
use nboom_model::{HingeState, Mode, Release, SAME_ANGLE, Scene};
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::event::{Event, EventKind, Jump};
use crate::events::guard::{Bound, GuardKind, Guards, read};

/// Angle \[rad\] through which the fastest hinge that arrives turns in one instant; of a line, the
/// share of the length at which it arrives by which it changes.
const ONE_INSTANT: f64 = 1e-11;

/// Spacings of `f64` that an instant lasts at least.
const SPACINGS: f64 = 4.0;

/// Share of the span that an instant lasts at most, however slowly something arrives.
const LONGEST: f64 = 1e-6;

/// How long after the first arrival at `time` an instant lasts, when the fastest to arrive goes at
/// `pace`, radians or lengths at a bound per time unit; zero where nothing moves.
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
    /// What is scheduled until this long after belongs to the instant, too.
    duration: f64,
}

impl Arrivals {
    /// The guards at zero: the one that ended the step, and those that reach zero within the
    /// same instant.
    pub fn find<R: Number>(
        scene: &Scene,
        guards: &Guards,
        dynamics: &mut Recursive<R>,
        state: &State<R>,
        located: Option<GuardKind>,
    ) -> Self {
        Self::within_an_instant(scene, guards, dynamics, state, |kind| located == Some(kind))
    }

    /// What the initial time itself brings: releases by an angle that holds already, and what reaches
    /// zero within the same instant.
    pub fn at_start<R: Number>(
        scene: &Scene,
        guards: &Guards,
        dynamics: &mut Recursive<R>,
        state: &State<R>,
    ) -> Self {
        let holds = |i: usize| match scene.bodies[i].hinge.release {
            Release::Angle { hinge, angle } => {
                (scene.bodies[hinge].hinge.start.angle - angle).abs() <= SAME_ANGLE
            }
            _ => false,
        };
        let mut arrivals = Self::within_an_instant(
            scene,
            guards,
            dynamics,
            state,
            |kind| matches!(kind, GuardKind::Trigger { hinge, .. } if holds(hinge)),
        );
        // Held hinges have no guards.
        arrivals.triggered = (0..scene.bodies.len())
            .filter(|&i| holds(i) || arrivals.triggered.contains(&i))
            .collect();
        arrivals
    }

    /// The guards that are `here`, and those that arrive in the same instant.
    fn within_an_instant<R: Number>(
        scene: &Scene,
        guards: &Guards,
        dynamics: &mut Recursive<R>,
        state: &State<R>,
        here: impl Fn(GuardKind) -> bool,
    ) -> Self {
        let time = state.time.to_f64();
        let mut coming: Vec<(f64, f64, GuardKind)> = Vec::new();
        for guard in &guards.list {
            let reading = read(guard.kind, dynamics, state);
            let away = if here(guard.kind) { Some(0.0) } else { guard.time_away(reading) };
            let pace = guard.kind.pace(dynamics.elements(), reading);
            coming.extend(away.map(|away| (away, pace, guard.kind)));
        }
        coming.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut arrived, mut fastest) = (Vec::new(), 0.0_f64);
        for (away, pace, kind) in coming {
            let faster = fastest.max(pace);
            if away > duration(scene, time, faster) {
                break;
            }
            fastest = faster;
            arrived.push(kind);
        }
        let mut arrivals = Self { duration: duration(scene, time, fastest), ..Self::default() };
        for kind in guards.list.iter().map(|guard| guard.kind).filter(|kind| arrived.contains(kind))
        {
            match kind {
                GuardKind::Lock { hinge, .. } => arrivals.locks.push(hinge),
                GuardKind::Trigger { hinge, .. } => arrivals.triggered.push(hinge),
                GuardKind::Bound(bound) => arrivals.bounds.push(bound),
            }
        }
        arrivals
    }

    /// Whether a hinge locks.
    pub fn lock(&self) -> bool {
        !self.locks.is_empty()
    }
}

/// The result of an instant: events in the order in which they are reported, and the elements that
/// have just passed a bound of their law, with the bound.
pub(crate) struct Outcome {
    pub events: Vec<Event>,
    pub crossed: Vec<(usize, usize)>,
    /// What each hinge that locks changes.
    pub jumps: Vec<Jump>,
    /// The hinges that become free.
    pub released: Vec<usize>,
}

/// Takes `state` and `mode` through an instant: lock-ups jointly, then releases, then force laws
/// and thrust. `dynamics` is in the mode before and is left there.
pub(crate) fn pass<R: Number>(
    scene: &Scene,
    dynamics: &mut Recursive<R>,
    arrivals: &Arrivals,
    state: &mut State<R>,
    mode: &mut Mode,
) -> Result<Outcome, SimError> {
    let before = Totals::of(state, &state.invariants(dynamics));
    let mut events = Vec::new();
    let locked = lock(scene, dynamics, &arrivals.locks, state, mode)?;
    let after = Totals::of(state, &state.invariants(dynamics));
    let time = state.time.to_f64();
    let event =
        |kind, hinge, impulse, before: Totals| Event { time, kind, hinge, impulse, before, after };
    for (jump, impulse) in &locked {
        events.push(event(EventKind::LockUp, Some(jump.hinge), Some(*impulse), before));
    }
    let released = released(scene, mode, arrivals, time);
    for &i in &released {
        mode.hinges[i] = HingeState::Free;
        events.push(event(EventKind::Release, Some(i), None, after));
    }
    let mut crossed = Vec::new();
    for &bound in &arrivals.bounds {
        let index = bound.element.index;
        mode.pieces[index] = bound.next_piece();
        crossed.push((index, bound.number));
        let kind = GuardKind::Bound(bound);
        events.push(event(kind.event(), Some(kind.hinge()), None, after));
    }
    if let Some(thrust) = thrust_switch(scene, mode, time + arrivals.duration) {
        mode.thrust = thrust;
        let kind = if thrust { EventKind::ThrustOn } else { EventKind::ThrustOff };
        events.push(event(kind, None, None, after));
    }
    let jumps = locked.into_iter().map(|(jump, _)| jump).collect();
    Ok(Outcome { events, crossed, jumps, released })
}

/// Locks hinges with the exact change of all velocities; returns what each hinge contributes, and
/// its impulse.
fn lock<R: Number>(
    scene: &Scene,
    dynamics: &mut Recursive<R>,
    locks: &[usize],
    state: &mut State<R>,
    mode: &mut Mode,
) -> Result<Vec<(Jump, f64)>, SimError> {
    let Some(&first) = locks.first() else { return Ok(Vec::new()) };
    let free = dynamics.free_hinges().to_vec();
    for &i in locks {
        if let Some(angle) = scene.bodies[i].hinge.lock_angle {
            state.beta[i] = R::constant(angle);
        }
    }
    let [beta, tau] = state.of_free(dynamics);
    let position = |i: &usize| free.iter().position(|j| j == i);
    let positions: Vec<usize> = locks.iter().filter_map(position).collect();
    let (time, hinge) = (state.time.to_f64(), Some(scene.label(first)));
    let lock_up =
        dynamics.lock_up(&beta, &tau, &positions).map_err(|_| SimError::LockUp { time, hinge })?;
    state.omega_body += lock_up.delta_omega_body;
    for (&i, &change) in free.iter().zip(&lock_up.delta_tau) {
        state.tau[i] += change;
    }
    state.work.lock_ups -= lock_up.delta_energy;
    for &i in locks {
        state.tau[i] = R::zero();
        mode.hinges[i] = HingeState::Locked;
    }
    let jump = |(&hinge, jump): (&usize, &VelocityJump<R>)| {
        let mut tau = vec![0.0; state.tau.len()];
        for (&i, change) in free.iter().zip(&jump.tau) {
            tau[i] = change.to_f64();
        }
        let (velocity_body, omega_body) = (jump.velocity_body.to_f64(), jump.omega_body.to_f64());
        Jump { hinge, velocity_body, omega_body, tau }
    };
    let jumps = locks.iter().zip(&lock_up.jumps).map(jump);
    let impulses = lock_up.impulses.iter().map(|impulse| impulse.to_f64());
    Ok(jumps.zip(impulses).collect())
}

/// The unreleased hinges whose release is due.
fn released(scene: &Scene, mode: &Mode, arrivals: &Arrivals, time: f64) -> Vec<usize> {
    let locked_at = |hinge: usize, angle: f64| {
        let lock_angle = scene.bodies[hinge].hinge.lock_angle;
        arrivals.locks.contains(&hinge)
            && lock_angle.is_some_and(|at| (at - angle).abs() <= SAME_ANGLE)
    };
    let due = |i: &usize| {
        mode.hinges[*i] == HingeState::Unreleased
            && match scene.bodies[*i].hinge.release {
                Release::Time(at) => at <= time + arrivals.duration,
                Release::Angle { hinge, angle } => {
                    arrivals.triggered.contains(i) || locked_at(hinge, angle)
                }
                Release::Never => false,
            }
    };
    (0..scene.bodies.len()).filter(due).collect()
}

/// Whether the thrust is on from the end of an instant on, if that is a change.
fn thrust_switch(scene: &Scene, mode: &Mode, end: f64) -> Option<bool> {
    let on = thrust_acts(&scene.thrust?, end);
    (on != mode.thrust).then_some(on)
}

/// The next time after `time` at which the scene itself changes the mode.
pub(crate) fn next_scheduled(scene: &Scene, mode: &Mode, time: f64) -> f64 {
    let release = |(i, state): (usize, &HingeState)| match scene.bodies[i].hinge.release {
        Release::Time(at) if *state == HingeState::Unreleased => at,
        _ => f64::INFINITY,
    };
    let releases = mode.hinges.iter().enumerate().map(release);
    let thrust = scene.thrust.map(|thrust| thrust_change(&thrust, mode.thrust));
    releases.chain(thrust).filter(|&at| at > time).fold(f64::INFINITY, f64::min)
}
