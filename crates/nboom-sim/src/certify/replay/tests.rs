use nboom_elements::{HingeLaw, Kind};
use nboom_model::{
    Appendage, Hinge, HingeStart, HingeState, KickOffSpring, MassProperties, Mount, Release,
    SceneDescription, Segment, Spring, TorqueTable,
};
use nboom_scalar::{Mat3, Sym3, Vec3};

use super::*;
use crate::certify::trust::Witness;
use crate::events::event::EventKind;
use crate::options::Options;
use crate::run::simulate;

/// Two booms of two segments on springs, which unfold in a spin and lock; one hinge is released on
/// the way. Nothing acts from outside. All that the scene states is exact on `f64`, matrices of
/// mounts included: one that is orthogonal to 1e-16 only would not let energy be constant beyond.
fn unfolding() -> Scene {
    let hub =
        MassProperties::new(50.0, Vec3::new(0.1, 0.0, -0.05), Sym3::diagonal(20.0, 30.0, 25.0));
    let mut description = SceneDescription::at_rest("unfolding", hub, 1.5);
    description.initial.omega_body = Vec3::new(0.4, 0.3, 1.0);
    let body = MassProperties::new(3.0, Vec3::new(0.0, 0.5, 0.05), Sym3::diagonal(0.5, 0.1, 0.45));
    let hinge = |angle: f64, lock: f64, state, release| Hinge {
        spring: Spring { quadratic: 0.0, linear: -2.0, preload_angle: 0.25 },
        lock_angle: Some(lock),
        release,
        start: HingeStart { angle, rate: 0.0, state },
        ..Hinge::free()
    };
    let free = |angle| hinge(angle, 0.25, HingeState::Free, Release::Never);
    let at = |time| hinge(-1.25, -0.75, HingeState::Unreleased, Release::Time(time));
    let turned = Mat3::from_rows(Vec3::unit_z(), Vec3::unit_x(), Vec3::unit_y());
    for (point, rot_inboard_from_hinge, hinges) in [
        (Vec3::new(0.0, 1.0, 0.0), Mat3::identity(), [free(1.25), free(-0.5)]),
        (Vec3::new(0.5, -1.0, 0.25), turned, [free(1.0), at(0.375)]),
    ] {
        let segment = |hinge| Segment { length: 1.0, mass_properties: body, hinge };
        let segments = hinges.map(segment).to_vec();
        let mount = Mount { point, rot_inboard_from_hinge };
        description.attach(&Appendage::Regular { mount, segments });
    }
    Scene::new(description).expect("bodies are physical")
}

fn guide(scene: &Scene) -> Vec<Event> {
    let options = Options { rtol: 1e-13, atol: 1e-15, samples: 1, ..Options::default() };
    let mut witness = Witness::new();
    simulate(scene, &options, &mut witness).expect("it runs to its end");
    witness.events
}

fn replay<'a>(scene: &'a Scene, guide: &'a [Event], accuracy: Accuracy) -> Replay<'a> {
    let mut replay = Replay::new(scene, guide, accuracy, 1000, &|| false);
    assert!(replay.complete().expect("it runs to its end"), "{:?}", replay.events);
    replay
}

fn lock_ups(events: &[Event]) -> usize {
    events.iter().filter(|event| event.kind == EventKind::LockUp).count()
}

/// Energy with what lock-ups have taken away, and the angular momentum along inertial axes.
fn conserved(replay: &mut Replay<'_>) -> [DoubleDouble; 4] {
    let Replay { scene, situation: Situation { state, .. }, dynamics, .. } = replay;
    let found = state.invariants(dynamics);
    let laws = scene.bodies.iter().map(|b| HingeLaw::new(&b.hinge.spring, &b.hinge.dashpot));
    let potentials = laws.zip(&state.beta).map(|(law, &beta)| law.potential(beta));
    let energy = potentials.fold(found.kinetic_energy + state.work.lock_ups, |sum, p| sum + p);
    let [x, y, z] = (state.attitude.to_matrix() * found.angular_momentum).to_array();
    [energy, x, y, z]
}

#[test]
fn energy_and_angular_momentum_are_conserved() {
    let scene = unfolding();
    let guide = guide(&scene);
    assert!(lock_ups(&guide) >= 2 && guide.len() > lock_ups(&guide), "{guide:?}");
    let before = conserved(&mut Replay::new(&scene, &guide, Accuracy::REFERENCE, 1000, &|| false));
    let mut replay = replay(&scene, &guide, Accuracy::REFERENCE);
    let after = conserved(&mut replay);
    let largest = |all: &[DoubleDouble]| all.iter().fold(0.0_f64, |m, x| m.max(x.to_f64().abs()));
    for (name, range) in [("energy", 0..1), ("angular momentum", 1..4)] {
        let (before, after) = (&before[range.clone()], &after[range]);
        let change: Vec<_> = before.iter().zip(after).map(|(a, b)| *b - *a).collect();
        let relative = largest(&change) / largest(before);
        println!("{name} {relative:.1e} in {} steps", replay.steps);
        // Some twenty steps, each off by 1e-28 at most, and by the rounding of some thousand
        // operations of 5e-32.
        assert!(relative < 1e-26, "{name}: {relative:e}");
    }
}

#[test]
fn neither_the_order_nor_the_tolerance_matters() {
    let scene = unfolding();
    let guide = guide(&scene);
    let end = |order, relative| {
        let accuracy = Accuracy { order, relative, absolute: 1e-3 * relative };
        let State { time, attitude, omega_body, beta, tau, .. } =
            replay(&scene, &guide, accuracy).situation.state;
        let mut all = vec![time, attitude.scalar];
        [attitude.vector, omega_body].iter().for_each(|v| all.extend(v.to_array()));
        [beta, tau].iter().for_each(|list| all.extend(list));
        all
    };
    let expected = end(33, 1e-28);
    for (order, relative) in [(30, 1e-28), (36, 1e-28), (33, 1e-26)] {
        let off = end(order, relative).into_iter().zip(&expected).map(|(a, &b)| (a - b).to_f64());
        let worst = off.fold(0.0_f64, |worst, off| worst.max(off.abs()));
        println!("order {order}, tolerance {relative:.0e}: {worst:.1e}");
        // All numbers are about 1; the motion magnifies what steps are off by, and so do lock-ups.
        assert!(worst < 100.0 * relative, "order {order}, {relative:e}: {worst:e}");
    }
}

/// The time of a release that follows a lock-up has the digits of the lock-up's, not those of an `f64`.
#[test]
fn a_release_that_follows_a_lock_up_is_as_exact_as_that() {
    let mut description = SceneDescription::clone(&unfolding());
    let delay = 0.1;
    description.bodies[3].hinge.release = Release::AfterLock { hinge: 0, delay };
    let scene = Scene::new(description).expect("bodies are physical");
    let guide = guide(&scene);
    let release = guide.iter().position(|event| event.kind == EventKind::Release).expect("one");
    let before = conserved(&mut Replay::new(&scene, &guide, Accuracy::REFERENCE, 1000, &|| false));
    let mut replay = replay(&scene, &guide, Accuracy::REFERENCE);
    let after = conserved(&mut replay);
    // As in the test above.
    let change = ((after[0] - before[0]) / before[0]).to_f64().abs();
    assert!(change < 1e-26, "{change:e}");
    let locked = replay.events.iter().find(|event| event.hinge == Some(0)).expect("it locks");
    let off = replay.events[release].time - (locked.time + delay);
    // Each of the times is rounded once.
    assert!(off.abs() <= 2.0 * f64::EPSILON, "{off:e}");
}

#[test]
fn an_event_that_the_guide_misses_is_noticed() {
    let scene = unfolding();
    let whole = guide(&scene);
    for left_out in 0..whole.len() {
        let mut guide = whole.clone();
        guide.remove(left_out);
        let mut replay = Replay::new(&scene, &guide, Accuracy::REFERENCE, 1000, &|| false);
        assert!(!replay.complete().expect("up to there it runs"), "{:?}", whole[left_out]);
    }
}

#[test]
fn an_event_that_does_not_come_is_refused_or_noticed() {
    let scene = unfolding();
    let mut guide = guide(&scene);
    let first = guide.iter().position(|event| event.kind == EventKind::LockUp).expect("one");
    // Of a hinge that is far from its lock angle.
    let other = (0..4).rfind(|&i| Some(i) != guide[first].hinge && i != 3).expect("one");
    guide[first].hinge = Some(other);
    let mut replay = Replay::new(&scene, &guide, Accuracy::REFERENCE, 1000, &|| false);
    assert!(!matches!(replay.complete(), Ok(true)));
}

#[test]
fn steps_without_end_are_given_up() {
    let scene = unfolding();
    let guide = guide(&scene);
    let mut replay = Replay::new(&scene, &guide, Accuracy::REFERENCE, 2, &|| false);
    assert!(matches!(replay.complete(), Err(SimError::StepsUsedUp { steps: 2, .. })));
}

/// A boom on a hub, both turning about x, with a kick-off spring whose length is
/// sqrt(1.64 − 1.6 cos β): at the angle `start` of the hinge and turning at `rate`.
fn kicked(start: f64, rate: f64, limit_length: f64) -> Scene {
    let ball =
        |moment| MassProperties::new(2.0, Vec3::zero(), Sym3::diagonal(moment, moment, moment));
    let mut description = SceneDescription::at_rest("kicked", ball(4.0), 6.0);
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::unit_y(),
        body_point: Vec3::unit_y() * 0.8,
        coefficients: [0.125, 0.0, 0.0, 0.0],
        limit_length,
    });
    let start = HingeStart { angle: start, rate, state: HingeState::Free };
    let hinge = Hinge { kick_off, start, ..Hinge::free() };
    let segments = vec![Segment { length: 1.0, mass_properties: ball(1.0), hinge }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    Scene::new(description).expect("bodies are physical")
}

#[test]
fn a_kick_off_spring_that_nobody_told_of_is_noticed() {
    // Over its limit and back; then from its limit on, whose length at a right angle is known to
    // the last digit, outward and inward.
    let right_angle = std::f64::consts::FRAC_PI_2;
    let at_limit = 1.64_f64.sqrt();
    for (scene, least) in [
        (kicked(0.5, 1.0, 1.0), 2),
        (kicked(right_angle, 1.0, at_limit), 2),
        (kicked(right_angle, -1.0, at_limit), 1),
    ] {
        let whole = guide(&scene);
        assert!(whole.len() >= least, "{whole:?}");
        assert!(whole.iter().all(|event| matches!(
            event.kind,
            EventKind::Rise(Kind::KickOff) | EventKind::Fall(Kind::KickOff)
        )));
        replay(&scene, &whole, Accuracy::REFERENCE);
        for left_out in 0..whole.len() {
            let mut guide = whole.clone();
            guide.remove(left_out);
            let mut replay = Replay::new(&scene, &guide, Accuracy::REFERENCE, 1000, &|| false);
            let outcome = replay.complete();
            assert!(!matches!(outcome, Ok(true)), "{:?}", whole[left_out]);
        }
        let mut replay = Replay::new(&scene, &[], Accuracy::REFERENCE, 1000, &|| false);
        assert!(!matches!(replay.complete(), Ok(true)), "none of {whole:?}");
    }
}

/// No rate tells when a hinge has come to where it rests.
#[test]
fn a_hinge_that_starts_at_rest_on_a_point_of_its_table_leaves_it_at_once() {
    let still = |table: Vec<[f64; 2]>, release| {
        let mut description = (*kicked(-0.75, 0.0, 0.0)).clone();
        let hinge = &mut description.bodies[0].hinge;
        *hinge = Hinge { release, start: hinge.start, ..Hinge::free() };
        if let Release::Time(_) = release {
            hinge.start.state = HingeState::Unreleased;
        }
        description.torque_tables.push(TorqueTable { hinge: 0, points: table });
        Scene::new(description).expect("bodies are physical")
    };
    for release in [Release::Never, Release::Time(0.375)] {
        let scene = still(vec![[-0.75, 0.5], [0.25, 1.0]], release);
        replay(&scene, &guide(&scene), Accuracy::REFERENCE);
    }
}

/// The guide's time of the release that another hinge causes is off, and so would be that at which the hinge leaves its
/// point, as a square root.
#[test]
fn a_hinge_that_another_releases_on_a_point_of_its_table_leaves_it_at_once() {
    for release in
        [Release::AfterLock { hinge: 0, delay: 0.1 }, Release::Angle { hinge: 0, angle: 1.0 }]
    {
        let mut description = SceneDescription::clone(&unfolding());
        description.bodies[3].hinge.release = release;
        let points = vec![[-1.25, 0.5], [0.25, 1.0]];
        description.torque_tables.push(TorqueTable { hinge: 3, points });
        let scene = Scene::new(description).expect("bodies are physical");
        let options = Options { rtol: 1e-9, samples: 1, ..Options::default() };
        let mut witness = Witness::new();
        simulate(&scene, &options, &mut witness).expect("it runs to its end");
        let leaves = |event: &Event| event.kind == EventKind::Rise(Kind::TorqueTable);
        assert!(witness.events.iter().any(leaves), "{:?}", witness.events);
        replay(&scene, &witness.events, Accuracy::REFERENCE);
    }
}
