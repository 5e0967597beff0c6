//! What arrives in one instant.

use nboom_dynamics::Recursive;
use nboom_elements::Kind;
use nboom_model::{Release, SAME_ANGLE, Scene, Stop};
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::events::bound::Bound;
use crate::events::guard::{GuardKind, Guards, read};
use crate::events::instant::duration;

/// What has changed sign in an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arrivals {
    locks: Vec<usize>,
    impacts: Vec<Impact>,
    triggered: Vec<usize>,
    /// Bounds of force laws.
    bounds: Vec<Bound>,
    /// Hinges with friction that come to rest.
    halts: Vec<usize>,
    /// What is scheduled until this long after belongs to the instant, too.
    duration: f64,
    /// The guards on their way to zero, of which those that are not in the instant are left out.
    coming: Vec<Coming>,
}

/// A hinge that comes to a stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Impact {
    pub hinge: usize,
    pub stop: Stop,
    /// The share of its rate at which it rebounds.
    pub restitution: f64,
    /// Whether an impulse of either sign keeps it at its stop, since its flight was rounding.
    pub stays: bool,
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
        self.find_within_an_instant(scene, guards, dynamics, state, |kind| match kind {
            GuardKind::Trigger { hinge, .. } => holds(hinge),
            GuardKind::Lock { .. } | GuardKind::Stop { .. } | GuardKind::Bound(_) => false,
        });
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
        let Self { locks, impacts, triggered, bounds, halts, coming, .. } = self;
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
        halts.clear();
        impacts.clear();
        for of in &*coming {
            match guards.list[of.number].kind {
                GuardKind::Lock { hinge, .. } => locks.push(hinge),
                GuardKind::Stop { hinge, stop } => {
                    let restitution = scene.bodies[hinge].hinge.stops.restitution;
                    impacts.push(Impact { hinge, stop, restitution, stays: false });
                }
                GuardKind::Trigger { hinge, .. } => triggered.push(hinge),
                GuardKind::Bound(Bound { element, .. }) if element.kind == Kind::Friction => {
                    halts.push(element.hinge);
                }
                GuardKind::Bound(bound) => bounds.push(bound),
            }
        }
        impacts.retain(|impact| !locks.contains(&impact.hinge));
    }

    /// Whether nothing has arrived that an instant acts on; halts are left to stick and slip.
    pub fn is_empty(&self) -> bool {
        let Self { locks, impacts, triggered, bounds, .. } = self;
        locks.is_empty() && impacts.is_empty() && triggered.is_empty() && bounds.is_empty()
    }

    /// How long the instant lasts.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The hinges with friction that come to rest. Whether they stay so is found when all else has happened.
    pub fn halts(&self) -> &[usize] {
        &self.halts
    }

    /// The bounds of force laws that are passed.
    pub fn bounds(&self) -> &[Bound] {
        &self.bounds
    }

    /// The hinges that come to stops, without those that lock there.
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// The same, to set their restitutions.
    pub fn impacts_mut(&mut self) -> &mut [Impact] {
        &mut self.impacts
    }

    /// Whether impulses act.
    pub fn has_impulses(&self) -> bool {
        !(self.locks.is_empty() && self.impacts.is_empty())
    }

    /// Whether hinges rebound from stops, and nothing else happens.
    pub fn is_rebound(&self) -> bool {
        let Self { locks, impacts, triggered, bounds, .. } = self;
        let rebounds = impacts.iter().any(|impact| impact.restitution > 0.0);
        rebounds && locks.is_empty() && triggered.is_empty() && bounds.is_empty()
    }

    /// Whether the angle has arrived at which hinge `i` is released.
    pub fn has_triggered(&self, i: usize) -> bool {
        self.triggered.contains(&i)
    }

    /// The hinges that lock.
    pub fn locks(&self) -> &[usize] {
        &self.locks
    }
}
