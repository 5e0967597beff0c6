use nboom_model::{Hinge, HingeState, Scene};

use crate::events::event::{Event, EventKind};

/// What became of the hinges of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Every hinge of the scene.
    pub hinges: Vec<HingeVerdict>,
    /// The lock-up or impact with the largest impulse, if there was one.
    pub largest_impulse: Option<HingeImpulse>,
}

/// What became of a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeVerdict {
    /// Its state when the run ended.
    pub state: HingeState,
    /// When it was released or locked, or began to stick or to slip, for the last time; `None` if it is as it was at
    /// the start.
    pub since: Option<f64>,
    /// β when the run ended \[rad\].
    pub angle: f64,
    /// By how much it has missed its lock angle so far; `None` unless it is free or stuck, has a lock angle, and became
    /// free elsewhere.
    pub miss: Option<Miss>,
    /// τ just before it locked; `None` unless it has \[rad/T\].
    pub closing_rate: Option<f64>,
    /// The largest magnitude of τ just before it came to a stop; `None` unless it has \[rad/T\].
    pub impact_rate: Option<f64>,
    /// How much farther it would have gone before it stopped, at its deceleration just before it locked; `None` unless
    /// it has, slowly and slowing down \[rad\].
    pub stopping_distance: Option<f64>,
    /// The largest magnitude of τ so far, at the ends of steps \[rad/T\].
    pub largest_rate: f64,
}

/// Where a free hinge was nearest to its lock angle, which it has not reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Its distance from the lock angle \[rad\]; of a slide that of the travel.
    pub by: f64,
    /// When.
    pub time: f64,
}

/// The impulse of a lock-up or an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeImpulse {
    /// The hinge that locked or hit its stop.
    pub hinge: usize,
    /// When.
    pub time: f64,
    /// Impulsive torque on the outboard side, positive along the hinge axis.
    pub impulse: f64,
}

/// Why errors of a run may decide whether a hinge locks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// It turns back just before its lock angle.
    Missed(Miss),
    /// It locks, but at this rate, at which it would soon have stopped or turned back \[rad/T\].
    HardlyLocks(f64),
}

/// Errors of a run that is not unstable are below so many times its tolerance.
const ERRORS: f64 = 1e3;

/// No run errs by more, of the size of a change of a hinge's angle, that is worth having.
const MOST: f64 = 1e-2;

/// The largest share of its fastest rate at which a hinge counts as one that is at rest.
const SLOW: f64 = 1e-3;

impl HingeVerdict {
    /// Of a hinge to which nothing has happened yet.
    pub fn new(state: HingeState, angle: f64) -> Self {
        Self {
            state,
            since: None,
            angle,
            miss: None,
            closing_rate: None,
            impact_rate: None,
            stopping_distance: None,
            largest_rate: 0.0,
        }
    }

    /// Why errors of a run at the tolerance `rtol` may decide whether the hinge locks, if they may; `scale` is the
    /// [size](Scene::coordinate_scale) of a change of its angle.
    pub fn doubt(&self, scale: f64, rtol: f64) -> Option<Doubt> {
        let share = ERRORS * rtol;
        let error = share.min(MOST) * scale;
        let is_at_rest = |rate: f64| {
            self.largest_rate > 0.0 && rate.abs() <= share.min(SLOW) * self.largest_rate
        };
        let soon_stops = self.stopping_distance.is_some_and(|distance| distance <= error);
        let hardly_locks = |rate: &f64| soon_stops || is_at_rest(*rate);
        let missed = self.miss.filter(|miss| miss.by <= error).map(Doubt::Missed);
        missed.or_else(|| self.closing_rate.filter(hardly_locks).map(Doubt::HardlyLocks))
    }
}

impl Verdict {
    /// The hinges of which errors of a run at the tolerance `rtol` may decide whether they lock, and why.
    pub fn doubts(&self, scene: &Scene, rtol: f64) -> impl Iterator<Item = (usize, Doubt)> {
        let hinges = self.hinges.iter().enumerate();
        hinges
            .filter_map(move |(i, hinge)| Some((i, hinge.doubt(scene.coordinate_scale(i), rtol)?)))
    }

    /// Begins anew, before anything has happened to as many hinges.
    pub(crate) fn begin(&mut self, hinges: &[HingeState], beta: &[f64]) {
        let hinges = hinges.iter().zip(beta);
        self.hinges.clear();
        self.hinges.extend(hinges.map(|(&state, &angle)| HingeVerdict::new(state, angle)));
        self.largest_impulse = None;
    }

    /// Notes an event of `scene`.
    pub(crate) fn note(&mut self, scene: &Scene, event: &Event) {
        let Some(hinge) = event.hinge else { return };
        if matches!(
            event.kind,
            EventKind::Stick | EventKind::Slip | EventKind::Rest | EventKind::Leave
        ) {
            self.hinges[hinge].since = Some(event.time);
        }
        if matches!(event.kind, EventKind::LockUp | EventKind::Release) {
            (self.hinges[hinge].since, self.hinges[hinge].miss) = (Some(event.time), None);
        }
        let Some(impulse) = event.impulse else { return };
        // A stroke makes what it is beside a torque of a force.
        let size = |hinge: usize, impulse: f64| (impulse * scene.coordinate_scale(hinge)).abs();
        let is_larger = |of: HingeImpulse| size(hinge, impulse) > size(of.hinge, of.impulse);
        if self.largest_impulse.is_none_or(is_larger) {
            self.largest_impulse = Some(HingeImpulse { hinge, time: event.time, impulse });
        }
    }

    /// Notes that friction or a stop brings a hinge to rest, where the hinges are at `beta`, maybe short of its lock angle.
    pub(crate) fn note_stick(&mut self, scene: &Scene, hinge: usize, beta: &[f64], time: f64) {
        let Hinge { lock_angle, start, .. } = scene.bodies[hinge].hinge;
        if let Some(lock) = lock_angle.filter(|lock| *lock != start.angle) {
            self.note_distance(hinge, Miss { by: (beta[hinge] - lock).abs(), time });
        }
    }

    /// Notes the rates of all hinges at the end of a step.
    pub(crate) fn note_rates(&mut self, tau: &[f64]) {
        for (hinge, tau) in self.hinges.iter_mut().zip(tau) {
            hinge.largest_rate = hinge.largest_rate.max(tau.abs());
        }
    }

    /// Notes that a hinge has locked, which came at the rate τ.
    pub(crate) fn note_closing(&mut self, hinge: usize, tau: f64) {
        (self.hinges[hinge].closing_rate, self.hinges[hinge].stopping_distance) = (Some(tau), None);
    }

    /// Notes that a hinge has come to a stop at the rate τ.
    pub(crate) fn note_impact(&mut self, hinge: usize, tau: f64) {
        let fastest = &mut self.hinges[hinge].impact_rate;
        *fastest = Some(fastest.unwrap_or(0.0).max(tau.abs()));
    }

    /// Notes the acceleration τ̇ of a hinge just before it locks, which came at the rate that was noted last.
    pub(crate) fn note_stopping(&mut self, hinge: usize, tau_dot: f64) {
        let HingeVerdict { closing_rate, stopping_distance, .. } = &mut self.hinges[hinge];
        // Within τ²/2|τ̇| the deceleration |τ̇| takes the rate τ away.
        *stopping_distance = closing_rate
            .filter(|tau| tau * tau_dot < 0.0)
            .map(|tau| 0.5 * tau * tau / tau_dot.abs());
    }

    /// Notes that a free hinge was at such a distance from its lock angle.
    pub(crate) fn note_distance(&mut self, hinge: usize, here: Miss) {
        let nearest = &mut self.hinges[hinge].miss;
        if nearest.is_none_or(|known| here.by < known.by) {
            *nearest = Some(here);
        }
    }

    /// Notes that the hinges are left in these states at these angles.
    pub(crate) fn end(&mut self, hinges: &[HingeState], beta: &[f64]) {
        for (hinge, (&state, &angle)) in self.hinges.iter_mut().zip(hinges.iter().zip(beta)) {
            (hinge.state, hinge.angle) = (state, angle);
        }
    }
}
