use nboom_model::{
    Course, Dashpot, External, ExternalAxes, ExternalKind, Hinge, HingeState, KickOffSpring,
    Release, Scene, Spring,
};
use nboom_scalar::Vec3;

use super::super::NEVER;
use super::appendages::DeckSegment;
use super::cards::Cards;
use super::inverse::degrees;
use super::obstacle::{DeckDefect, Obstacles};
use super::{numbers, vectors};
use crate::words::external_table;

/// Reports what a deck cannot say of the hinges of a scene.
pub(super) fn check(scene: &Scene, obstacles: &mut Obstacles<'_>) {
    for rotor in &scene.rotors {
        match rotor.body {
            Some(body) => obstacles.add(body, "rotor", DeckDefect::Rotor),
            None => obstacles.add_to_main_body("rotor", DeckDefect::Rotor),
        }
    }
    if scene.base.is_held() {
        obstacles.add_to_main_body("base", DeckDefect::Held);
    }
    check_externals(scene, obstacles);
    for (i, body) in scene.bodies.iter().enumerate() {
        let hinge = &body.hinge;
        if body.joint.slides() {
            obstacles.add(i, "slide", DeckDefect::Slides);
            continue;
        }
        if scene.couplings.iter().any(|coupling| coupling.hinges[0] == i) {
            obstacles.add(i, "coupling", DeckDefect::Coupling);
        }
        if scene.torque_tables.iter().any(|table| table.hinge == i) {
            obstacles.add(i, "hinge.torque", DeckDefect::Torque);
        }
        if hinge.friction != 0.0 {
            obstacles.add(i, "hinge.friction", DeckDefect::Friction);
        }
        if !hinge.stops.is_none() {
            obstacles.add(i, "hinge.stops", DeckDefect::Stops);
        }
        if let Some(lock) = hinge.lock_angle.map(degrees).filter(|lock| lock.abs() >= NEVER) {
            obstacles.add(i, "hinge.latch", DeckDefect::Never(lock));
        }
        let defect = match release(hinge) {
            Release::Time(time) if release_time(scene, time).is_none() => DeckDefect::Never(time),
            Release::Angle { angle, .. } if degrees(angle).abs() >= NEVER => {
                DeckDefect::Never(degrees(angle))
            }
            Release::AfterLock { .. } => DeckDefect::AfterLock,
            _ => continue,
        };
        obstacles.add(i, "hinge.release", defect);
    }
}

fn check_externals(scene: &Scene, obstacles: &mut Obstacles<'_>) {
    for (i, external) in scene.externals.iter().enumerate() {
        let found = match (as_thrust(external), i) {
            (Some(_), 0) => continue,
            (Some(_), _) => "another thrust",
            (None, _) if external.kind == ExternalKind::Torque => "a torque from outside",
            (None, _) if external.body.is_some() => "a force on a hinged body",
            (None, _) if external.axes == ExternalAxes::Inertial => "a force along inertial axes",
            (None, _) => "a force by a table over time",
        };
        let (key, defect) = (external_table(external.kind), DeckDefect::External(found.to_owned()));
        match external.body {
            Some(body) => obstacles.add(body, key, defect),
            None => obstacles.add_to_main_body(key, defect),
        }
    }
}

/// What a deck says as its thrust, with the times from and until which it acts.
pub(super) fn as_thrust(external: &External) -> Option<(&External, [f64; 2])> {
    match external {
        External {
            body: None,
            kind: ExternalKind::Force,
            axes: ExternalAxes::Body,
            course: Course::Pulse { on, off },
            ..
        } => Some((external, [*on, *off])),
        _ => None,
    }
}

/// The release of a hinge, if it starts held.
fn release(hinge: &Hinge) -> Release {
    if hinge.start.state == HingeState::Unreleased { hinge.release } else { Release::Never }
}

/// The time that means a release time to a deck. Those that it takes for never have one outside of the run.
fn release_time(scene: &Scene, time: f64) -> Option<f64> {
    let is_read_as_a_time = time < NEVER || time > scene.end_time;
    is_read_as_a_time.then(|| time.clamp(f64::MIN, f64::MAX))
}

/// A release time that never comes.
fn never(scene: &Scene) -> f64 {
    if scene.end_time < NEVER { NEVER } else { f64::MAX }
}

/// Angles, laws and releases of all hinges.
pub(super) fn write(cards: &mut Cards, scene: &Scene, segments: &[&DeckSegment]) {
    let hinges: Vec<&Hinge> = segments.iter().map(|s| &scene.bodies[s.body].hinge).collect();
    cards.values("BETAIK", &numbers(&hinges, |hinge| degrees(hinge.start.angle)));
    cards.unless_zero("TAUIK", &numbers(&hinges, |hinge| degrees(hinge.start.rate)));
    cards.values("BSIK", &numbers(&hinges, |hinge| hinge.lock_angle.map_or(NEVER, degrees)));
    laws(cards, &hinges);
    kick_off(cards, &hinges, segments);
    releases(cards, scene, &hinges, segments);
}

fn laws(cards: &mut Cards, hinges: &[&Hinge]) {
    let springs = [
        ("EKNIK(1,1)", numbers(hinges, |hinge| hinge.spring.quadratic)),
        ("EKNIK(1,2)", numbers(hinges, |hinge| hinge.spring.linear)),
    ];
    // Without its law an angle would mean nothing.
    let preload = |hinge: &&Hinge| match hinge.spring {
        Spring { quadratic: 0.0, linear: 0.0, .. } => 0.0,
        spring => degrees(spring.preload_angle),
    };
    let dashpots = [
        ("QNIK(1,1)", numbers(hinges, |hinge| hinge.dashpot.rate_quadratic)),
        ("QNIK(1,2)", numbers(hinges, |hinge| hinge.dashpot.rate_linear)),
        ("QNIK(1,3)", numbers(hinges, |hinge| hinge.dashpot.angle_quadratic)),
        ("QNIK(1,4)", numbers(hinges, |hinge| hinge.dashpot.angle_linear)),
    ];
    let damper_preload = |hinge: &&Hinge| match hinge.dashpot {
        Dashpot { angle_quadratic: 0.0, angle_linear: 0.0, .. } => 0.0,
        dashpot => degrees(dashpot.preload_angle),
    };
    springs.iter().for_each(|(name, values)| cards.unless_zero(name, values));
    cards.unless_zero("THETIK", &numbers(hinges, preload));
    dashpots.iter().for_each(|(name, values)| cards.unless_zero(name, values));
    cards.unless_zero("GAMAIK", &numbers(hinges, damper_preload));
}

fn kick_off(cards: &mut Cards, hinges: &[&Hinge], segments: &[&DeckSegment]) {
    if hinges.iter().all(|hinge| hinge.kick_off.is_none()) {
        return;
    }
    let none = KickOffSpring {
        main_body_point: Vec3::zero(),
        body_point: Vec3::zero(),
        coefficients: [0.0; 4],
        limit_length: 0.0,
    };
    let springs = hinges.iter().zip(segments).map(|(hinge, segment)| {
        let spring = hinge.kick_off.unwrap_or(none);
        KickOffSpring { body_point: segment.axes.transpose_mul(spring.body_point), ..spring }
    });
    let springs: Vec<KickOffSpring> = springs.collect();
    cards.values("RIK1", &vectors(&springs, |spring| spring.main_body_point));
    cards.values("SIK1", &vectors(&springs, |spring| spring.body_point));
    let coefficients: Vec<f64> = springs.iter().flat_map(|spring| spring.coefficients).collect();
    cards.values("AES", &coefficients);
    cards.values("XIKF", &numbers(&springs, |spring| spring.limit_length));
}

fn releases(cards: &mut Cards, scene: &Scene, hinges: &[&Hinge], segments: &[&DeckSegment]) {
    let never = never(scene);
    let number = |body: usize| segments.iter().position(|s| s.body == body).map_or(0, |i| i + 1);
    let releases = hinges.iter().map(|hinge| match release(hinge) {
        Release::Time(time) => (0, release_time(scene, time).unwrap_or(never)),
        Release::Angle { hinge, angle } => (number(hinge), degrees(angle)),
        Release::AfterLock { .. } | Release::Never => (0, never),
    });
    let (triggers, values): (Vec<usize>, Vec<f64>) = releases.unzip();
    cards.integers("IREL", &triggers);
    cards.values("RELTB", &values);
}
