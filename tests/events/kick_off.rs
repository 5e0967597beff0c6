//! Kick-off springs between points of coaxial rotors: |x|² = a² + b² − 2ab cos β.

use std::f64::consts::TAU;

use nboom::model::{
    Appendage, Hinge, HingeState, KickOffSpring, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::EventKind;

use crate::collect::{DISENGAGES, ENGAGES, detail, run, tight};
use crate::rotors::{HUB, REDUCED, ROUNDING, ball, description, free, scene};

const A: f64 = 1.0;
const B: f64 = 0.8;
const LIMIT: f64 = 0.9;

/// Too weak to change any digit of the motion, but a spring.
const FEEBLE: [f64; 4] = [1e-200, 0.0, 0.0, 0.0];

fn with_spring(hinge: Hinge, coefficients: [f64; 4]) -> Hinge {
    with_limit(hinge, coefficients, LIMIT)
}

fn with_limit(hinge: Hinge, coefficients: [f64; 4], limit_length: f64) -> Hinge {
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.0, A, 0.0),
        body_point: Vec3::new(0.0, B, 0.0),
        coefficients,
        limit_length,
    });
    Hinge { kick_off, ..hinge }
}

fn length(beta: f64) -> f64 {
    (A * A + B * B - 2.0 * A * B * beta.cos()).sqrt()
}

/// β at which the spring has its limit length.
fn limit_angle() -> f64 {
    ((A * A + B * B - LIMIT * LIMIT) / (2.0 * A * B)).acos()
}

#[test]
fn a_boom_that_keeps_turning_lets_go_and_engages_in_every_turn() {
    for rate in [2.0, -2.0, 31.0] {
        let turns = 3;
        let end = f64::from(turns) * TAU / f64::abs(rate);
        let hinge = with_spring(free(0.0, rate), FEEBLE);
        let (found, summary) = run(&scene(&[hinge], end), &tight(1));
        let expected: Vec<_> = (0..turns)
            .flat_map(|turn| {
                let start = f64::from(turn) * TAU;
                [
                    (DISENGAGES, (start + limit_angle()) / rate.abs()),
                    (ENGAGES, (start + TAU - limit_angle()) / rate.abs()),
                ]
            })
            .collect();
        let found = found.happenings();
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, (kind, time)) in found.iter().zip(expected) {
            assert_eq!((found.0, found.1), (kind, Some(0)));
            // Some roundings of an angle of up to 19.
            assert!((found.2 - time).abs() < 10.0 * ROUNDING, "{}, {time}", found.2);
        }
        // The motion is uniform, so that one step between two events is long enough: a crossing
        // within it, and one back, must be found inside it.
        assert!(summary.steps_accepted < 200);
    }
}

#[test]
fn a_spring_lets_go_at_the_same_length_from_wherever_it_is_shortest() {
    for shortest in [0.3_f64, -0.4, 2.0] {
        let mut hinge = with_spring(free(shortest, 1.0), FEEBLE);
        let spring = hinge.kick_off.as_mut().expect("it has one");
        spring.main_body_point = Vec3::new(0.0, A * shortest.cos(), A * shortest.sin());
        let found = run(&scene(&[hinge], TAU), &tight(1)).0.happenings();
        let [(DISENGAGES, _, lets_go), (ENGAGES, _, engages)] = found[..] else {
            panic!("{found:?}")
        };
        let expected = [limit_angle(), TAU - limit_angle()];
        for (time, expected) in [lets_go, engages].into_iter().zip(expected) {
            // Two or three roundings of angles of order 10 at a rate of 1.
            assert!((time - expected).abs() < 3.0 * ROUNDING, "{shortest}: {time} {expected}");
        }
    }
}

#[test]
fn what_the_spring_pushes_is_its_energy() {
    let coefficients = [3.0, -0.5, 0.2, 0.1];
    let hinge = with_spring(free(0.3, 0.0), coefficients);
    let (found, _) = run(&scene(&[hinge], 2.0), &tight(50));
    let (event, after) = &found.events[0];
    assert_eq!((event.kind, event.hinge), (DISENGAGES, Some(0)));
    assert!((after.beta[0] - limit_angle()).abs() < 1e-14);
    let integral = |x: f64| {
        let [a0, a1, a2, a3] = coefficients;
        x * (a0 + x * (a1 / 2.0 + x * (a2 / 3.0 + x * a3 / 4.0)))
    };
    let rate = (2.0 / REDUCED * (integral(LIMIT) - integral(length(0.3)))).sqrt();
    // At the tolerance of 1e-12.
    assert!((after.tau[0] - rate).abs() < 1e-11, "{}, {rate}", after.tau[0]);
    assert_eq!(detail(after).lines[0].force, 0.0, "it lets go beyond its limit");
    for sample in &found.samples {
        let spring = detail(sample).lines[0];
        assert!((spring.length - length(sample.beta[0])).abs() < 1e-14);
        assert_eq!(spring.acts, spring.length <= LIMIT, "at {}", sample.time);
        assert_eq!(spring.force > 0.0, spring.acts, "at {}", sample.time);
    }
}

#[test]
fn without_coefficients_there_is_no_spring() {
    let hinge = with_spring(free(0.0, 2.0), [0.0; 4]);
    let (found, _) = run(&scene(&[hinge], TAU), &tight(1));
    assert_eq!(found.happenings(), []);
}

#[test]
fn a_spring_that_starts_beyond_its_limit_has_no_event_until_it_engages() {
    let start = 3.0;
    let (found, _) = run(&scene(&[with_spring(free(start, -1.0), FEEBLE)], 2.2), &tight(1));
    let [(ENGAGES, Some(0), time)] = found.happenings()[..] else { panic!("one event") };
    assert!((time - (start - limit_angle())).abs() < ROUNDING, "{time}");
}

#[test]
fn a_length_that_only_just_passes_its_limit_is_seen() {
    // The length is A − B at β = 0 and A + B at β = π; the gaps are some 1e-4 of a uniform
    // motion, over which a step may be as long as the run.
    let hair = 1e-8;
    let angle = |limit: f64| ((A * A + B * B - limit * limit) / (2.0 * A * B)).acos();
    let (shortest, longest) = (A - B + hair, A + B - hair);
    for (limit, kinds, times) in [
        (shortest, [ENGAGES, DISENGAGES], [-angle(shortest), angle(shortest)]),
        (longest, [DISENGAGES, ENGAGES], [angle(longest), TAU - angle(longest)]),
    ] {
        let hinge = with_limit(free(-1.0, 1.0), FEEBLE, limit);
        let found = run(&scene(&[hinge], 6.0), &tight(1)).0.happenings();
        assert_eq!(found.iter().map(|event| event.0).collect::<Vec<_>>(), kinds, "{limit}");
        for (event, time) in found.iter().zip(times) {
            // Rounding of the length, 1e-16, at its rate of 1e-4 here.
            assert!((event.2 - (time + 1.0)).abs() < 2e-11, "{limit}: {}", event.2);
        }
    }
    for limit in [A - B - hair, A + B + hair] {
        let hinge = with_limit(free(-1.0, 1.0), FEEBLE, limit);
        assert_eq!(run(&scene(&[hinge], 6.0), &tight(1)).0.happenings(), [], "{limit}");
    }
}

/// A boom that turns uniformly, with a second segment at its end that is held at angle zero.
fn with_held_segment(limit_length: f64) -> Scene {
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.0, A, 0.0),
        body_point: Vec3::zero(),
        coefficients: FEEBLE,
        limit_length,
    });
    let start = nboom::model::HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Locked };
    let held = Hinge { kick_off, start, ..Hinge::free() };
    let mut description = SceneDescription::at_rest("held segment", ball(HUB), 3.0);
    let inertia = Sym3::diagonal(1.0, 1.0, 1.0);
    // The mass centre of the outer segment is on the hub's axis, too.
    let outer = MassProperties::new(1.0, Vec3::new(0.0, -B, 0.0), inertia);
    description.attach(&Appendage::Regular {
        mount: Mount::at(Vec3::zero()),
        segments: vec![
            Segment { length: B, mass_properties: ball(1.0), hinge: free(0.0, 1.0) },
            Segment { length: 1.0, mass_properties: outer, hinge: held },
        ],
    });
    Scene::new(description).expect("segments are bodies")
}

#[test]
fn the_spring_of_a_held_hinge_has_events_as_its_length_changes() {
    let (found, _) = run(&with_held_segment(LIMIT), &tight(1));
    let [(DISENGAGES, Some(1), time)] = found.happenings()[..] else { panic!("one event") };
    assert!((time - limit_angle()).abs() < ROUNDING, "{time}");
    assert_eq!(run(&with_held_segment(5.0), &tight(1)).0.happenings(), []);
}

#[test]
fn a_spring_between_bodies_that_do_not_move_has_no_events() {
    let start = nboom::model::HingeStart { angle: limit_angle(), ..Hinge::free().start };
    let start = nboom::model::HingeStart { state: HingeState::Locked, ..start };
    let locked = with_spring(Hinge { start, ..Hinge::free() }, [1.0, 0.0, 0.0, 0.0]);
    let (found, _) = run(&scene(&[locked, free(0.0, 1.0)], 1.0), &tight(1));
    assert_eq!(found.happenings(), []);
}

/// A boom with a spring of this reach that turns at `rate` from `start`, on a scene that begins at
/// `initial`: whenever its length passes the limit, in closed form and as it is found.
fn passings(start: f64, rate: f64, initial: f64, turns: f64) -> [Vec<(EventKind, f64)>; 2] {
    let mut description = description(&[with_spring(free(start, rate), FEEBLE)], 0.0);
    description.initial.time = initial;
    description.end_time = initial + turns * TAU / rate;
    let scene = Scene::new(description).expect("rotors are bodies");
    let found = run(&scene, &tight(1)).0.happenings();
    let (from, to) = (start, start + turns * TAU);
    let turn = |n: i32| f64::from(n) * TAU;
    let first = (start / TAU).floor() as i32 - 1;
    let expected = (first..=first + turns as i32 + 2).flat_map(|n| {
        [(DISENGAGES, turn(n) + limit_angle()), (ENGAGES, turn(n + 1) - limit_angle())]
    });
    let within = expected.filter(|(_, angle)| (from..to).contains(angle));
    let expected = within.map(|(kind, angle)| (kind, initial + (angle - start) / rate));
    [expected.collect(), found.iter().map(|&(kind, _, time)| (kind, time)).collect()]
}

fn are_alike([expected, found]: &[Vec<(EventKind, f64)>; 2], off: f64) {
    let kinds = |all: &[(EventKind, f64)]| all.iter().map(|event| event.0).collect::<Vec<_>>();
    assert_eq!(kinds(found), kinds(expected), "{found:?}, {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.1 - expected.1).abs() < off, "{found:?}, {expected:?}");
    }
}

#[test]
fn a_spring_that_has_passed_its_limit_is_beyond_it_where_time_has_few_digits() {
    // At a million a time has steps of 1.2e-10, by half of which each event may shift those after.
    for rate in [2.0, 31.0] {
        are_alike(&passings(0.0, rate, 1e6, 5.75), 12.0 * 0.6e-10);
    }
}

#[test]
fn a_spring_that_leaves_its_limit_is_followed_through_all_of_a_long_step() {
    // From the limit outward, so fast that the first step is some turns long.
    let start = 16.0 * TAU + limit_angle();
    let rate = 1000.0;
    let [mut expected, found] = passings(start, rate, 0.0, 4.75);
    // The spring lets go at once, or has just done so.
    expected.retain(|&(_, time)| time > 1e-9);
    let found = found.into_iter().filter(|&(_, time)| time > 1e-9).collect();
    // Roundings of an angle of 130.
    are_alike(&[expected, found], 1e-13);
}
