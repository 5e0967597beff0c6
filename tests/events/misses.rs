//! How near hinges come to lock angles that they do not reach, against closed forms.

use std::f64::consts::{FRAC_PI_2, PI};

use nboom::model::{External, Hinge, Release, Scene, SceneDescription};
use nboom::scalar::Vec3;
use nboom::sim::{HingeVerdict, Method, Miss, Options};

use crate::collect::{run, tight};
use crate::rotors::{description, free, growing, locking_at, oscillating, scene, waiting};

/// Integration errs by some 1e-12 and dense output by ten times as much.
const CLOSE: f64 = 1e-10;

/// An extreme is flat: what moves its height by 1e-11 moves its time by the root of twice that.
const CLOSE_IN_TIME: f64 = 1e-5;

/// β = sin t.
fn swinging() -> Hinge {
    oscillating(free(0.0, 1.0), 1.0, 0.0)
}

fn misses(scene: &Scene, options: &Options) -> Vec<Option<Miss>> {
    let (_, summary) = run(scene, options);
    summary.verdict.hinges.iter().map(|hinge| hinge.miss).collect()
}

/// The miss of the only hinge.
fn miss(hinge: Hinge, end_time: f64) -> Option<Miss> {
    misses(&scene(&[hinge], end_time), &tight(1))[0]
}

fn assert_is(found: Option<Miss>, by: f64, time: f64) {
    let Miss { by: found, time: at } = found.expect("it does not lock");
    assert!((found - by).abs() < CLOSE, "{found:e}, {by:e}");
    assert!((at - time).abs() < CLOSE_IN_TIME, "{at}, {time}");
}

#[test]
fn a_hinge_that_turns_back_misses_by_what_it_lacks() {
    for gap in [0.5, 1e-3, 1e-6, 1e-9] {
        assert_is(miss(locking_at(swinging(), 1.0 + gap), 6.0), gap, FRAC_PI_2);
        assert_is(miss(locking_at(swinging(), -1.0 - gap), 6.0), gap, 1.5 * PI);
    }
}

#[test]
fn a_hinge_that_is_on_its_way_is_nearest_at_the_end() {
    assert_is(miss(locking_at(swinging(), 1.0), 0.5), 1.0 - 0.5_f64.sin(), 0.5);
}

#[test]
fn a_hinge_that_turns_away_is_nearest_at_the_start() {
    assert_is(miss(locking_at(free(0.25, 1.0), -0.5), 3.0), 0.75, 0.0);
}

#[test]
fn the_nearest_of_several_swings_counts() {
    // Damping makes each swing less wide than the one before, the other way round each wider.
    for growth in [-0.05_f64, 0.05] {
        let damped = (1.0 - growth * growth).sqrt();
        // At extremes β̇ = 0, which is tan(ω t) = -ω/g.
        let first = (damped / -growth).atan().rem_euclid(PI) / damped;
        let last = first + 2.0 * (2.0 * PI / damped);
        let time = if growth < 0.0 { first } else { last };
        let height = (growth * time).exp() * (damped * time).sin() / damped;
        let hinge = locking_at(growing(swinging(), growth), 3.0);
        assert_is(miss(hinge, 2.5 * 2.0 * PI), 3.0 - height, time);
    }
}

#[test]
fn a_hinge_that_locks_or_has_no_lock_misses_nothing() {
    assert_eq!(miss(locking_at(swinging(), 0.9), 6.0), None);
    assert_eq!(miss(swinging(), 6.0), None);
    // It passes close by several times before it locks.
    assert_eq!(miss(locking_at(growing(swinging(), 0.05), 1.5), 40.0), None);
}

#[test]
fn a_hinge_that_becomes_free_at_its_lock_angle_misses_nothing() {
    assert_eq!(miss(locking_at(swinging(), 0.0), 3.0), None);
}

#[test]
fn a_hinge_is_followed_from_its_release_on() {
    let held = locking_at(oscillating(waiting(Release::Time(2.0)), 1.0, 0.5), 1.25);
    assert_eq!(miss(held, 1.0), None);
    // β = ½ (1 − cos(t − 2)).
    assert_is(miss(held, 6.0), 0.25, 2.0 + PI);
}

#[test]
fn steps_that_events_cut_short_count_as_far_as_they_go() {
    // Pushes along the axis turn nothing; they begin and end around the turning points.
    let mut pushed: SceneDescription = description(&[locking_at(swinging(), 1.01)], 6.0);
    let push = |time: f64| {
        External::thrust(Vec3::unit_x() * 2.0, Vec3::zero(), [time - 0.01, time + 0.02])
    };
    pushed.externals = [0.4, 1.2, FRAC_PI_2, 1.7, 2.5, 4.0].map(push).to_vec();
    let pushed = Scene::new(pushed).expect("rotors are bodies");
    assert_is(misses(&pushed, &tight(1))[0], 0.01, FRAC_PI_2);
    // A lock-up of another hinge ends a step in which this one would have come nearer: it holds the hub still,
    // but for the moment of its own spring, which is none.
    let stopped = locking_at(free(0.0, 1.0), 0.5);
    let until = |end: f64| misses(&scene(&[locking_at(swinging(), 1.01), stopped], end), &tight(1));
    let (short, long) =
        (until(0.49)[0].expect("it is free"), until(0.5 - 1e-9)[0].expect("it is free"));
    assert!(long.by < short.by && long.time > short.time);
}

#[test]
fn every_integrator_says_so() {
    let scene = scene(&[locking_at(swinging(), 1.01)], 4.0);
    for integrator in Method::ALL {
        let options = Options { samples: 1, integrator, rtol: 1e-9, ..Options::default() };
        let found = misses(&scene, &options)[0].expect("it does not lock");
        // A global error of some hundred times the tolerance, and dense output of the lowest order.
        assert!((found.by - 0.01).abs() < 1e-6, "{}: {found:?}", integrator.name());
        assert!((found.time - FRAC_PI_2).abs() < 1e-3, "{}: {found:?}", integrator.name());
    }
}

/// A spring that rests at the lock angle takes a hinge there past it unless it is overdamped: then only errors do.
#[test]
fn errors_decide_about_a_hinge_that_comes_to_rest_at_its_lock_angle() {
    for (damping, is_doubtful) in
        [(0.0, false), (0.5, false), (0.9, false), (2.0, true), (5.0, true)]
    {
        let swing = oscillating(free(1.0, 0.0), 1.0, 0.0);
        let scene = scene(&[locking_at(growing(swing, -damping), 0.0)], 400.0);
        for rtol in [1e-6, 1e-9] {
            let options = Options { samples: 1, rtol, atol: 1e-3 * rtol, ..Options::default() };
            let (_, summary) = run(&scene, &options);
            let doubts: Vec<_> = summary.verdict.doubts(&scene, rtol).collect();
            assert_eq!(doubts.len(), usize::from(is_doubtful), "{damping}, {rtol:e}: {doubts:?}");
            let rate = summary.verdict.hinges[0].closing_rate;
            assert!(is_doubtful || rate.is_some_and(|rate| rate < -1e-3), "{damping}: {rate:?}");
        }
    }
}

#[test]
fn errors_decide_about_a_hinge_that_turns_back_just_before_its_lock_angle() {
    for (gap, rtol, is_doubtful) in
        [(1e-8, 1e-9, true), (1e-8, 1e-12, false), (1e-4, 1e-6, true), (1e-2, 1e-6, false)]
    {
        let verdict = verdict_of_a_swing_that_locks_at(1.0 + gap, rtol);
        assert!(verdict.0.closing_rate.is_none(), "{gap:e}, {rtol:e}");
        assert_eq!(verdict.1, is_doubtful, "{gap:e}, {rtol:e}: {verdict:?}");
    }
    // No run that is worth having errs by so much, whatever its tolerance.
    assert!(!verdict_of_a_swing_that_locks_at(1.05, 1e-3).1);
}

#[test]
fn errors_decide_about_a_hinge_that_locks_just_before_it_would_turn_back() {
    for (gap, rtol, is_doubtful) in [
        (1e-8, 1e-9, true),
        (1e-8, 1e-12, false),
        (1e-4, 1e-6, true),
        (1e-4, 1e-9, false),
        (1e-3, 1e-3, true),
        (5e-2, 1e-3, false),
    ] {
        let verdict = verdict_of_a_swing_that_locks_at(1.0 - gap, rtol);
        assert!(verdict.0.closing_rate.is_some(), "{gap:e}, {rtol:e}");
        assert_eq!(verdict.1, is_doubtful, "{gap:e}, {rtol:e}: {verdict:?}");
        if let Some(found) = verdict.0.stopping_distance {
            // τ²/2|τ̇| at β = sin t = 1 − gap, and errors of some hundred times the tolerance.
            let expected = gap * (1.0 - 0.5 * gap) / (1.0 - gap);
            assert!((found - expected).abs() < 1e3 * rtol, "{found:e}, {expected:e}");
        }
    }
}

/// What becomes of the hinge, and whether errors may decide that.
fn verdict_of_a_swing_that_locks_at(angle: f64, rtol: f64) -> (HingeVerdict, bool) {
    let scene = scene(&[locking_at(swinging(), angle)], 3.0);
    let options = Options { samples: 1, rtol, atol: 1e-3 * rtol, ..Options::default() };
    let (_, summary) = run(&scene, &options);
    (summary.verdict.hinges[0], summary.verdict.doubts(&scene, rtol).next().is_some())
}
