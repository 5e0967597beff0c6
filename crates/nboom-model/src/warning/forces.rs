//! Finds what drives a hinge the wrong way, as springs, dashpots and couplings of the wrong sign do.

use std::iter::successors;

use nboom_scalar::{Vec3, Wrench};

use super::ModelWarning;
use crate::hinge::SAME_ANGLE;
use crate::{Coupling, Hinge, HingeLabel, HingeState, KickOffSpring, Posture, Scene};

/// Share of its terms below which a torque is none.
pub(super) const NO_TORQUE: f64 = 1e-9;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let postures = [Posture::at_start(scene), Posture::locked(scene)];
    let hinges = (0..scene.bodies.len()).filter(|&i| scene.bodies[i].hinge.can_turn());
    let feeds = scene.couplings.iter().filter(|coupling| coupling.is_mutual);
    let feeds = feeds.filter(|coupling| coupling.damping < 0.0).map(|coupling| {
        let hinges = coupling.hinges.map(|i| scene.label(i));
        ModelWarning::CouplingFeeds { hinges, damping: coupling.damping }
    });
    hinges.flat_map(|i| of_hinge(scene, &postures, i)).chain(feeds).collect()
}

/// Warnings about a hinge, from where all hinges start and from where they lock.
fn of_hinge(scene: &Scene, postures: &[Posture; 2], i: usize) -> Vec<ModelWarning> {
    let [posture, _] = postures;
    let body = &scene.bodies[i];
    let (hinge, label) = (&body.hinge, || scene.label(i));
    let mut found = dashpot(hinge)
        .map(|(coefficient, beyond)| ModelWarning::DashpotFeeds {
            hinge: label(),
            coefficient,
            beyond,
        })
        .into_iter()
        .collect::<Vec<_>>();
    let is_tabulated = scene.torque_tables.iter().any(|table| table.hinge == i);
    let is_coupled = scene.couplings.iter().any(|coupling| coupling.hinges.contains(&i));
    if !is_tabulated && !is_coupled {
        found.extend(spring(hinge, label()));
    }
    found.extend(away_from_lock(scene, posture, i));
    found.extend(held_by_friction(scene, posture, i));
    if let Some((_, force, length)) = push(scene, posture, i).filter(|(_, force, _)| *force < 0.0) {
        found.push(ModelWarning::KickOffPulls { hinge: label(), force, length });
    }
    if let Some(spring) = &hinge.kick_off {
        let [length, with_locks] = postures.each_ref().map(|at| between(spring, at, i).norm());
        let limit = spring.limit_length;
        if length == 0.0 {
            found.push(ModelWarning::KickOffWithoutLength(label()));
        } else if hinge.lock_angle.is_some() && length.min(with_locks) > limit {
            let hinge = label();
            found.push(ModelWarning::KickOffNeverPushes { hinge, length, limit });
        }
    }
    found
}

/// From one end of the kick-off spring of hinge `j` to the other.
fn between(spring: &KickOffSpring, posture: &Posture, j: usize) -> Vec3<f64> {
    posture.hinges[j].kick_off - spring.main_body_point
}

/// A warning about the spring and the dashpot's terms in the angle of a hinge on which nothing else acts.
fn spring(hinge: &Hinge, label: HingeLabel) -> Option<ModelWarning> {
    let torque = AngleTorque::of(hinge);
    let start = hinge.start.angle;
    if let Some((stiffness, away_from)) = torque.without_rest() {
        let way = start - away_from;
        let is_open = |side: f64| way * side >= 0.0 && !hinge.stops.has_on(side);
        [-1.0, 1.0].into_iter().any(is_open).then_some(ModelWarning::SpringWithoutRest {
            hinge: label,
            stiffness,
            away_from,
        })
    } else if torque.drives_on(hinge) {
        Some(ModelWarning::SpringDrivesOn { hinge: label, start })
    } else {
        None
    }
}

/// Whether no latch and no stop ends the motion of a hinge to one side of its start.
pub(super) fn is_endless(hinge: &Hinge, side: f64) -> bool {
    let latches = |lock: f64| (lock - hinge.start.angle) * side > 0.0;
    !hinge.lock_angle.is_some_and(latches) && !hinge.stops.has_on(side)
}

/// A warning about a hinge that springs, tables and couplings at the start together drive away from its lock angle.
fn away_from_lock(scene: &Scene, posture: &Posture, i: usize) -> Option<ModelWarning> {
    let hinge = &scene.bodies[i].hinge;
    let start = hinge.start.angle;
    let same = SAME_ANGLE * scene.coordinate_scale(i);
    let lock = hinge.lock_angle.filter(|lock| (lock - start).abs() > same)?;
    let torque = torque_at_start(scene, posture, i)?;
    (torque * (lock - start).signum() < 0.0).then(|| ModelWarning::DrivenFromLock {
        hinge: scene.label(i),
        start,
        lock,
    })
}

/// A warning about a hinge that springs, tables and couplings would move from rest at the start, but for its friction.
/// Weight is not known of.
fn held_by_friction(scene: &Scene, posture: &Posture, i: usize) -> Option<ModelWarning> {
    if scene.base.is_held() && scene.gravity.is_some() {
        return None;
    }
    let Hinge { friction, start, .. } = scene.bodies[i].hinge;
    let torque = torque_at_start(scene, posture, i).filter(|torque| *torque != 0.0)?;
    (start.rate == 0.0 && torque.abs() <= friction).then(|| ModelWarning::FrictionHolds {
        hinge: scene.label(i),
        friction,
        torque,
    })
}

/// The torque at rest of springs, tables and couplings on hinge `i` at the start. None of one that is released later, if
/// another hinge that changes it may have moved by then.
fn torque_at_start(scene: &Scene, posture: &Posture, i: usize) -> Option<f64> {
    let hinge = &scene.bodies[i].hinge;
    let start = hinge.start.angle;
    let mut torques = vec![AngleTorque::of(hinge).at(start)];
    let tables = scene.torque_tables.iter().filter(|table| table.hinge == i);
    torques.extend(tables.map(|table| table.at(&table.slopes(), start)));
    let mut changed_by = Vec::new();
    for (torque, other) in scene.couplings.iter().filter_map(|one| of_coupling(scene, one, i)) {
        torques.push(torque);
        changed_by.push(other);
    }
    for j in (i..scene.bodies.len()).filter(|&j| scene.bodies[j].hinge.kick_off.is_some()) {
        let inward: Vec<usize> = successors(Some(j), |&j| scene.bodies[j].inboard).collect();
        if inward.contains(&i) {
            torques.push(of_kick_off(scene, posture, [i, j]));
            changed_by.extend(inward);
        }
    }
    let may_have_moved = |&j: &usize| j != i && scene.bodies[j].hinge.can_turn();
    let is_known = hinge.start.state == HingeState::Free || !changed_by.iter().any(may_have_moved);
    is_known.then(|| sum(&torques))
}

/// The torque of a coupling on hinge `i` at the start and its other hinge, if it acts on `i`.
fn of_coupling(scene: &Scene, coupling: &Coupling, i: usize) -> Option<(f64, usize)> {
    let Coupling { hinges: [first, second], ratio, stiffness, rest, is_mutual, .. } = *coupling;
    let [own, other] = [first, second].map(|j| scene.bodies[j].hinge.start.angle);
    let parts = if is_mutual { [own, -ratio * other, -rest] } else { [0.0, ratio * other, -rest] };
    let pull = -stiffness * sum(&parts);
    match i {
        _ if i == first => Some((pull, second)),
        _ if i == second && is_mutual => Some((-ratio * pull, first)),
        _ => None,
    }
}

/// The moment about hinge `i` of the kick-off spring of hinge `j`, which is outboard, at the start.
fn of_kick_off(scene: &Scene, posture: &Posture, [i, j]: [usize; 2]) -> f64 {
    let Some((direction, force, _)) = push(scene, posture, j) else { return 0.0 };
    let hinge = &posture.hinges[i];
    let push = Wrench::of_force(posture.hinges[j].kick_off - hinge.point, direction * force);
    scene.bodies[i].joint.along(hinge.axis, &push)
}

/// The sum of torques; zero where nothing but rounding is left.
fn sum(torques: &[f64]) -> f64 {
    let scale = torques.iter().map(|torque| torque.abs()).sum::<f64>();
    let sum = torques.iter().sum::<f64>();
    if sum.abs() <= NO_TORQUE * scale { 0.0 } else { sum }
}

/// A coefficient by which the dashpot gives power q₁τ³ + q₂τ² above zero, with the power of the
/// rate it belongs to, and the rate beyond which it does. The squared rate pushes one way; where
/// that is not the way to the lock angle, it is taken for meant.
fn dashpot(hinge: &Hinge) -> Option<((f64, u8), f64)> {
    let (quadratic, linear) = (hinge.dashpot.rate_quadratic, hinge.dashpot.rate_linear);
    if linear > 0.0 {
        return Some(((linear, 1), 0.0));
    }
    let way = hinge.lock_angle.map_or(hinge.start.rate, |lock| lock - hinge.start.angle);
    let is_along = quadratic != 0.0 && (way == 0.0 || way * quadratic > 0.0);
    is_along.then(|| ((quadratic, 2), (linear / quadratic).abs()))
}

/// Torque A₂β² + A₁β + A₀ of spring and dashpot at rest, eq. (6.1) in powers of β.
#[derive(Clone, Copy)]
pub(super) struct AngleTorque {
    pub a2: f64,
    pub a1: f64,
    pub a0: f64,
}

impl AngleTorque {
    pub fn of(hinge: &Hinge) -> Self {
        let (spring, dashpot) = (&hinge.spring, &hinge.dashpot);
        let [q3, q4, gamma] =
            [dashpot.angle_quadratic, dashpot.angle_linear, dashpot.preload_angle];
        let [k1, k2, theta] = [spring.quadratic, spring.linear, spring.preload_angle];
        Self {
            a2: q3 + k1,
            a1: q4 + k2 + 2.0 * (q3 * gamma + k1 * theta),
            a0: (q3 * gamma + q4) * gamma + (k1 * theta + k2) * theta,
        }
    }

    /// Zero where nothing but rounding is left.
    pub fn at(&self, beta: f64) -> f64 {
        sum(&[self.a2 * beta * beta, self.a1 * beta, self.a0])
    }

    fn potential(&self, beta: f64) -> f64 {
        -(((self.a2 / 3.0 * beta + self.a1 / 2.0) * beta + self.a0) * beta)
    }

    /// The stiffness of a linear torque that points away from an angle, and that angle.
    fn without_rest(&self) -> Option<(f64, f64)> {
        (self.a2 == 0.0 && self.a1 > 0.0).then(|| (self.a1, -self.a0 / self.a1))
    }

    /// Whether a hinge that starts at rest turns for ever: on the side to which a quadratic torque
    /// pushes far out, no potential is above that of the start, and there is neither lock angle nor stop.
    fn drives_on(&self, hinge: &Hinge) -> bool {
        let (side, start) = (self.a2.signum(), hinge.start.angle);
        self.a2 != 0.0
            && is_endless(hinge, side)
            && self.hill(start, side).is_some_and(|height| height < 0.0)
    }

    /// The height above `from` of the last summit of the potential on one side, beyond which the torque points
    /// outward and grows; without end below where `from` is beyond it. None if far out it does not.
    pub fn hill(&self, from: f64, side: f64) -> Option<f64> {
        let Self { a2, a1, a0 } = *self;
        let summit = if a2 == 0.0 {
            (a1 > 0.0).then(|| -a0 / a1)?
        } else if a2 * side < 0.0 {
            return None;
        } else {
            // Without roots it points outward all along.
            let discriminant = a1 * a1 - 4.0 * a2 * a0;
            if discriminant < 0.0 {
                return Some(f64::NEG_INFINITY);
            }
            (-a1 + discriminant.sqrt().copysign(a2)) / (2.0 * a2)
        };
        let is_beyond = (from - summit) * side > 0.0;
        let height = || self.potential(summit) - self.potential(from);
        Some(if is_beyond { f64::NEG_INFINITY } else { height() })
    }
}

/// Direction, force and length of the kick-off spring of hinge `j`, if it acts at the start.
fn push(scene: &Scene, posture: &Posture, j: usize) -> Option<(Vec3<f64>, f64, f64)> {
    let spring = scene.bodies[j].hinge.kick_off?;
    let between = between(&spring, posture, j);
    let length = between.norm();
    let [a0, a1, a2, a3] = spring.coefficients;
    let acts = length > 0.0 && length <= spring.limit_length;
    acts.then(|| {
        (between * (1.0 / length), ((a3 * length + a2) * length + a1) * length + a0, length)
    })
}
