//! Crossings that a look at the ends of each step would miss, against closed forms.

use nboom::model::Release;
use nboom::sim::EventKind::{LockUp, Release as Released};
use nboom::sim::Options;

use crate::collect::{run, tight};
use crate::rotors::{free, growing, locking_at, oscillating, scene, waiting};

/// A tolerance at which a step spans a good part of a period.
fn loose() -> Options {
    Options { samples: 1, rtol: 1e-5, atol: 1e-6, ..Options::default() }
}

#[test]
fn an_angle_a_hair_below_the_turning_point_is_passed() {
    // β = sin t exceeds 1 − 2e-4 for 0.04 around π/2, while a step is about one radian.
    let angle = 1.0 - 2e-4_f64;
    let trigger = oscillating(free(0.0, 1.0), 1.0, 0.0);
    let waits = waiting(Release::Angle { hinge: 0, angle });
    let (found, summary) = run(&scene(&[trigger, waits], 1.9), &loose());
    let [(Released, Some(1), time)] = found.happenings()[..] else { panic!("one release") };
    // Hinge 2 is rigid with the hub, which makes the oscillation slower.
    let frequency = (0.8 / (5.0 / 6.0_f64)).sqrt();
    let amplitude = 1.0 / frequency;
    assert!(amplitude > 1.0);
    let expected = (angle / amplitude).asin() / frequency;
    assert!((time - expected).abs() < 1e-4, "{time}, {expected}");
    assert!(summary.steps_accepted < 40);
}

/// Steps of a free oscillation β = sin t through its first two turning points.
fn steps_of(hinge: nboom::model::Hinge) -> usize {
    run(&scene(&[hinge], 6.0), &loose()).1.steps_accepted
}

#[test]
fn a_lock_angle_passed_twice_within_a_step_is_not_missed() {
    let swing = oscillating(free(0.0, 1.0), 1.0, 0.0);
    let steps = steps_of(swing);
    // Time above the angle: 2 acos(1 − d), for d from wide to narrow. The amplitude errs by the
    // tolerance of 1e-5, so that narrower gaps have no right answer.
    let mut widest_steps_missed = false;
    for depth in [1e-1, 1e-2, 1e-3, 2e-4] {
        let angle = 1.0 - depth;
        let (found, _) = run(&scene(&[locking_at(swing, angle)], 6.0), &loose());
        let [(LockUp, Some(0), time)] = found.happenings()[..] else {
            panic!("{depth:e}: {:?}", found.happenings())
        };
        // An error of 1e-5 in the angle at the rate there.
        let allowed = 1e-5 / angle.acos();
        assert!((time - angle.asin()).abs() < allowed, "{depth:e}: {time}, {}", angle.asin());
        widest_steps_missed |= 6.0 / steps as f64 > 5.0 * 2.0 * angle.acos();
    }
    assert!(widest_steps_missed, "the steps are too short to miss anything: {steps} steps");
}

#[test]
fn an_angle_a_hair_beyond_the_turning_point_is_not_reached() {
    let swing = oscillating(free(0.0, 1.0), 1.0, 0.0);
    for depth in [1e-2, 1e-3, 2e-4] {
        let (found, _) = run(&scene(&[locking_at(swing, 1.0 + depth)], 6.0), &loose());
        assert_eq!(found.happenings(), [], "{depth:e}");
    }
}

#[test]
fn a_crossing_is_as_exact_as_the_motion() {
    // Down to the rounding of the rate: angle 1 − 1e-6 at a tolerance of 1e-12.
    let swing = oscillating(free(0.0, 1.0), 1.0, 0.0);
    let angle = 1.0 - 1e-6_f64;
    let (found, _) = run(&scene(&[locking_at(swing, angle)], 6.0), &tight(1));
    let [(LockUp, Some(0), time)] = found.happenings()[..] else { panic!("one lock-up") };
    assert!((time - angle.asin()).abs() < 1e-11 / angle.acos(), "{time}, {}", angle.asin());
}

#[test]
fn the_first_of_many_swings_that_passes_is_found() {
    // β grows by exp(0.05 t); it first exceeds 1.5 in the swing in which the envelope does.
    let swing = growing(oscillating(free(0.0, 1.0), 1.0, 0.0), 0.05);
    let damped = (1.0_f64 - 0.05 * 0.05).sqrt();
    let beta = |t: f64| (0.05 * t).exp() * (damped * t).sin() / damped;
    let mut first = 0.0;
    while beta(first) < 1.5 {
        first += 1e-6;
    }
    let (found, _) = run(&scene(&[locking_at(swing, 1.5)], 40.0), &tight(1));
    let [(LockUp, Some(0), time)] = found.happenings()[..] else { panic!("one lock-up") };
    // The closed form was searched in steps of 1e-6.
    assert!(time <= first && time > first - 1.1e-6, "{time}, {first}");
    assert!(first > 7.0);
}
