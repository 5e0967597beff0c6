use nboom_model::{HingeState, Scene};

use crate::events::event::{Event, EventKind};

/// What became of the hinges of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Every hinge of the scene.
    pub hinges: Vec<HingeVerdict>,
    /// The lock-up with the largest impulse, if there was one.
    pub largest_impulse: Option<LockUpImpulse>,
}

/// What became of a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeVerdict {
    /// Its state when the run ended.
    pub state: HingeState,
    /// When it was released or locked for the last time; `None` if it is as it was at the start.
    pub since: Option<f64>,
    /// β when the run ended \[rad\].
    pub angle: f64,
    /// By how much it has missed its lock angle so far; `None` unless it is free, has a lock angle, and became free
    /// elsewhere.
    pub miss: Option<Miss>,
}

/// Where a free hinge was nearest to its lock angle, which it has not reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Its distance from the lock angle \[rad\]; of a slide that of the travel.
    pub by: f64,
    /// When.
    pub time: f64,
}

/// The impulse of a lock-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LockUpImpulse {
    /// The hinge that locked.
    pub hinge: usize,
    /// When.
    pub time: f64,
    /// Impulsive torque on the outboard side, positive along the hinge axis.
    pub impulse: f64,
}

impl Verdict {
    /// Begins anew, before anything has happened to as many hinges.
    pub(crate) fn begin(&mut self, hinges: &[HingeState], beta: &[f64]) {
        let hinge = |(&state, &angle): (&HingeState, &f64)| HingeVerdict {
            state,
            since: None,
            angle,
            miss: None,
        };
        self.hinges.clear();
        self.hinges.extend(hinges.iter().zip(beta).map(hinge));
        self.largest_impulse = None;
    }

    /// Notes an event of `scene`.
    pub(crate) fn note(&mut self, scene: &Scene, event: &Event) {
        let Some(hinge) = event.hinge else { return };
        if matches!(event.kind, EventKind::LockUp | EventKind::Release) {
            (self.hinges[hinge].since, self.hinges[hinge].miss) = (Some(event.time), None);
        }
        let Some(impulse) = event.impulse else { return };
        // A stroke makes what it is beside a torque of a force.
        let size = |hinge: usize, impulse: f64| (impulse * scene.coordinate_scale(hinge)).abs();
        let is_larger = |of: LockUpImpulse| size(hinge, impulse) > size(of.hinge, of.impulse);
        if self.largest_impulse.is_none_or(is_larger) {
            self.largest_impulse = Some(LockUpImpulse { hinge, time: event.time, impulse });
        }
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
