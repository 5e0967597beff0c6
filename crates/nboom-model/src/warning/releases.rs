//! Releases that never come, and hinges that start where they are hardly meant to.

use std::f64::consts::TAU;

use super::ModelWarning;
use crate::hinge::SAME_ANGLE;
use crate::{Hinge, HingeStart, HingeState, Release, Scene};

/// Turns beyond which an angle in radians was probably meant in degrees.
const MANY_TURNS: f64 = 2.0;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let mut warnings = Vec::new();
    for i in 0..scene.bodies.len() {
        let same = SAME_ANGLE * scene.coordinate_scale(i);
        if starts_locked_elsewhere(&scene.bodies[i].hinge, same) {
            warnings.push(ModelWarning::LockedElsewhere(scene.label(i)));
        }
        warnings.extend(of_start(scene, i));
        let Some(trigger) = waits_for(scene, i) else { continue };
        let circle = circle_from(scene, i);
        let (hinge, of_trigger) = (scene.label(i), &scene.bodies[trigger].hinge);
        let release = scene.bodies[i].hinge.release;
        if circle.first() == Some(&i) && circle.iter().min() == Some(&i) {
            let labels = circle.iter().map(|&j| scene.label(j)).collect();
            warnings.push(ModelWarning::ReleaseCircle(labels));
        } else if !of_trigger.can_turn() {
            let trigger = scene.label(trigger);
            warnings.push(ModelWarning::TriggerNeverTurns { hinge, trigger });
        } else if matches!(release, Release::Angle { angle, .. } if locks_before(scene, trigger, angle))
        {
            let trigger = scene.label(trigger);
            warnings.push(ModelWarning::TriggerLocksBefore { hinge, trigger });
        } else if let Release::Angle { angle, .. } = release
            && stops_before(scene, trigger, angle)
        {
            let trigger = scene.label(trigger);
            warnings.push(ModelWarning::TriggerStopsBefore { hinge, trigger });
        } else if let Release::Angle { angle, .. } = release
            && let Some(lock) = of_trigger.lock_angle
            && is_other_way(&of_trigger.start, angle, lock)
        {
            let (trigger, start) = (scene.label(trigger), of_trigger.start.angle);
            warnings.push(ModelWarning::TriggerOtherWay { hinge, trigger, angle, start, lock });
        } else if matches!(release, Release::AfterLock { .. } if of_trigger.lock_angle.is_none()) {
            let trigger = scene.label(trigger);
            warnings.push(ModelWarning::TriggerNeverLocks { hinge, trigger });
        }
    }
    warnings
}

/// A start or a time of release that is hardly meant.
fn of_start(scene: &Scene, i: usize) -> Vec<ModelWarning> {
    let (hinge, end) = (&scene.bodies[i].hinge, scene.end_time);
    let HingeStart { angle: start, state, .. } = hinge.start;
    let mut found = Vec::new();
    if !scene.bodies[i].joint.slides() && start.abs() > MANY_TURNS * TAU {
        found.push(ModelWarning::ManyTurns { hinge: scene.label(i), start });
    }
    let same = SAME_ANGLE * scene.coordinate_scale(i);
    let apart = hinge.lock_angle.map(|lock| lock - start).filter(|apart| apart.abs() <= same);
    if let Some(apart) = apart.filter(|_| hinge.can_turn()) {
        let is_held = state == HingeState::Unreleased;
        found.push(ModelWarning::StartsAtLock { hinge: scene.label(i), is_held, apart });
    }
    if let (HingeState::Unreleased, Release::Time(release)) = (state, hinge.release)
        && release > end
        && release.is_finite()
    {
        found.push(ModelWarning::ReleasedAfterEnd { hinge: scene.label(i), release, end });
    }
    found
}

fn starts_locked_elsewhere(hinge: &Hinge, same: f64) -> bool {
    let HingeStart { angle, state, .. } = hinge.start;
    let elsewhere = |lock: f64| (lock - angle).abs() > same;
    state == HingeState::Locked && hinge.lock_angle.is_some_and(elsewhere)
}

/// Whether its lock angle is between where `hinge` starts and `angle`.
fn locks_before(scene: &Scene, trigger: usize, angle: f64) -> bool {
    let hinge = &scene.bodies[trigger].hinge;
    let same = SAME_ANGLE * scene.coordinate_scale(trigger);
    let between = |lock: f64| {
        (angle - lock).abs() > same && (angle - lock) * (lock - hinge.start.angle) > 0.0
    };
    hinge.lock_angle.is_some_and(between)
}

/// Whether the stops of hinge `trigger` keep it from `angle`.
fn stops_before(scene: &Scene, trigger: usize, angle: f64) -> bool {
    let same = SAME_ANGLE * scene.coordinate_scale(trigger);
    scene.bodies[trigger].hinge.stops.exclude(angle, same)
}

/// Whether a hinge that starts so has its lock angle on one side of it and `angle` on the other, and does
/// not move there at first.
fn is_other_way(start: &HingeStart, angle: f64, lock: f64) -> bool {
    let way = angle - start.angle;
    way * (lock - start.angle) < 0.0 && way * start.rate <= 0.0
}

/// The hinge that an unreleased hinge `i` waits for, unless that one starts at the angle or in the state
/// that is waited for.
fn waits_for(scene: &Scene, i: usize) -> Option<usize> {
    let hinge = &scene.bodies[i].hinge;
    let trigger =
        hinge.release.trigger().filter(|_| hinge.start.state == HingeState::Unreleased)?;
    let start = scene.bodies[trigger].hinge.start;
    let waits = match hinge.release {
        Release::Angle { angle, .. } => start.angle != angle,
        Release::AfterLock { .. } => start.state != HingeState::Locked,
        Release::Time(_) | Release::Never => false,
    };
    waits.then_some(trigger)
}

/// The hinges met by following triggers from `start` until one comes round again; empty when
/// the chain ends.
fn circle_from(scene: &Scene, start: usize) -> Vec<usize> {
    let mut seen = vec![start];
    while let Some(next) = waits_for(scene, seen[seen.len() - 1]) {
        if let Some(position) = seen.iter().position(|&j| j == next) {
            return seen.split_off(position);
        }
        seen.push(next);
    }
    Vec::new()
}
